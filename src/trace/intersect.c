#include "trace/intersect.h"

#include <stdlib.h>

#include "base/memory.h"
#include "math/gamma.h"
#include "math/larger.h"
#include "scene/shape_kernels.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/scratch.h"
#include "trace/user_bounds.h"

// ---- scratch, batches ---------------------------------------------------------------

struct trace_scratch *trace_scratch_new(const struct world *w)
{
    struct trace_scratch *s = must_calloc(1, sizeof *s);
    s->inside = must_calloc(w->accel->nodes_max, sizeof *s->inside);
    s->before = must_calloc(w->accel->nodes_max, sizeof *s->before);
    s->stamp = must_calloc(w->accel->nodes_max, sizeof *s->stamp);
    s->leaves = must_calloc(w->accel->leaves_max, sizeof *s->leaves);
    return s;
}

void trace_scratch_free(struct trace_scratch *s)
{
    if (!s)
        return;
    boundary_list_free(&s->crossings);
    free(s->own_dt);
    free(s->made_at);
    free(s->made_own_dt);
    free(s->inside);
    free(s->before);
    free(s->stamp);
    free(s->leaves);
    free(s);
}

const struct trace_stats *trace_scratch_stats(struct trace_scratch *s)
{
    s->stats.evaluations = s->crossings.evaluations;
    return &s->stats;
}

static void *aligned(size_t count, size_t size) { return must_align(64, count, size); }

struct ray_batch *ray_batch_new(uint32_t capacity)
{
    struct ray_batch *b = must_calloc(1, sizeof *b);
    b->capacity = (capacity + 7) & ~7u;
    for (int i = 0; i < 3; i++) {
        b->o[i] = aligned(b->capacity, sizeof(double));
        b->d[i] = aligned(b->capacity, sizeof(double));
    }
    b->t_min = aligned(b->capacity, sizeof(double));
    b->t_max = aligned(b->capacity, sizeof(double));
    b->hidden_by = aligned(b->capacity, sizeof(unsigned));
    return b;
}

struct hit_batch *hit_batch_new(uint32_t capacity)
{
    struct hit_batch *b = must_calloc(1, sizeof *b);
    capacity = (capacity + 7) & ~7u;
    double **const number[] = {&b->t, &b->dt, &b->part, &b->u, &b->v};
    for (int i = 0; i < 5; i++)
        *number[i] = aligned(capacity, sizeof(double));
    b->leaf = aligned(capacity, sizeof *b->leaf);
    b->crossing = aligned(capacity, 1);
    return b;
}

void hit_batch_free(struct hit_batch *b)
{
    if (!b)
        return;
    free(b->t);
    free(b->dt);
    free(b->part);
    free(b->u);
    free(b->v);
    free(b->leaf);
    free(b->crossing);
    free(b);
}

struct hit hit_batch_at(const struct hit_batch *b, uint32_t i)
{
    struct hit h = {.b = {.t = b->t[i]}};
    if (h.b.t < INFINITY)
        h.b = (struct boundary){.t = b->t[i],
                                .dt = b->dt[i],
                                .u = b->u[i],
                                .v = b->v[i],
                                .part = (uint32_t)b->part[i],
                                .leaf = b->leaf[i],
                                .crossing = b->crossing[i],
                                .drawn = 1};
    return h;
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

static double inverse_of(double d, double longest)
{
    return RUNS_ALONG(d, longest) ? HUGE_VAL : 1 / d;
}

struct box_ray box_ray_of(const struct ray *r)
{
    const double longest = vec3_max_abs(r->d);
    return (struct box_ray){r->o,
                            vec3(inverse_of(r->d.x, longest), inverse_of(r->d.y, longest),
                                 inverse_of(r->d.z, longest)),
                            r->t_min, r->t_max};
}

// A slab's t is off by at most 3 roundings. Along a zero direction the faces lie at
// infinity, or at NaN for an origin in the face, which the comparisons let pass: near
// and far face are told by the direction, so that no NaN takes part in choosing them.
static void meet_slab(double min, double max, double o, double inv, double *t0,
                      double *t1)
{
    const double grow = 1 + BOX_SLACK;
    const bool back = signbit(inv);
    const double near = ((back ? max : min) - o) * inv;
    const double far = ((back ? min : max) - o) * inv * grow;
    *t0 = near > *t0 ? near : *t0;
    *t1 = far < *t1 ? far : *t1;
}

bool box_meets(const struct aabb *b, const struct box_ray *r, double *t)
{
    double t0 = r->t_min, t1 = r->t_max;
    meet_slab(b->min.x, b->max.x, r->o.x, r->inv.x, &t0, &t1);
    meet_slab(b->min.y, b->max.y, r->o.y, r->inv.y, &t0, &t1);
    meet_slab(b->min.z, b->max.z, r->o.z, r->inv.z, &t0, &t1);
    *t = t0;
    return t0 <= t1;
}

// ---- objects ----------------------------------------------------------------------------

// A shape that takes eight rays, and one.
static bool lone_lane(const struct world *w, struct trace_scratch *s, uint32_t leaf,
                      const struct ray *ray, bool any, struct boundary *out)
{
    const struct leaf *l = &w->leaf[leaf];
    struct ray local = *ray;
    if (!l->transform->identity)
        local = transform_inverse_ray(l->transform, ray);
    const struct shape_rays rays = shape_rays_alike(&local);
    struct shape_hits hits;
    hits.evaluations = 0;
    hits.cancel = s->crossings.cancel;
    hits.cut = false;
    const bool met =
        l->ops->closest8(w->accel->kernels->shapes, l->shape, &rays, 1, any, &hits);
    s->crossings.evaluations += hits.evaluations;
    s->crossings.cut |= hits.cut;
    if (!met || !(hits.t[0] < ray->t_max))
        return false;
    *out = shape_hits_at(&hits, 0);
    out->leaf = leaf;
    out->crossing = crossing_of_leaf(out->crossing, l->inverted);
    return true;
}

static bool single_leaf(const struct world *w, struct trace_scratch *s,
                        const struct world_object *o, const struct ray *ray,
                        enum sweep_mode mode, struct boundary *out)
{
    const struct leaf *l = &w->leaf[o->first_leaf];
    s->stats.leaf_tests++;
    if (mode == SWEEP_OPAQUE && !w->surface[l->surface].opaque)
        return false;
    if (w->accel->leaf_shape[o->first_leaf] == PACKET_LANES && l->drawn)
        return lone_lane(w, s, o->first_leaf, ray, mode == SWEEP_OPAQUE, out);
    if (l->ops->closest) {
        struct ray local = *ray;
        if (!l->transform->identity)
            local = transform_inverse_ray(l->transform, ray);
        out->leaf = o->first_leaf;
        return l->ops->closest(l->shape, &local, out);
    }
    s->crossings.count = 0;
    s->crossings.first_only = true;
    leaf_crossings(w, o->first_leaf, ray, &s->crossings);
    s->crossings.first_only = false;
    for (uint32_t i = 0; i < s->crossings.count; i++) {
        const struct boundary *b = &s->crossings.at[i];
        if (b->drawn && b->t > ray->t_min && b->t < ray->t_max) {
            *out = *b;
            return true;
        }
    }
    return false;
}

// User bounds cull: the ray must meet every bounding solid or start in it.
static bool culled(const struct world_object *o, const struct ray *ray,
                   struct trace_scratch *s)
{
    const struct box_ray r = box_ray_of(ray);
    for (uint32_t i = 0; i < o->bound_count; i++) {
        double t;
        if (!box_meets(&o->bound[i].box, &r, &t) ||
            user_bound_culls(&o->bound[i], ray, &s->crossings))
            return true;
    }
    return false;
}

struct search search_of(const struct world *w, struct trace_scratch *s,
                        const struct ray_query *q, enum sweep_mode mode)
{
    return (struct search){.w = w,
                           .s = s,
                           .q = q,
                           .mode = mode,
                           .box = box_ray_of(&q->ray),
                           .dd = vec3_dot(q->ray.d, q->ray.d),
                           .t = INFINITY,
                           .object = UINT32_MAX,
                           .b = {.t = INFINITY}};
}

// The first surface of an object on the ray. A CSG object sees the whole ray whatever
// was found so far, so that its batches do not depend on the order of the search; what
// begins beyond the nearest is of no interest.
static bool object_hit(struct search *f, uint32_t object, struct boundary *out)
{
    const struct world_object *o = &f->w->object[object];
    const struct ray_query *q = f->q;
    const bool one_kind = f->mode == SWEEP_CLOSEST || o->opaque; // every surface counts
    if ((o->flags & q->hidden_by) || (!one_kind && !o->mixed) ||
        (o->bound_count && culled(o, &q->ray, f->s)))
        return false;
    if (o->is_csg) {
        double t;
        f->box.t_max = smaller(f->t + fabs(f->t) * BOX_SLACK, q->ray.t_max);
        if (!box_meets(&o->bounds, &f->box, &t))
            return false;
        if (one_kind && f->w->accel->object_shape[object] == PACKET_SPONGE) {
            const enum stab_result r =
                stab_object(f->w, f->s, object, &q->ray, f->t, out);
            if (r != STAB_UNSURE)
                return r == STAB_FOUND;
        }
        if (f->w->accel->object_shape[object] == PACKET_CARVED) {
            bool unsure;
            const bool met = f->w->accel->kernels->carve(f, object, out, &unsure);
            if (!unsure)
                return met;
        }
        return sweep_object(f->w, f->s, object, &q->ray, f->t, f->mode, out);
    }
    struct ray ray = q->ray;
    // An equal distance must still be seen: the object may have been declared earlier.
    if (f->t < ray.t_max)
        ray.t_max = nextafter(f->t, INFINITY);
    return single_leaf(f->w, f->s, o, &ray, f->mode, out);
}

bool search_try_object(struct search *f, uint32_t object)
{
    struct boundary b;
    if (!object_hit(f, object, &b) || !search_is_nearer(f, b.t, object))
        return false;
    f->b = b;
    f->t = b.t;
    f->object = object;
    f->known = true;
    return true;
}

// The nearest hit's boundary in full.
static struct hit search_hit(struct search *f)
{
    if (f->object != UINT32_MAX && !f->known) {
        const uint32_t object = f->object;
        object_hit(f, object, &f->b);
    }
    return (struct hit){f->b};
}

struct hit trace_closest_1(const struct world *w, struct trace_scratch *s,
                           const struct ray_query *q)
{
    const struct accel *a = w->accel;
    struct search f = search_of(w, s, q, SWEEP_CLOSEST);
    s->stats.rays++;
    for (uint32_t i = 0; i < a->infinite_count; i++)
        search_try_object(&f, a->infinite[i]);
    struct bvh8_ray r;
    if (bvh8_ray_begin(&a->top, &q->ray, q->ray.t_min, smaller(f.t, q->ray.t_max), &r))
        a->kernels->walk(&f, &r, 0);
    return search_hit(&f);
}

bool trace_occluded_1(const struct world *w, struct trace_scratch *s,
                      const struct ray_query *q)
{
    const struct accel *a = w->dark->accel;
    struct search f = search_of(w->dark, s, q, SWEEP_OPAQUE);
    s->stats.shadow_rays++;
    for (uint32_t i = 0; i < a->infinite_count; i++)
        if (search_try_object(&f, a->infinite[i]))
            return true;
    struct bvh8_ray r;
    if (bvh8_ray_begin(&a->top, &q->ray, q->ray.t_min, q->ray.t_max, &r))
        a->kernels->walk(&f, &r, 0);
    return f.object != UINT32_MAX;
}

// ---- points -------------------------------------------------------------------------------

static bool leaf_inside(const struct leaf *l, struct vec3 p)
{
    return l->solid &&
           l->ops->inside(l->shape, transform_inverse_point(l->transform, p)) !=
               l->inverted;
}

// Walks the expression without a stack: down to the first child that is not settled,
// up as long as a child decides its parent. Deep trees cost no memory.
bool world_object_inside(const struct world *w, uint32_t object, struct vec3 p)
{
    const struct world_object *o = &w->object[object];
    const uint32_t root = o->root;
    if (!o->is_csg)
        return leaf_inside(&w->leaf[o->first_leaf], p);
    uint32_t n = root;
    for (;;) {
        while (w->node[n].op != NODE_LEAF && w->node[n].child_count)
            n = w->node[n].first_child;
        const struct csg_node *at = &w->node[n];
        bool in = at->op == NODE_LEAF ? leaf_inside(&w->leaf[at->leaf], p)
                                      : at->op == NODE_INTERSECTION;
        for (;;) {
            if (n == root)
                return in;
            const struct csg_node *up = &w->node[w->node[n].parent];
            const bool decides = in != (up->op == NODE_INTERSECTION);
            if (!decides && n + 1 < up->first_child + up->child_count)
                break;
            n = w->node[n].parent;
        }
        n++;
    }
}

static bool add_containing(const struct world *w, uint32_t i, struct vec3 p,
                           uint32_t *object, uint32_t *n, uint32_t max)
{
    if (world_object_inside(w, i, p) && *n < max)
        object[(*n)++] = i;
    return *n < max;
}

uint32_t trace_containing(const struct world *w, struct vec3 p, uint32_t *object,
                          uint32_t max)
{
    const struct accel *a = w->accel;
    uint32_t n = 0;
    for (uint32_t i = 0; i < a->infinite_count; i++)
        if (!add_containing(w, a->infinite[i], p, object, &n, max))
            return n;
    const struct vec3 local = vec3_sub(p, a->top.origin);
    const float at[3] = {(float)local.x, (float)local.y, (float)local.z};
    struct bvh8_walk walk;
    bvh8_walk_begin(&walk, &a->top);
    for (uint32_t first, count; bvh8_walk_point(&walk, &a->top, at, &first, &count);)
        for (uint32_t i = first; i < first + count; i++)
            if (!add_containing(w, a->top.item[i], p, object, &n, max))
                return n;
    // In the order of the scene, whatever the tree looks like.
    for (uint32_t i = 1; i < n; i++) {
        const uint32_t x = object[i];
        uint32_t j = i;
        for (; j > 0 && object[j - 1] > x; j--)
            object[j] = object[j - 1];
        object[j] = x;
    }
    return n;
}

uint32_t trace_boxes_meet(const struct world *w, struct aabb box, uint32_t *object,
                          uint32_t max)
{
    const struct accel *a = w->accel;
    uint32_t n = 0;
    for (uint32_t i = 0; i < a->infinite_count && n < max; i++)
        object[n++] = a->infinite[i];
    const struct vec3 from = vec3_sub(box.min, a->top.origin),
                      to = vec3_sub(box.max, a->top.origin);
    const float lo[3] = {(float)from.x, (float)from.y, (float)from.z},
                hi[3] = {(float)to.x, (float)to.y, (float)to.z};
    struct bvh8_walk walk;
    bvh8_walk_begin(&walk, &a->top);
    for (uint32_t first, count;
         n < max && bvh8_walk_box(&walk, &a->top, lo, hi, &first, &count);)
        for (uint32_t i = first; i < first + count && n < max; i++)
            object[n++] = a->top.item[i];
    return n;
}

// The largest sum of a row's magnitudes: how far the map can stretch a rounding error.
static double stretch(const struct mat3 *m)
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = larger(fabs(m->m[i][0]) + fabs(m->m[i][1]) + fabs(m->m[i][2]), most);
    return most;
}

// The rounding of coordinates of this size on their way into shape space and back.
static double position_error(const struct leaf *l, double size)
{
    if (l->transform->identity)
        return GAMMA(32) * size;
    size += vec3_max_abs(l->transform->offset);
    return GAMMA(32) * size *
           larger(stretch(&l->transform->linear) * stretch(&l->transform->inverse), 1);
}

void trace_interaction(const struct world *w, const struct ray *ray,
                       const struct hit *hit, struct interaction *out)
{
    const struct leaf *l = &w->leaf[hit->b.leaf];
    const struct vec3 p = ray_at(ray, hit->b.t);
    struct surface_point s = {.p = p, .want_uv = w->surface[l->surface].wants_uv};
    out->leaf = l;
    out->surface = &w->surface[l->surface];
    out->b = hit->b;
    if (l->transform->identity) {
        l->ops->surface(l->shape, &hit->b, p, &s);
        out->p = s.p;
        out->ng = s.ng;
        out->ns = s.ns;
    } else {
        l->ops->surface(l->shape, &hit->b, transform_inverse_point(l->transform, p), &s);
        out->p = transform_point(l->transform, s.p);
        out->ng = vec3_normalize(transform_normal(l->transform, s.ng));
        out->ns = vec3_normalize(transform_normal(l->transform, s.ns));
    }
    if (l->inverted) {
        out->ng = vec3_neg(out->ng);
        out->ns = vec3_neg(out->ns);
    }
    out->uv = l->ops->flags & SHAPE_UV ? s.uv : (struct vec2){p.x, p.y};
    // The root may be off by dt along the ray, its point by the rounding of o + t d.
    const double size = vec3_max_abs(ray->o) + fabs(hit->b.t) * vec3_max_abs(ray->d);
    // Along a grazing ray a large dt moves the point little off the surface.
    out->error =
        hit->b.dt * fabs(vec3_dot(ray->d, out->ng)) + position_error(l, size) + l->apart;
}
