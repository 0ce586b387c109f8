#include "trace/intersect.h"

#include <stdlib.h>

#include "math/gamma.h"
#include "trace/accel.h"
#include "trace/scratch.h"

// ---- scratch, batches ---------------------------------------------------------------

static void *must_alloc(size_t count, size_t size)
{
    void *p = calloc(count ? count : 1, size);
    if (!p)
        abort();
    return p;
}

struct trace_scratch *trace_scratch_new(const struct world *w)
{
    struct trace_scratch *s = must_alloc(1, sizeof *s);
    s->inside = must_alloc(w->accel->nodes_max, sizeof *s->inside);
    s->before = must_alloc(w->accel->nodes_max, sizeof *s->before);
    s->stamp = must_alloc(w->accel->nodes_max, sizeof *s->stamp);
    s->leaves = must_alloc(w->accel->leaves_max, sizeof *s->leaves);
    return s;
}

void trace_scratch_free(struct trace_scratch *s)
{
    if (!s)
        return;
    boundary_list_free(&s->crossings);
    free(s->inside);
    free(s->before);
    free(s->stamp);
    free(s->leaves);
    free(s);
}

const struct trace_stats *trace_scratch_stats(const struct trace_scratch *s)
{
    return &s->stats;
}

static void *aligned(size_t size)
{
    void *p = aligned_alloc(64, (size + 63) & ~(size_t)63);
    if (!p)
        abort();
    return p;
}

struct ray_batch *ray_batch_new(uint32_t capacity)
{
    struct ray_batch *b = must_alloc(1, sizeof *b);
    b->capacity = (capacity + 7) & ~7u;
    for (int i = 0; i < 3; i++) {
        b->o[i] = aligned(b->capacity * sizeof(double));
        b->d[i] = aligned(b->capacity * sizeof(double));
    }
    b->t_min = aligned(b->capacity * sizeof(double));
    b->t_max = aligned(b->capacity * sizeof(double));
    b->hidden_by = aligned(b->capacity * sizeof(unsigned));
    return b;
}

void ray_batch_free(struct ray_batch *b)
{
    if (!b)
        return;
    for (int i = 0; i < 3; i++) {
        free(b->o[i]);
        free(b->d[i]);
    }
    free(b->t_min);
    free(b->t_max);
    free(b->hidden_by);
    free(b);
}

// ---- boxes ------------------------------------------------------------------------------

struct box_ray box_ray_of(const struct ray *r)
{
    return (struct box_ray){r->o, vec3(1 / r->d.x, 1 / r->d.y, 1 / r->d.z), r->t_min, r->t_max};
}

// A slab's t is off by at most 3 roundings; a zero direction gives infinities, or NaN when
// the origin lies in the face, which the comparisons below let pass.
bool box_meets(const struct aabb *b, const struct box_ray *r, double *t)
{
    const double grow = 1 + 2 * GAMMA(3);
    double t0 = r->t_min, t1 = r->t_max;
    const double x0 = (b->min.x - r->o.x) * r->inv.x, x1 = (b->max.x - r->o.x) * r->inv.x;
    const double y0 = (b->min.y - r->o.y) * r->inv.y, y1 = (b->max.y - r->o.y) * r->inv.y;
    const double z0 = (b->min.z - r->o.z) * r->inv.z, z1 = (b->max.z - r->o.z) * r->inv.z;
    const double nx = x0 < x1 ? x0 : x1, fx = (x0 < x1 ? x1 : x0) * grow;
    const double ny = y0 < y1 ? y0 : y1, fy = (y0 < y1 ? y1 : y0) * grow;
    const double nz = z0 < z1 ? z0 : z1, fz = (z0 < z1 ? z1 : z0) * grow;
    t0 = nx > t0 ? nx : t0;
    t0 = ny > t0 ? ny : t0;
    t0 = nz > t0 ? nz : t0;
    t1 = fx < t1 ? fx : t1;
    t1 = fy < t1 ? fy : t1;
    t1 = fz < t1 ? fz : t1;
    *t = t0;
    return t0 <= t1;
}

// ---- objects ----------------------------------------------------------------------------

static bool single_leaf(const struct world *w, struct trace_scratch *s,
                        const struct world_object *o, const struct ray *ray,
                        enum sweep_mode mode, struct boundary *out)
{
    const struct leaf *l = &w->leaf[o->first_leaf];
    s->stats.leaf_tests++;
    if (mode == SWEEP_OPAQUE && !w->surface[l->surface].opaque)
        return false;
    if (l->ops->closest) {
        struct ray local = *ray;
        if (!l->transform.identity)
            local = transform_inverse_ray(&l->transform, ray);
        out->leaf = o->first_leaf;
        return l->ops->closest(l->shape, &local, out);
    }
    s->crossings.count = 0;
    leaf_crossings(w, o->first_leaf, ray, &s->crossings);
    for (uint32_t i = 0; i < s->crossings.count; i++) {
        const struct boundary *b = &s->crossings.at[i];
        if (b->drawn && b->t > ray->t_min && b->t < ray->t_max) {
            *out = *b;
            return true;
        }
    }
    return false;
}

// User bounds cull: the ray must meet one of the bounding solids or start inside it.
static bool culled(const struct world_object *o, const struct ray *ray)
{
    for (uint32_t i = 0; i < o->bound_count; i++) {
        const struct ray local = transform_inverse_ray(&o->bound_transform, ray);
        const struct aabb box = object_bounds(o->bound[i]);
        struct box_ray r = box_ray_of(&local);
        double t;
        if (!box_meets(&box, &r, &t))
            return true;
    }
    return false;
}

static bool object_hit(const struct world *w, struct trace_scratch *s, uint32_t object,
                       const struct ray_query *q, const struct ray *ray,
                       enum sweep_mode mode, struct boundary *out)
{
    const struct world_object *o = &w->object[object];
    if ((o->flags & q->hidden_by) || (o->bound_count && culled(o, ray)))
        return false;
    return o->is_csg ? sweep_object(w, s, object, ray, mode, out)
                     : single_leaf(w, s, o, ray, mode, out);
}

// Keeps the nearest hit; among equal distances the object declared first.
struct nearest {
    struct boundary b;
    uint32_t object;
};

static void try_object(const struct world *w, struct trace_scratch *s, uint32_t object,
                       const struct ray_query *q, struct ray *ray, struct nearest *best)
{
    struct boundary b;
    // An equal distance must still be seen, so the limit is just beyond the best.
    struct ray upto = *ray;
    upto.t_max = nextafter(ray->t_max, INFINITY);
    if (!object_hit(w, s, object, q, best->object == UINT32_MAX ? ray : &upto,
                    SWEEP_CLOSEST, &b))
        return;
    if (b.t < ray->t_max || best->object == UINT32_MAX || object < best->object) {
        best->b = b;
        best->object = object;
        ray->t_max = b.t;
    }
}

struct visit {
    uint32_t node;
    double t;
};

static void walk_closest(const struct world *w, struct trace_scratch *s,
                         const struct ray_query *q, struct ray *ray, struct nearest *best)
{
    const struct bvh *tree = &w->accel->top;
    struct visit stack[2 * BVH_STACK];
    uint32_t depth = 0;
    if (!tree->item_count)
        return;
    struct box_ray r = box_ray_of(ray);
    stack[depth++] = (struct visit){0, ray->t_min};
    while (depth) {
        const struct visit v = stack[--depth];
        if (v.t > ray->t_max)
            continue;
        const struct bvh_node *n = &tree->node[v.node];
        double t[2];
        bool met[2];
        r.t_max = ray->t_max;
        s->stats.node_visits++;
        for (int k = 0; k < 2; k++)
            met[k] = box_meets(&n->bounds[k], &r, &t[k]);
        const int first = met[0] && met[1] && t[1] < t[0];
        struct visit later[2];
        uint32_t pending = 0;
        for (int i = 0; i < 2; i++) {
            const int k = i ^ first;
            if (!met[k] || t[k] > ray->t_max)
                continue;
            for (uint32_t j = 0; j < n->count[k]; j++)
                try_object(w, s, tree->item[n->child[k] + j], q, ray, best);
            if (n->count[k] == 0)
                later[pending++] = (struct visit){n->child[k], t[k]};
        }
        while (pending)
            stack[depth++] = later[--pending]; // the nearer on top
    }
}

struct hit trace_closest_1(const struct world *w, struct trace_scratch *s,
                           const struct ray_query *q)
{
    struct ray ray = q->ray;
    struct nearest best = {.b = {.t = INFINITY}, .object = UINT32_MAX};
    s->stats.rays++;
    for (uint32_t i = 0; i < w->accel->infinite_count; i++)
        try_object(w, s, w->accel->infinite[i], q, &ray, &best);
    walk_closest(w, s, q, &ray, &best);
    return (struct hit){best.b};
}

bool trace_occluded_1(const struct world *w, struct trace_scratch *s,
                      const struct ray_query *q)
{
    struct boundary b;
    s->stats.shadow_rays++;
    for (uint32_t i = 0; i < w->accel->infinite_count; i++)
        if (object_hit(w, s, w->accel->infinite[i], q, &q->ray, SWEEP_OPAQUE, &b))
            return true;
    const struct bvh *tree = &w->accel->top;
    uint32_t stack[2 * BVH_STACK], depth = 0;
    if (!tree->item_count)
        return false;
    const struct box_ray r = box_ray_of(&q->ray);
    stack[depth++] = 0;
    while (depth) {
        const struct bvh_node *n = &tree->node[stack[--depth]];
        s->stats.node_visits++;
        for (int k = 0; k < 2; k++) {
            double t;
            if (!box_meets(&n->bounds[k], &r, &t))
                continue;
            if (n->count[k] == 0)
                stack[depth++] = n->child[k];
            for (uint32_t j = 0; j < n->count[k]; j++)
                if (object_hit(w, s, tree->item[n->child[k] + j], q, &q->ray,
                               SWEEP_OPAQUE, &b))
                    return true;
        }
    }
    return false;
}

// ---- batches -----------------------------------------------------------------------------

static struct ray_query query_of(const struct ray_batch *r, uint32_t i)
{
    return (struct ray_query){
        .ray = {vec3(r->o[0][i], r->o[1][i], r->o[2][i]),
                vec3(r->d[0][i], r->d[1][i], r->d[2][i]), r->t_min[i], r->t_max[i]},
        .hidden_by = r->hidden_by[i]};
}

void trace_closest(const struct world *w, struct trace_scratch *s,
                   const struct ray_batch *rays, struct hit *out)
{
    for (uint32_t i = 0; i < rays->count; i++) {
        const struct ray_query q = query_of(rays, i);
        out[i] = trace_closest_1(w, s, &q);
    }
}

void trace_occluded(const struct world *w, struct trace_scratch *s,
                    const struct ray_batch *rays, uint8_t *out)
{
    for (uint32_t i = 0; i < rays->count; i++) {
        const struct ray_query q = query_of(rays, i);
        out[i] = trace_occluded_1(w, s, &q);
    }
}

// ---- points -------------------------------------------------------------------------------

static bool leaf_inside(const struct leaf *l, struct vec3 p)
{
    return l->solid &&
           l->ops->inside(l->shape, transform_inverse_point(&l->transform, p)) != l->inverted;
}

static bool node_inside(const struct world *w, uint32_t node, struct vec3 p)
{
    const struct csg_node *n = &w->node[node];
    if (n->op == NODE_LEAF)
        return leaf_inside(&w->leaf[n->leaf], p);
    const bool all = n->op == NODE_INTERSECTION;
    for (uint32_t i = 0; i < n->child_count; i++)
        if (node_inside(w, n->first_child + i, p) != all)
            return !all;
    return all;
}

bool world_object_inside(const struct world *w, uint32_t object, struct vec3 p)
{
    return node_inside(w, w->object[object].root, p);
}

uint32_t trace_containing(const struct world *w, struct vec3 p, uint32_t *object, uint32_t max)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < w->object_count && n < max; i++)
        if (world_object_inside(w, i, p))
            object[n++] = i;
    return n;
}

void trace_interaction(const struct world *w, const struct ray *ray, const struct hit *hit,
                       struct interaction *out)
{
    const struct leaf *l = &w->leaf[hit->b.leaf];
    const struct vec3 p = ray_at(ray, hit->b.t);
    struct surface_point s = {.p = p};
    *out = (struct interaction){.leaf = l, .surface = &w->surface[l->surface]};
    if (l->transform.identity) {
        l->ops->surface(l->shape, &hit->b, p, &s);
        out->p = s.p;
        out->ng = s.ng;
        out->ns = s.ns;
    } else {
        l->ops->surface(l->shape, &hit->b, transform_inverse_point(&l->transform, p), &s);
        out->p = transform_point(&l->transform, s.p);
        out->ng = vec3_normalize(transform_normal(&l->transform, s.ng));
        out->ns = vec3_normalize(transform_normal(&l->transform, s.ns));
    }
    if (l->inverted) {
        out->ng = vec3_neg(out->ng);
        out->ns = vec3_neg(out->ns);
    }
    out->uv = l->ops->flags & SHAPE_UV ? s.uv : (struct vec2){p.x, p.y};
    // The root may be off by dt along the ray, its point by the rounding of o + t d.
    const double size = vec3_max_abs(ray->o) + fabs(hit->b.t) * vec3_max_abs(ray->d);
    out->error = hit->b.dt * vec3_length(ray->d) + GAMMA(32) * size;
}

struct vec3 trace_offset(const struct interaction *i, struct vec3 d)
{
    const double side = vec3_dot(d, i->ng) < 0 ? -1 : 1;
    return vec3_mad(i->p, 2 * side * i->error, i->ng);
}
