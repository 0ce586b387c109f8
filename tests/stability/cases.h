#ifndef TESTS_STABILITY_CASES_H
#define TESTS_STABILITY_CASES_H

// One ray, one object, one true answer.
#include <math.h>

#include "math/vec.h"

enum flags {
    FIXED = 1, // the case is about exact numbers: not moved, not scaled
    STILL = 2, // not moved (the case is itself about size or place)
};

struct ray_case {
    const char *name, *object;
    struct vec3 o, d;
    double t;      // of the nearest surface; < 0: a miss
    struct vec3 n; // its unit normal, or 0: not looked at
    double tolerance;
    unsigned flags;
};

#define MISS (-1)
#define ANY_NORMAL                                                                       \
    {                                                                                    \
        0, 0, 0                                                                          \
    }
#define BOX  "box { -1, 1 }"
#define BALL "sphere { 0, 1 }"
#define ROD  "cylinder { -z, z, 1 }"

static const struct ray_case cases[] = {
#include "cases.def"
};

// T12: t = 3 - sqrt((1 + rho)^2 - z^2), rho = sqrt(r^2 - y^2), in long double.
static inline double torus_crest(const struct ray_case *c)
{
    long double rho = sqrtl(.0625L - (long double)c->o.y * c->o.y);
    return (double)(3 - sqrtl((1 + rho) * (1 + rho) - .01L));
}

#endif
