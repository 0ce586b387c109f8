// Files that a scene reads and writes (spec/language 3.13). Writing is kept below one
// folder: a scene from elsewhere must not reach the rest of the user's files.

#define _XOPEN_SOURCE 700 // realpath

#include "eval/file_io.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"
#include "eval/expr.h"
#include "eval/file_data.h"
#include "eval/symbol.h"

enum file_mode { FILE_CLOSED, FILE_READING, FILE_WRITING };

struct scene_file {
    struct scene_file *next;
    enum file_mode mode;
    bool was_written;
    const char *name, *path; // as the scene says; as it is opened
    FILE *out;
    struct file_data in;
};

const char *file_written(const struct eval *e, const char *name)
{
    for (const struct scene_file *f = e->files; f; f = f->next)
        if (f->was_written && strcmp(f->name, name) == 0) {
            if (f->out)
                fflush(f->out);
            return f->path;
        }
    return NULL;
}

static void close_file(struct eval *e, struct scene_file *f, struct span where)
{
    f->mode = FILE_CLOSED;
    if (!f->out)
        return;
    bool failed = ferror(f->out);
    if (fclose(f->out) != 0 || failed)
        diag_at(e->diags, DIAG_FILE_WRITE, where, f->path, strerror(errno));
    f->out = NULL;
}

void files_close(struct eval *e)
{
    for (struct scene_file *f = e->files; f; f = f->next)
        close_file(e, f, (struct span){0});
}

// ---- opening -----------------------------------------------------------------

static bool open_failed(struct eval *e, struct span where, const char *name)
{
    diag_hint(e->diags, DIAG_FILE_OPEN, where, file_hint(e), name, strerror(errno));
    return false;
}

const char *file_to_write(struct eval *e, const char *name, struct span where)
{
    const char *folder = e->options->output_folder ? e->options->output_folder : ".";
    const char *path =
        name[0] == '/' ? name : arena_printf(e->arena, "%s/%s", folder, name);
    const char *slash = strrchr(path, '/'), *last = slash + 1;
    const char *parent = arena_strndup(e->arena, path, (size_t)(last - path));
    char *real = realpath(parent, NULL);
    const char *found = NULL;
    e->file_refused = false;
    if (!real)
        open_failed(e, where, name);
    else if (!file_may_write(e, real))
        diag_hint(e->diags, DIAG_FILE_OUTSIDE, where,
                  "--permit-write DIR permits another folder", name, folder);
    else
        found = arena_printf(e->arena, "%s/%s", strcmp(real, "/") == 0 ? "" : real, last);
    free(real);
    return found;
}

// Neither follows a link out of the folder nor waits for a pipe.
static bool open_to_write(struct eval *e, struct scene_file *f, bool append,
                          struct span where)
{
    if (!(f->path = file_to_write(e, f->name, where)))
        return false;
    int flags = O_WRONLY | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
    int file = open(f->path, append ? flags | O_APPEND : flags, 0666);
    struct stat s;
    if (file < 0)
        return open_failed(e, where, f->name);
    bool ok = fstat(file, &s) == 0;
    if (ok && !S_ISREG(s.st_mode)) {
        errno = EINVAL;
        ok = false;
    }
    if (!ok || (!append && ftruncate(file, 0) != 0) || !(f->out = fdopen(file, "ab"))) {
        open_failed(e, where, f->name);
        close(file);
        return false;
    }
    f->mode = FILE_WRITING;
    return f->was_written = true;
}

static bool open_to_read(struct eval *e, struct scene_file *f, struct span where)
{
    errno = ENOENT;
    f->path = file_find(e, f->name, NULL);
    if (e->file_refused)
        errno = EACCES;
    if (!f->path || !file_read(e->arena, f->path, &f->in.text, &f->in.len))
        return open_failed(e, where, f->name);
    f->mode = FILE_READING;
    return true;
}

// After an error the name stands for a closed file, so that the rest is not reported.
static bool open_file(struct eval *e, struct span where, const struct lvalue *handle,
                      const struct ast *items)
{
    const char *name;
    struct scene_file *f = arena_new_struct(e->arena, struct scene_file);
    if (handle->index || !eval_path(e, items, &name))
        return false;
    struct place p =
        symbols_find(e->symbols, handle->name, handle->len, symbols_depth(e->symbols));
    const struct value *old = place_found(p) ? place_get(e->parse, p) : NULL;
    if (old) {
        diag_at(e->diags, DIAG_REDECLARED, handle->where, (int)handle->len, handle->name,
                value_kind_name(old));
        return false;
    }
    f->name = arena_strndup(e->arena, name, strlen(name));
    f->next = e->files;
    e->files = f;
    enum word mode = (enum word)items->next->word;
    bool ok = mode == WORD_read ? open_to_read(e, f, where)
                                : open_to_write(e, f, mode == WORD_append, where);
    p = symbols_make(e->symbols, handle->name, handle->len, false);
    return place_set(e->arena, p, value_new_data(e->arena, VALUE_FILE, f)) && ok;
}

static struct scene_file *file_of(struct eval *e, const struct lvalue *handle)
{
    struct place p =
        symbols_find(e->symbols, handle->name, handle->len, symbols_depth(e->symbols));
    const struct value *v = place_found(p) ? place_get(e->parse, p) : NULL;
    return v && v->kind == VALUE_FILE && !handle->index ? (struct scene_file *)v->data
                                                        : NULL;
}

static void forget(struct eval *e, const struct lvalue *handle, struct scene_file *f,
                   struct span where)
{
    close_file(e, f, where);
    symbols_remove(e->symbols, handle->name, handle->len);
}

// ---- #read -------------------------------------------------------------------

static bool read_items(struct eval *e, struct scene_file *f, struct span where,
                       const struct lvalue *handle, const struct ast *items)
{
    for (const struct ast *n = items; n; n = n->next) {
        struct value v;
        enum file_item found = file_data_next(&f->in, e->arena, &v);
        if (found == FILE_ITEM_WRONG)
            diag_at(e->diags, DIAG_FILE_DATA, where, f->path,
                    (unsigned)file_data_line(&f->in));
        if (found == FILE_ITEM_WRONG || found == FILE_ITEM_END) {
            forget(e, handle, f, where);
            return found == FILE_ITEM_END;
        }
        const struct value *kept =
            v.kind == VALUE_STRING
                ? value_new_string(e->arena, v.string.text, v.string.len)
                : &v;
        const struct lvalue to = {.name = n->text,
                                  .len = n->len,
                                  .where = n->where,
                                  .index = n->kind == AST_INDEX ? n->list : NULL};
        if (!eval_assign(e, &to, kept))
            return false;
        if (found == FILE_ITEM_LAST) {
            forget(e, handle, f, where);
            return true;
        }
    }
    return true;
}

// ---- #write ------------------------------------------------------------------

struct binary {
    enum word word;
    int bytes;
    bool big_endian;
    double min, max;
};

static const struct binary *binary_of(enum word w)
{
    static const struct binary kinds[] = {
        {WORD_uint8, 1, false, 0, 255},
        {WORD_sint8, 1, false, -128, 127},
        {WORD_uint16le, 2, false, 0, 65535},
        {WORD_uint16be, 2, true, 0, 65535},
        {WORD_sint16le, 2, false, -32768, 32767},
        {WORD_sint16be, 2, true, -32768, 32767},
        {WORD_sint32le, 4, false, -2147483648.0, 2147483647},
        {WORD_sint32be, 4, true, -2147483648.0, 2147483647},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (kinds[i].word == w)
            return &kinds[i];
    return NULL;
}

static void write_binary(FILE *out, const struct binary *b, double v)
{
    v = floor(v + 0.5);
    v = v >= b->min ? v : b->min;
    uint32_t n = (uint32_t)(int64_t)(v < b->max ? v : b->max);
    for (int i = 0; i < b->bytes; i++)
        putc((int)(n >> 8 * (b->big_endian ? b->bytes - 1 - i : i) & 255), out);
}

// The expressions after the word, up to a comma.
static const struct ast *write_run(struct eval *e, FILE *out, const struct ast *n,
                                   bool *ok)
{
    const struct binary *b = binary_of((enum word)n->word);
    bool more = !n->comma_after;
    for (n = n->next; n && more && *ok && n->kind != AST_WORD; n = n->next) {
        double v;
        more = !n->comma_after;
        *ok = eval_float(e, n, &v);
        if (*ok)
            write_binary(out, b, v);
    }
    return n;
}

static bool write_text(struct eval *e, FILE *out, const struct ast *n)
{
    const char *text;
    double v[5];
    int width;
    if (ast_is_string(n)) {
        if (!eval_string(e, n, &text))
            return false;
        fputs(text, out);
        return true;
    }
    if (!eval_number(e, n, 1, v, &width))
        return false;
    for (int i = 0; i < width; i++)
        fprintf(out, "%s%g", width == 1 ? "" : i ? "," : "<", v[i]);
    if (width > 1)
        fputs("> ", out);
    return true;
}

static bool write_items(struct eval *e, FILE *out, const struct ast *n)
{
    bool ok = true;
    while (n && ok) {
        if (n->kind == AST_WORD && binary_of((enum word)n->word)) {
            n = write_run(e, out, n, &ok);
        } else {
            ok = write_text(e, out, n);
            n = n->next;
        }
    }
    return ok;
}

bool eval_file_io(void *user, enum word directive, struct span where,
                  const struct lvalue *handle, const struct ast *items)
{
    struct eval *e = user;
    if (directive == WORD_fopen)
        return open_file(e, where, handle, items);
    struct scene_file *f = file_of(e, handle);
    if (directive == WORD_fclose) {
        if (f)
            forget(e, handle, f, where);
        return true;
    }
    bool reading = directive == WORD_read;
    if (!f || (f->mode != FILE_CLOSED && (f->mode == FILE_READING) != reading)) {
        diag_at(e->diags, DIAG_FILE_HANDLE, handle->where, (int)handle->len, handle->name,
                reading ? "read" : "written");
        return false;
    }
    if (f->mode == FILE_CLOSED) { // it could not be opened
        if (reading)
            forget(e, handle, f, where);
        return false;
    }
    return reading ? read_items(e, f, where, handle, items)
                   : write_items(e, f->out, items);
}
