#include "trace/coincident.h"

#include <math.h>

#include "scene/shape.h"
#include "trace/coplanar.h"
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

static void mark_clear(struct world *w)
{
    for (uint32_t i = 0; i < w->object_count; i++)
        w->object[i].flat = is_flat(w, &w->object[i]);
    for (uint32_t i = 0; i < w->object_count; i++) {
        struct world_object *o = &w->object[i];
        const struct aabb box = aabb_is_finite(o->bounds) ? o->bounds : w->bounds;
        o->may_coincide = !o->opaque && o->flat && others_near(w, box).count > 0;
        w->has_coincident |= o->may_coincide;
    }
}

static void mark_opaque(struct world *w)
{
    if (!coplanar_mark(w))
        return;
    for (uint32_t i = 0; i < w->leaf_count; i++)
        if (w->leaf[i].coplanar) {
            struct world_object *o = &w->object[w->leaf[i].object];
            o->flat = o->may_coincide = true;
        }
    w->has_coincident = true;
}

void coincident_mark(struct world *w)
{
    if (w->has_transparent)
        mark_clear(w);
    mark_opaque(w);
}

static struct aabb box_around(struct vec3 p, double reach)
{
    const struct vec3 r = vec3(reach, reach, reach);
    return (struct aabb){vec3_sub(p, r), vec3_add(p, r)};
}

// Puts the opaque face that is to be seen in place of hit i of a clear one, between q's ends.
static void behind_clear(const struct world *w, struct trace_scratch *s,
                         const struct ray_query *q, double reach, uint32_t i,
                         const struct hit_batch *hit)
{
    const double t = hit->t[i], dt = hit->dt[i];
    const uint32_t own = w->leaf[hit->leaf[i]].object;
    const struct others x = others_near(w, box_around(ray_at(&q->ray, t), reach));
    for (uint32_t k = 0; k < x.count; k++) {
        struct search f = search_of(w, s, q, SWEEP_CLOSEST);
        if (x.object[k] != own && search_try_object(&f, x.object[k]) &&
            fabs(f.b.t - t) <= f.b.dt + dt)
            hit_batch_put(hit, i, &f.b);
    }
}

static bool is_near(const struct aabb *b, struct vec3 p, double reach)
{
    return p.x >= b->min.x - reach && p.x <= b->max.x + reach &&
           p.y >= b->min.y - reach && p.y <= b->max.y + reach &&
           p.z >= b->min.z - reach && p.z <= b->max.z + reach;
}

// Puts the first of the opaque faces in one plane in place of hit i of one, likewise.
static void first_of_opaque(const struct world *w, struct trace_scratch *s,
                            const struct ray_query *q, double reach, uint32_t i,
                            const struct hit_batch *hit)
{
    const uint32_t leaf = hit->leaf[i];
    const struct vec3 point = ray_at(&q->ray, hit->t[i]);
    for (uint32_t k = w->leaf[leaf].first_pair;
         k < w->coplanar_pair_count && w->coplanar_pair[k].leaf == leaf; k++) {
        const struct coplanar_pair *p = &w->coplanar_pair[k];
        if (!is_near(&p->where, point, reach))
            continue;
        struct search f = search_of(w, s, q, SWEEP_CLOSEST);
        if (search_try_object(&f, p->earlier) && w->leaf[f.b.leaf].coplanar) {
            hit_batch_put(hit, i, &f.b);
            return;
        }
    }
}

void coincident_hits(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const struct hit_batch *hit)
{
    // Errors of the hit's distance within which another face is looked for. Of opaque faces,
    // which lie in one plane, it also covers the rounding of the ray's way into their spaces.
    static const double wide = 32;
    for (uint32_t i = 0; i < rays->count; i++) {
        const double t = hit->t[i], dt = hit->dt[i];
        if (!(t < INFINITY))
            continue;
        const struct leaf *l = &w->leaf[hit->leaf[i]];
        const bool opaque = w->surface[l->surface].opaque;
        if (!w->object[l->object].may_coincide || (opaque && !l->coplanar))
            continue;
        const struct ray_query q = {
            .ray = {.o = {rays->o[0][i], rays->o[1][i], rays->o[2][i]},
                    .d = {rays->d[0][i], rays->d[1][i], rays->d[2][i]},
                    .t_min = fmax(rays->t_min[i], t - wide * dt),
                    .t_max = fmin(rays->t_max[i], t + wide * dt)},
            .hidden_by = rays->hidden_by[i]};
        (opaque ? first_of_opaque
                : behind_clear)(w, s, &q, wide * dt * vec3_max_abs(q.ray.d), i, hit);
    }
}
