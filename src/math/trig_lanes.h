#ifndef MATH_TRIG_LANES_H
#define MATH_TRIG_LANES_H

// det_sin and det_cos in lanes, operation by operation as math/trig.c: the same bits.

#include "math/dd_lanes.h"
#include "math/elementary.h"
#include "math/lanes.h"
#include "math/trig.h"

// |x| <= 2^20 less the nearest multiple of pi/2; turns: which.
LANES_INLINE struct dd8 trig8_reduce(struct real8 x, struct real8 *turns)
{
    const struct real8 none = r8_set(0), ax = r8_abs(x);
    const struct real8 k =
        r8_floor(r8_add(r8_mul(ax, r8_set(0x1.45f306dc9c883p-1)), r8_set(0.5)));
    *turns = k;
    struct dd8 r = dd8_two_sum(r8_sub(ax, r8_mul(k, r8_set(0x1.921fb54400000p+0))),
                               r8_neg(r8_mul(k, r8_set(0x1.0b4611a600000p-34))));
    r = dd8_add(r, (struct dd8){r8_neg(r8_mul(k, r8_set(0x1.3198a2e000000p-69))), none});
    return dd8_add(r,
                   (struct dd8){r8_neg(r8_mul(k, r8_set(0x1.b839a252049c1p-104))), none});
}

LANES_INLINE struct real8 trig8_series(struct real8 r2, const double c[8])
{
    struct real8 p = r8_set(0);
#pragma GCC unroll 8
    for (int i = 7; i >= 0; i--)
        p = r8_add(r8_mul(p, r2), r8_set(c[i]));
    return p;
}

LANES_INLINE struct real8 trig8_sin_kernel(struct dd8 r)
{
    const struct real8 r2 = r8_mul(r.hi, r.hi), p = trig8_series(r2, TRIG_SIN);
    const struct real8 rest =
        r8_add(r8_mul(r8_mul(r.hi, r2), p),
               r8_mul(r.lo, r8_sub(r8_set(1), r8_mul(r8_set(0.5), r2))));
    return r8_add(r.hi, rest);
}

LANES_INLINE struct real8 trig8_cos_kernel(struct dd8 r)
{
    const struct real8 half = r8_set(0.5), r2 = r8_mul(r.hi, r.hi),
                       p = trig8_series(r2, TRIG_COS);
    const struct dd8 h = dd8_square(r.hi);
    const struct dd8 s = dd8_fast_sum(r8_set(1), r8_mul(r8_set(-0.5), h.hi));
    const struct real8 rest =
        r8_sub(r8_sub(r8_mul(r8_mul(r2, r2), p), r8_mul(r.hi, r.lo)), r8_mul(half, h.lo));
    return r8_add(s.hi, r8_add(s.lo, rest));
}

// Lanes where the reduction above does not hold.
LANES_INLINE unsigned trig8_large(struct real8 x)
{
    return 255 & ~m8_bits(r8_le(r8_abs(x), r8_set(0x1p20)));
}

static inline struct real8 trig8_one_by_one(double (*f)(double), unsigned lanes,
                                            struct real8 x, struct real8 others)
{
    double at[8], v[8];
    r8_store(at, x);
    r8_store(v, others);
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        v[i] = f(at[i]);
    }
    return r8_load(v);
}

// What sin and cos have in common: both kernels where lanes need both, and the turn as two
// bits.
struct trig8 {
    struct real8 sine, cosine;
    struct mask8 odd, back; // quadrants 1 and 3; 2 and 3
};

LANES_INLINE struct trig8 trig8_of(struct real8 x)
{
    struct real8 k;
    const struct dd8 r = trig8_reduce(x, &k);
    const struct real8 half = r8_floor(r8_mul(k, r8_set(0.5))),
                       quarter = r8_floor(r8_mul(half, r8_set(0.5)));
    return (struct trig8){trig8_sin_kernel(r), trig8_cos_kernel(r),
                          r8_lt(r8_add(half, half), k),
                          r8_lt(r8_add(quarter, quarter), half)};
}

static inline struct real8 det_sin8(struct real8 x)
{
    const struct trig8 t = trig8_of(x);
    struct real8 s = r8_select(t.odd, t.cosine, t.sine);
    s = r8_select(t.back, r8_neg(s), s);
    s = r8_select(r8_lt(r8_copysign(r8_set(1), x), r8_set(0)), r8_neg(s), s);
    const unsigned large = trig8_large(x);
    return large ? trig8_one_by_one(det_sin, large, x, s) : s;
}

static inline struct real8 det_cos8(struct real8 x)
{
    const struct trig8 t = trig8_of(x);
    struct real8 c = r8_select(t.odd, t.sine, t.cosine);
    // cos is negative in quadrants 1 and 2.
    const struct mask8 left = m8_or(m8_without(t.odd, t.back), m8_without(t.back, t.odd));
    c = r8_select(left, r8_neg(c), c);
    const unsigned large = trig8_large(x);
    return large ? trig8_one_by_one(det_cos, large, x, c) : c;
}

#endif
