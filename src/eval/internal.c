// The table of internal functions, and those that are one formula.

#include "eval/internal.h"

#include "eval/internal_math.h"

#define CUSHION                                                                          \
    C *A - C *C - 2 * z *A + 2 * C *z + A - C - square(A - z) - B *B - 2 * A *B -        \
        B *C + 2 * B *z + B

#define FORMULA(name, point, value)                                                      \
    double internal_##name(struct vec3 at, const double *p,                              \
                           const struct pattern_defaults *d)                             \
    {                                                                                    \
        const struct vec3 q = point;                                                     \
        const double x = q.x, y = q.y, z = q.z, A = x * x, B = y * y, C = z * z;         \
        (void)x, (void)y, (void)z, (void)A, (void)B, (void)C, (void)p, (void)d;          \
        return value;                                                                    \
    }
#define INTERNAL(name, parameters, value) FORMULA(name, at, value)
#define LIMITED(name, parameters, value)                                                 \
    FORMULA(name, at, bounded(p[0] * (value), 10))
#define BOUNDED(name, parameters, value)                                                 \
    FORMULA(name, revolved(at, p + 2), bounded(p[0] * (value), p[1]))
#define REVOLVED(name, parameters, first, value)                                         \
    FORMULA(name, revolved(at, p + first), bounded(p[0] * (value), 10))
#define WRITTEN(name, parameters)
#include "eval/internal.def"
#undef INTERNAL
#undef LIMITED
#undef BOUNDED
#undef REVOLVED
#undef WRITTEN

static const struct internal_function functions[] = {
#define ROW(name, parameters) {#name, parameters, internal_##name},
#define INTERNAL(name, parameters, value)        ROW(name, parameters)
#define LIMITED(name, parameters, value)         ROW(name, parameters)
#define BOUNDED(name, parameters, value)         ROW(name, parameters)
#define REVOLVED(name, parameters, first, value) ROW(name, parameters)
#define WRITTEN(name, parameters)                ROW(name, parameters)
#include "eval/internal.def"
};

const struct internal_function *internal_function(double number)
{
    const double count = sizeof functions / sizeof functions[0];
    return number >= 0 && number < count ? &functions[(int)number] : NULL;
}
