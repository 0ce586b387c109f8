#ifndef TRACE_SHADE_LAMP_H
#define TRACE_SHADE_LAMP_H

// What comes from one lamp at eight points.
#include "trace/lamp.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

struct light8 {
    struct vec8 to;
    struct real8 distance;
    struct rgb8 color;
};

// Light of its colour that comes the way `to`.
LANES_INLINE struct light8 from8(const struct light *light, struct vec8 to)
{
    struct light8 v; // not set to zero: it is large
    v.color = rgb8_set(light->color);
    v.distance = r8_sqrt(v8_dot(to, to));
    const struct real8 inv = r8_div(r8_set(1), v.distance);
    const struct vec8 unit = {r8_mul(inv, to.x), r8_mul(inv, to.y), r8_mul(inv, to.z)};
    v.to = v8_select(r8_lt(r8_set(0), v.distance), unit, to);
    return v;
}

// lamp_direction, from the lamp's centre.
LANES_INLINE struct light8 direction8(const struct lamp *lamp, struct vec8 p)
{
    const struct light *light = lamp->light;
    const struct vec8 to = v8_sub(V8_SET(light->location), p);
    if (!light->parallel && light->kind != LIGHT_CYLINDER)
        return from8(light, to);
    struct light8 v; // not set to zero: it is large
    struct lamp_view one;
    lamp_direction(lamp, light->location, light->location, &one);
    v.color = rgb8_set(light->color);
    v.to = V8_SET(one.l);
    v.distance = v8_dot(to, v.to);
    return v;
}

static bool is_black(struct rgb c)
{
    const float e = (float)NEAR_ZERO;
    return fabsf(c.r) < e && fabsf(c.g) < e && fabsf(c.b) < e;
}

// power, smooth and spot of trace/lamp.c.
LANES_INLINE struct real8 power8(struct real8 base, double exponent)
{
    return exponent == 0   ? r8_set(1)
           : exponent == 1 ? base
                           : r8_pow_single(base, exponent);
}

LANES_INLINE struct real8 smooth8(double low, double high, struct real8 v)
{
    const struct real8 t = r8_div(r8_sub(v, r8_set(low)), r8_set(high - low));
    const struct real8 s = r8_mul(r8_mul(t, t), r8_sub(r8_set(3), r8_mul(r8_set(2), t)));
    return r8_select(r8_lt(v, r8_set(low)), r8_set(0),
                     r8_select(r8_lt(v, r8_set(high)), s, r8_set(1)));
}

LANES_INLINE struct real8 spot8(const struct lamp *lamp, const struct light8 *v)
{
    const struct real8 along = v8_dot(v->to, V8_SET(lamp->light->axis));
    const struct real8 k = r8_select(r8_lt(r8_set(0), v->distance), r8_neg(along), along);
    const struct mask8 ahead = r8_lt(r8_set(0), k);
    if (!m8_bits(ahead))
        return r8_set(0);
    // Behind the lamp nothing is lit: any base will do.
    struct real8 factor = power8(r8_select(ahead, k, r8_set(1)), lamp->light->tightness);
    if (lamp->cos_radius > 0) {
        const struct real8 edge = smooth8(lamp->cos_falloff, lamp->cos_radius, k);
        factor =
            r8_select(r8_lt(k, r8_set(lamp->cos_radius)), r8_mul(factor, edge), factor);
    }
    return r8_select(ahead, factor, r8_set(0));
}

static struct real8 cylinders(const struct lamp *lamp, const double p[3][8],
                              const struct light8 *v)
{
    double to[3][8], distance[8], factor[8];
    v8_store(to, v->to);
    r8_store(distance, v->distance);
    for (int i = 0; i < 8; i++) {
        const struct lamp_view one = {
            {to[0][i], to[1][i], to[2][i]}, distance[i], lamp->light->color};
        factor[i] = lamp_attenuation(lamp, lamp->light->location,
                                     vec3(p[0][i], p[1][i], p[2][i]), &one);
    }
    return r8_load(factor);
}

// lamp_attenuation.
LANES_INLINE struct real8 attenuation8(const struct lamp *lamp, const double p[3][8],
                                       const struct light8 *v)
{
    const struct light *l = lamp->light;
    if (l->kind == LIGHT_CYLINDER)
        return cylinders(lamp, p, v); // with its fading
    struct real8 factor = l->kind == LIGHT_SPOT ? spot8(lamp, v) : r8_set(1);
    if (l->fade_power > 0 && l->fade_distance != 0)
        factor = r8_mul(
            factor,
            r8_div(r8_set(2),
                   r8_add(r8_set(1), power8(r8_div(v->distance, r8_set(l->fade_distance)),
                                            l->fade_power))));
    return factor;
}

// The rest of lamp_view; returns the lanes that are lit.
LANES_INLINE unsigned attenuate(const struct lamp *lamp, const struct simple_group *g,
                                struct light8 *v)
{
    const struct real8 factor = attenuation8(lamp, (const double(*)[8])g->p, v);
    const unsigned dark = m8_bits(r8_eq(factor, r8_set(0)));
    if (dark == 255)
        return 0;
    v->color = rgb8_scale(f8_of(factor), v->color);
    const struct float8 e = f8_set((float)NEAR_ZERO), o = f8_set(0);
    const unsigned seen = f8_le(e, f8_max(v->color.r, f8_sub(o, v->color.r))) |
                          f8_le(e, f8_max(v->color.g, f8_sub(o, v->color.g))) |
                          f8_le(e, f8_max(v->color.b, f8_sub(o, v->color.b)));
    return g->live & seen & ~dark;
}

#endif
