#include "trace/coincident.h"

#include <math.h>

#include "scene/shape.h"
#include "trace/packet.h"

static bool is_flat(const struct world *w, const struct world_object *o)
{
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (w->leaf[i].ops->flags & SHAPE_FLAT)
            return true;
    return false;
}

// Opaque objects with flat faces whose boxes meet a box.
enum { MOST = 64 };
struct others {
    uint32_t object[MOST], count;
};

static struct others others_near(const struct world *w, struct aabb box)
{
    struct others x = {.count = 0};
    uint32_t near[MOST];
    const uint32_t count = trace_boxes_meet(w->dark, box, near, MOST);
    for (uint32_t i = 0; i < count; i++)
        if (w->object[near[i]].opaque && w->object[near[i]].flat)
            x.object[x.count++] = near[i];
    return x;
}

void coincident_mark(struct world *w)
{
    if (!w->has_transparent)
        return;
    for (uint32_t i = 0; i < w->object_count; i++)
        w->object[i].flat = is_flat(w, &w->object[i]);
    for (uint32_t i = 0; i < w->object_count; i++) {
        struct world_object *o = &w->object[i];
        const struct aabb box = aabb_is_finite(o->bounds) ? o->bounds : w->bounds;
        o->may_coincide = !o->opaque && o->flat && others_near(w, box).count > 0;
        w->has_coincident |= o->may_coincide;
    }
}

static bool is_opaque(const struct world *w, uint32_t leaf)
{
    return w->surface[w->leaf[leaf].surface].opaque;
}

static struct aabb box_around(struct vec3 p, double reach)
{
    const struct vec3 r = vec3(reach, reach, reach);
    return (struct aabb){vec3_sub(p, r), vec3_add(p, r)};
}

void coincident_hits(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const struct hit_batch *hit)
{
    // Errors of the opaque face's distance that are looked for, in those of the clear one's.
    static const double wide = 8;
    for (uint32_t i = 0; i < rays->count; i++) {
        const double t = hit->t[i], dt = hit->dt[i];
        if (!(t < INFINITY) || !w->object[w->leaf[hit->leaf[i]].object].may_coincide ||
            is_opaque(w, hit->leaf[i]))
            continue;
        const struct ray_query q = {
            .ray = {.o = {rays->o[0][i], rays->o[1][i], rays->o[2][i]},
                    .d = {rays->d[0][i], rays->d[1][i], rays->d[2][i]},
                    .t_min = fmax(rays->t_min[i], t - wide * dt),
                    .t_max = fmin(rays->t_max[i], t + wide * dt)},
            .hidden_by = rays->hidden_by[i]};
        const struct others x = others_near(
            w, box_around(ray_at(&q.ray, t), wide * dt * vec3_max_abs(q.ray.d)));
        struct search f = search_of(w, s, &q, SWEEP_CLOSEST);
        for (uint32_t k = 0; k < x.count; k++)
            search_try_object(&f, x.object[k]);
        if (f.object != UINT32_MAX && fabs(f.t - t) <= f.b.dt + dt)
            hit_batch_put(hit, i, &f.b);
    }
}
