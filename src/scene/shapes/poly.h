#ifndef SCENE_SHAPES_POLY_H
#define SCENE_SHAPES_POLY_H

#include <stdint.h>

#include "math/aabb.h"
#include "math/polynomial.h"
#include "math/vec.h"

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

// Up to this order one expansion, about the point nearest to the origin, is as exact as need be on
// all of a line.
enum { POLY_LOW_ORDER = 7 };

// Roots whose error is so many times the rounding of where they are gain from another look.
enum { POLY_ROUGH = 64 };

// A polynomial in the ray's parameter, ascending powers; degree -1: zero. What lies behind
// the degree is not set.
struct line_poly {
    int degree;
    double c[POLYNOMIAL_DEGREE_MAX + 1];
};

// The polynomial along o + t d; its degree is not below 0.
void poly_along(const struct poly *s, struct vec3 o, struct vec3 d,
                struct line_poly *out);

// The sum of the terms' sizes with coordinates of these sizes.
double poly_magnitude(const struct poly *s, struct vec3 size);

// The sign changes on lo < t < hi of the polynomial along o + t u, |u| = 1, in ascending order;
// dt without the rounding of t itself. As exact as the terms at each root allow, whatever the
// order is and wherever o lies.
int poly_line_roots(const struct poly *s, struct vec3 o, struct vec3 u, double lo,
                    double hi, struct polynomial_root *root);

// A box around the set, from its rows; infinite where none is known. Where the terms of the
// highest degree are positive in all directions the set is bounded (poly_bounds.c).
struct aabb poly_bounds(const struct poly *s);

#endif
