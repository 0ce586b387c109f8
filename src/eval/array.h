#ifndef EVAL_ARRAY_H
#define EVAL_ARRAY_H

#include <stdbool.h>
#include <stdint.h>

#include "eval/value.h"

enum { ARRAY_DIMENSIONS_MAX = 5 };

// Elements in row order. The first element assigned fixes kind and width; numbers
// are kept unboxed. Changed in place by assignments to elements, copied whole
// when one name is assigned to another.
struct array_value {
    uint32_t dimensions, size[ARRAY_DIMENSIONS_MAX];
    uint32_t count;
    enum value_kind kind; // VALUE_NONE until an element is assigned
    uint8_t width;
    bool *set;
    double *number;               // width doubles an element
    const struct value **element; // of any other kind
};

// NULL when a size is below 1 or the product is too large.
struct array_value *array_new(struct arena *a, uint32_t dimensions, const long *size);
struct array_value *array_copy(struct arena *a, const struct array_value *from);
// The element, or NULL when none was assigned. Numbers are copied into `copies`.
const struct value *array_get(struct arena *copies, const struct array_value *v,
                              uint32_t index);
// All elements, at first: numbers of that width.
void array_fill(struct arena *a, struct array_value *v, const double *number,
                uint8_t width);
// False when v is of another kind or width than the elements.
bool array_set(struct arena *a, struct array_value *v, uint32_t index,
               const struct value *to);

#endif
