#include "trace/coincident.h"

#include <math.h>

#include "scene/shape.h"

static bool is_flat(const struct world *w, const struct world_object *o)
{
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (w->leaf[i].ops->flags & SHAPE_FLAT)
            return true;
    return false;
}

static bool touches_opaque(const struct world *w, const struct world_object *o)
{
    enum { MOST = 64 };
    uint32_t near[MOST];
    const struct aabb box = aabb_is_finite(o->bounds) ? o->bounds : w->bounds;
    const uint32_t count = trace_boxes_meet(w->dark, box, near, MOST);
    for (uint32_t i = 0; i < count; i++)
        if (&w->object[near[i]] != o && is_flat(w, &w->object[near[i]]))
            return true;
    return count == MOST;
}

void coincident_mark(struct world *w)
{
    if (!w->has_transparent)
        return;
    for (uint32_t i = 0; i < w->object_count; i++) {
        struct world_object *o = &w->object[i];
        o->may_coincide = !o->opaque && is_flat(w, o) && touches_opaque(w, o);
        w->has_coincident |= o->may_coincide;
    }
}

static bool is_opaque(const struct world *w, uint32_t leaf)
{
    return w->surface[w->leaf[leaf].surface].opaque;
}

void coincident_hits(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const struct hit_batch *hit)
{
    // Errors of the opaque face's distance that are looked for, in those of the clear one's.
    static const double wide = 8;
    for (uint32_t i = 0; i < rays->count; i++) {
        const double t = hit->t[i];
        if (!(t < INFINITY) || !w->object[w->leaf[hit->leaf[i]].object].may_coincide ||
            is_opaque(w, hit->leaf[i]))
            continue;
        const double dt = hit->dt[i];
        const struct ray_query q = {
            .ray = {.o = {rays->o[0][i], rays->o[1][i], rays->o[2][i]},
                    .d = {rays->d[0][i], rays->d[1][i], rays->d[2][i]},
                    .t_min = fmax(rays->t_min[i], t - wide * dt),
                    .t_max = fmin(rays->t_max[i], t + wide * dt)},
            .hidden_by = rays->hidden_by[i]};
        const struct hit met = trace_closest_1(w->dark, s, &q);
        if (met.b.t < INFINITY && fabs(met.b.t - t) <= met.b.dt + dt &&
            is_opaque(w, met.b.leaf))
            hit_batch_put(hit, i, &met.b);
    }
}
