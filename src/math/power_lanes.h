#ifndef MATH_POWER_LANES_H
#define MATH_POWER_LANES_H

// det_exp, det_log and det_pow in lanes, operation by operation as math/elementary.c: the
// same bits.

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "math/dd_lanes.h"
#include "math/elementary.h"
#include "math/lanes_bits.h"
#include "math/power.h"

// exp(x.hi + x.lo) for |x.hi| < 700.
LANES_INLINE struct real8 power8_exp(struct dd8 x)
{
    const struct real8 k = r8_floor(r8_add(r8_mul(x.hi, r8_set(INV_LN2)), r8_set(0.5)));
    const struct dd8 a = dd8_two_sum(r8_sub(x.hi, r8_mul(k, r8_set(LN2_HIGH))),
                                     r8_sub(x.lo, r8_mul(k, r8_set(LN2_LOW.hi))));
    const struct real8 square = r8_mul(a.hi, a.hi);
    struct real8 q = r8_set(EXP_TERMS[12]), odd = r8_set(EXP_TERMS[11]);
#pragma GCC unroll 5
    for (int i = 10; i > 0; i -= 2) {
        q = r8_add(r8_mul(q, square), r8_set(EXP_TERMS[i]));
        odd = r8_add(r8_mul(odd, square), r8_set(EXP_TERMS[i - 1]));
    }
    q = r8_add(r8_mul(q, square), r8_set(EXP_TERMS[0]));
    q = r8_mul(r8_add(q, r8_mul(a.hi, odd)), square);
    const struct dd8 s = dd8_fast_sum(r8_set(1), a.hi);
    const struct real8 rest = r8_add(r8_add(q, a.lo), r8_mul(a.lo, a.hi));
    const struct real8 e = dd8_fast_sum(s.hi, r8_add(s.lo, rest)).hi;
    return r8_mul(e, r8_power_of_two(k));
}

// x > 0, finite and normal.
LANES_INLINE struct dd8 power8_log(struct real8 x)
{
    double v[8];
    bits_int8 bits;
    r8_store(v, x);
    memcpy(&bits, v, sizeof v);
    const bits_real8 exponent =
        (bits_real8)((bits >> 52) - 1022 + BITS_BIG_BITS) - BITS_BIG;
    bits = (bits & 0x000fffffffffffff) | 0x3fe0000000000000;
    memcpy(v, &exponent, sizeof v);
    struct real8 k = r8_load(v);
    memcpy(v, &bits, sizeof v);
    struct real8 m = r8_load(v);
    const struct real8 one = r8_set(1), zero = r8_set(0);
    const struct mask8 small = r8_lt(m, r8_set(SQRT_HALF));
    m = r8_select(small, r8_mul(m, r8_set(2)), m);
    k = r8_select(small, r8_sub(k, one), k);
    const struct dd8 s = dd8_div((struct dd8){r8_sub(m, one), zero}, dd8_two_sum(m, one));
    const struct dd8 s2 = dd8_mul(s, s);
    const struct real8 square = r8_mul(s2.hi, s2.hi);
    struct real8 p = r8_set(2. / 25), odd = r8_set(2. / 23);
#pragma GCC unroll 4
    for (int n = 21; n > 5; n -= 4) {
        p = r8_add(r8_mul(p, square), r8_set(2. / n));
        odd = r8_add(r8_mul(odd, square), r8_set(2. / (n - 2)));
    }
    p = r8_add(r8_add(r8_mul(p, square), r8_set(2. / 5)), r8_mul(s2.hi, odd));
    const struct dd8 t =
        dd8_add(dd8_set(TWO_THIRDS), (struct dd8){r8_mul(p, s2.hi), zero});
    const struct dd8 series = dd8_mul(s, dd8_mul(s2, t));
    const struct real8 two = r8_set(2);
    const struct dd8 log_m =
        dd8_add((struct dd8){r8_mul(two, s.hi), r8_mul(two, s.lo)}, series);
    const struct dd8 log_k = dd8_scale(k, dd8_set(LN2_LOW));
    const struct dd8 high = {r8_mul(k, r8_set(LN2_HIGH)), zero};
    return dd8_add(dd8_add(high, log_k), log_m);
}

LANES_INLINE struct mask8 power8_normal(struct real8 x)
{
    return m8_and(r8_le(r8_set(DBL_MIN), x), r8_le(x, r8_set(DBL_MAX)));
}

// v, but f(x) in the lanes that are not `done`.
static inline struct real8 power8_rest(struct real8 v, struct real8 x, unsigned done,
                                       double (*f)(double))
{
    unsigned left = 255 & ~done;
    if (!left)
        return v;
    double at[8], out[8];
    r8_store(at, x);
    r8_store(out, v);
    for (; left; left &= left - 1)
        out[__builtin_ctz(left)] = f(at[__builtin_ctz(left)]);
    return r8_load(out);
}

static inline struct real8 det_exp8(struct real8 x)
{
    const struct mask8 small = r8_lt(r8_abs(x), r8_set(700));
    const struct real8 zero = r8_set(0);
    const struct real8 v = power8_exp((struct dd8){r8_select(small, x, zero), zero});
    return power8_rest(v, x, m8_bits(small), det_exp);
}

static inline struct real8 det_log8(struct real8 x)
{
    const struct mask8 normal = power8_normal(x);
    const struct real8 v = power8_log(r8_select(normal, x, r8_set(1))).hi;
    return power8_rest(v, x, m8_bits(normal), det_log);
}

// In lanes: normal x and zeros, and exponents that are whole if x is negative.
static inline struct real8 det_pow8(struct real8 x, struct real8 y)
{
    const struct real8 zero = r8_set(0), one = r8_set(1), ax = r8_abs(x);
    const struct mask8 none = m8_and(r8_eq(ax, zero), r8_lt(zero, y));
    const struct mask8 positive = r8_lt(zero, r8_copysign(one, x));
    const struct real8 whole = r8_floor(y), half = r8_floor(r8_mul(y, r8_set(0.5)));
    const struct mask8 is_whole = r8_eq(whole, y);
    const struct mask8 odd = r8_lt(r8_add(half, half), whole);
    struct mask8 good = m8_and(m8_or(power8_normal(ax), none), m8_or(positive, is_whole));
    good = m8_and(good, r8_lt(r8_abs(y), r8_set(0x1p50)));
    const struct real8 base = r8_select(m8_without(good, none), ax, one);
    const struct dd8 e = dd8_scale(r8_select(good, y, one), power8_log(base));
    good = m8_and(good, r8_lt(r8_abs(e.hi), r8_set(700)));
    struct real8 v = power8_exp(dd8_select(good, e, (struct dd8){zero, zero}));
    v = r8_select(none, zero, v);
    v = r8_select(m8_without(m8_and(odd, is_whole), positive), r8_neg(v), v);
    const unsigned left = 255 & ~m8_bits(good);
    if (!left)
        return v;
    double a[8], b[8], out[8];
    r8_store(a, x);
    r8_store(b, y);
    r8_store(out, v);
    for (unsigned bits = left; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        out[i] = det_pow(a[i], b[i]);
    }
    return r8_load(out);
}

#endif
