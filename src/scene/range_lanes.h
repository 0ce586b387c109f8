#ifndef SCENE_RANGE_LANES_H
#define SCENE_RANGE_LANES_H

// Interval arithmetic in lanes: each operation holds what math/interval.h says of it, with
// bounds that are the same but for a few roundings.
#include <float.h>

#include "math/interval.h"
#include "math/lanes.h"
#include "math/quick_lanes.h"

struct range {
    struct real8 lo, hi;
};

LANES_INLINE struct range range_of(struct real8 lo, struct real8 hi)
{
    return (struct range){lo, hi};
}

LANES_INLINE struct range whole_unless(struct mask8 good, struct range r)
{
    return range_of(r8_select(good, r.lo, r8_set(-INFINITY)),
                    r8_select(good, r.hi, r8_set(INFINITY)));
}

// As interval_widened.
LANES_INLINE struct range widen(struct range r)
{
    const struct real8 e = r8_set(INTERVAL_ROUNDING);
    r.lo = r8_sub(r.lo, r8_mul(r8_abs(r.lo), e));
    r.hi = r8_add(r.hi, r8_mul(r8_abs(r.hi), e));
    return whole_unless(r8_le(r.lo, r.hi), r);
}

LANES_INLINE struct range add(struct range a, struct range b)
{
    return widen(range_of(r8_add(a.lo, b.lo), r8_add(a.hi, b.hi)));
}

LANES_INLINE struct range negate(struct range a)
{
    return range_of(r8_neg(a.hi), r8_neg(a.lo));
}

// Ends among four products; a 0 * infinity, or infinities of both signs, are the whole.
LANES_INLINE struct range ends(struct real8 p, struct real8 q, struct real8 r,
                               struct real8 s)
{
    const struct real8 sum = r8_add(r8_add(p, q), r8_add(r, s));
    const struct range out = widen(
        range_of(r8_min(r8_min(p, q), r8_min(r, s)), r8_max(r8_max(p, q), r8_max(r, s))));
    return whole_unless(r8_eq(sum, sum), out);
}

LANES_INLINE struct range multiply(struct range a, struct range b)
{
    return ends(r8_mul(a.lo, b.lo), r8_mul(a.lo, b.hi), r8_mul(a.hi, b.lo),
                r8_mul(a.hi, b.hi));
}

LANES_INLINE struct mask8 never_zero(struct range a)
{
    return m8_or(r8_lt(r8_set(0), a.lo), r8_lt(a.hi, r8_set(0)));
}

LANES_INLINE struct mask8 not_whole(struct range a)
{
    return m8_or(r8_lt(r8_set(-INFINITY), a.lo), r8_lt(a.hi, r8_set(INFINITY)));
}

LANES_INLINE struct range divide(struct range a, struct range b)
{
    return whole_unless(never_zero(b), ends(r8_div(a.lo, b.lo), r8_div(a.lo, b.hi),
                                            r8_div(a.hi, b.lo), r8_div(a.hi, b.hi)));
}

LANES_INLINE struct range square(struct range a)
{
    const struct real8 p = r8_mul(a.lo, a.lo), q = r8_mul(a.hi, a.hi);
    const struct real8 lo = r8_select(never_zero(a), r8_min(p, q), r8_set(0));
    return whole_unless(not_whole(a), widen(range_of(lo, r8_max(p, q))));
}

LANES_INLINE struct range absolute(struct range a)
{
    const struct real8 p = r8_abs(a.lo), q = r8_abs(a.hi);
    const struct real8 lo = r8_select(never_zero(a), r8_min(p, q), r8_set(0));
    return whole_unless(not_whole(a), range_of(lo, r8_max(p, q)));
}

LANES_INLINE struct range root(struct range a)
{
    const struct real8 zero = r8_set(0);
    const struct range r =
        range_of(r8_sqrt(r8_max(a.lo, zero)), r8_sqrt(r8_max(a.hi, zero)));
    return whole_unless(r8_le(zero, a.lo), widen(r));
}

LANES_INLINE struct real8 size_of(struct range a)
{
    return r8_max(r8_abs(a.lo), r8_abs(a.hi));
}

// ---- waves ----------------------------------------------------------------------------

// Beyond this the lanes go one by one. quick_sincos8 is off by less than WAVE_ERROR.
#define WAVE_MAX   1e5
#define WAVE_ERROR 0x1p-48
#define PI_2       1.57079632679489661923

// Where `a` may reach a quarter turn q = first (mod 4), as reaches_quarter of interval.c.
LANES_INLINE struct mask8 reaches_quarter(struct real8 from, struct real8 to, int first)
{
    const struct real8 slack = r8_set(1e-13), four = r8_set(4), q = r8_set(first);
    const struct real8 low = r8_sub(r8_sub(from, r8_mul(r8_abs(from), slack)), slack);
    const struct real8 high = r8_add(r8_add(to, r8_mul(r8_abs(to), slack)), slack);
    const struct real8 n = r8_neg(r8_floor(r8_mul(r8_sub(q, low), r8_set(0.25))));
    return r8_le(r8_add(r8_mul(four, n), q), high);
}

LANES_INLINE struct range wave_between(struct real8 p, struct real8 q, struct mask8 rises,
                                       struct mask8 falls)
{
    const struct real8 e = r8_set(WAVE_ERROR), one = r8_set(1), less = r8_set(-1);
    const struct real8 lo = r8_max(r8_sub(r8_min(p, q), e), less);
    const struct real8 hi = r8_min(r8_add(r8_max(p, q), e), one);
    return range_of(r8_select(falls, less, lo), r8_select(rises, one, hi));
}

// Both waves of a.
LANES_INLINE void waves(struct range a, struct range *sine, struct range *cosine)
{
    struct real8 s0, c0, s1, c1;
    quick_sincos8(a.lo, &s0, &c0);
    quick_sincos8(a.hi, &s1, &c1);
    const struct real8 turn = r8_set(1 / PI_2);
    const struct real8 from = r8_mul(a.lo, turn), to = r8_mul(a.hi, turn);
    *sine =
        wave_between(s0, s1, reaches_quarter(from, to, 1), reaches_quarter(from, to, 3));
    *cosine =
        wave_between(c0, c1, reaches_quarter(from, to, 0), reaches_quarter(from, to, 2));
}

LANES_INLINE unsigned large_lanes(struct range a)
{
    return 255 & ~m8_bits(r8_lt(size_of(a), r8_set(WAVE_MAX)));
}

// ---- angles -----------------------------------------------------------------------------

// As interval_atan2; lanes with infinite ends are the whole.
LANES_INLINE struct mask8 holds_zero(struct range a)
{
    return m8_and(r8_le(a.lo, r8_set(0)), r8_le(r8_set(0), a.hi));
}

// Whether the angle of (x, y) may jump.
LANES_INLINE struct mask8 angle_jumps(struct range y, struct range x)
{
    return m8_and(r8_le(x.lo, r8_set(0)), holds_zero(y));
}

LANES_INLINE struct range angle(struct range y, struct range x)
{
    const struct real8 zero = r8_set(0);
    const struct mask8 up = r8_le(zero, y.lo);                   // and else,
    const struct mask8 down = m8_without(r8_le(y.hi, zero), up); // below the x axis
    const struct mask8 right = r8_lt(zero, x.lo), some = r8_lt(zero, x.hi);
    // The angle grows with y right of the y axis, with x below the x axis.
    const struct real8 low_y = r8_select(up, r8_select(some, y.lo, y.hi),
                                         r8_select(m8_without(down, right), y.hi, y.lo));
    const struct real8 high_y = r8_select(up, r8_select(right, y.hi, y.lo),
                                          r8_select(m8_without(down, some), y.lo, y.hi));
    const struct real8 low_x = r8_select(r8_le(zero, low_y), x.hi, x.lo);
    const struct real8 high_x = r8_select(r8_le(zero, high_y), x.lo, x.hi);
    const struct real8 e = r8_set(2 * INTERVAL_ELEMENTARY);
    struct range r = {quick_atan2_8(low_y, low_x), quick_atan2_8(high_y, high_x)};
    const struct mask8 jumps = angle_jumps(y, x);
    r.lo = r8_select(jumps, r8_set(-2 * PI_2), r.lo);
    r.hi = r8_select(jumps, r8_set(2 * PI_2), r.hi);
    r.lo = r8_sub(r.lo, r8_mul(r8_abs(r.lo), e));
    r.hi = r8_add(r.hi, r8_mul(r8_abs(r.hi), e));
    const struct mask8 finite = r8_lt(r8_max(size_of(x), size_of(y)), r8_set(INFINITY));
    return whole_unless(m8_and(finite, r8_le(r.lo, r.hi)), r);
}

// ---- remainders ---------------------------------------------------------------------------

LANES_INLINE struct real8 truncated(struct real8 v)
{
    return r8_copysign(r8_floor(r8_abs(v)), v);
}

// Whether fmod(a, b) has one branch, b a point, and its number of turns.
LANES_INLINE struct mask8 one_branch(struct range a, struct range b, struct real8 *turns)
{
    const struct real8 p = truncated(r8_div(a.lo, b.lo)),
                       q = truncated(r8_div(a.hi, b.lo));
    *turns = p;
    return m8_and(r8_eq(b.lo, b.hi), r8_eq(p, q));
}

// As interval_mod.
LANES_INLINE struct range modulo(struct range a, struct range b)
{
    const struct real8 zero = r8_set(0), size = size_of(a);
    const struct range m = absolute(b);
    struct real8 turns;
    const struct mask8 up = r8_le(zero, a.lo), down = r8_le(a.hi, zero);
    const struct real8 p = quick_fmod8(a.lo, m.lo), q = quick_fmod8(a.hi, m.lo);
    struct mask8 one = m8_and(one_branch(a, m, &turns), r8_le(p, q));
    one = m8_and(one, m8_or(m8_or(up, down), r8_lt(size, m.lo)));
    one = m8_and(one, r8_le(r8_mul(r8_sub(a.hi, a.lo), r8_set(0.5)), r8_sub(q, p)));
    const struct real8 most = r8_min(m.hi, size);
    const struct range all = {r8_select(up, zero, r8_neg(most)),
                              r8_select(down, zero, most)};
    const struct mask8 good =
        m8_and(r8_lt(zero, m.lo),
               m8_and(r8_lt(size, r8_set(INFINITY)), r8_lt(m.hi, r8_set(INFINITY))));
    return whole_unless(good,
                        range_of(r8_select(one, p, all.lo), r8_select(one, q, all.hi)));
}

// ---- conditions -----------------------------------------------------------------------------

LANES_INLINE struct range truth(struct mask8 never, struct mask8 always)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    return range_of(r8_select(always, one, zero), r8_select(never, zero, one));
}

LANES_INLINE struct range is_less(struct range a, struct range b)
{
    return truth(r8_le(b.hi, a.lo), r8_lt(a.hi, b.lo));
}

LANES_INLINE struct range is_less_equal(struct range a, struct range b)
{
    return truth(r8_lt(b.hi, a.lo), r8_le(a.hi, b.lo));
}

LANES_INLINE struct range negated(struct range t)
{
    return range_of(r8_sub(r8_set(1), t.hi), r8_sub(r8_set(1), t.lo));
}

LANES_INLINE struct range is_equal(struct range a, struct range b)
{
    const struct mask8 point = m8_and(r8_eq(a.lo, a.hi), r8_eq(b.lo, b.hi));
    return truth(m8_or(r8_lt(b.hi, a.lo), r8_lt(a.hi, b.lo)),
                 m8_and(point, r8_eq(a.lo, b.lo)));
}

LANES_INLINE struct range hull(struct range a, struct range b)
{
    return range_of(r8_min(a.lo, b.lo), r8_max(a.hi, b.hi));
}

LANES_INLINE struct range either(struct mask8 m, struct range a, struct range b)
{
    return range_of(r8_select(m, a.lo, b.lo), r8_select(m, a.hi, b.hi));
}

LANES_INLINE struct mask8 is_zero(struct range a)
{
    return m8_and(r8_eq(a.lo, r8_set(0)), r8_eq(a.hi, r8_set(0)));
}

LANES_INLINE struct range both(struct range a, struct range b)
{
    return truth(m8_or(is_zero(a), is_zero(b)), m8_and(never_zero(a), never_zero(b)));
}

LANES_INLINE struct range one_of(struct range a, struct range b)
{
    return truth(m8_and(is_zero(a), is_zero(b)), m8_or(never_zero(a), never_zero(b)));
}

// ---- powers ---------------------------------------------------------------------------------

// Of what is not negative to a constant power, as interval_pow.
LANES_INLINE struct real8 log_of(struct real8 x)
{
    double v[8];
    r8_store(v, x);
    quick_log8(v, v);
    return r8_load(v);
}

LANES_INLINE struct real8 exp_of(struct real8 x)
{
    double v[8];
    r8_store(v, x);
    quick_exp8(v, v);
    return r8_load(v);
}

// Between e^from and e^to; null: lanes where it is 0 and e^to.
LANES_INLINE struct range power_between(struct real8 from, struct real8 to,
                                        struct mask8 null)
{
    const struct real8 zero = r8_set(0), e = r8_set(INTERVAL_POWER);
    const struct real8 p = r8_select(null, zero, exp_of(from)), q = exp_of(to);
    const struct real8 least = r8_min(p, q), most = r8_max(p, q);
    const struct real8 lo = r8_sub(least, r8_mul(least, e));
    return range_of(r8_select(r8_lt(lo, r8_set(0x1p-1000)), zero, lo),
                    r8_add(most, r8_mul(most, e)));
}

// a^y, and its slope, the same rounding more; returns the lanes that are for interval_pow.
LANES_INLINE unsigned power_of(struct range a, double y, struct range *v,
                               struct range *by)
{
    const struct real8 zero = r8_set(0), one = r8_set(1), least = r8_set(DBL_MIN);
    const struct mask8 null = r8_eq(a.lo, zero), below = r8_lt(a.lo, zero);
    struct mask8 good = m8_and(r8_le(least, a.hi), r8_le(a.hi, r8_set(DBL_MAX)));
    good = m8_and(good, y > 0 ? m8_or(null, r8_le(least, a.lo)) : r8_le(least, a.lo));
    const struct real8 from = log_of(r8_select(m8_without(good, null), a.lo, one));
    const struct real8 to = log_of(r8_select(good, a.hi, one));
    const struct real8 most =
        r8_mul(r8_max(r8_abs(from), r8_abs(to)), r8_set(fmax(fabs(y), fabs(y - 1))));
    good = m8_and(good, r8_lt(most, r8_set(700)));
    const struct real8 e0 = r8_select(good, from, zero), e1 = r8_select(good, to, zero);
    const struct real8 less = r8_set(y - 1);
    *v = whole_unless(good,
                      power_between(r8_mul(r8_set(y), e0), r8_mul(r8_set(y), e1), null));
    const struct range slope =
        power_between(r8_mul(less, e0), r8_mul(less, e1), y > 1 ? null : m8_of(0));
    *by = whole_unless(y > 1 ? good : m8_without(good, null),
                       multiply(range_of(r8_set(y), r8_set(y)), slope));
    // Of what is negative only whole powers are known.
    return 255 & ~m8_bits(y == floor(y) ? good : m8_or(good, below));
}

#endif
