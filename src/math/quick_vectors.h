#ifndef MATH_QUICK_VECTORS_H
#define MATH_QUICK_VECTORS_H

// The functions of math/quick.h of eight numbers, with the same bits: the same operations
// in the same order, on vectors that the compiler makes of what the instruction set has.

#include <stdint.h>
#include <string.h>

#include "math/lanes.h"
#include "math/quick.h"

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

// The sine alone.
LANES_INLINE void quick_sin8(const double v[8], double out[8])
{
    quick_real8 x;
    memcpy(&x, v, sizeof x);
    const quick_real8 sum = x * 0x1.45f306dc9c883p-1 + QUICK_BIG, k = sum - QUICK_BIG;
    const quick_real8 r = ((x - k * 0x1.921fb54400000p+0) - k * 0x1.0b4611a600000p-34) -
                          k * 0x1.3198a2e037073p-69;
    const quick_real8 r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const quick_real8 s =
        (-1. / 6 + r2 * (1. / 120)) + r4 * (-1. / 5040 + r2 * (1. / 362880)) +
        r8 * ((-1. / 39916800 + r2 * (1. / 6227020800.)) + r4 * (-1. / 1307674368000.));
    const quick_real8 c = (-1. / 2 + r2 * (1. / 24)) +
                          r4 * (-1. / 720 + r2 * (1. / 40320)) +
                          r8 * ((-1. / 3628800 + r2 * (1. / 479001600)) +
                                r4 * (-1. / 87178291200. + r2 * (1. / 20922789888000.)));
    const quick_int8 sr = (quick_int8)(r + r * r2 * s), cr = (quick_int8)(1 + r2 * c);
    const quick_int8 quadrant = (quick_int8)sum - QUICK_BIG_BITS;
    const quick_int8 odd = -(quadrant & 1), sign = (quadrant & 2) << 62;
    const quick_int8 sine = ((cr & odd) | (sr & ~odd)) ^ sign;
    memcpy(out, &sine, sizeof sine);
}

#endif
