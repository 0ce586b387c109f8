#ifndef TRACE_PACKET_TREE_H
#define TRACE_PACKET_TREE_H

// Eight rays and the boxes of a BVH8; one ray and eight boxes.
#include "math/lanes.h"
#include "trace/packet.h"
#include "trace/packet_shapes.h"

// ---- one ray ----------------------------------------------------------------------------

struct tree_ray8 {
    struct float8 o[3], inverse[3];
};

LANES_INLINE struct tree_ray8 tree_ray8_of(const struct bvh8_ray *r)
{
    struct tree_ray8 v;
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        v.o[a] = f8_set(r->o[a]);
        v.inverse[a] = f8_set(r->inverse[a]);
    }
    return v;
}

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

// Puts the children that the ray meets on the stack, the nearest on top.
LANES_INLINE uint32_t push_children(const struct bvh8_node *n, const struct bvh8_ray *r,
                                    const struct tree_ray8 *v, struct bvh8_entry *stack,
                                    uint32_t depth)
{
    float t[8];
    const uint32_t base = depth;
    for (unsigned bits = node_meets(n, r, v, t); bits; bits &= bits - 1) {
        const int k = __builtin_ctz(bits);
        uint32_t at = depth++;
        for (; at > base && stack[at - 1].t < t[k]; at--)
            stack[at] = stack[at - 1];
        stack[at] = (struct bvh8_entry){n->child[k], t[k]};
    }
    return depth;
}

// The ray of one lane.
static inline struct bvh8_ray tree_lane(const struct tree_lanes *l, int lane)
{
    struct bvh8_ray r = {
        .t_far = l->t_far[lane], .t_begin = l->t_begin[lane], .scale = l->scale[lane]};
    for (int a = 0; a < 3; a++) {
        r.o[a] = l->o[a][lane];
        r.inverse[a] = l->inverse[a][lane];
        r.negative[a] = r.inverse[a] < 0 ? 3 : 0;
    }
    return r;
}

// ---- eight rays ---------------------------------------------------------------------------

struct packet_entry {
    float near[8]; // where the lanes enter the box; beyond all where they do not
    int32_t child;
    float t; // of one lane, for the order
};

struct tree8 {
    struct float8 o[3], inverse[3], far;
    int negative[3];
    bool mixed; // the directions' signs differ between lanes
    // Where they do not: of the lanes' origins the one that meets a near side first, and a
    // far side last, and the range of `inverse`.
    float o_near[3], o_far[3], slowest[3], fastest[3];
};

static const float never = 3e38f;

LANES_INLINE void tree8_ranges(struct tree8 *v, unsigned lanes)
{
    float o[3][8], inverse[3][8];
    const int some = __builtin_ctz(lanes);
    if (lanes != 255) {
        for (int a = 0; a < 3; a++) {
            f8_store(o[a], v->o[a]);
            f8_store(inverse[a], v->inverse[a]);
            for (unsigned m = lanes ^ 255; m; m &= m - 1) {
                o[a][__builtin_ctz(m)] = o[a][some];
                inverse[a][__builtin_ctz(m)] = inverse[a][some];
            }
        }
    }
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        float lo, hi;
        f8_range(lanes == 255 ? v->o[a] : f8_load(o[a]), &lo, &hi);
        v->o_near[a] = v->negative[a] ? lo : hi;
        v->o_far[a] = v->negative[a] ? hi : lo;
        f8_range(lanes == 255 ? v->inverse[a] : f8_load(inverse[a]), &v->slowest[a],
                 &v->fastest[a]);
    }
}

LANES_INLINE struct tree8 tree8_of(const struct tree_lanes *l, unsigned lanes)
{
    struct tree8 v; // not set to zero: it is large
    v.mixed = false;
    v.far = f8_set(0);
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        v.o[a] = f8_load(l->o[a]);
        v.inverse[a] = f8_load(l->inverse[a]);
        const unsigned down = lanes & ~f8_le(f8_set(0), v.inverse[a]);
        v.negative[a] = down ? 3 : 0;
        v.mixed |= down && down != lanes;
    }
    if (v.mixed)
        v.negative[0] = v.negative[1] = v.negative[2] = 0;
    else
        tree8_ranges(&v, lanes);
    return v;
}

// The children whose boxes some lane may meet; rounding keeps order, so that what
// child_meets has of any lane lies within. Not for mixed directions.
LANES_INLINE unsigned node_candidates(const struct bvh8_node *n, const struct tree8 *v)
{
    struct float8 near = f8_set(0), far = f8_set(never);
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct float8 p =
            f8_sub(f8_load(n->box[a + v->negative[a]]), f8_set(v->o_near[a]));
        const struct float8 q =
            f8_sub(f8_load(n->box[a + 3 - v->negative[a]]), f8_set(v->o_far[a]));
        const struct float8 s = f8_set(v->slowest[a]), f = f8_set(v->fastest[a]);
        near = f8_max(f8_min(f8_mul(p, s), f8_mul(p, f)), near);
        far = f8_min(f8_max(f8_mul(q, s), f8_mul(q, f)), far);
    }
    return f8_le(near, f8_mul(far, f8_set(BVH8_SLACK)));
}

// The children that are there.
LANES_INLINE unsigned node_children(const struct bvh8_node *n)
{
    unsigned bits = 0;
    for (int k = 0; k < 8 && n->child[k] != BVH8_EMPTY; k++)
        bits |= 1u << k;
    return bits;
}

LANES_INLINE unsigned child_meets(const struct bvh8_node *n, int k, const struct tree8 *v,
                                  bool mixed, float near_t[8])
{
    struct float8 near = f8_set(0), far = v->far;
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct float8 p =
            f8_mul(f8_sub(f8_set(n->box[a + v->negative[a]][k]), v->o[a]), v->inverse[a]);
        const struct float8 q = f8_mul(
            f8_sub(f8_set(n->box[a + 3 - v->negative[a]][k]), v->o[a]), v->inverse[a]);
        near = f8_max(mixed ? f8_min(p, q) : p, near);
        far = f8_min(mixed ? f8_max(p, q) : q, far);
    }
    far = f8_mul(far, f8_set(BVH8_SLACK));
    const unsigned bits = f8_le(near, far);
    if (bits)
        f8_store(near_t, f8_keep_le(near, far, never));
    return bits;
}

LANES_INLINE uint32_t push_some8(const struct bvh8_node *n, unsigned some, bool mixed,
                                 const struct tree8 *v, struct packet_entry *stack,
                                 uint32_t depth, bool any, uint32_t *met_lanes)
{
    const uint32_t base = depth;
    for (; some; some &= some - 1) {
        const int k = __builtin_ctz(some);
        struct packet_entry *top = &stack[depth];
        const unsigned met = child_meets(n, k, v, mixed, top->near);
        if (!met)
            continue;
        *met_lanes += (uint32_t)__builtin_popcount(met);
        top->child = n->child[k];
        uint32_t at = depth++;
        if (any)
            continue;
        top->t = top->near[__builtin_ctz(met)];
        if (at == base || !(stack[at - 1].t < top->t))
            continue;
        const struct packet_entry moved = *top;
        for (; at > base && stack[at - 1].t < moved.t; at--)
            stack[at] = stack[at - 1];
        stack[at] = moved;
    }
    return depth;
}

// As push_children; *met_lanes grows by the lanes of the children met. any: in any order.
LANES_INLINE uint32_t push_children8(const struct bvh8_node *n, const struct tree8 *v,
                                     struct packet_entry *stack, uint32_t depth, bool any,
                                     uint32_t *met_lanes)
{
    if (v->mixed)
        return push_some8(n, node_children(n), true, v, stack, depth, any, met_lanes);
    return push_some8(n, node_candidates(n, v), false, v, stack, depth, any, met_lanes);
}

// As bvh8_ray_begin, for each of `lanes`; returns those that may meet the tree. inverse:
// 1 / d; anything along a plane.
LANES_INLINE unsigned tree_begin(const struct bvh8 *b, struct vec8 o, struct vec8 d,
                                 struct vec8 inverse, struct real8 t_min,
                                 struct real8 t_max, unsigned lanes, struct tree_lanes *l)
{
    const struct real8 largest = v8_max_abs(d);
    struct mask8 out = m8_of(0), real = m8_of(0xff);
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct real8 at = a == 0 ? o.x : a == 1 ? o.y : o.z;
        const struct real8 by = a == 0 ? d.x : a == 1 ? d.y : d.z;
        const struct real8 lo = r8_set(vec3_axis(b->bounds.min, a));
        const struct real8 hi = r8_set(vec3_axis(b->bounds.max, a));
        const struct mask8 flat = runs_along8(by, largest);
        const struct real8 inv = a == 0 ? inverse.x : a == 1 ? inverse.y : inverse.z;
        const struct real8 t0 = r8_mul(r8_sub(lo, at), inv);
        const struct real8 t1 = r8_mul(r8_sub(hi, at), inv);
        t_min = r8_select(flat, t_min, r8_max(t_min, r8_min(t0, t1)));
        t_max = r8_select(flat, t_max, r8_min(t_max, r8_max(t0, t1)));
        out = m8_or(out, m8_and(flat, m8_or(r8_lt(at, lo), r8_lt(hi, at))));
        const struct real8 most =
            r8_select(r8_lt(by, r8_set(0)), r8_set(-0x1p60), r8_set(0x1p60));
        const struct real8 slow = r8_select(flat, most, r8_mul(largest, inv));
        r8_store_floats(l->inverse[a], slow);
        real = m8_and(real, r8_le(r8_abs(slow), r8_set(never)));
    }
    const struct vec8 begin = v8_sub(v8_mad(o, t_min, d), V8_SET(b->origin));
    // A ray from nowhere would meet boxes that are not there (bvh8_ray_begin).
    real = m8_and(real, r8_le(r8_abs(begin.x), r8_set(never)));
    real = m8_and(real, r8_le(r8_abs(begin.y), r8_set(never)));
    real = m8_and(real, r8_le(r8_abs(begin.z), r8_set(never)));
    const unsigned in =
        lanes & m8_bits(m8_without(m8_and(real, r8_le(t_min, t_max)), out));
    r8_store_floats(l->o[0], begin.x);
    r8_store_floats(l->o[1], begin.y);
    r8_store_floats(l->o[2], begin.z);
    r8_store(l->t_begin, t_min);
    r8_store(l->scale, largest);
    const struct real8 far = r8_mul(r8_sub(t_max, t_min), largest);
    r8_store_floats(l->t_far,
                    r8_select(m8_of(in),
                              r8_min(r8_mul(far, r8_set(BVH8_SLACK)), r8_set(1e30)),
                              r8_set(-1)));
    return in;
}

// A lane wants nothing beyond t; if `any`, nothing at all.
static inline void tree_limit_lane(struct tree_lanes *l, int i, double t, bool any)
{
    const double far = (t - l->t_begin[i]) * l->scale[i];
    l->t_far[i] = any ? -1 : far < 1e30 ? (float)far * BVH8_SLACK : 1e30f;
}

// The lanes of `won` want nothing beyond t; if `any`, nothing at all.
LANES_INLINE void tree_limit(struct tree_lanes *l, unsigned won, const double t[8],
                             bool any)
{
    if (!won)
        return;
    if (any) {
        f8_put(l->t_far, won, f8_set(-1));
        return;
    }
    float far[8];
    r8_store_floats(
        far, r8_min(r8_mul(r8_sub(r8_load(t), r8_load(l->t_begin)), r8_load(l->scale)),
                    r8_set(1e30)));
    f8_put(l->t_far, won,
           f8_min(f8_mul(f8_load(far), f8_set(BVH8_SLACK)), f8_set(1e30f)));
}

#endif
