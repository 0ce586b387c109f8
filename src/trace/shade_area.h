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

LANES_INLINE void places_copy(double (*to)[8], const double (*from)[BATCH_SIZE],
                              int count, const uint32_t place[8], bool in_row)
{
    for (int a = 0; a < count; a++)
        if (in_row)
            memcpy(to[a], from[a] + place[0], sizeof to[a]);
        else
            for (int i = 0; i < 8; i++)
                to[a][i] = from[a][place[i]];
}

// Moves the points as area_point.
static void points_jitter(const uint32_t hash[8], const uint32_t point[8],
                          struct area_eight *e)
{
    for (int i = 0; i < 8; i++) {
        const uint32_t h = hash_mix(hash[i], point[i]);
        e->u[i] += hash_unit(hash_mix(h, 1)) - 0.5;
        e->v[i] += hash_unit(hash_mix(h, 2)) - 0.5;
    }
}

static void area_eight_of(const struct lamp *lamp, const struct area_places *from,
                          const struct area_ray *const ray[8], struct area_eight *e)
{
    const uint32_t size2 = (uint32_t)lamp->light->size2;
    uint32_t hash[8], place[8], point[8];
    bool to_one = true, in_row = true;
    for (uint32_t i = 0; i < 8; i++) {
        place[i] = ray[i]->place;
        point[i] = ray[i]->point;
        hash[i] = from->hash[place[i]];
        to_one &= point[i] == point[0];
        in_row &= place[i] == place[0] + i;
    }
    for (int i = 0; i < 8; i++) {
        e->u[i] = to_one && i ? e->u[0] : point[i] / size2;
        e->v[i] = to_one && i ? e->v[0] : point[i] % size2;
    }
    places_copy(e->p, from->p, 3, place, in_row);
    places_copy(e->ng, from->ng, 3, place, in_row);
    places_copy(&e->error, &from->error, 1, place, in_row);
    if (lamp->light->orient) {
        places_copy(e->axis1, from->axis1, 3, place, in_row);
        places_copy(e->axis2, from->axis2, 3, place, in_row);
    }
    if (lamp->light->jitter)
        points_jitter(hash, point, e);
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
