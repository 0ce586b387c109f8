// Hints for names that are not declared and includes that are not there, from what the
// includes of the library path declare.
#define _XOPEN_SOURCE 700

#include "eval/include_hint.h"

#include <ctype.h>
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/arena.h"
#include "eval/expr.h"
#include "eval/symbol.h"

enum {
    INCLUDE_BYTES_MAX = 4 << 20, // the standard ones have 120 kB at most
    INCLUDES_MAX = 1024,
    NAMES_MAX = 1 << 16,
};

struct include {
    const char *folder, *name;
};

struct include_list {
    struct include file[INCLUDES_MAX];
    size_t count;
};

// What includes declare, at most NAMES_MAX of it.
struct declared_names {
    const char **name;
    const struct include **home;
    size_t count;
};

static bool is_include(const char *folder, const char *name)
{
    size_t len = strlen(name);
    char path[4096];
    struct stat s;
    return len > 4 && !strcmp(name + len - 4, ".inc") &&
           snprintf(path, sizeof path, "%s/%s", folder, name) < (int)sizeof path &&
           stat(path, &s) == 0 && S_ISREG(s.st_mode) && s.st_size <= INCLUDE_BYTES_MAX;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct include *)a)->name, ((const struct include *)b)->name);
}

// In the order of the search; those of a folder by name, as readdir has no order of its own.
static const struct include_list *list_includes(struct eval *e)
{
    struct include_list *l = arena_new_struct(e->parse, struct include_list);
    for (uint32_t i = 0; i < e->options->library_path_count; i++) {
        const char *folder = e->options->library_path[i];
        size_t first = l->count;
        DIR *dir = opendir(folder);
        for (struct dirent *d; dir && l->count < INCLUDES_MAX && (d = readdir(dir));)
            if (is_include(folder, d->d_name))
                l->file[l->count++] = (struct include){
                    folder, arena_strndup(e->parse, d->d_name, strlen(d->d_name))};
        if (dir)
            closedir(dir);
        qsort(l->file + first, l->count - first, sizeof *l->file, by_name);
    }
    return l;
}

static const char *skip_blanks(const char *at)
{
    while (*at == ' ' || *at == '\t')
        at++;
    return at;
}

static size_t name_length(const char *at)
{
    size_t n = 0;
    while (isalnum((unsigned char)at[n]) || at[n] == '_')
        n++;
    return n;
}

// After blanks, the word, whole: what comes then. NULL: something else.
static const char *after_word(const char *at, const char *word)
{
    at = skip_blanks(at);
    size_t len = strlen(word);
    return name_length(at) == len && !strncmp(at, word, len) ? at + len : NULL;
}

// The name that a line declares where it begins, *len letters; 0: none. What is indented is
// mostly a macro's own.
static const char *line_declares(const char *line, bool macro, size_t *len)
{
    *len = 0;
    if (*line != '#')
        return line;
    const char *at = after_word(line + 1, "macro");
    if (!at && !macro)
        at = after_word(line + 1, "declare");
    if (!at)
        return line;
    at = skip_blanks(at);
    *len = name_length(at);
    return at;
}

static void add_declared(struct eval *e, const struct include *home, bool macro,
                         struct declared_names *d)
{
    const char *text;
    size_t bytes, len;
    if (!file_read(e->parse, arena_printf(e->parse, "%s/%s", home->folder, home->name),
                   &text, &bytes))
        return;
    for (const char *line = text; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        const char *name = line_declares(line, macro, &len);
        if (!len || d->count == NAMES_MAX)
            continue;
        d->name[d->count] = arena_strndup(e->parse, name, len);
        d->home[d->count++] = home;
    }
}

static struct declared_names declared_names(struct eval *e, bool macro)
{
    struct declared_names d = {
        arena_new_array(e->parse, const char *, NAMES_MAX),
        arena_new_array(e->parse, const struct include *, NAMES_MAX), 0};
    const struct include_list *l = list_includes(e);
    for (size_t i = 0; i < l->count; i++)
        add_declared(e, &l->file[i], macro, &d);
    return d;
}

static size_t place_of(const struct declared_names *d, const char *name, size_t len)
{
    size_t i = 0;
    while (i < d->count && (strlen(d->name[i]) != len || memcmp(d->name[i], name, len)))
        i++;
    return i;
}

const char *undeclared_hint(struct eval *e, const char *name, size_t len,
                            enum undeclared_kind kind, const char *word)
{
    struct declared_names d;
    size_t i;
    const bool macro = kind != UNDECLARED_VALUE;
    for (int macros = kind == UNDECLARED_MACRO; macros <= macro; macros++) {
        d = declared_names(e, macros);
        i = place_of(&d, name, len);
        if (i < d.count)
            return arena_printf(e->parse, "declared in \"%s\": #include it first",
                                d.home[i]->name);
    }
    const char *close = word ? word : symbols_closest(e->symbols, name, len, macro);
    if (close)
        return arena_printf(e->parse, "did you mean '%s'?", close);
    close = diag_closest(name, len, d.name, d.count);
    if (!close)
        return NULL;
    i = place_of(&d, close, strlen(close));
    return arena_printf(e->parse, "did you mean '%s' of \"%s\"?", close, d.home[i]->name);
}

const char *include_hint(struct eval *e, const char *name)
{
    const struct include_list *l = list_includes(e);
    const char **names = arena_new_array(e->parse, const char *, l->count + 1);
    for (size_t i = 0; i < l->count; i++)
        names[i] = l->file[i].name;
    const char *close = diag_closest(name, strlen(name), names, l->count);
    return close ? arena_printf(e->parse, "did you mean \"%s\"?", close) : NULL;
}
