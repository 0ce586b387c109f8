#ifndef MATH_QUICK_LANES_H
#define MATH_QUICK_LANES_H

// Elementary functions of math/quick.h in lanes.
#include <stdint.h>
#include <string.h>

#include "math/elementary.h"
#include "math/lanes.h"
#include "math/quick.h"

// sin and cos for |x| < 10^5, operation by operation as quick_sincos: |error| <= 2 units
// of ROUNDOFF.
LANES_INLINE void quick_sincos8(struct real8 x, struct real8 *sine, struct real8 *cosine)
{
#define C(v)         r8_set(v)
#define MAD(a, b, c) r8_add(a, r8_mul(b, c))
    const struct real8 big = C(0x1.8p52);
    const struct real8 k = r8_sub(r8_add(r8_mul(x, C(0x1.45f306dc9c883p-1)), big), big);
    struct real8 r = r8_sub(x, r8_mul(k, C(0x1.921fb54400000p+0)));
    r = r8_sub(r, r8_mul(k, C(0x1.0b4611a600000p-34)));
    r = r8_sub(r, r8_mul(k, C(0x1.3198a2e037073p-69)));
    const struct real8 r2 = r8_mul(r, r), r4 = r8_mul(r2, r2), r8 = r8_mul(r4, r4);
    const struct real8 s0 = MAD(C(-1. / 6), r2, C(1. / 120));
    const struct real8 s1 = MAD(C(-1. / 5040), r2, C(1. / 362880));
    const struct real8 s2 = MAD(C(-1. / 39916800), r2, C(1. / 6227020800.));
    const struct real8 s =
        r8_add(MAD(s0, r4, s1), r8_mul(r8, MAD(s2, r4, C(-1. / 1307674368000.))));
    const struct real8 c0 = MAD(C(-1. / 2), r2, C(1. / 24));
    const struct real8 c1 = MAD(C(-1. / 720), r2, C(1. / 40320));
    const struct real8 c2 = MAD(C(-1. / 3628800), r2, C(1. / 479001600));
    const struct real8 c3 = MAD(C(-1. / 87178291200.), r2, C(1. / 20922789888000.));
    const struct real8 c = r8_add(MAD(c0, r4, c1), r8_mul(r8, MAD(c2, r4, c3)));
    const struct real8 sr = MAD(r, r8_mul(r, r2), s), cr = MAD(C(1), r2, c);
    // The quadrant, k mod 4, in halves and quarters: no integers are needed.
    const struct real8 half = r8_floor(r8_mul(k, C(0.5)));
    const struct mask8 odd = r8_lt(r8_add(half, half), k);
    const struct real8 quarter = r8_floor(r8_mul(half, C(0.5)));
    const struct mask8 back = r8_lt(r8_add(quarter, quarter), half); // quadrants 2 and 3
    const struct real8 a = r8_select(odd, cr, sr), b = r8_select(odd, sr, cr);
    *sine = r8_select(back, r8_neg(a), a);
    // cos is negative in quadrants 1 and 2.
    const struct mask8 left = m8_or(m8_without(odd, back), m8_without(back, odd));
    *cosine = r8_select(left, r8_neg(b), b);
#undef C
#undef MAD
}

// quick_atan2, operation by operation.
static inline struct real8 quick_atan2_8(struct real8 y, struct real8 x)
{
    static const double term[] = {1. / 21,  -1. / 19, 1. / 17, -1. / 15, 1. / 13,
                                  -1. / 11, 1. / 9,   -1. / 7, 1. / 5,   -1. / 3};
    const struct real8 ax = r8_abs(x), ay = r8_abs(y), zero = r8_set(0);
    const struct mask8 steep = r8_lt(ax, ay);
    const struct real8 num = r8_select(steep, ax, ay), den = r8_select(steep, ay, ax);
    const struct real8 k =
        r8_floor(r8_add(r8_mul(r8_set(4), r8_div(num, den)), r8_set(0.5)));
    const struct real8 c = r8_mul(k, r8_set(0.25));
    const struct real8 t =
        r8_div(r8_sub(num, r8_mul(c, den)), r8_add(den, r8_mul(c, num)));
    struct real8 base = zero; // atan(k/4)
    base = r8_select(r8_eq(k, r8_set(1)), r8_set(0x1.f5b75f92c80ddp-3), base);
    base = r8_select(r8_eq(k, r8_set(2)), r8_set(0x1.dac670561bb4fp-2), base);
    base = r8_select(r8_eq(k, r8_set(3)), r8_set(0x1.4978fa3269ee1p-1), base);
    base = r8_select(r8_eq(k, r8_set(4)), r8_set(0x1.921fb54442d18p-1), base);
    const struct real8 t2 = r8_mul(t, t);
    struct real8 p = r8_set(term[0]);
    for (int i = 1; i < 10; i++)
        p = r8_add(r8_mul(p, t2), r8_set(term[i]));
    struct real8 a = r8_add(base, r8_add(t, r8_mul(r8_mul(t, t2), p)));
    a = r8_select(steep, r8_sub(r8_set(0x1.921fb54442d18p+0), a), a);
    a = r8_select(r8_lt(x, zero), r8_sub(r8_set(0x1.921fb54442d18p+1), a), a);
    a = r8_copysign(a, y);
    const unsigned plain =
        m8_bits(m8_and(r8_lt(r8_set(0x1p-900), den), r8_lt(den, r8_set(INFINITY))));
    if (plain != 255) {
        double x8[8], y8[8], v[8];
        r8_store(x8, x);
        r8_store(y8, y);
        for (int l = 0; l < 8; l++)
            v[l] = det_atan2(y8[l], x8[l]);
        a = r8_select(m8_of(plain), a, r8_load(v));
    }
    return a;
}

// C's fmod, exact.
static inline struct real8 quick_fmod8(struct real8 a, struct real8 b)
{
    const struct real8 x = r8_abs(a), y = r8_abs(b), zero = r8_set(0);
    const struct real8 q = r8_floor(r8_div(x, y));
    // q y in two parts (Dekker).
    const struct real8 split = r8_set(134217729.0), cq = r8_mul(split, q),
                       cy = r8_mul(split, y);
    const struct real8 qh = r8_sub(cq, r8_sub(cq, q)), ql = r8_sub(q, qh);
    const struct real8 yh = r8_sub(cy, r8_sub(cy, y)), yl = r8_sub(y, yh);
    const struct real8 p = r8_mul(q, y);
    struct real8 low = r8_sub(r8_mul(qh, yh), p);
    low = r8_add(low, r8_mul(qh, yl));
    low = r8_add(low, r8_mul(ql, yh));
    low = r8_add(low, r8_mul(ql, yl));
    struct real8 r = r8_sub(r8_sub(x, p), low);
    r = r8_select(r8_lt(r, zero), r8_add(r, y), r); // q was rounded up
    r = r8_select(r8_le(y, r), r8_sub(r, y), r);
    r = r8_copysign(r, a);
    const unsigned plain =
        m8_bits(m8_and(m8_and(r8_lt(q, r8_set(0x1p50)), r8_lt(x, r8_set(0x1p900))),
                       m8_and(r8_lt(r8_set(0x1p-900), y), r8_lt(y, r8_set(0x1p900)))));
    if (plain != 255) {
        double a8[8], b8[8], v[8];
        r8_store(a8, a);
        r8_store(b8, b);
        for (int l = 0; l < 8; l++)
            v[l] = fmod(a8[l], b8[l]);
        r = r8_select(m8_of(plain), r, r8_load(v));
    }
    return r;
}

// Logarithm, exponential and power have the bits of math/quick.h: the same operations in the
// same order. They need whole numbers, so the compiler makes vectors of what the instruction
// set has.
typedef double quick_real8 __attribute__((vector_size(64)));
typedef int64_t quick_int8 __attribute__((vector_size(64)));

#define QUICK_BIG      0x1.8p52           // whole numbers appear in the last bits
#define QUICK_BIG_BITS 0x4338000000000000 // its own bits

// x > 0 and normal.
LANES_INLINE void quick_log8(const double x[8], double out[8])
{
    quick_int8 bits;
    memcpy(&bits, x, sizeof bits);
    const quick_int8 k = (bits - 0x3fe6a09e667f3bcd) >> 52;
    bits -= k << 52;
    const quick_real8 m = (quick_real8)bits,
                      kd = (quick_real8)(k + QUICK_BIG_BITS) - QUICK_BIG;
    const quick_real8 s = (m - 1) / (m + 1), s2 = s * s, s4 = s2 * s2, s8 = s4 * s4;
    const quick_real8 a = 1. / 3 + s2 * (1. / 5), b = 1. / 7 + s2 * (1. / 9);
    const quick_real8 c = 1. / 11 + s2 * (1. / 13), d = 1. / 15 + s2 * (1. / 17);
    const quick_real8 tail =
        (a + s4 * b) + s8 * ((c + s4 * d) + s8 * (1. / 19 + s2 * (1. / 21)));
    const quick_real8 log = kd * 0x1.62e42fefa39efp-1 + (2 * s + 2 * s * s2 * tail);
    memcpy(out, &log, sizeof log);
}

// |x| < 700.
LANES_INLINE void quick_exp8(const double v[8], double out[8])
{
    quick_real8 x;
    memcpy(&x, v, sizeof x);
    const quick_real8 sum = x * 0x1.71547652b82fep+0 + QUICK_BIG, k = sum - QUICK_BIG;
    const quick_real8 r = (x - k * 0x1.62e42fee00000p-1) - k * 0x1.a39ef35793c76p-33;
    const quick_real8 r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const quick_real8 a = 1 + r, b = 1. / 2 + r * (1. / 6), c = 1. / 24 + r * (1. / 120);
    const quick_real8 d = 1. / 720 + r * (1. / 5040), e = 1. / 40320 + r * (1. / 362880);
    const quick_real8 f = 1. / 3628800 + r * (1. / 39916800);
    const quick_real8 g = 1. / 479001600 + r * (1. / 6227020800.);
    const quick_real8 p = (a + r2 * b) + r4 * (c + r2 * d) + r8 * ((e + r2 * f) + r4 * g);
    const quick_int8 scale = ((quick_int8)sum - QUICK_BIG_BITS + 1023) << 52;
    const quick_real8 power = p * (quick_real8)scale;
    memcpy(out, &power, sizeof power);
}

LANES_INLINE void quick_pow8(const double x[8], double y, double out[8])
{
    double e[8];
    quick_log8(x, e);
    const struct real8 exponent = r8_mul(r8_set(y), r8_load(e));
    const unsigned small = m8_bits(r8_lt(r8_abs(exponent), r8_set(700)));
    r8_store(e, r8_select(m8_of(small), exponent, r8_set(0)));
    quick_exp8(e, out);
    for (unsigned rest = 255 & ~small; rest; rest &= rest - 1) {
        const int i = __builtin_ctz(rest);
        out[i] = quick_pow(x[i], y);
    }
}

#endif
