#ifndef SCENE_PATTERN_LANES_H
#define SCENE_PATTERN_LANES_H

// Functions of scene/pattern_math.h in lanes.
#include "math/pi.h"
#include "math/quick_lanes.h"
#include "scene/pattern_math.h"

// cycloidal.
LANES_INLINE struct real8 cycloidal8(struct real8 x)
{
    const struct mask8 up = r8_le(r8_set(0), x);
    const struct real8 turn =
        r8_select(up, r8_sub(x, r8_floor(x)), r8_neg(r8_add(x, r8_floor(r8_neg(x)))));
    struct real8 s, cosine;
    quick_sincos8(
        r8_mul(r8_div(r8_mul(turn, r8_set(50000.0)), r8_set(50000.0)), r8_set(2 * PI)),
        &s, &cosine);
    return r8_select(up, s, r8_neg(s));
}

#endif
