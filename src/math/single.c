// exp and pow for results that are kept in single precision.
#include "math/elementary.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "math/single.h"

static double from_bits(uint64_t bits)
{
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static uint64_t to_bits(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

double det_exp_single(double x)
{
    if (!(fabs(x) < SINGLE_EXP_MOST))
        return det_exp(x);
    const double k = floor(x * SINGLE_INV_LN2 + 0.5);
    const double r = (x - k * SINGLE_LN2_HIGH) - k * SINGLE_LN2_LOW, s = r * r;
    double even = single_exp_even[5], odd = single_exp_odd[5];
#pragma GCC unroll 5
    for (int i = 4; i >= 0; i--) {
        even = single_exp_even[i] + s * even;
        odd = single_exp_odd[i] + s * odd;
    }
    return (even + r * odd) * from_bits((uint64_t)((int64_t)k + 1023) << 52);
}

// log m = 2 atanh((m-1)/(m+1)) for m between sqrt(1/2) and sqrt(2), to s^17: what is left
// out is below 2^-46 of it. The log's relative error grows by |y log x| < 700 on the way
// through exp: 2^-36 at the most.
double det_pow_single(double x, double y)
{
    if (!(x >= DBL_MIN && x <= DBL_MAX))
        return det_pow(x, y);
    const uint64_t bits = to_bits(x), half = to_bits(0x1.6a09e667f3bcdp-1);
    // The exponent that leaves a mantissa of sqrt(1/2) or more.
    const int64_t k = ((int64_t)(bits - half)) >> 52;
    const double m = from_bits(bits - ((uint64_t)k << 52));
    const double s = (m - 1) / (m + 1), q = s * s, w = q * q;
    const double even = 1 + w * (1. / 5 + w * (1. / 9 + w * (1. / 13 + w * (1. / 17))));
    const double odd = 1. / 3 + w * (1. / 7 + w * (1. / 11 + w * (1. / 15)));
    const double log_m = 2 * s * (even + q * odd);
    const double log_x =
        (double)k * SINGLE_LN2_HIGH + ((double)k * SINGLE_LN2_LOW + log_m);
    return det_exp_single(y * log_x);
}
