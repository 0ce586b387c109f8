#ifndef TRACE_SHADE_LANES_H
#define TRACE_SHADE_LANES_H

// What shading needs beyond math/lanes.h: colours are floats, computed in lanes too.

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "math/acos_lanes.h"
#include "math/color.h"
#include "math/elementary.h"
#include "math/lanes_vec.h"
#include "math/pi.h"
#include "math/single_lanes.h"
#include "math/transform.h"
#include "trace/near_zero.h"

struct rgb8 {
    struct float8 r, g, b;
};
LANES_INLINE struct rgb8 rgb8_set(struct rgb c)
{
    return (struct rgb8){f8_set(c.r), f8_set(c.g), f8_set(c.b)};
}
LANES_INLINE struct rgb8 rgb8_load(const float c[3][8])
{
    return (struct rgb8){f8_load(c[0]), f8_load(c[1]), f8_load(c[2])};
}
LANES_INLINE void rgb8_store(float to[3][8], struct rgb8 c)
{
    f8_store(to[0], c.r);
    f8_store(to[1], c.g);
    f8_store(to[2], c.b);
}
LANES_INLINE struct rgb8 rgb8_add(struct rgb8 a, struct rgb8 b)
{
    return (struct rgb8){f8_add(a.r, b.r), f8_add(a.g, b.g), f8_add(a.b, b.b)};
}
LANES_INLINE struct rgb8 rgb8_mul(struct rgb8 a, struct rgb8 b)
{
    return (struct rgb8){f8_mul(a.r, b.r), f8_mul(a.g, b.g), f8_mul(a.b, b.b)};
}
LANES_INLINE struct rgb8 rgb8_scale(struct float8 s, struct rgb8 a)
{
    return (struct rgb8){f8_mul(s, a.r), f8_mul(s, a.g), f8_mul(s, a.b)};
}
LANES_INLINE unsigned black8(struct rgb8 c)
{
    const struct float8 o = f8_set(0);
    return f8_le(c.r, o) & f8_le(o, c.r) & f8_le(c.g, o) & f8_le(o, c.g) & f8_le(c.b, o) &
           f8_le(o, c.b);
}

// metal_tint of trace/shade_light.c.
LANES_INLINE struct rgb8 metal_tint8(struct rgb8 c, struct rgb8 tint, float metallic,
                                     struct real8 cosine)
{
    const struct real8 one = r8_set(1);
    const struct mask8 known = r8_le(r8_abs(cosine), one);
    const struct real8 angle = r8_abs(det_acos8(r8_select(known, cosine, one)));
    const struct real8 x = r8_sub(r8_div(angle, r8_set(PI / 2)), r8_set(1.12));
    const struct real8 y =
        r8_sub(r8_div(r8_set(0.014567225), r8_mul(x, x)), r8_set(0.011612903));
    const struct real8 share = r8_max(r8_min(y, one), r8_set(0));
    const struct float8 k = f8_mul(
        f8_set(metallic), f8_sub(f8_set(1), f8_of(r8_select(known, share, r8_set(0)))));
    const struct float8 o = f8_set(1);
    return rgb8_mul(c, (struct rgb8){f8_add(o, f8_mul(k, f8_sub(tint.r, o))),
                                     f8_add(o, f8_mul(k, f8_sub(tint.g, o))),
                                     f8_add(o, f8_mul(k, f8_sub(tint.b, o)))});
}

#endif
