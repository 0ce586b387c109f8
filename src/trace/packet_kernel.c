// The tracer's inner loops, compiled once per instruction set: ISA names it, the compiler's
// flags choose the width in math/lanes.h. All give the same bits.
#include "math/isa.h"
#include "trace/packet.h"
#include "trace/packet_any.h"
#include "trace/packet_list.h"
#include "trace/packet_shaft.h"

enum { SMALL_TREE = 16 }; // nodes up to which packets always pay

// ---- one ray ----------------------------------------------------------------------------

static bool lone_hidden(const struct search *f, uint32_t object)
{
    const struct world_object *o = &f->w->object[object];
    return (o->flags & f->q->hidden_by) || (f->mode == SWEEP_OPAQUE && !o->opaque);
}

// The crossings of the spheres among `count` items of the tree, as spheres8 below; says
// whether one is the nearest now.
static bool walk_spheres(struct search *f, const struct ray8 *ray, uint32_t first,
                         uint32_t count)
{
    const struct accel *a = f->w->accel;
    const struct vec8 centre = {r8_load(a->ball[0] + first), r8_load(a->ball[1] + first),
                                r8_load(a->ball[2] + first)};
    const struct real8 r = r8_load(a->ball[3] + first);
    const struct vec8 oc = v8_sub(ray->o, centre);
    const struct real8 at = r8_div(v8_dot(ray->d, oc), ray->dd);
    const struct vec8 near = v8_mad(oc, r8_neg(at), ray->d);
    const struct real8 rest = r8_sub(r8_mul(r, r), v8_dot(near, near));
    unsigned met = m8_bits(r8_lt(r8_set(0), rest)) & ((1u << count) - 1);
    if (!met)
        return false;
    const struct real8 reach = r8_sqrt(r8_div(rest, ray->dd));
    const struct real8 t_min = r8_set(f->q->ray.t_min);
    const struct real8 t0 = r8_sub(r8_neg(at), reach), t1 = r8_add(r8_neg(at), reach);
    const struct real8 t = r8_select(r8_lt(t_min, t0), t0, t1);
    met &= m8_bits(m8_and(r8_lt(t_min, t), r8_lt(t, r8_set(f->q->ray.t_max))));
    met &= m8_bits(r8_le(t, r8_set(f->t)));
    if (!met)
        return false;
    double all[8];
    bool found = false;
    const bool ask =
        (a->lone_flags & f->q->hidden_by) || (f->mode == SWEEP_OPAQUE && !a->lone_opaque);
    r8_store(all, t);
    for (; met; met &= met - 1) {
        const uint32_t i = first + (uint32_t)__builtin_ctz(met);
        const uint32_t object = a->top.item[i];
        if (!search_is_nearer(f, all[i - first], object) ||
            (ask && lone_hidden(f, object)))
            continue;
        f->t = all[i - first];
        f->object = object;
        f->known = false;
        found = true;
    }
    return found;
}

// Shapes that packets know are for packets, of one ray as well; a mesh is walked by the ray.
LANES_INLINE bool takes_one(unsigned shape)
{
    return shape == PACKET_PRODUCT || shape == PACKET_CARVED || shape == PACKET_CSG ||
           (shape >= PACKET_SPHERE && shape <= PACKET_TORUS);
}

// What a leaf of the tree holds takes some rays as well as one.
LANES_INLINE bool takes_some(const struct accel *a, int32_t child)
{
    const uint32_t first = bvh8_leaf_first(child);
    return bvh8_leaf_count(child) == 1 &&
           (a->ball[3][first] > 0 || takes_one(a->object_shape[a->top.item[first]]));
}

// boxed: the lane has just met the object's own box.
static bool walk_packet(struct eight *e, int lane, uint32_t object, bool boxed)
{
    struct packet *p = e->p;
    packet_lane_end(p, lane);
    e->boxed = boxed;
    const bool won = try_eight(e, 1u << lane, object);
    e->boxed = false;
    if (!won)
        return false;
    packet_lane_begin(p, lane);
    return true;
}

// e: the packet of which the ray is a lane, or NULL.
static bool walk_leaf(struct search *f, const struct ray8 *ray, uint32_t first,
                      uint32_t count, struct eight *e, int lane)
{
    const struct accel *a = f->w->accel;
    uint32_t balls = 0;
    for (uint32_t i = first; i < first + count; i++)
        balls += a->ball[3][i] > 0;
    f->s->stats.leaf_tests += balls;
    bool found = balls && walk_spheres(f, ray, first, count);
    if (balls == count)
        return found;
    for (uint32_t i = first; i < first + count; i++) {
        const uint32_t object = a->top.item[i];
        if (a->ball[3][i] > 0)
            continue;
        if (e && takes_one(a->object_shape[object]))
            found |= walk_packet(e, lane, object, count == 1);
        else
            found |= search_try_object(f, object);
    }
    return found;
}

static void walk_from(struct search *f, struct bvh8_ray *r, int32_t child,
                      struct eight *in, int lane)
{
    const struct bvh8 *tree = &f->w->accel->top;
    const struct ray *q = &f->q->ray;
    const struct ray8 ray = {.o = V8_SET(q->o), .d = V8_SET(q->d), .dd = r8_set(f->dd)};
    const struct tree_ray8 v = tree_ray8_of(r);
    struct bvh8_entry stack[BVH8_STACK];
    uint32_t depth = 0;
    stack[depth++] = (struct bvh8_entry){child, 0};
    while (depth) {
        const struct bvh8_entry e = stack[--depth];
        if (e.t > r->t_far * BVH8_SLACK)
            continue;
        if (e.child < 0) {
            if (!walk_leaf(f, &ray, bvh8_leaf_first(e.child), bvh8_leaf_count(e.child),
                           in, lane))
                continue;
            if (f->mode == SWEEP_OPAQUE)
                return;
            bvh8_ray_limit(r, f->t);
            continue;
        }
        f->s->stats.node_visits++;
        depth = push_children(&tree->node[e.child], r, &v, stack, depth);
    }
}

static void walk(struct search *f, struct bvh8_ray *r, int32_t child)
{
    walk_from(f, r, child, NULL, 0);
}

// ---- the tree ---------------------------------------------------------------------------

static void limit(struct packet *p, unsigned won)
{
    tree_limit(&p->top, won, p->t, p->mode == SWEEP_OPAQUE);
}

static void one_by_one(struct eight *e, unsigned lanes, int32_t child)
{
    struct packet *p = e->p;
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        struct bvh8_ray r = tree_lane(&p->top, i);
        const double before = p->t[i];
        walk_from(packet_lane_begin(p, i), &r, child, e, i);
        packet_lane_end(p, i);
        if (p->t[i] < before)
            tree_limit_lane(&p->top, i, p->t[i], p->mode == SWEEP_OPAQUE);
    }
}

static void traverse(struct eight *e, unsigned lanes)
{
    struct packet *p = e->p;
    const struct bvh8 *tree = &p->w->accel->top;
    struct tree8 v = tree8_of(&p->top, lanes);
    const bool any = p->mode == SWEEP_OPAQUE;
    const uint32_t together = p->w->accel->together, alone = p->w->accel->alone;
    struct packet_entry stack[BVH8_STACK];
    uint32_t depth = 1;
    f8_store(stack[0].near, f8_set(0));
    stack[0].child = 0;
    while (depth) {
        const struct packet_entry *top = &stack[--depth];
        const int32_t child = top->child;
        v.far = f8_load(p->top.t_far);
        const unsigned bits =
            f8_le(f8_load(top->near), f8_mul(v.far, f8_set(BVH8_SLACK)));
        if (!bits)
            continue;
        if ((uint32_t)__builtin_popcount(bits) <= alone &&
            (child >= 0 || !takes_some(p->w->accel, child))) {
            one_by_one(e, bits, child);
            continue;
        }
        if (child < 0) {
            const uint32_t first = bvh8_leaf_first(child), n = bvh8_leaf_count(child);
            unsigned won = 0;
            e->boxed = n == 1;
            for (uint32_t i = first; i < first + n; i++)
                won |= try_item(e, bits, i);
            e->boxed = false;
            limit(p, won);
            if (any && !(lanes &= ~won))
                return;
            continue;
        }
        uint32_t met_lanes = 0;
        p->s->stats.node_visits++;
        depth = push_children8(&tree->node[child], &v, stack, depth, any, &met_lanes);
        // Rays that part at the root gain nothing from each other, and each alone meets
        // its boxes in its own order.
        if (child == 0 && tree->node_count > SMALL_TREE && met_lanes < together * depth) {
            one_by_one(e, bits, 0);
            return;
        }
    }
}

static void find(struct eight *e, struct packet *p)
{
    const struct accel *a = p->w->accel;
    for (uint32_t i = 0; i < a->infinite_count && p->alive; i++) {
        const unsigned won = try_eight(e, p->alive, a->infinite[i]);
        if (p->mode == SWEEP_OPAQUE)
            p->alive &= ~won;
    }
    if (!p->alive || !a->top.node)
        return;
    if (a->few) {
        for (uint32_t i = 0; i < a->top.item_count && p->alive; i++) {
            const unsigned won = try_item(e, p->alive, i);
            if (p->mode == SWEEP_OPAQUE)
                p->alive &= ~won;
        }
        return;
    }
    const unsigned lanes = tree_begin(&a->top, e->ray.o, e->ray.d, e->inverse, e->t_min,
                                      r8_min(e->t_max, r8_load(p->t)), p->alive, &p->top);
    if (lanes)
        traverse(e, lanes);
}

// The same for whether there is any hit, of some objects alone.
static void find_some(struct eight *e, struct packet *p, uint64_t some)
{
    for (; some && p->alive; some &= some - 1)
        p->alive &= ~try_eight(e, p->alive, (uint32_t)__builtin_ctzll(some));
}

// The same of listed ones: those that are dearer than their boxes behind them.
static void find_listed(struct eight *e, struct packet *p, const uint32_t *object,
                        uint32_t count)
{
    for (uint32_t i = 0; i < count && p->alive; i++) {
        const struct world_object *o = &p->w->object[object[i]];
        const enum packet_shape shape = p->w->accel->object_shape[object[i]];
        const bool boxed = (shape < PACKET_SPHERE || shape > PACKET_CYLINDER) &&
                           aabb_is_finite(o->bounds);
        unsigned lanes = p->alive;
        if (boxed)
            lanes &= box_lanes(e, &o->bounds);
        e->boxed = boxed;
        if (lanes)
            p->alive &= ~try_eight(e, lanes, object[i]);
    }
    e->boxed = false;
}

// As box_ray_of has it.
LANES_INLINE struct real8 inverse8(struct real8 d, struct real8 longest)
{
    return r8_select(runs_along8(d, longest), r8_set(INFINITY), r8_div(r8_set(1), d));
}

// Eight rays of the batch, from `first` on.
static void begin(struct eight *e, struct packet *p, const struct ray_batch *r,
                  uint32_t first, unsigned lanes)
{
    p->rays = r;
    p->first = first;
    p->alive = lanes;
    p->searching = p->whole = p->hidden_any = 0;
    r8_store(p->t, r8_set(INFINITY));
    u8_put(p->object, 255, UINT32_MAX);
    if (p->w->accel->flags &
        (OBJECT_NO_IMAGE | OBJECT_NO_REFLECTION | OBJECT_NO_SHADOW | OBJECT_NO_RADIOSITY))
        for (uint32_t i = 0; i < 8; i++)
            p->hidden_any |= r->hidden_by[first + i];
    e->p = p;
    e->ray = ray8_of((struct vec8){r8_load(r->o[0] + first), r8_load(r->o[1] + first),
                                   r8_load(r->o[2] + first)},
                     (struct vec8){r8_load(r->d[0] + first), r8_load(r->d[1] + first),
                                   r8_load(r->d[2] + first)});
    e->t_min = r8_load(r->t_min + first);
    e->t_max = r8_load(r->t_max + first);
    e->sheared = e->boxed = false;
    const struct real8 longest = v8_max_abs(e->ray.d);
    e->inverse =
        (struct vec8){inverse8(e->ray.d.x, longest), inverse8(e->ray.d.y, longest),
                      inverse8(e->ray.d.z, longest)};
}

// The rays from `first` to the end of the batch, fewer than eight, with copies of the first
// behind them.
struct rest {
    struct ray_batch rays;
    double number[8][8];
    unsigned hidden_by[8];
};

static const struct ray_batch *rest_of(struct rest *x, const struct ray_batch *r,
                                       uint32_t first)
{
    const double *const from[8] = {r->o[0], r->o[1], r->o[2],  r->d[0],
                                   r->d[1], r->d[2], r->t_min, r->t_max};
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t k = first + i < r->count ? first + i : first;
        for (int a = 0; a < 8; a++)
            x->number[a][i] = from[a][k];
        x->hidden_by[i] = r->hidden_by[k];
    }
    x->rays = (struct ray_batch){.count = r->count - first,
                                 .capacity = 8,
                                 .o = {x->number[0], x->number[1], x->number[2]},
                                 .d = {x->number[3], x->number[4], x->number[5]},
                                 .t_min = x->number[6],
                                 .t_max = x->number[7],
                                 .hidden_by = x->hidden_by};
    return &x->rays;
}

static void hits_from(struct packet *p, const struct ray_batch *r, uint32_t first,
                      unsigned lanes, const struct hit_batch *out)
{
    struct eight e; // not set to zero as a whole: it is large
    begin(&e, p, r, first, lanes);
    find(&e, p);
    hits(&e, out);
}

static void trace_closest8(const struct world *w, struct trace_scratch *s,
                           const struct ray_batch *rays, const struct hit_batch *out)
{
    struct packet p;
    p.w = w;
    p.s = s;
    p.mode = SWEEP_CLOSEST;
    s->stats.rays += rays->count;
    uint32_t i = 0;
    for (; i + 8 <= rays->count; i += 8)
        hits_from(&p, rays, i, 255, out);
    if (i < rays->count) {
        struct rest x;
        const struct hit_batch to = {out->t + i,       out->dt + i, out->part + i,
                                     out->u + i,       out->v + i,  out->leaf + i,
                                     out->crossing + i};
        hits_from(&p, rest_of(&x, rays, i), 0, (1u << (rays->count - i)) - 1, &to);
    }
}

static void trace_occluded8(const struct world *w, struct trace_scratch *s,
                            const struct ray_batch *rays, const uint64_t *some,
                            uint8_t *out)
{
    struct packet p;
    struct rest x;
    p.w = w;
    p.s = s;
    p.mode = SWEEP_OPAQUE;
    s->stats.shadow_rays += rays->count;
    uint32_t blocker = UINT32_MAX; // of all rays before: likely of these as well
    struct shaft_search shaft;
    shaft.end = shaft.skip = shaft.failed = 0;
    shaft.count = RAY_SHAFT_MANY;
    for (uint32_t i = 0; i < rays->count; i += 8) {
        struct eight e;
        const uint32_t n = rays->count - i < 8 ? rays->count - i : 8;
        if (!some && i == shaft.end)
            shaft_search_at(&shaft, w, rays, i);
        if (!shaft.count) {
            memset(out + i, 0, 8);
            continue;
        }
        if (n == 8)
            begin(&e, &p, rays, i, 255);
        else
            begin(&e, &p, rest_of(&x, rays, i), 0, (1u << n) - 1);
        if (blocker != UINT32_MAX)
            p.alive &= ~try_eight(&e, p.alive, blocker);
        if (some)
            find_some(&e, &p, *some);
        else if (shaft.count != RAY_SHAFT_MANY)
            find_listed(&e, &p, shaft.object, shaft.count);
        else if (p.alive)
            find(&e, &p);
        bool all = true;
        for (uint32_t k = 0; k < n; k++) {
            out[i + k] = p.object[k] != UINT32_MAX;
            all &= out[i + k];
        }
        blocker = all ? p.object[0] : UINT32_MAX;
    }
}

static void crossings(const struct world *w, struct trace_scratch *s,
                      const struct ray_batch *rays, uint32_t first, unsigned lanes,
                      struct crossings8 *out)
{
    struct packet p;
    struct eight e;
    p.w = w;
    p.s = s;
    p.mode = SWEEP_CLOSEST;
    s->stats.rays += (unsigned)__builtin_popcount(lanes);
    memset(out->count, 0, sizeof out->count);
    out->left = 0;
    begin(&e, &p, rays, first, lanes);
    list_all(&e, out);
}

static bool carve(struct search *f, uint32_t object, struct boundary *out, bool *unsure)
{
    const struct ray *q = &f->q->ray;
    double number[8] = {q->o.x, q->o.y, q->o.z,   q->d.x,
                        q->d.y, q->d.z, q->t_min, q->t_max};
    unsigned hidden_by = 0;
    const struct ray_batch one = {.count = 1,
                                  .capacity = 1,
                                  .o = {&number[0], &number[1], &number[2]},
                                  .d = {&number[3], &number[4], &number[5]},
                                  .t_min = &number[6],
                                  .t_max = &number[7],
                                  .hidden_by = &hidden_by};
    struct rest x;
    struct packet p;
    struct eight e;
    struct carve_hits h;
    p.w = f->w;
    p.s = f->s;
    p.mode = f->mode;
    begin(&e, &p, rest_of(&x, &one, 0), 0, 1);
    const unsigned met = carve8(&e, 1, object, r8_set(f->t), &h);
    *unsure = h.unsure != 0;
    if (!met)
        return false;
    if (h.own) {
        *out = shape_hits_at(&h.hits, 0);
        out->leaf = h.leaf[0];
        out->crossing = crossing_of_leaf(out->crossing, f->w->leaf[out->leaf].inverted);
    } else {
        *out = boundary_at(f->w, f->s, q, h.leaf[0], h.t[0]);
    }
    return true;
}

const struct packet_kernels OF_ISA(packet_kernels_) = {
    ISA_TEXT,      trace_closest8,          trace_occluded8,       crossings, walk, carve,
    shaft_objects, &OF_ISA(shape_kernels_), OF_ISA(photon_search_)};
