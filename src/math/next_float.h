#ifndef MATH_NEXT_FLOAT_H
#define MATH_NEXT_FLOAT_H

// The neighbours of a float: nextafterf towards either infinity, without its call.
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static inline float float_above(float f)
{
    uint32_t bits;
    if (f == 0)
        return FLT_TRUE_MIN;
    if (!(f < INFINITY))
        return f;
    memcpy(&bits, &f, sizeof bits);
    bits += f > 0 ? 1u : -1u;
    memcpy(&f, &bits, sizeof f);
    return f;
}

static inline float float_below(float f) { return -float_above(-f); }

#endif
