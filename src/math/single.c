// exp and pow for results that are kept in single precision.
#include "math/elementary.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static const double inv_ln2 = 0x1.71547652b82fep+0;
// ln 2 in two parts, the first with 32 bits so that k * ln2_high is exact.
static const double ln2_high = 0x1.62e42fee00000p-1, ln2_low = 0x1.a39ef35793c76p-33;

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

// The Taylor series to r^11 on |r| <= ln2/2: 0.3466^12/12! < 2^-46. Even and odd terms are
// summed apart, which halves the chain of dependent operations.
double det_exp_single(double x)
{
    static const double most = 700; // the result and its factor 2^k are normal numbers
    if (!(fabs(x) < most))
        return det_exp(x);
    const double k = floor(x * inv_ln2 + 0.5);
    const double r = (x - k * ln2_high) - k * ln2_low, s = r * r;
    const double even =
        1 + s * (1. / 2 +
                 s * (1. / 24 + s * (1. / 720 + s * (1. / 40320 + s * (1. / 3628800)))));
    const double odd =
        1 + s * (1. / 6 + s * (1. / 120 + s * (1. / 5040 +
                                               s * (1. / 362880 + s * (1. / 39916800)))));
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
    const double log_x = (double)k * ln2_high + ((double)k * ln2_low + log_m);
    return det_exp_single(y * log_x);
}
