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

// The relative error of the logarithm grows by |y log x| < 700 on the way through exp: to
// 2^-36 at the most.
double det_pow_single(double x, double y)
{
    if (!(x >= DBL_MIN && x <= DBL_MAX))
        return det_pow(x, y);
    double m;
    const double k = single_split(x, &m);
    const double s = (m - 1) / (m + 1), q = s * s, w = q * q;
    double even = single_log_even[4], odd = single_log_odd[3];
#pragma GCC unroll 4
    for (int i = 3; i >= 0; i--)
        even = single_log_even[i] + w * even;
#pragma GCC unroll 3
    for (int i = 2; i >= 0; i--)
        odd = single_log_odd[i] + w * odd;
    const double log_m = 2 * s * (even + q * odd);
    return det_exp_single(y * (k * SINGLE_LN2_HIGH + (k * SINGLE_LN2_LOW + log_m)));
}
