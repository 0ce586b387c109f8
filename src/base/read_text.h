#ifndef BASE_READ_TEXT_H
#define BASE_READ_TEXT_H

#include <stddef.h>
#include <stdio.h>

struct arena;

enum { TEXT_END = 2 }; // zero bytes after a text that text_read made

// `prefix` and the rest of the file, in the arena, with TEXT_END zero bytes after it. NULL
// when reading failed, or, with *len above `most`, for a longer text.
char *text_read(FILE *in, struct arena *a, const char *prefix, size_t most, size_t *len);

#endif
