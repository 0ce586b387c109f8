// The search for files (spec/language 3.11).

#include <ctype.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/arena.h"
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
    if (found && e->options->file_found)
        e->options->file_found(e->options->file_user, found);
    return found;
}

bool file_read(struct arena *a, const char *path, const char **text, size_t *len)
{
    FILE *in = fopen(path, "rb");
    if (!in)
        return false;
    char *buffer = NULL;
    size_t used = 0, capacity = 0;
    for (size_t got = 1; got;) {
        if (used == capacity) {
            capacity = 2 * capacity + (1 << 16);
            char *grown = realloc(buffer, capacity);
            if (!grown)
                break;
            buffer = grown;
        }
        got = fread(buffer + used, 1, capacity - used, in);
        used += got;
    }
    bool ok = !ferror(in);
    fclose(in);
    if (ok)
        *text = arena_strndup(a, buffer ? buffer : "", used);
    *len = used;
    free(buffer);
    return ok;
}
