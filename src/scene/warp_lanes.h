#ifndef SCENE_WARP_LANES_H
#define SCENE_WARP_LANES_H

// Warps of scene/warp.c at eight points, in the same order.
#include "math/lanes_vec.h"
#include "math/power_lanes.h"
#include "scene/pattern_math.h"

LANES_INLINE struct real8 block8(struct real8 v, double width)
{
    return width >= PATTERN_EDGE ? r8_floor(r8_div(v, r8_set(width))) : r8_set(0);
}

// Three random numbers for each block.
static inline struct vec8 block_random8(struct vec8 block)
{
    double b[3][8], r[3][8];
    v8_store(b, block);
    for (int l = 0; l < 8; l++) {
        const unsigned n = noise_cell_hash(b[0][l], b[1][l], b[2][l]);
        for (unsigned k = 0; k < 3; k++)
            r[k][l] = noise_random(n + k);
    }
    return v8_load((const double(*)[8])r);
}

static inline struct vec8 hole_center8(const struct warp *w, struct vec8 p)
{
    struct vec8 c = V8_SET(w->centre);
    const struct vec3 v = w->repeat, u = w->uncertainty;
    if (v.x == 0 && v.y == 0 && v.z == 0)
        return c;
    const struct vec8 b = {block8(p.x, v.x), block8(p.y, v.y), block8(p.z, v.z)};
    if (u.x != 0 || u.y != 0 || u.z != 0) {
        const struct vec8 r = block_random8(b);
        c = (struct vec8){r8_add(c.x, r8_mul(r.x, r8_set(u.x))),
                          r8_add(c.y, r8_mul(r.y, r8_set(u.y))),
                          r8_add(c.z, r8_mul(r.z, r8_set(u.z)))};
    }
    return (struct vec8){r8_add(c.x, r8_mul(r8_set(v.x), b.x)),
                         r8_add(c.y, r8_mul(r8_set(v.y), b.y)),
                         r8_add(c.z, r8_mul(r8_set(v.z), b.z))};
}

static inline struct vec8 black_hole8(const struct warp *w, struct vec8 p)
{
    const struct real8 radius = r8_set(w->radius), one = r8_set(1);
    const struct vec8 d = v8_sub(p, hole_center8(w, p));
    const struct real8 length = r8_sqrt(v8_dot(d, d));
    const struct mask8 in =
        m8_without(m8_of(w->type == 0 ? 255 : 0), r8_le(radius, length));
    if (!m8_bits(in))
        return p;
    const struct real8 part = r8_div(r8_sub(radius, length), radius);
    struct real8 k = r8_mul(det_pow8(r8_select(in, part, one), r8_set(w->falloff)),
                            r8_set(w->strength));
    k = r8_select(r8_lt(one, k), one, k);
    return v8_select(in, v8_mad(p, w->inverse ? r8_neg(k) : k, d), p);
}

#endif
