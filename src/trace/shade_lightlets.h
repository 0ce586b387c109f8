#ifndef TRACE_SHADE_LIGHTLETS_H
#define TRACE_SHADE_LIGHTLETS_H

// Lights with area_illumination at eight points: every point of the grid lights for itself.
#include "trace/area.h"
#include "trace/shade_area.h"
#include "trace/shade_lamp.h"

// The grid as the points see it.
static void lightlets_of(const struct tracer *t, const struct lamp *lamp,
                         const struct simple_group *g, struct area_eight *e,
                         uint32_t hash[8])
{
    memcpy(e->p, g->p, sizeof e->p);
    for (int i = 0; i < 8; i++) {
        if (lamp->light->jitter)
            hash[i] = hash_mix(area_lit_hash(wave_hash(t, g->slot[i])), lamp->index);
        if (!lamp->light->orient)
            continue;
        const struct lamp_grid grid =
            lamp_grid_of(lamp, vec3(g->p[0][i], g->p[1][i], g->p[2][i]));
        e->axis1[0][i] = grid.axis1.x, e->axis2[0][i] = grid.axis2.x;
        e->axis1[1][i] = grid.axis1.y, e->axis2[1][i] = grid.axis2.y;
        e->axis1[2][i] = grid.axis1.z, e->axis2[2][i] = grid.axis2.z;
    }
}

// lamp_view of one point of the grid; *live: the lanes that it lights.
LANES_INLINE struct light8 lightlet8(const struct lamp *lamp, uint32_t point,
                                     const uint32_t hash[8], struct area_eight *e,
                                     unsigned *live)
{
    const uint32_t size2 = (uint32_t)lamp->light->size2;
    uint32_t points[8];
    for (int i = 0; i < 8; i++) {
        points[i] = point;
        e->u[i] = point / size2;
        e->v[i] = point % size2;
    }
    if (lamp->light->jitter)
        points_jitter(hash, points, e);
    const double(*p)[8] = (const double(*)[8])e->p;
    struct light8 v = from8(lamp->light, v8_sub(area_point8(lamp->light, e), v8_load(p)));
    const struct real8 factor = attenuation8(lamp, p, &v);
    *live &= ~m8_bits(r8_eq(factor, r8_set(0)));
    v.color = rgb8_scale(f8_of(factor), v.color);
    return v;
}

#endif
