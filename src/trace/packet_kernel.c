// The tracer's inner loops, compiled once per instruction set: ISA names it, the compiler's
// flags choose the width in trace/lanes.h. All give the same bits.
#include "trace/packet.h"
#include "trace/packet_sponge.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b) PASTE_(a, b)
#define TEXT_(a) #a
#define TEXT(a) TEXT_(a)

enum {
    FEW = 2,         // lanes that go on one by one
    SMALL_TREE = 8,  // nodes up to which packets always pay
    TOGETHER = 4     // of the lanes at the root, how many a child must hold on average
};

// ---- one ray ----------------------------------------------------------------------------

struct tree_ray8 {
    struct float8 o[3], inverse[3];
};

LANES_INLINE unsigned node_meets(const struct bvh8_node *n, const struct bvh8_ray *r,
                                 const struct tree_ray8 *v, float near_t[8])
{
    struct float8 near = f8_set(0), far = f8_set(r->t_far);
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct float8 p = f8_load(n->box[a + r->negative[a]]);
        const struct float8 q = f8_load(n->box[a + 3 - r->negative[a]]);
        near = f8_max(f8_mul(f8_sub(p, v->o[a]), v->inverse[a]), near);
        far = f8_min(f8_mul(f8_sub(q, v->o[a]), v->inverse[a]), far);
    }
    f8_store(near_t, near);
    return f8_le(near, f8_mul(far, f8_set(BVH8_SLACK)));
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
    r8_store(all, t);
    for (; met; met &= met - 1) {
        const uint32_t i = first + (uint32_t)__builtin_ctz(met);
        const uint32_t object = a->top.item[i];
        if (!search_is_nearer(f, all[i - first], object) ||
            (f->w->object[object].flags & f->q->hidden_by) ||
            (f->mode == SWEEP_OPAQUE && !f->w->object[object].opaque))
            continue;
        f->t = all[i - first];
        f->object = object;
        f->known = false;
        found = true;
    }
    return found;
}

static bool walk_leaf(struct search *f, const struct ray8 *ray, uint32_t first,
                      uint32_t count)
{
    const struct accel *a = f->w->accel;
    uint32_t balls = 0;
    for (uint32_t i = first; i < first + count; i++)
        balls += a->ball[3][i] > 0;
    f->s->stats.leaf_tests += balls;
    bool found = balls && walk_spheres(f, ray, first, count);
    if (balls == count)
        return found;
    for (uint32_t i = first; i < first + count; i++)
        if (!(a->ball[3][i] > 0))
            found |= search_try_object(f, a->top.item[i]);
    return found;
}

static void walk(struct search *f, struct bvh8_ray *r, int32_t child)
{
    const struct bvh8 *tree = &f->w->accel->top;
    const struct ray *q = &f->q->ray;
    const struct ray8 ray = {.o = V8_SET(q->o), .d = V8_SET(q->d), .dd = r8_set(f->dd)};
    struct tree_ray8 v;
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        v.o[a] = f8_set(r->o[a]);
        v.inverse[a] = f8_set(r->inverse[a]);
    }
    struct bvh8_entry stack[BVH8_STACK];
    uint32_t depth = 0;
    stack[depth++] = (struct bvh8_entry){child, 0};
    while (depth) {
        const struct bvh8_entry e = stack[--depth];
        if (e.t > r->t_far * BVH8_SLACK)
            continue;
        if (e.child < 0) {
            if (!walk_leaf(f, &ray, bvh8_leaf_first(e.child), bvh8_leaf_count(e.child)))
                continue;
            if (f->mode == SWEEP_OPAQUE)
                return;
            bvh8_ray_limit(r, f->t);
            continue;
        }
        float t[8];
        const struct bvh8_node *n = &tree->node[e.child];
        const uint32_t base = depth;
        f->s->stats.node_visits++;
        for (unsigned bits = node_meets(n, r, &v, t); bits; bits &= bits - 1) {
            const int k = __builtin_ctz(bits);
            uint32_t at = depth++;
            for (; at > base && stack[at - 1].t < t[k]; at--)
                stack[at] = stack[at - 1];
            stack[at] = (struct bvh8_entry){n->child[k], t[k]};
        }
    }
}

// ---- the tree ---------------------------------------------------------------------------

static unsigned try_eight(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    const struct world_object *o = &p->w->object[object];
    const enum packet_shape shape = a->object_shape[object];
    if (shape == PACKET_NONE)
        return packet_try_object(p, bits, object);
    bits = seeing(p, o->flags, bits);
    if (!bits || (p->mode == SWEEP_OPAQUE && !o->opaque))
        return 0;
    if (shape == PACKET_PRODUCT)
        return product(e, bits, object);
    if (shape == PACKET_SPONGE)
        return accel_large(a, o, object)->ball ? sponge(e, bits, object)
                                               : packet_try_object(p, bits, object);
    p->s->stats.leaf_tests++;
    return lone(e, bits, object);
}

// Item i of the tree: a bare sphere stands in the tree's own list, so that most tests
// touch nothing else.
static unsigned try_item(struct eight *e, unsigned bits, uint32_t i)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    const struct sphere ball = {.centre = vec3(a->ball[0][i], a->ball[1][i], a->ball[2][i]),
                                .radius = a->ball[3][i]};
    if (!(ball.radius > 0))
        return try_eight(e, bits, a->top.item[i]);
    p->s->stats.leaf_tests++;
    const struct span8 x = span8_sphere(&ball, &e->ray);
    bits &= m8_bits(x.met);
    if (!bits)
        return 0;
    const uint32_t object = a->top.item[i];
    const struct world_object *o = &p->w->object[object];
    bits = seeing(p, o->flags, bits);
    if (p->mode == SWEEP_OPAQUE && !o->opaque)
        return 0;
    const struct real8 t = r8_select(r8_lt(e->t_min, x.in), x.in, x.out);
    return take(e, bits, t, object, 0);
}

struct packet_entry {
    float near[8]; // where the lanes enter the box; beyond all where they do not
    int32_t child;
    float t; // of one lane, for the order
};

struct tree8 {
    struct float8 o[3], inverse[3], far;
    int negative[3];
    bool mixed; // the directions' signs differ between lanes
};

static const float never = 3e38f;

LANES_INLINE unsigned child_meets(const struct bvh8_node *n, int k, const struct tree8 *v,
                                  float near_t[8])
{
    struct float8 near = f8_set(0), far = v->far;
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct float8 p = f8_mul(
            f8_sub(f8_set(n->box[a + v->negative[a]][k]), v->o[a]), v->inverse[a]);
        const struct float8 q = f8_mul(
            f8_sub(f8_set(n->box[a + 3 - v->negative[a]][k]), v->o[a]), v->inverse[a]);
        near = f8_max(v->mixed ? f8_min(p, q) : p, near);
        far = f8_min(v->mixed ? f8_max(p, q) : q, far);
    }
    far = f8_mul(far, f8_set(BVH8_SLACK));
    const unsigned bits = f8_le(near, far);
    if (bits)
        f8_store(near_t, f8_keep_le(near, far, never));
    return bits;
}

// As bvh8_ray_begin, for each alive lane; returns those that may meet the tree.
static unsigned tree_begin(struct eight *e)
{
    struct packet *p = e->p;
    const struct bvh8 *b = &p->w->accel->top;
    const struct real8 largest = v8_max_abs(e->ray.d), tiny = r8_set(0x1p-60);
    const struct vec8 d = e->ray.d, o = e->ray.o;
    struct real8 t_min = e->t_min, t_max = r8_min(e->t_max, r8_load(p->t));
    struct mask8 out = m8_of(0);
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct real8 at = a == 0 ? o.x : a == 1 ? o.y : o.z;
        const struct real8 by = a == 0 ? d.x : a == 1 ? d.y : d.z;
        const struct real8 lo = r8_set(vec3_axis(b->bounds.min, a));
        const struct real8 hi = r8_set(vec3_axis(b->bounds.max, a));
        const struct mask8 flat = r8_lt(r8_abs(by), r8_mul(tiny, largest));
        const struct real8 inv = a == 0   ? e->inverse.x
                                 : a == 1 ? e->inverse.y
                                          : e->inverse.z;
        const struct real8 t0 = r8_mul(r8_sub(lo, at), inv);
        const struct real8 t1 = r8_mul(r8_sub(hi, at), inv);
        t_min = r8_select(flat, t_min, r8_max(t_min, r8_min(t0, t1)));
        t_max = r8_select(flat, t_max, r8_min(t_max, r8_max(t0, t1)));
        out = m8_or(out, m8_and(flat, m8_or(r8_lt(at, lo), r8_lt(hi, at))));
        const struct real8 most = r8_select(r8_lt(by, r8_set(0)), r8_set(-0x1p60),
                                            r8_set(0x1p60));
        r8_store_floats(p->tree_inverse[a],
                        r8_select(flat, most, r8_mul(largest, inv)));
    }
    const unsigned in = p->alive & m8_bits(m8_without(r8_le(t_min, t_max), out));
    const struct vec8 begin = v8_sub(v8_mad(o, t_min, d), V8_SET(b->origin));
    r8_store_floats(p->tree_o[0], begin.x);
    r8_store_floats(p->tree_o[1], begin.y);
    r8_store_floats(p->tree_o[2], begin.z);
    r8_store(p->t_begin, t_min);
    r8_store(p->scale, largest);
    const struct real8 far = r8_mul(r8_sub(t_max, t_min), largest);
    r8_store_floats(p->t_far, r8_select(m8_of(in),
                                        r8_min(r8_mul(far, r8_set(BVH8_SLACK)),
                                               r8_set(1e30)),
                                        r8_set(-1)));
    return in;
}

// The lanes of `won` have a nearer hit.
static void limit(struct packet *p, unsigned won)
{
    for (; won; won &= won - 1) {
        const int i = __builtin_ctz(won);
        const double far = (p->t[i] - p->t_begin[i]) * p->scale[i];
        p->t_far[i] = p->mode == SWEEP_OPAQUE ? -1
                      : far < 1e30            ? (float)far * BVH8_SLACK
                                              : 1e30f;
    }
}

static void one_by_one(struct packet *p, unsigned lanes, int32_t child)
{
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        struct bvh8_ray r = {.t_far = p->t_far[i],
                             .t_begin = p->t_begin[i],
                             .scale = p->scale[i]};
        for (int a = 0; a < 3; a++) {
            r.o[a] = p->tree_o[a][i];
            r.inverse[a] = p->tree_inverse[a][i];
            r.negative[a] = r.inverse[a] < 0 ? 3 : 0;
        }
        const double before = p->t[i];
        walk(packet_lane_begin(p, i), &r, child);
        packet_lane_end(p, i);
        if (p->t[i] < before)
            limit(p, 1u << i);
    }
}

static void traverse(struct eight *e, unsigned lanes)
{
    struct packet *p = e->p;
    const struct bvh8 *tree = &p->w->accel->top;
    struct tree8 v = {.mixed = false};
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        v.o[a] = f8_load(p->tree_o[a]);
        v.inverse[a] = f8_load(p->tree_inverse[a]);
        const unsigned down = lanes & ~f8_le(f8_set(0), v.inverse[a]);
        v.negative[a] = down ? 3 : 0;
        v.mixed |= down && down != lanes;
    }
    if (v.mixed)
        v.negative[0] = v.negative[1] = v.negative[2] = 0;
    struct packet_entry stack[BVH8_STACK];
    uint32_t depth = 1;
    f8_store(stack[0].near, f8_set(0));
    stack[0].child = 0;
    while (depth) {
        const struct packet_entry *top = &stack[--depth];
        const int32_t child = top->child;
        v.far = f8_load(p->t_far);
        const unsigned bits =
            f8_le(f8_load(top->near), f8_mul(v.far, f8_set(BVH8_SLACK)));
        if (!bits)
            continue;
        if (!(bits & (bits - 1)) || (FEW > 1 && __builtin_popcount(bits) <= FEW)) {
            one_by_one(p, bits, child);
            continue;
        }
        if (child < 0) {
            const uint32_t first = bvh8_leaf_first(child), n = bvh8_leaf_count(child);
            unsigned won = 0;
            for (uint32_t i = first; i < first + n; i++)
                won |= try_item(e, bits, i);
            limit(p, won);
            continue;
        }
        const struct bvh8_node *n = &tree->node[child];
        const uint32_t base = depth;
        uint32_t met_lanes = 0;
        p->s->stats.node_visits++;
        for (int k = 0; k < 8 && n->child[k] != BVH8_EMPTY; k++) {
            float near[8];
            const unsigned met = child_meets(n, k, &v, near);
            if (!met)
                continue;
            met_lanes += (uint32_t)__builtin_popcount(met);
            const float t = near[__builtin_ctz(met)];
            uint32_t at = depth++;
            for (; at > base && stack[at - 1].t < t; at--)
                stack[at] = stack[at - 1];
            f8_store(stack[at].near, f8_load(near));
            stack[at].child = n->child[k];
            stack[at].t = t;
        }
        // Rays that part at the root gain nothing from each other, and each alone meets
        // its boxes in its own order.
        if (child == 0 && tree->node_count > SMALL_TREE && met_lanes < TOGETHER * depth) {
            one_by_one(p, bits, 0);
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
    const unsigned lanes = tree_begin(e);
    if (lanes)
        traverse(e, lanes);
}

static void trace(struct packet *p, struct hit *out)
{
    const unsigned lanes = p->alive;
    struct eight e = {
        .p = p,
        .ray = ray8_of(
            (struct vec8){r8_load(p->o[0]), r8_load(p->o[1]), r8_load(p->o[2])},
            (struct vec8){r8_load(p->d[0]), r8_load(p->d[1]), r8_load(p->d[2])}),
        .t_min = r8_load(p->t_min),
        .t_max = r8_load(p->t_max),
        .sheared = false};
    e.inverse = (struct vec8){r8_div(r8_set(1), e.ray.d.x), r8_div(r8_set(1), e.ray.d.y),
                              r8_div(r8_set(1), e.ray.d.z)};
    find(&e, p);
    if (out)
        hits(&e, lanes, out);
}

const struct packet_kernels PASTE(packet_kernels_, ISA) = {TEXT(ISA), trace, walk};
