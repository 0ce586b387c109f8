#ifndef TRACE_PACKET_SHAFT_H
#define TRACE_PACKET_SHAFT_H

// Shafts and the boxes of a BVH8. A segment from a point of one box to a point of another lies, at
// each share of its length, in the box between both, whose sides are linear in the share: eight
// children of a node are tested as a ray would be.
#include "math/larger.h"
#include "trace/packet_objects.h"
#include "trace/ray_shaft.h"

// Shafts are grown by this share of the largest coordinate, seen from the tree: far beyond what
// single precision, or any test of a ray, rounds.
static const double shaft_margin = 0x1p-18;

// A side of the shaft along an axis, as a function of the share: from + share * by.
struct shaft_side {
    double from, inverse; // 1 / by
};

// Both boxes, grown, from the tree's origin; for each axis its upper, then its lower side.
struct shaft_sides {
    struct vec3 origin;
    struct aabb from, to;
    struct shaft_side side[6];
};

static inline double shaft_most(const struct aabb *b)
{
    return larger(vec3_max_abs(b->min), vec3_max_abs(b->max));
}

static inline struct shaft_side shaft_side_of(double from, double to)
{
    static const double least = 0x1p-100; // along the axis: any share will do, or none
    return (struct shaft_side){from, 1 / (fabs(to - from) > least ? to - from : least)};
}

static void shaft_sides_of(struct shaft_sides *v, struct vec3 origin,
                           const struct ray_shaft *s)
{
    v->origin = origin;
    v->from = (struct aabb){vec3_sub(s->from.min, origin), vec3_sub(s->from.max, origin)};
    v->to = (struct aabb){vec3_sub(s->to.min, origin), vec3_sub(s->to.max, origin)};
    // Coordinates in the world are doubles, whose rounding may show where it is far away.
    const double by = shaft_margin * larger(shaft_most(&v->from), shaft_most(&v->to)) +
                      0x1p-40 * (shaft_most(&s->from) + shaft_most(&s->to));
    const struct vec3 grow = vec3(by, by, by);
    v->from = (struct aabb){vec3_sub(v->from.min, grow), vec3_add(v->from.max, grow)};
    v->to = (struct aabb){vec3_sub(v->to.min, grow), vec3_add(v->to.max, grow)};
    for (int a = 0; a < 3; a++) {
        v->side[a] = shaft_side_of(vec3_axis(v->from.max, a), vec3_axis(v->to.max, a));
        v->side[a + 3] =
            shaft_side_of(vec3_axis(v->from.min, a), vec3_axis(v->to.min, a));
    }
}

// A box is met at the shares at which, on each axis, the upper side lies above its lower
// face and the lower side below its upper one. A side that grows does so from where it
// reaches the face, or until then.
LANES_INLINE bool side_begins(const struct shaft_side *s, int a)
{
    return (s->inverse > 0) == (a < 3);
}

LANES_INLINE unsigned shaft_children(const struct bvh8_node *n,
                                     const struct shaft_sides *v)
{
    struct float8 near = f8_set(0), far = f8_set(1);
#pragma GCC unroll 6
    for (int a = 0; a < 6; a++) {
        const struct shaft_side *s = &v->side[a];
        const struct float8 at =
            f8_mul(f8_sub(f8_load(n->box[a]), f8_set((float)s->from)),
                   f8_set((float)s->inverse));
        if (side_begins(s, a))
            near = f8_max(at, near);
        else
            far = f8_min(at, far);
    }
    return f8_le(near, far);
}

static bool shaft_meets_box(const struct shaft_sides *v, const struct aabb *b)
{
    double near = 0, far = 1;
    for (int a = 0; a < 6; a++) {
        const struct shaft_side *s = &v->side[a];
        const double face = a < 3
                                ? vec3_axis(b->min, a) - vec3_axis(v->origin, a)
                                : vec3_axis(b->max, a - 3) - vec3_axis(v->origin, a - 3);
        const double at = (face - s->from) * s->inverse;
        if (side_begins(s, a))
            near = larger(at, near);
        else
            far = smaller(at, far);
    }
    return near <= far;
}

static double shaft_farthest(const struct aabb *b, struct vec3 c)
{
    const struct vec3 p = vec3_sub(b->min, c), q = vec3_sub(b->max, c);
    return vec3_length(vec3(larger(fabs(p.x), fabs(q.x)), larger(fabs(p.y), fabs(q.y)),
                            larger(fabs(p.z), fabs(q.z))));
}

// Whether the shaft lies within a sphere: item i of the tree.
static bool shaft_within(const struct accel *a, uint32_t i, const struct shaft_sides *v)
{
    const double r = a->ball[3][i] * (1 - shaft_margin);
    const struct vec3 c =
        vec3_sub(vec3(a->ball[0][i], a->ball[1][i], a->ball[2][i]), v->origin);
    return r > 0 && shaft_farthest(&v->from, c) < r && shaft_farthest(&v->to, c) < r;
}

// Whether all ways certainly begin and end on one side of a plane. Where they begin is asked as
// plane8 does, as places on the plane itself are within its rounding of it.
static bool shaft_beside(const struct leaf *l, const struct ray_shaft *s)
{
    const struct plane *p = l->shape;
    const struct vec3 n = p->normal;
    const struct vec3 half = vec3_scale(0.5, vec3_sub(s->to.max, s->to.min));
    const struct vec3 centre = vec3_scale(0.5, vec3_add(s->to.min, s->to.max));
    const double end = vec3_dot(n, vec3_sub(centre, p->point));
    const double reach = fabs(n.x) * half.x + fabs(n.y) * half.y + fabs(n.z) * half.z +
                         shaft_margin * (shaft_most(&s->from) + shaft_most(&s->to) +
                                         vec3_max_abs(p->point));
    if (!l->transform->identity || !(fabs(end) > reach))
        return false;
    const struct real8 zero = r8_set(0);
    for (uint32_t i = 0; i < s->count; i += 8) {
        const struct vec8 o = {r8_load(s->origin[0] + i), r8_load(s->origin[1] + i),
                               r8_load(s->origin[2] + i)};
        const struct real8 down = v8_dot(V8_SET(n), v8_sub(V8_SET(p->point), o));
        if (m8_bits(end > 0 ? r8_lt(down, zero) : r8_lt(zero, down)) != 255)
            return false;
    }
    return true;
}

static uint32_t shaft_unbounded(const struct world *w, const struct ray_shaft *s,
                                uint32_t object[RAY_SHAFT_OBJECTS])
{
    const struct accel *a = w->accel;
    uint32_t n = 0;
    for (uint32_t i = 0; i < a->infinite_count; i++) {
        const uint32_t one = a->infinite[i];
        const struct world_object *o = &w->object[one];
        if ((o->flags & s->hidden_by) || (a->object_shape[one] == PACKET_PLANE &&
                                          shaft_beside(&w->leaf[o->first_leaf], s)))
            continue;
        if (n == RAY_SHAFT_OBJECTS)
            return RAY_SHAFT_MANY;
        object[n++] = one;
    }
    return n;
}

static uint32_t shaft_objects(const struct world *w, const struct ray_shaft *s,
                              uint32_t object[RAY_SHAFT_OBJECTS])
{
    const struct accel *a = w->accel;
    uint32_t n = shaft_unbounded(w, s, object);
    if (n == RAY_SHAFT_MANY || !a->top.node)
        return n;
    struct shaft_sides v;
    int32_t stack[BVH8_STACK];
    uint32_t depth = 1;
    stack[0] = 0;
    shaft_sides_of(&v, a->top.origin, s);
    while (depth) {
        const int32_t child = stack[--depth];
        if (child >= 0) {
            const struct bvh8_node *node = &a->top.node[child];
            for (unsigned bits = shaft_children(node, &v); bits; bits &= bits - 1)
                stack[depth++] = node->child[__builtin_ctz(bits)];
            continue;
        }
        const uint32_t first = bvh8_leaf_first(child), count = bvh8_leaf_count(child);
        for (uint32_t i = first; i < first + count; i++) {
            const struct world_object *o = &w->object[a->top.item[i]];
            if ((o->flags & s->hidden_by) ||
                (count > 1 && !shaft_meets_box(&v, &o->bounds)) || shaft_within(a, i, &v))
                continue;
            if (n == RAY_SHAFT_OBJECTS)
                return RAY_SHAFT_MANY;
            object[n++] = a->top.item[i];
        }
    }
    return n;
}

LANES_INLINE void shaft_range(struct real8 low, struct real8 high, double *least,
                              double *largest)
{
    double lo[8], hi[8];
    r8_store(lo, low);
    r8_store(hi, high);
    for (int step = 4; step; step /= 2)
        for (int i = 0; i < step; i++) {
            lo[i] = lo[i + step] < lo[i] ? lo[i + step] : lo[i];
            hi[i] = hi[i + step] > hi[i] ? hi[i + step] : hi[i];
        }
    *least = lo[0];
    *largest = hi[0];
}

// The shaft of the rays [first, end) of a batch, of which the number is a multiple of eight;
// false: some go on without end.
static bool shaft_of_rays(const struct ray_batch *r, uint32_t first, uint32_t end,
                          struct ray_shaft *s)
{
    const double far = ray_shaft_far;
    struct mask8 real = m8_of(255);
    double low[6], high[6];
    for (int a = 0; a < 3; a++) {
        struct real8 lo = r8_set(far), hi = r8_set(-far), to_lo = lo, to_hi = hi;
        for (uint32_t i = first; i < end; i += 8) {
            const struct real8 o = r8_load(r->o[a] + i);
            const struct real8 e =
                r8_add(o, r8_mul(r8_load(r->t_max + i), r8_load(r->d[a] + i)));
            real = m8_and(real, m8_and(r8_lt(r8_abs(o), r8_set(far)),
                                       r8_lt(r8_abs(e), r8_set(far))));
            lo = r8_min(o, lo);
            hi = r8_max(o, hi);
            to_lo = r8_min(e, to_lo);
            to_hi = r8_max(e, to_hi);
        }
        shaft_range(lo, hi, &low[a], &high[a]);
        shaft_range(to_lo, to_hi, &low[a + 3], &high[a + 3]);
        s->origin[a] = r->o[a] + first;
    }
    s->hidden_by = ~0u;
    for (uint32_t i = first; i < end; i++)
        s->hidden_by &= r->hidden_by[i];
    s->count = end - first;
    s->from =
        (struct aabb){vec3(low[0], low[1], low[2]), vec3(high[0], high[1], high[2])};
    s->to = (struct aabb){vec3(low[3], low[4], low[5]), vec3(high[3], high[4], high[5])};
    return m8_bits(real) == 255;
}

// What neighbouring shadow rays may meet.
struct shaft_search {
    uint32_t object[RAY_SHAFT_OBJECTS], count; // as shaft_objects
    uint32_t end;                              // of the rays that this is known of
    uint32_t skip, failed; // shafts of rays that go apart are not tried
};

// Goes on to the rays from `first` on.
static void shaft_search_at(struct shaft_search *f, const struct world *w,
                            const struct ray_batch *r, uint32_t first)
{
    enum { TOGETHER = 64, LEAST = 16, SKIPS = 8 };
    const uint32_t whole = r->count & ~7u;
    const uint32_t end = whole - first < TOGETHER ? whole : first + TOGETHER;
    struct ray_shaft s;
    f->end = end > first ? end : r->count;
    f->count = RAY_SHAFT_MANY;
    if (f->skip) {
        f->skip--;
        return;
    }
    if (end < first + LEAST)
        return;
    if (shaft_of_rays(r, first, end, &s))
        f->count = shaft_objects(w, &s, f->object);
    f->failed = f->count != RAY_SHAFT_MANY ? 0
                : f->failed < SKIPS        ? 2 * f->failed + 1
                                           : SKIPS;
    f->skip = f->failed;
}

#endif
