#ifndef MATH_SINGLE_LANES_H
#define MATH_SINGLE_LANES_H

// Powers and exponentials of single precision in lanes.

#include <float.h>
#include <stdint.h>
#include <string.h>

#include "math/elementary.h"
#include "math/lanes_bits.h"
#include "math/single.h"

// single_split of positive normal numbers in lanes.
LANES_INLINE struct real8 r8_split(struct real8 x, struct real8 *m)
{
    const uint64_t half = 0x3fe6a09e667f3bcd, up = 1024; // sqrt(1/2); k + up > 0
    double v[8];
    bits_int8 bits;
    r8_store(v, x);
    memcpy(&bits, v, sizeof v);
    const bits_uint8 k = ((bits_uint8)bits - half + (up << 52)) >> 52;
    const bits_real8 exponent =
        (bits_real8)((bits_int8)k - (int64_t)up + BITS_BIG_BITS) - BITS_BIG;
    bits -= (bits_int8)((k - up) << 52);
    memcpy(v, &bits, sizeof v);
    *m = r8_load(v);
    memcpy(v, &exponent, sizeof v);
    return r8_load(v);
}

// det_exp_single in lanes.
LANES_INLINE struct real8 r8_exp_single(struct real8 x)
{
    double all[8];
    const struct real8 kd =
        r8_floor(r8_add(r8_mul(x, r8_set(SINGLE_INV_LN2)), r8_set(0.5)));
    if (m8_bits(r8_lt(r8_abs(x), r8_set(SINGLE_EXP_MOST))) != 255) {
        r8_store(all, x);
        for (int i = 0; i < 8; i++)
            all[i] = det_exp_single(all[i]);
        return r8_load(all);
    }
    const struct real8 r = r8_sub(r8_sub(x, r8_mul(kd, r8_set(SINGLE_LN2_HIGH))),
                                  r8_mul(kd, r8_set(SINGLE_LN2_LOW)));
    const struct real8 s = r8_mul(r, r);
    struct real8 even = r8_set(single_exp_even[5]), odd = r8_set(single_exp_odd[5]);
#pragma GCC unroll 5
    for (int i = 4; i >= 0; i--) {
        even = r8_add(r8_set(single_exp_even[i]), r8_mul(s, even));
        odd = r8_add(r8_set(single_exp_odd[i]), r8_mul(s, odd));
    }
    return r8_mul(r8_add(even, r8_mul(r, odd)), r8_power_of_two(kd));
}

// det_pow_single in lanes.
LANES_INLINE struct real8 r8_pow_single(struct real8 x, double y)
{
    if (m8_bits(m8_and(r8_le(r8_set(DBL_MIN), x), r8_le(x, r8_set(DBL_MAX)))) != 255) {
        double all[8];
        r8_store(all, x);
        for (int i = 0; i < 8; i++)
            all[i] = det_pow_single(all[i], y);
        return r8_load(all);
    }
    struct real8 m;
    const struct real8 k = r8_split(x, &m), one = r8_set(1);
    const struct real8 s = r8_div(r8_sub(m, one), r8_add(m, one));
    const struct real8 q = r8_mul(s, s), w = r8_mul(q, q);
    struct real8 even = r8_set(single_log_even[4]), odd = r8_set(single_log_odd[3]);
#pragma GCC unroll 4
    for (int i = 3; i >= 0; i--)
        even = r8_add(r8_set(single_log_even[i]), r8_mul(w, even));
#pragma GCC unroll 3
    for (int i = 2; i >= 0; i--)
        odd = r8_add(r8_set(single_log_odd[i]), r8_mul(w, odd));
    const struct real8 log_m = r8_mul(r8_mul(r8_set(2), s), r8_add(even, r8_mul(q, odd)));
    const struct real8 log_x = r8_add(r8_mul(k, r8_set(SINGLE_LN2_HIGH)),
                                      r8_add(r8_mul(k, r8_set(SINGLE_LN2_LOW)), log_m));
    return r8_exp_single(r8_mul(r8_set(y), log_x));
}

#endif
