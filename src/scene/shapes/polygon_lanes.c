// Eight rays and a polygon, compiled once per instruction set: the operations of polygon.c,
// with the same bits.
#include "scene/shapes/lanes.h"
#include "scene/shapes/polygon.h"

LANES_INLINE struct real8 axis8(struct vec8 p, int axis)
{
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

// The lanes whose point the polygon covers.
static unsigned covers8(const struct polygon *s, struct vec8 p, unsigned lanes)
{
    const struct real8 pu = axis8(p, s->u), pv = axis8(p, s->v);
    unsigned in = 0;
    for (uint32_t i = 0; i + 1 < s->count; i++) {
        if (s->last[i])
            continue;
        const double av = vec3_axis(s->point[i], s->v);
        const double bv = vec3_axis(s->point[i + 1], s->v);
        const unsigned across =
            lanes & (m8_bits(r8_lt(pv, r8_set(av))) ^ m8_bits(r8_lt(pv, r8_set(bv))));
        if (!across)
            continue;
        const double au = vec3_axis(s->point[i], s->u);
        const double bu = vec3_axis(s->point[i + 1], s->u);
        const struct real8 share = r8_div(r8_sub(pv, r8_set(av)), r8_set(bv - av));
        const struct real8 at = r8_add(r8_set(au), r8_mul(share, r8_set(bu - au)));
        in ^= across & m8_bits(r8_lt(pu, at));
    }
    return in;
}

unsigned OF_ISA(polygon_closest8_)(const struct polygon *s, const struct shape_rays *rays,
                                   unsigned lanes, struct shape_hits *out)
{
    if (!s->drawn)
        return 0;
    const struct vec8 o = v8_load(rays->o), d = v8_load(rays->d), n = V8_SET(s->normal);
    const struct real8 down = v8_dot(n, d);
    const struct real8 t = r8_div(v8_dot(n, v8_sub(V8_SET(s->origin), o)), down);
    lanes &=
        m8_bits(m8_and(r8_lt(r8_load(rays->t_min), t), r8_le(t, r8_load(rays->t_max))));
    lanes &= m8_bits(r8_lt(r8_abs(t), r8_set(INFINITY)));
    if (lanes)
        lanes = covers8(s, v8_mad(o, t, d), lanes);
    if (!lanes)
        return 0;
    const struct real8 size =
        r8_add(r8_add(v8_max_abs(o), r8_set(vec3_max_abs(s->origin))),
               r8_mul(r8_abs(t), v8_max_abs(d)));
    r8_store(out->t, t);
    r8_store(out->dt, r8_div(r8_mul(r8_set(GAMMA(12)), size), r8_abs(down)));
    for (int i = 0; i < 8; i++) {
        out->u[i] = out->v[i] = 0;
        out->part[i] = 0;
        out->crossing[i] = CROSS_TOUCH;
    }
    return lanes;
}
