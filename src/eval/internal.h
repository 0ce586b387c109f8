#ifndef EVAL_INTERNAL_H
#define EVAL_INTERNAL_H

#include "math/vec.h"
#include "scene/pattern.h"

// The functions `internal(i)` (spec/language Appendix A).

enum { INTERNAL_PARAMETERS_MAX = 10 };

struct internal_function {
    const char *name; // as functions.inc has it, without f_
    int parameters;   // after x, y, z
    double (*value)(struct vec3 at, const double *p, const struct pattern_defaults *d);
};

// NULL: there is no such number.
const struct internal_function *internal_function(double number);

#define INTERNAL_DECLARE(name)                                                           \
    double internal_##name(struct vec3 at, const double *p,                              \
                           const struct pattern_defaults *d);
#define INTERNAL(name, parameters, value)        INTERNAL_DECLARE(name)
#define LIMITED(name, parameters, value)         INTERNAL_DECLARE(name)
#define BOUNDED(name, parameters, value)         INTERNAL_DECLARE(name)
#define REVOLVED(name, parameters, first, value) INTERNAL_DECLARE(name)
#define WRITTEN(name, parameters)                INTERNAL_DECLARE(name)
#include "eval/internal.def"
#undef INTERNAL
#undef LIMITED
#undef BOUNDED
#undef REVOLVED
#undef WRITTEN
#undef INTERNAL_DECLARE

#endif
