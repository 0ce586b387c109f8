#ifndef SCENE_TAPE_SLOPE_LANES_H
#define SCENE_TAPE_SLOPE_LANES_H

#include "scene/range_lanes.h"

// Bounds of what a tape's operations do to slopes, over eight boxes.

struct reg {
    struct range v, d[3];
};

// N: how many partial derivatives are carried along; `moving`: which of them may be other
// than zero.
LANES_INLINE void scale(struct range by, const struct range *d, unsigned moving, int n,
                        struct range *out)
{
    for (int i = 0; i < n; i++)
        if (moving >> i & 1)
            out[i] = multiply(by, d[i]);
}

LANES_INLINE void scale_twice(struct range by_a, const struct reg *a, unsigned moving_a,
                              struct range by_b, const struct reg *b, unsigned moving_b,
                              int n, struct range *out)
{
    for (int i = 0; i < n; i++) {
        const unsigned x = moving_a >> i & 1, y = moving_b >> i & 1;
        if (x && y)
            out[i] = add(multiply(by_a, a->d[i]), multiply(by_b, b->d[i]));
        else if (x)
            out[i] = multiply(by_a, a->d[i]);
        else if (y)
            out[i] = multiply(by_b, b->d[i]);
    }
}

// No length grows faster than its sides.
LANES_INLINE void limit(const struct reg *a, const struct reg *b, const struct reg *c,
                        int n, struct range *d)
{
    for (int i = 0; i < n; i++) {
        struct real8 most = r8_add(size_of(a->d[i]), size_of(b->d[i]));
        if (c)
            most = r8_add(most, size_of(c->d[i]));
        most = r8_add(most, r8_mul(most, r8_set(8 * INTERVAL_ROUNDING)));
        d[i].lo = r8_max(d[i].lo, r8_neg(most));
        d[i].hi = r8_min(d[i].hi, most);
    }
}

// The smaller (larger) of two, and the slopes of both where it is not certain which.
LANES_INLINE void extreme(bool max, const struct reg *a, const struct reg *b, int n,
                          struct reg *out)
{
    const struct mask8 good = m8_and(not_whole(a->v), not_whole(b->v));
    const struct mask8 first =
        m8_and(good, max ? r8_lt(b->v.hi, a->v.lo) : r8_lt(a->v.hi, b->v.lo));
    const struct mask8 second =
        m8_and(good, max ? r8_lt(a->v.hi, b->v.lo) : r8_lt(b->v.hi, a->v.lo));
    for (int i = 0; i < n; i++) {
        struct range r =
            range_of(r8_min(a->d[i].lo, b->d[i].lo), r8_max(a->d[i].hi, b->d[i].hi));
        r.lo = r8_select(first, a->d[i].lo, r.lo);
        r.hi = r8_select(first, a->d[i].hi, r.hi);
        out->d[i].lo = r8_select(second, b->d[i].lo, r.lo);
        out->d[i].hi = r8_select(second, b->d[i].hi, r.hi);
    }
    out->v = whole_unless(
        good, max ? range_of(r8_max(a->v.lo, b->v.lo), r8_max(a->v.hi, b->v.hi))
                  : range_of(r8_min(a->v.lo, b->v.lo), r8_min(a->v.hi, b->v.hi)));
}

// A function of steps: slope 0 on each, unknown where the box holds two.
LANES_INLINE void flat(struct range v, const struct range *d, unsigned moving, int n,
                       struct range *out)
{
    const struct range none = {r8_set(0), r8_set(0)};
    const struct range whole = {r8_set(-INFINITY), r8_set(INFINITY)};
    for (int i = 0; i < n; i++)
        if (moving >> i & 1)
            out[i] = either(m8_or(r8_eq(v.lo, v.hi), is_zero(d[i])), none, whole);
}

LANES_INLINE void flat_of_two(const struct reg *a, unsigned moving_a, const struct reg *b,
                              unsigned moving_b, int n, struct reg *v)
{
    struct range other[3];
    flat(v->v, a->d, moving_a, n, v->d);
    flat(v->v, b->d, moving_b, n, other);
    for (int i = 0; i < n; i++)
        if (moving_b >> i & 1)
            v->d[i] = moving_a >> i & 1 ? hull(v->d[i], other[i]) : other[i];
}

// The slope is that of the first operand in one branch, less the turns times that of the
// second.
LANES_INLINE void modulo_slopes(const struct reg *a, unsigned ma, const struct reg *b,
                                unsigned mb, int n, struct reg *v)
{
    struct real8 turns;
    const struct real8 slack = r8_mul(size_of(a->v), r8_set(4 * INTERVAL_ROUNDING));
    const struct real8 room = r8_add(r8_sub(a->v.hi, a->v.lo), slack);
    const struct mask8 one =
        m8_and(one_branch(a->v, b->v, &turns), r8_le(r8_sub(v->v.hi, v->v.lo), room));
    const struct range whole = {r8_set(-INFINITY), r8_set(INFINITY)};
    const struct range by_a = either(one, range_of(r8_set(1), r8_set(1)), whole);
    const struct range by_b = either(one, range_of(r8_neg(turns), r8_neg(turns)), whole);
    scale_twice(by_a, a, ma, by_b, b, mb, n, v->d);
    for (int i = 0; i < n; i++) { // 0 times the whole
        const struct mask8 still = m8_and(ma >> i & 1 ? is_zero(a->d[i]) : m8_of(255),
                                          mb >> i & 1 ? is_zero(b->d[i]) : m8_of(255));
        v->d[i] = either(still, range_of(r8_set(0), r8_set(0)), v->d[i]);
    }
}

LANES_INLINE void angle_slopes(const struct reg *y, unsigned my, const struct reg *x,
                               unsigned mx, int n, struct reg *v)
{
    if (!(my | mx))
        return;
    const struct range rr = add(square(y->v), square(x->v));
    const struct mask8 good = m8_without(m8_of(255), angle_jumps(y->v, x->v));
    scale_twice(whole_unless(good, divide(x->v, rr)), y, my,
                whole_unless(good, negate(divide(y->v, rr))), x, mx, n, v->d);
}

// A choice whose condition is not settled jumps.
LANES_INLINE void choose(const struct reg *a, const struct reg *below,
                         const struct reg *at, const struct reg *above, unsigned moving_a,
                         int n, struct reg *v)
{
    const struct real8 zero = r8_set(0);
    const struct mask8 less = r8_lt(a->v.hi, zero), more = r8_lt(zero, a->v.lo);
    const struct mask8 null = is_zero(a->v), holds = holds_zero(a->v);
    const struct mask8 some = r8_lt(a->v.lo, zero), reach = r8_lt(zero, a->v.hi);
    const struct mask8 settled = m8_or(m8_or(less, more), null);
    const struct range none = {r8_set(INFINITY), r8_set(-INFINITY)};
    v->v = hull(hull(either(some, below->v, none), either(holds, at->v, none)),
                either(m8_or(reach, m8_without(m8_of(255), holds)), above->v, none));
    v->v = either(less, below->v, either(more, above->v, either(null, at->v, v->v)));
    for (int i = 0; i < n; i++) {
        struct range d = either(less, below->d[i], either(more, above->d[i], at->d[i]));
        struct mask8 still =
            m8_and(is_zero(above->d[i]),
                   m8_or(m8_without(m8_of(255), some), is_zero(below->d[i])));
        still = m8_and(still, m8_or(m8_without(m8_of(255), holds), is_zero(at->d[i])));
        if (moving_a >> i & 1)
            still = m8_and(still, is_zero(a->d[i]));
        const struct range zeros = {zero, zero};
        const struct range whole = {r8_set(-INFINITY), r8_set(INFINITY)};
        v->d[i] = either(settled, d, either(still, zeros, whole));
    }
}

#endif
