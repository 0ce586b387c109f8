#ifndef TRACE_SHADE_AREA_H
#define TRACE_SHADE_AREA_H

// Rays from places on surfaces to points of area lights.
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

// The places of eight rays, and the points that they go to.
struct area_eight {
    double p[3][8], ng[3][8], axis1[3][8], axis2[3][8], error[8];
    double u[8], v[8]; // of the point
};

static void area_eight_of(const struct lamp *lamp, const struct area_places *from,
                          const struct area_ray *const ray[8], struct area_eight *e)
{
    const uint32_t size2 = (uint32_t)lamp->light->size2;
    uint32_t hash[8], h[2][8];
    for (int i = 0; i < 8; i++) {
        const uint32_t k = ray[i]->place;
        for (int a = 0; a < 3; a++) {
            e->p[a][i] = from->p[a][k];
            e->ng[a][i] = from->ng[a][k];
        }
        e->error[i] = from->error[k];
        e->u[i] = ray[i]->point / size2;
        e->v[i] = ray[i]->point % size2;
        hash[i] = from->hash[k];
    }
    for (int i = 0; i < 8 && lamp->light->orient; i++)
        for (int a = 0; a < 3; a++) {
            e->axis1[a][i] = from->axis1[a][ray[i]->place];
            e->axis2[a][i] = from->axis2[a][ray[i]->place];
        }
    if (!lamp->light->jitter)
        return;
    for (int i = 0; i < 8; i++)
        hash[i] = hash_mix(hash[i], ray[i]->point);
    for (int i = 0; i < 8; i++) {
        h[0][i] = hash_mix(hash[i], 1);
        h[1][i] = hash_mix(hash[i], 2);
    }
    for (int i = 0; i < 8; i++) {
        e->u[i] += hash_unit(h[0][i]) - 0.5;
        e->v[i] += hash_unit(h[1][i]) - 0.5;
    }
}

// lamp_grid_point.
LANES_INLINE struct vec8 area_point8(const struct light *l, const struct area_eight *e)
{
    const struct real8 half = r8_set(0.5), shift = r8_set(0.001);
    struct real8 u = r8_set(0), v = r8_set(0);
    if (l->size1 > 1)
        u = r8_sub(r8_div(r8_load(e->u), r8_set(l->size1 - 1)), half);
    if (l->size2 > 1)
        v = r8_sub(r8_div(r8_load(e->v), r8_set(l->size2 - 1)), half);
    if (l->circular) {
        u = r8_add(u, shift);
        v = r8_add(v, shift);
        const struct real8 squash = r8_div(r8_max(r8_abs(u), r8_abs(v)),
                                           r8_sqrt(r8_add(r8_mul(u, u), r8_mul(v, v))));
        u = r8_mul(u, squash);
        v = r8_mul(v, squash);
    }
    const struct vec8 axis1 =
        l->orient ? v8_load((const double(*)[8])e->axis1) : V8_SET(l->axis1);
    const struct vec8 axis2 =
        l->orient ? v8_load((const double(*)[8])e->axis2) : V8_SET(l->axis2);
    return v8_mad(v8_mad(V8_SET(l->location), u, axis1), v, axis2);
}

// lamp_direction to a point of the lamp, and trace_offset.
static void toward(const struct lamp *lamp, const struct area_places *places,
                   const struct area_ray *ray, uint32_t count, struct ray_batch *out)
{
    const struct light *light = lamp->light;
    const struct real8 none = r8_set(0), one = r8_set(1);
    for (uint32_t i = 0; i < count; i += 8) {
        const struct area_ray *eight[8];
        struct area_eight e;
        for (uint32_t k = 0; k < 8; k++)
            eight[k] = &ray[i + k < count ? i + k : count - 1];
        area_eight_of(lamp, places, eight, &e);
        const struct vec8 p = v8_load((const double(*)[8])e.p),
                          ng = v8_load((const double(*)[8])e.ng);
        const struct vec8 at = area_point8(light, &e), to = v8_sub(at, p);
        struct vec8 d;
        struct real8 length;
        if (light->parallel || light->kind == LIGHT_CYLINDER) {
            d = v8_normalize(v8_sub(at, V8_SET(light->point_at)));
            length = v8_dot(to, d);
        } else {
            length = r8_sqrt(v8_dot(to, to));
            const struct real8 k =
                r8_select(r8_lt(none, length), r8_div(one, length), one);
            d = (struct vec8){r8_mul(k, to.x), r8_mul(k, to.y), r8_mul(k, to.z)};
        }
        const struct real8 side = r8_select(r8_lt(v8_dot(d, ng), none), r8_set(-1), one);
        const struct real8 by = r8_mul(r8_mul(r8_set(2), side), r8_load(e.error));
        const struct vec8 o = v8_mad(p, by, ng);
        r8_store(out->o[0] + i, o.x);
        r8_store(out->o[1] + i, o.y);
        r8_store(out->o[2] + i, o.z);
        r8_store(out->d[0] + i, d.x);
        r8_store(out->d[1] + i, d.y);
        r8_store(out->d[2] + i, d.z);
        r8_store(out->t_max + i, length);
    }
}

#endif
