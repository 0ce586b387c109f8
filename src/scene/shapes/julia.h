#ifndef SCENE_SHAPES_JULIA_H
#define SCENE_SHAPES_JULIA_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"

// The iterations of julia_fractal: h <- f(h) + c on quaternions or on hypercomplex
// numbers, which are pairs of complex numbers (spec/shapes.md 4.22).
enum julia_function {
    JULIA_SQR,
    JULIA_CUBE,
    JULIA_EXP,
    JULIA_RECIPROCAL,
    JULIA_SIN,
    JULIA_ASIN,
    JULIA_SINH,
    JULIA_ASINH,
    JULIA_COS,
    JULIA_ACOS,
    JULIA_COSH,
    JULIA_ACOSH,
    JULIA_TAN,
    JULIA_ATAN,
    JULIA_TANH,
    JULIA_ATANH,
    JULIA_LN,
    JULIA_PWR,
};

struct complex {
    double re, im;
};

struct julia {
    double c[4];
    bool hypercomplex;
    enum julia_function function;
    struct complex power; // of JULIA_PWR
    int iterations;
    double precision;
    double slice[4],
        distance;          // the hyperplane slice . h = distance, slice of unit length
    double start[4];       // w = start[3] + start . p
    double radius, escape; // everything is within the ball; |h|^2 > escape: outside
};

// The number of the first iterate that leaves the ball; j->iterations: none, p is inside.
// Else *step, if not NULL, is how far the surface is at least along the unit direction d,
// as estimated (0: no idea).
// *norm is that iterate's squared length, or the last one's.
int julia_escape(const struct julia *j, struct vec3 p, struct vec3 d, double *step,
                 double *norm);
// The gradient of iterate k's length, up to a factor.
struct vec3 julia_gradient(const struct julia *j, struct vec3 p, int k);
// Which iterate's gradient is the normal at the place `inner` of the line o + t d, just in the
// set, that it leaves (or enters) before (behind) the place `outer`.
uint32_t julia_normal(const struct julia *j, struct vec3 o, struct vec3 d, double inner,
                      double outer, bool exits);
// Whether julia_lanes.c knows the function.
bool julia_has_lanes(const struct julia *j);

#endif
