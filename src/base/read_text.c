#include "base/read_text.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/arena.h"

// What is left of a plain file, read where it will stay; NULL: it is none, or has changed.
static char *read_plain(FILE *in, struct arena *a, const char *prefix, size_t most,
                        size_t *len)
{
    struct stat s;
    const size_t before = strlen(prefix);
    const int fd = fileno(in);
    if (fd < 0 || fstat(fd, &s) || !S_ISREG(s.st_mode) || ftell(in) != 0 ||
        s.st_size <= 0)
        return NULL;
    *len = before + (size_t)s.st_size;
    if (*len > most)
        return NULL;
    setvbuf(in, NULL, _IONBF, 0); // all of it is read at once
    const struct arena_mark mark = arena_mark(a);
    char *text = arena_alloc(a, *len + TEXT_END);
    memcpy(text, prefix, before);
    if (fread(text + before, 1, (size_t)s.st_size, in) == (size_t)s.st_size &&
        fgetc(in) == EOF)
        return text;
    arena_rewind(a, mark);
    rewind(in);
    return NULL;
}

char *text_read(FILE *in, struct arena *a, const char *prefix, size_t most, size_t *len)
{
    char *kept = read_plain(in, a, prefix, most, len);
    if (kept)
        return kept;
    size_t used = strlen(prefix), capacity = used + 65536;
    char *text = malloc(capacity);
    if (text)
        memcpy(text, prefix, used);
    for (size_t got = 1; text && got && used <= most; used += got) {
        if (used == capacity) {
            char *more = realloc(text, capacity *= 2);
            if (!more)
                free(text);
            text = more;
            if (!text)
                break;
        }
        got = fread(text + used, 1, capacity - used, in);
    }
    *len = used;
    if (text && used <= most && !ferror(in)) {
        kept = arena_alloc(a, used + TEXT_END);
        memcpy(kept, text, used);
    }
    free(text);
    return kept;
}
