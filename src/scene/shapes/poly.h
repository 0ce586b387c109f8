#ifndef SCENE_SHAPES_POLY_H
#define SCENE_SHAPES_POLY_H

#include <stdint.h>

#include "math/aabb.h"
#include "math/polynomial.h"

// The powers of z that go with one product of powers of x and y, from the highest that occurs.
struct poly_row {
    int x, y, top;
    const double *c;
};

// The set where a polynomial in x, y, z is negative.
struct poly {
    int order;
    const double *coefficient;
    const struct poly_row *row; // those that are not zero
    uint32_t rows;
    struct aabb box; // of the set and its surface
    bool compact;    // box is finite
};

// A box around the set, from its rows; infinite where none is known. Where the terms of the
// highest degree are positive in all directions the set is bounded (poly_bounds.c).
struct aabb poly_bounds(const struct poly *s);

#endif
