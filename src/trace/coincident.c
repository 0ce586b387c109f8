#include "trace/coincident.h"

#include <math.h>

#include "math/larger.h"
#include "scene/shape.h"
#include "trace/face_pairs.h"
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

static uint32_t others_near(const struct world *w, struct aabb box, uint32_t object[MOST])
{
    uint32_t kept = 0;
    const uint32_t count = trace_boxes_meet(w->dark, box, object, MOST);
    for (uint32_t i = 0; i < count; i++)
        if (w->object[object[i]].opaque && w->object[object[i]].flat)
            object[kept++] = object[i];
    return kept;
}

static void mark_clear(struct world *w)
{
    for (uint32_t i = 0; i < w->object_count; i++)
        w->object[i].flat = is_flat(w, &w->object[i]);
    for (uint32_t i = 0; i < w->object_count; i++) {
        struct world_object *o = &w->object[i];
        const struct aabb box = aabb_is_finite(o->bounds) ? o->bounds : w->bounds;
        uint32_t other[MOST];
        o->clear_flat = !o->opaque && o->flat && others_near(w, box, other) > 0;
        o->may_coincide = o->clear_flat;
        w->has_coincident |= o->may_coincide;
    }
}

static void mark_pairs(struct world *w)
{
    if (!face_pairs_mark(w))
        return;
    for (uint32_t i = 0; i < w->leaf_count; i++)
        if (w->leaf[i].paired)
            w->object[w->leaf[i].object].may_coincide = true;
    w->has_coincident = true;
}

void coincident_mark(struct world *w)
{
    if (w->has_transparent)
        mark_clear(w);
    mark_pairs(w);
}

static struct aabb box_around(struct vec3 p, double reach)
{
    const struct vec3 r = vec3(reach, reach, reach);
    return (struct aabb){vec3_sub(p, r), vec3_add(p, r)};
}

// Errors of a hit's distance within which another face is looked for.
static const double wide = 32;

static void look_between(struct ray_query *q, double t, double reach)
{
    q->ray.t_min = larger(t - reach, q->ray.t_min);
    q->ray.t_max = smaller(t + reach, q->ray.t_max);
}

// Puts the opaque face that is to be seen in place of hit i of a clear one.
static void behind_clear(const struct world *w, struct trace_scratch *s,
                         struct ray_query q, uint32_t i, const struct hit_batch *hit)
{
    const double t = hit->t[i], dt = hit->dt[i];
    const uint32_t own = w->leaf[hit->leaf[i]].object;
    uint32_t other[MOST];
    const uint32_t others = others_near(
        w, box_around(ray_at(&q.ray, t), wide * dt * vec3_max_abs(q.ray.d)), other);
    look_between(&q, t, wide * dt);
    for (uint32_t k = 0; k < others; k++) {
        struct search f = search_of(w, s, &q, SWEEP_CLOSEST);
        if (other[k] != own && search_try_object(&f, other[k]) &&
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

// How far apart along the ray its hits of two faces may lie that are `apart`. Where a ray
// touches the face it bends away; the root of rounding is more than that makes of it.
static double along_ray(const struct world *w, const struct ray *ray,
                        const struct hit *hit, double apart)
{
    struct interaction at;
    trace_interaction(w, ray, hit, &at);
    const double length = vec3_length(ray->d);
    const double cosine = fabs(vec3_dot(at.ng, ray->d)) / length;
    return apart / (length * larger(cosine, sqrt(GAMMA(64))));
}

static struct ray_query query_of(const struct ray_batch *rays, uint32_t i)
{
    return (struct ray_query){.ray = {.o = {rays->o[0][i], rays->o[1][i], rays->o[2][i]},
                                      .d = {rays->d[0][i], rays->d[1][i], rays->d[2][i]},
                                      .t_min = rays->t_min[i],
                                      .t_max = rays->t_max[i]},
                              .hidden_by = rays->hidden_by[i]};
}

// Whether what a pair has in common is near a point of the ray o + t d, off by dt.
static bool is_at(const struct face_pair *p, struct vec3 o, struct vec3 d, double t,
                  double dt)
{
    return is_near(&p->where, vec3_mad(o, t, d), wide * dt * vec3_max_abs(d) + p->error);
}

// Whether the object of a pair that is near the hit has such a face on the ray, too.
static bool face_there(const struct world *w, struct trace_scratch *s,
                       const struct ray_query *q, const struct hit *hit,
                       const struct face_pair *p, struct boundary *out)
{
    struct ray_query near = *q;
    const double apart = along_ray(w, &q->ray, hit, p->error);
    look_between(&near, hit->b.t, wide * hit->b.dt + apart);
    struct search f = search_of(w, s, &near, SWEEP_CLOSEST);
    if (!search_try_object(&f, p->other) || !w->leaf[f.b.leaf].paired)
        return false;
    *out = f.b;
    return true;
}

// Puts the face that is to be seen of those in one place in place of hit i of another one;
// whether there is one.
static bool first_of_pairs(const struct world *w, struct trace_scratch *s,
                           const struct ray_batch *rays, uint32_t i,
                           const struct hit_batch *hit)
{
    const uint32_t leaf = hit->leaf[i];
    const struct vec3 o = {rays->o[0][i], rays->o[1][i], rays->o[2][i]};
    const struct vec3 d = {rays->d[0][i], rays->d[1][i], rays->d[2][i]};
    struct boundary seen;
    for (uint32_t k = w->leaf[leaf].first_pair;
         k < w->face_pair_count && w->face_pair[k].leaf == leaf; k++) {
        const struct face_pair *p = &w->face_pair[k];
        if (p->contact && p->other > w->leaf[leaf].object)
            return false; // as all that follow
        if (!is_at(p, o, d, hit->t[i], hit->dt[i]))
            continue;
        const struct hit found = hit_batch_at(hit, i);
        const struct ray_query q = query_of(rays, i);
        if (face_there(w, s, &q, &found, p, &seen)) {
            hit_batch_put(hit, i, &seen);
            return true;
        }
    }
    return false;
}

uint32_t coincident_contacts(const struct world *w, struct trace_scratch *s,
                             const struct ray_query *q, const struct hit *hit,
                             struct hit other[CONTACTS_MOST])
{
    const uint32_t leaf = hit->b.leaf;
    uint32_t count = 0;
    for (uint32_t k = w->leaf[leaf].first_pair;
         k < w->face_pair_count && w->face_pair[k].leaf == leaf; k++) {
        const struct face_pair *p = &w->face_pair[k];
        // Faces of one object stand side by side.
        if (!p->contact || count == CONTACTS_MOST ||
            (count && w->leaf[other[count - 1].b.leaf].object == p->other))
            continue;
        if (is_at(p, q->ray.o, q->ray.d, hit->b.t, hit->b.dt))
            count += face_there(w, s, q, hit, p, &other[count].b);
    }
    return count;
}

void coincident_hits(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const struct hit_batch *hit)
{
    for (uint32_t i = 0; i < rays->count; i++) {
        if (!(hit->t[i] < INFINITY))
            continue;
        const struct leaf *l = &w->leaf[hit->leaf[i]];
        const struct world_object *o = &w->object[l->object];
        if (!o->may_coincide)
            continue;
        if (l->paired && first_of_pairs(w, s, rays, i, hit))
            continue;
        if (o->clear_flat && !w->surface[l->surface].opaque)
            behind_clear(w, s, query_of(rays, i), i, hit);
    }
}
