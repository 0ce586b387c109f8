#ifndef EVAL_TEXT_H
#define EVAL_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "base/arena.h"

// A string being put together, in an arena.
struct text_buffer {
    struct arena *arena;
    char *text; // terminated once anything was added
    size_t len, capacity;
};

void text_add(struct text_buffer *b, const char *text, size_t len);
void text_add_unit(struct text_buffer *b, uint32_t unit); // as UTF-8

// Strings are kept as UTF-8; the language counts 16-bit units, so one sequence is
// one unit. Reads one and advances *at; a byte that is no UTF-8 stands for itself.
uint32_t text_unit(const char **at, const char *end);
size_t text_units(const char *text, size_t len);

// Resolves the escapes of a literal (spec/language 1.3). In a path only \" is one.
// Returns NULL, or the first bad escape, and adds the text before it.
const char *text_unescape(struct text_buffer *b, const char *raw, size_t len, bool path);

#endif
