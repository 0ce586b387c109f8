#ifndef MATH_SINGLE_H
#define MATH_SINGLE_H

#include <stdint.h>
#include <string.h>

// The numbers of det_exp_single, for those who compute it in lanes with the same bits:
// exp x = 2^k (E(r^2) + r O(r^2)) with k = floor(x/ln 2 + 1/2), r = x - k ln 2.

#define SINGLE_INV_LN2 0x1.71547652b82fep+0
// ln 2 in two parts, the first with 32 bits so that k * SINGLE_LN2_HIGH is exact.
#define SINGLE_LN2_HIGH 0x1.62e42fee00000p-1
#define SINGLE_LN2_LOW  0x1.a39ef35793c76p-33
// Below this |x| the result and its factor 2^k are normal numbers.
#define SINGLE_EXP_MOST 700.0

// The Taylor series to r^11 on |r| <= ln2/2: 0.3466^12/12! < 2^-46. Even and odd terms are
// summed apart, which halves the chain of dependent operations.
static const double single_exp_even[6] = {1,        1. / 2,     1. / 24,
                                          1. / 720, 1. / 40320, 1. / 3628800};
static const double single_exp_odd[6] = {1,         1. / 6,      1. / 120,
                                         1. / 5040, 1. / 362880, 1. / 39916800};

// det_pow_single: log m = 2 s (E(s^4) + s^2 O(s^4)), s = (m-1)/(m+1), for m between
// sqrt(1/2) and sqrt(2), to s^17: what is left out is below 2^-46 of it.
static const double single_log_even[5] = {1, 1. / 5, 1. / 9, 1. / 13, 1. / 17};
static const double single_log_odd[4] = {1. / 3, 1. / 7, 1. / 11, 1. / 15};

// x = m 2^k for a positive normal x.
static inline double single_split(double x, double *m)
{
    uint64_t bits;
    const uint64_t half = 0x3fe6a09e667f3bcdu; // sqrt(1/2)
    memcpy(&bits, &x, sizeof bits);
    const int64_t k = (int64_t)(bits - half) >> 52;
    bits -= (uint64_t)k << 52;
    memcpy(m, &bits, sizeof bits);
    return (double)k;
}

#endif
