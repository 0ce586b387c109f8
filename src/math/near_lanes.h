#ifndef MATH_NEAR_LANES_H
#define MATH_NEAR_LANES_H

// Powers in lanes of floats that are not exact, but the same on every machine.
#include <stdint.h>
#include <string.h>

#include "math/lanes_vec.h"

typedef float near_float8 __attribute__((vector_size(32)));
typedef int32_t near_word8 __attribute__((vector_size(32)));

#define NEAR_BIG      0x1.8p23f  // whole numbers appear in the last bits
#define NEAR_BIG_BITS 0x4b400000 // its own bits

// 2^k of the nearest whole k in -126..127, and that.
LANES_INLINE struct float8 near_power_of_two(struct float8 k, struct float8 *whole)
{
    float v[8];
    near_float8 x;
    f8_store(v, k);
    memcpy(&x, v, sizeof v);
    x += NEAR_BIG;
    const near_word8 power = ((near_word8)x - NEAR_BIG_BITS + 127) << 23;
    x -= NEAR_BIG;
    memcpy(v, &x, sizeof v);
    *whole = f8_load(v);
    memcpy(v, &power, sizeof v);
    return f8_load(v);
}

// x = m 2^k for positive normal x, m between sqrt(1/2) and sqrt(2); returns k.
LANES_INLINE struct float8 near_split(struct float8 x, struct float8 *m)
{
    float v[8];
    near_word8 bits;
    f8_store(v, x);
    memcpy(&bits, v, sizeof v);
    const near_word8 k = (bits - 0x3f3504f3) >> 23; // sqrt(1/2)
    const near_float8 exponent = (near_float8)(k + NEAR_BIG_BITS) - NEAR_BIG;
    bits -= k << 23;
    memcpy(v, &bits, sizeof v);
    *m = f8_load(v);
    memcpy(v, &exponent, sizeof v);
    return f8_load(v);
}

// x^y, for normal x > 0, to 2^-19 of it while it is between 2^-20 and 2^20: that is
// enough to tell a difference from a threshold.
LANES_INLINE struct float8 near_pow8(struct float8 x, float y)
{
    static const float log_term[4] = {0x1.715476p+1f, 0x1.ec709ep-1f, 0x1.2776c6p-1f,
                                      0x1.a61762p-2f}; // 2 log2(e)/n for n = 1, 3, 5, 7
    static const float exp_term[7] = {1,
                                      0x1.62e430p-1f,
                                      0x1.ebfbe0p-3f,
                                      0x1.c6b08ep-5f,
                                      0x1.3b2ab6p-7f,
                                      0x1.5d87fep-10f,
                                      0x1.430912p-13f}; // ln(2)^n/n!
    const struct float8 one = f8_set(1);
    struct float8 m, whole, sum = f8_set(log_term[3]);
    const struct float8 k = near_split(x, &m);
    const struct float8 s = f8_div(f8_sub(m, one), f8_add(m, one)), q = f8_mul(s, s);
#pragma GCC unroll 3
    for (int i = 2; i >= 0; i--)
        sum = f8_add(f8_set(log_term[i]), f8_mul(q, sum));
    struct float8 e = f8_mul(f8_set(y), f8_add(k, f8_mul(s, sum)));
    e = f8_max(f8_min(e, f8_set(127)), f8_set(-126));
    const struct float8 power = near_power_of_two(e, &whole);
    e = f8_sub(e, whole);
    sum = f8_set(exp_term[6]);
#pragma GCC unroll 6
    for (int i = 5; i >= 0; i--)
        sum = f8_add(f8_set(exp_term[i]), f8_mul(e, sum));
    return f8_mul(power, sum);
}

#endif
