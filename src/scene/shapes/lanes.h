#ifndef SCENE_SHAPES_LANES_H
#define SCENE_SHAPES_LANES_H

// What shapes that take eight rays at once have in common.
#include "math/gamma.h"
#include "math/isa.h"
#include "math/lanes.h"
#include "math/lanes_vec.h"
#include "scene/shape_kernels.h"

// Eight lines of unit directions, from their points nearest to the middle: t of a ray is
// (t of its line + shift) / length.
struct lines8 {
    struct vec8 o, u;
    struct real8 shift, length, lo, hi; // lo, hi: the rays' ranges
};

LANES_INLINE struct lines8 lines8_of(const struct shape_rays *rays, struct vec3 middle)
{
    const struct vec8 o = v8_load(rays->o), d = v8_load(rays->d);
    struct lines8 l = {.length = r8_sqrt(v8_dot(d, d))};
    const struct real8 per = r8_div(r8_set(1), l.length);
    l.u = (struct vec8){r8_mul(d.x, per), r8_mul(d.y, per), r8_mul(d.z, per)};
    l.shift = v8_dot(v8_sub(V8_SET(middle), o), l.u);
    l.o = v8_mad(o, l.shift, l.u);
    l.lo = r8_sub(r8_mul(r8_load(rays->t_min), l.length), l.shift);
    l.hi = r8_sub(r8_mul(r8_load(rays->t_max), l.length), l.shift);
    return l;
}

LANES_INLINE void lanes_slab(struct real8 o, struct real8 d, double min, double max,
                             struct real8 *lo, struct real8 *hi)
{
    const struct real8 inverse =
        r8_div(r8_set(1), d); // its sign is that of a direction -0
    const struct real8 p = r8_mul(r8_sub(r8_set(min), o), inverse);
    const struct real8 q = r8_mul(r8_sub(r8_set(max), o), inverse);
    const struct mask8 back = r8_lt(inverse, r8_set(0));
    // NaN, of a ray in a face, changes nothing.
    *lo = r8_max(r8_select(back, q, p), *lo);
    *hi = r8_min(r8_select(back, p, q), *hi);
}

// Narrows the ranges to where the lines are in a box; returns the lanes that are.
LANES_INLINE unsigned lines8_clip(struct lines8 *l, const struct aabb *box)
{
    lanes_slab(l->o.x, l->u.x, box->min.x, box->max.x, &l->lo, &l->hi);
    lanes_slab(l->o.y, l->u.y, box->min.y, box->max.y, &l->lo, &l->hi);
    lanes_slab(l->o.z, l->u.z, box->min.z, box->max.z, &l->lo, &l->hi);
    return m8_bits(r8_lt(l->lo, l->hi));
}

LANES_INLINE void lanes_put(double *to, unsigned lanes, struct real8 v)
{
    r8_store(to, r8_select(m8_of(lanes), v, r8_load(to)));
}

// Crossings of the lines' parameters t with errors dt, of which `leaving` are exits; returns
// the lanes where they are in the rays' ranges.
LANES_INLINE unsigned lines8_hits(const struct lines8 *l, const struct shape_rays *rays,
                                  unsigned lanes, struct real8 t, struct real8 dt,
                                  unsigned leaving, struct shape_hits *out)
{
    t = r8_div(r8_add(t, l->shift), l->length);
    lanes_put(out->t, lanes, t);
    lanes_put(out->dt, lanes, r8_div(dt, l->length));
    for (unsigned m = lanes; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        out->u[i] = out->v[i] = 0;
        out->part[i] = 0;
        out->crossing[i] = leaving >> i & 1 ? CROSS_EXIT : CROSS_ENTER;
    }
    return lanes & m8_bits(m8_and(r8_lt(r8_load(rays->t_min), t),
                                  r8_le(t, r8_load(rays->t_max))));
}

#endif
