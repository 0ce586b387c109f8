// The search for files (spec/language 3.11), and where they may be.
#define _XOPEN_SOURCE 700 // realpath

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/arena.h"
#include "base/read_text.h"
#include "eval/expr.h"
#include "eval/file_io.h"

static bool is_file(const char *path)
{
    struct stat s;
    return stat(path, &s) == 0 && S_ISREG(s.st_mode);
}

static const char *find_exact(struct eval *e, const char *name)
{
    const char *written = file_written(e, name);
    if (written)
        return written;
    if (is_file(name))
        return arena_strndup(e->arena, name, strlen(name));
    for (uint32_t i = 0; *name != '/' && i < e->options->library_path_count; i++) {
        const char *folder = e->options->library_path[i];
        size_t len = strlen(folder);
        const char *slash = len && folder[len - 1] == '/' ? "" : "/";
        const char *path = arena_printf(e->arena, "%s%s%s", folder, slash, name);
        if (is_file(path))
            return path;
    }
    return NULL;
}

// Whether what a path leads to, all links followed, lies in a folder that is there or in
// one below it.
static bool file_is_below(const char *folder, const char *path)
{
    char *real_folder = realpath(folder, NULL), *real = realpath(path, NULL);
    size_t n = real_folder ? strlen(real_folder) : 0;
    bool root = n == 1;
    bool below = real_folder && real && strncmp(real_folder, real, n) == 0 &&
                 (root || real[n] == '/' || real[n] == 0);
    free(real_folder);
    free(real);
    return below;
}

bool file_may_write(const struct eval *e, const char *path)
{
    const struct eval_options *o = e->options;
    bool may = file_is_below(o->output_folder ? o->output_folder : ".", path);
    for (uint32_t i = 0; !may && i < o->write_folder_count; i++)
        may = file_is_below(o->write_folder[i], path);
    return may;
}

static bool may_read(const struct eval *e, const char *path)
{
    const struct eval_options *o = e->options;
    bool may = !o->read_folder_count;
    for (uint32_t i = 0; !may && i < o->read_folder_count; i++)
        may = file_is_below(o->read_folder[i], path);
    return may || file_may_write(e, path);
}

const char *file_hint(const struct eval *e)
{
    return e->file_refused ? "it is there but may not be read; --permit-read DIR permits "
                             "another folder"
                           : NULL;
}

static bool ends_in(const char *name, const char *extension)
{
    size_t n = strlen(name), m = strlen(extension);
    return n > m && !strcmp(name + n - m, extension);
}

const char *file_find(struct eval *e, const char *name, const char *const *extensions)
{
    bool known = !extensions;
    for (const char *const *x = extensions; x && *x; x++)
        known |= ends_in(name, *x);
    const char *found = known ? find_exact(e, name) : NULL;
    for (const char *const *x = extensions; !found && x && *x; x++)
        found = find_exact(e, arena_printf(e->parse, "%s%s", name, *x));
    if (!found && !known)
        found = find_exact(e, name);
    e->file_refused = found && !may_read(e, found);
    if (e->file_refused)
        return NULL;
    if (found && e->options->file_found)
        e->options->file_found(e->options->file_user, found);
    return found;
}

bool file_read(struct arena *a, const char *path, const char **text, size_t *len)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return false;
    *text = text_read(in, a, "", SIZE_MAX / 4, len);
    fclose(in);
    return *text;
}
