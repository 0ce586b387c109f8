#ifndef MATH_QUICK_LANES_H
#define MATH_QUICK_LANES_H

// Elementary functions of math/quick.h in lanes.
#include "math/lanes.h"

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

#endif
