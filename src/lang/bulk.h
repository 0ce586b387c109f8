#ifndef LANG_BULK_H
#define LANG_BULK_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "lang/token.h"

struct arena;

// `n, <a, b>, <a, b>, ...`: the contents of a block of mesh2 as one token; or those of an
// array's braces, `1, 2, 3` or `{1, 2}, {3, 4}`, of numbers or of vectors. Only what
// programs write is taken: plain numbers, blanks, commas, exactly n vectors, rows of one
// length. Anything else (a comment, a name, a sum, a wrong count) is left to scanner and
// grammar, which give the same mesh or array and the errors.
enum { BULK_DIMENSIONS_MAX = 5 };

struct bulk {
    uint32_t count, width; // vectors, components of each
    uint32_t len;          // bytes of the text
    const double *number;  // count*width; NULL: whole numbers
    const uint32_t *index; // likewise, for lists of indices
    uint32_t dimensions;   // of an array
    uint32_t size[BULK_DIMENSIONS_MAX];
};

// text: what follows the '{' of block `w`. The bytes before its '}' and *out, or 0.
size_t bulk_scan(struct arena *a, enum word w, const char *text, size_t len,
                 struct bulk *out);

// The same of what follows the '{' of an array's elements.
size_t bulk_scan_array(struct arena *a, const char *text, size_t len, struct bulk *out);

// text: what follows a '<'. The bytes up to and with the '>' when three numbers are written
// out there, and the numbers; or 0.
size_t bulk_vector(const char *text, size_t len, double out[3]);

// Whether `w` is the word of such a block.
bool bulk_word(enum word w);

#endif
