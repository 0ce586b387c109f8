// CSG on a ray, the reference: every leaf's crossings, sorted, taken in batches whose
// error bounds overlap; the expression's state before and after a batch decides which of
// its boundaries are surfaces of the whole. Roth 1982 with coincidence resolved at once.
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/gamma.h"
#include "scene/shape_kernels.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/scratch.h"

// The leaf owns the crossings from `from` on.
static void take_crossings(const struct world *w, uint32_t leaf, uint32_t from,
                           struct boundary_list *out)
{
    const struct leaf *l = &w->leaf[leaf];
    for (uint32_t i = from; i < out->count; i++) {
        struct boundary *b = &out->at[i];
        b->leaf = leaf;
        b->drawn = b->drawn && l->drawn;
        if (l->inverted && b->crossing != CROSS_TOUCH)
            b->crossing = b->crossing == CROSS_ENTER ? CROSS_EXIT : CROSS_ENTER;
    }
}

void leaf_crossings(const struct world *w, uint32_t leaf, const struct ray *ray,
                    struct boundary_list *out)
{
    const struct leaf *l = &w->leaf[leaf];
    const uint32_t from = out->count;
    if (l->transform->identity) {
        l->ops->intersect(l->shape, ray, out);
    } else {
        const struct ray local = transform_inverse_ray(l->transform, ray);
        l->ops->intersect(l->shape, &local, out);
    }
    take_crossings(w, leaf, from, out);
}

// Where a bound in proportion to dt is no more than this many dt, none closer is sought.
static const double MOVED_ENOUGH = 64;

// The rounding of a ray on its way into the leaf's space moves the whole shape by `error`,
// in that space: coordinates as large as the ray's and the offset, which a chain of
// transforms has rounded as well, times what the inverse stretches them by. Faces that
// coincide but for that are met at t that differ by it over the slope. The dt of a shape
// with a kernel for products allows for a place that is off by GAMMA(8) of the origin's
// size; in proportion to that, which the lanes use (packet_objects.h), is enough as well.
// known: the slope, |normal . direction|; NULL: it is not known.
static double moved_error(const struct world *w, const struct ray *ray,
                          const struct ray *local, const struct boundary *b,
                          const double *known)
{
    const struct leaf *l = &w->leaf[b->leaf];
    const double error =
        leaf_position_error(l, vec3_max_abs(ray->o), b->t, vec3_max_abs(ray->d));
    double most = HUGE_VAL;
    if (packet_is_product_shape(w->accel->leaf_shape[b->leaf])) {
        const double share = error / (GAMMA(8) * vec3_max_abs(local->o));
        most = b->dt * share;
        if (share <= MOVED_ENOUGH)
            return most;
    }
    struct surface_point at = {.p = ray_at(local, b->t)};
    if (!known)
        l->ops->surface(l->shape, b, at.p, &at);
    // The direction is off by `turned` too, which counts |t| times in `error`. A crossing far away
    // comes no nearer than where the ray that turns towards it has it.
    const double slope = known ? *known : fabs(vec3_dot(at.ng, local->d)),
                 turned = GAMMA(32) * vec3_max_abs(ray->d) * l->stretch;
    const double dt =
        fmin(most, error / (fmax(slope, GAMMA(12) * vec3_max_abs(local->d)) + turned));
    return dt > 0 ? dt : 0; // of a t that is no number, none
}

static void keep_own_dt(struct trace_scratch *s, struct boundary *b, double dt)
{
    s->own_dt = must_grow(s->own_dt, s->own_count, &s->own_capacity, sizeof *s->own_dt);
    s->own_dt[s->own_count++] = dt;
    b->own = s->own_count;
}

struct boundary boundary_as_shape_has_it(const struct trace_scratch *s,
                                         const struct boundary *b)
{
    struct boundary own = *b;
    if (b->own)
        own.dt = s->own_dt[b->own - 1];
    own.own = 0;
    return own;
}

// The errors of crossings from `from` on cover the rounding of the leaf's transform, too.
static void widen_crossings(const struct world *w, struct trace_scratch *s, uint32_t leaf,
                            const struct ray *ray, uint32_t from, const double *slope)
{
    const struct leaf *l = &w->leaf[leaf];
    struct boundary_list *out = &s->crossings;
    if (l->transform->identity || out->count == from)
        return;
    const struct ray local = transform_inverse_ray(l->transform, ray);
    for (uint32_t i = from; i < out->count; i++) {
        const double moved =
            moved_error(w, ray, &local, &out->at[i], slope ? &slope[i - from] : NULL);
        keep_own_dt(s, &out->at[i], out->at[i].dt);
        out->at[i].dt += moved;
    }
}

// leaf_crossings of a shape whose kernel finds those of eight lines: of one, with the same bits.
static bool lines_alone(const struct world *w, uint32_t leaf, const struct ray *ray,
                        struct boundary_list *out)
{
    const struct leaf *l = &w->leaf[leaf];
    const uint32_t from = out->count;
    if (!l->ops->lines8)
        return false;
    const struct ray local =
        l->transform->identity ? *ray : transform_inverse_ray(l->transform, ray);
    const struct shape_rays rays = shape_rays_alike(&local);
    struct shape_lines lines;
    if (!l->ops->lines8(w->accel->kernels->shapes, l->shape, &rays, 1, &lines))
        return false;
    shape_lines_add(&lines, 0, out);
    take_crossings(w, leaf, from, out);
    return true;
}

void leaf_crossings_in_csg(const struct world *w, struct trace_scratch *s, uint32_t leaf,
                           const struct ray *ray)
{
    const uint32_t from = s->crossings.count;
    if (!lines_alone(w, leaf, ray, &s->crossings))
        leaf_crossings(w, leaf, ray, &s->crossings);
    widen_crossings(w, s, leaf, ray, from, NULL);
}

void leaf_crossings_made(const struct world *w, struct trace_scratch *s, uint32_t leaf,
                         const struct ray *ray, uint32_t from, const double *slope)
{
    take_crossings(w, leaf, from, &s->crossings);
    widen_crossings(w, s, leaf, ray, from, slope);
}

void scratch_keep_crossings(struct trace_scratch *s, const struct made_crossings *made)
{
    struct boundary *at = s->made_at;
    double *own_dt = s->made_own_dt;
    const uint32_t capacity = s->made_capacity, own_capacity = s->made_own_capacity;
    s->made = made;
    s->made_at = s->crossings.at;
    s->made_capacity = s->crossings.capacity;
    s->made_own_dt = s->own_dt;
    s->made_own_capacity = s->own_capacity;
    s->crossings.at = at;
    s->crossings.capacity = capacity;
    s->own_dt = own_dt;
    s->own_capacity = own_capacity;
    s->crossings.count = s->own_count = 0;
}

// As leaf_crossings_in_csg, where they are made already.
static bool take_made(struct trace_scratch *s, uint32_t leaf)
{
    const struct made_crossings *m = s->made;
    if (!m || !(m->lanes[leaf - m->first_leaf] >> m->lane & 1))
        return false;
    const uint32_t i = leaf - m->first_leaf;
    for (uint32_t k = m->from[i][m->lane]; k < m->to[i][m->lane]; k++) {
        const struct boundary *b = &s->made_at[k];
        struct boundary *copy =
            boundary_list_add(&s->crossings, b->t, b->dt, b->crossing, b->part);
        *copy = *b;
        if (b->own)
            keep_own_dt(s, copy, s->made_own_dt[b->own - 1]);
    }
    return true;
}

// ---- collecting ---------------------------------------------------------------------

static uint32_t collect_from_tree(const struct bvh8 *tree, const struct ray *ray,
                                  struct trace_scratch *s)
{
    struct bvh8_ray r;
    struct bvh8_walk walk;
    uint32_t n = 0;
    if (!bvh8_ray_begin(tree, ray, ray->t_min, ray->t_max, &r))
        return 0;
    bvh8_walk_begin(&walk, tree);
    for (uint32_t first, count; bvh8_walk_next(&walk, tree, &r, &first, &count);) {
        memcpy(s->leaves + n, tree->item + first, count * sizeof *s->leaves);
        n += count;
    }
    s->stats.node_visits += walk.visits;
    return n;
}

// The leaves whose boxes the ray meets on its way. One whose box lies behind t_min or
// beyond t_max is in its base state wherever it matters.
static uint32_t collect(const struct world *w, struct trace_scratch *s, uint32_t object,
                        const struct ray *ray)
{
    const struct world_object *o = &w->object[object];
    const struct accel *a = w->accel;
    if (o->leaf_count < LARGE_OBJECT) {
        const struct box_ray r = box_ray_of(ray);
        uint32_t n = 0;
        for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
            double t;
            if (!aabb_is_finite(w->leaf[i].bounds) ||
                box_meets(&w->leaf[i].bounds, &r, &t))
                s->leaves[n++] = i;
        }
        return n;
    }
    const struct accel_large *large = accel_large(a, o, object);
    uint32_t n = collect_from_tree(&large->leaves, ray, s);
    memcpy(s->leaves + n, large->unbounded, large->unbounded_count * sizeof *s->leaves);
    return n + large->unbounded_count;
}

// ---- states -------------------------------------------------------------------------

struct sweep {
    const struct world *w;
    struct trace_scratch *s;
    const struct csg_node *node; // of this object, by index from its root
    uint32_t root;
};

static bool inside_now(const struct sweep *v, uint32_t n)
{
    return node_is_inside(&v->node[n], v->s->inside[n]);
}

static uint32_t count_before(const struct sweep *v, uint32_t n)
{
    return v->s->stamp[n] == v->s->batch ? v->s->before[n] : v->s->inside[n];
}

static bool inside_before(const struct sweep *v, uint32_t n)
{
    return node_is_inside(&v->node[n], count_before(v, n));
}

static void remember(struct sweep *v, uint32_t n)
{
    if (v->s->stamp[n] == v->s->batch)
        return;
    v->s->stamp[n] = v->s->batch;
    v->s->before[n] = v->s->inside[n];
}

// Sets a leaf's state and counts the change upwards as far as it goes.
static void set_leaf(struct sweep *v, uint32_t leaf, bool in)
{
    uint32_t n = v->w->leaf[leaf].node - v->root;
    if (v->s->inside[n] == (uint32_t)in)
        return;
    remember(v, n);
    v->s->inside[n] = in;
    while (n != 0) {
        const uint32_t up = v->node[n].parent - v->root;
        const bool was = inside_now(v, up);
        remember(v, up);
        v->s->inside[up] += in ? 1u : -1u;
        const bool is = inside_now(v, up);
        if (was == is)
            return;
        in = is;
        n = up;
    }
}

static void toggle_leaf(struct sweep *v, uint32_t leaf)
{
    set_leaf(v, leaf, !v->s->inside[v->w->leaf[leaf].node - v->root]);
}

// Whether the boundary of a leaf is a surface of the whole, given the states around the
// batch (the rules are in doc/architecture.md).
static bool survives(const struct sweep *v, const struct boundary *b)
{
    uint32_t n = v->w->leaf[b->leaf].node - v->root;
    bool was = inside_before(v, n), is = inside_now(v, n);
    // Entered and left within one batch. A flat solid is still to be seen, as a sheet;
    // a flat hole is none.
    if (b->crossing != CROSS_TOUCH && was == is && v->w->leaf[b->leaf].inverted)
        return false;
    while (n != 0) {
        const uint32_t up = v->node[n].parent - v->root;
        const uint32_t before = count_before(v, up), now = v->s->inside[up];
        const bool up_was = inside_before(v, up), up_is = inside_now(v, up);
        const enum node_op op = v->node[up].op;
        if (was != is) {
            if (op != NODE_UNION && up_was == up_is)
                return false;
        } else if (op == NODE_INTERSECTION) {
            const uint32_t others = v->node[up].child_count - 1;
            if (before - was != others || now - is != others)
                return false;
        } else if (op == NODE_MERGE) {
            if (before - was != 0 || now - is != 0)
                return false;
        }
        was = up_was;
        is = up_is;
        n = up;
    }
    return true;
}

// ---- the sweep -------------------------------------------------------------------------

// By the lower ends of the error bounds: then the bounds that overlap, directly or
// through others, are neighbours. States toggle, so the order in a batch is free.
static int by_begin(const void *a, const void *b)
{
    const struct boundary *x = a, *y = b;
    const double s = x->t - x->dt, t = y->t - y->dt;
    if (s != t)
        return s < t ? -1 : 1;
    return x->leaf < y->leaf ? -1 : x->leaf > y->leaf;
}

static void sort_crossings(struct boundary_list *l)
{
    if (l->count > 32) {
        qsort(l->at, l->count, sizeof *l->at, by_begin);
        return;
    }
    for (uint32_t i = 1; i < l->count; i++) {
        const struct boundary b = l->at[i];
        uint32_t j = i;
        for (; j > 0 && by_begin(&l->at[j - 1], &b) > 0; j--)
            l->at[j] = l->at[j - 1];
        l->at[j] = b;
    }
}

// Adds a leaf's crossings and puts it in its state at t = -infinity.
static void start_leaf(struct sweep *v, uint32_t leaf, const struct ray *ray)
{
    struct boundary_list *list = &v->s->crossings;
    const struct leaf *l = &v->w->leaf[leaf];
    const uint32_t from = list->count;
    if (!take_made(v->s, leaf)) {
        leaf_crossings_in_csg(v->w, v->s, leaf, ray);
        v->s->stats.leaf_tests++;
    }
    if (!l->solid)
        return;
    if (list->count > from)
        set_leaf(v, leaf, list->at[from].crossing == CROSS_EXIT);
    else if (!l->bounded)
        set_leaf(v, leaf,
                 l->ops->inside(l->shape, transform_inverse_point(
                                              l->transform, ray->o)) != l->inverted);
}

// Takes a required leaf and narrows *near, the stretch on which the object may have
// surfaces and other leaves count; false when it is empty. The margins only have to
// exceed the errors of t: a leaf too many does no harm.
static bool start_required(struct sweep *v, uint32_t leaf, const struct ray *ray,
                           double limit, struct ray *near)
{
    const struct boundary_list *list = &v->s->crossings;
    const uint32_t from = list->count;
    start_leaf(v, leaf, ray);
    if (list->count == from)
        return false;
    const struct boundary *in = &list->at[from], *out = &list->at[list->count - 1];
    const double begin = in->t - in->dt, end = out->t + out->dt;
    if (in->crossing != CROSS_ENTER || out->crossing != CROSS_EXIT)
        return true; // the shape left crossings out that it was told not to need
    if (begin > limit || begin >= ray->t_max || end <= ray->t_min)
        return false;
    const double margin = 0x1p-10 * (end - begin) + 0x1p-30 * (fabs(begin) + fabs(end));
    near->t_min = fmax(near->t_min, begin - margin);
    near->t_max = fmin(near->t_max, end + margin);
    return true;
}

static bool start_all_required(struct sweep *v, uint32_t object, const struct ray *ray,
                               double limit, struct ray *near)
{
    const struct world_object *o = &v->w->object[object];
    const struct accel_large *large = accel_large(v->w->accel, o, object);
    if (large) {
        for (uint32_t i = 0; i < large->required_count; i++)
            if (!start_required(v, large->required[i], ray, limit, near))
                return false;
    } else {
        for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
            if (v->w->leaf[i].required && !start_required(v, i, ray, limit, near))
                return false;
    }
    return near->t_min <= near->t_max;
}

// Gathers the crossings and the states before them; false: there is no surface.
static bool start(struct sweep *v, uint32_t object, const struct ray *ray, double limit)
{
    struct trace_scratch *s = v->s;
    const struct world_object *o = &v->w->object[object];
    memcpy(s->inside, v->w->accel->base_inside + o->root,
           o->node_count * sizeof *s->inside);
    s->crossings.count = 0;
    s->own_count = 0;
    s->batch++;
    struct ray near = *ray;
    if (!start_all_required(v, object, ray, limit, &near))
        return false;
    const uint32_t n = collect(v->w, s, object, &near);
    for (uint32_t i = 0; i < n; i++)
        if (!v->w->leaf[s->leaves[i]].required)
            start_leaf(v, s->leaves[i], ray);
    sort_crossings(&s->crossings);
    return true;
}

static bool ends_search(const struct sweep *v, const struct boundary *b,
                        enum sweep_mode mode)
{
    return mode == SWEEP_CLOSEST || v->w->surface[v->w->leaf[b->leaf].surface].opaque;
}

bool sweep_object(const struct world *w, struct trace_scratch *s, uint32_t object,
                  const struct ray *ray, double limit, enum sweep_mode mode,
                  struct boundary *out)
{
    struct sweep v = {w, s, w->node + w->object[object].root, w->object[object].root};
    const struct box_ray box = box_ray_of(ray);
    double begins;
    s->stats.csg_tests++;
    // A crossing that could be anywhere on the line, but for its error, is not outside the box.
    if (!box_meets(&w->object[object].bounds, &box, &begins))
        return false;
    if (!start(&v, object, ray, limit))
        return false;
    const struct boundary_list *l = &s->crossings;
    for (uint32_t i = 0, end; i < l->count; i = end) {
        double reach = l->at[i].t + l->at[i].dt;
        s->batch++;
        // A shape of infinite size may give a t that is no number: it ends a batch.
        for (end = i;
             end < l->count && (end == i || l->at[end].t - l->at[end].dt <= reach);
             end++) {
            const struct boundary *b = &l->at[end];
            reach = b->t + b->dt > reach ? b->t + b->dt : reach;
            if (b->crossing != CROSS_TOUCH)
                toggle_leaf(&v, b->leaf);
        }
        if (reach <= ray->t_min)
            continue;
        const double begin = l->at[i].t - l->at[i].dt;
        if (begin >= ray->t_max || begin > limit)
            return false;
        const struct boundary *found = NULL;
        for (uint32_t k = i; k < end; k++) {
            const struct boundary *b = &l->at[k];
            if (b->drawn && b->t > ray->t_min && b->t < ray->t_max &&
                (!found || b->leaf > found->leaf) && survives(&v, b) &&
                ends_search(&v, b, mode))
                found = b;
        }
        if (found) {
            *out = boundary_as_shape_has_it(s, found);
            return true;
        }
    }
    return false;
}
