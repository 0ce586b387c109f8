#ifndef MATH_QUICK_H
#define MATH_QUICK_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "math/elementary.h"

// Elementary functions for inner loops of geometry: the same bits on every CPU, as det_*,
// but a few roundings off instead of below one. Errors are given in units of ROUNDOFF.

// log x for a positive, normal x: |error| <= 2 |log x| + 1.
static inline double quick_log(double x)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    // x = m 2^k with sqrt(1/2) <= m < sqrt(2)
    const uint64_t shifted = bits - 0x3fe6a09e667f3bcdu;
    const int64_t k = (int64_t)shifted >> 52;
    bits -= (uint64_t)k << 52;
    double m;
    memcpy(&m, &bits, sizeof m);
    // 2 atanh s, s = (m - 1)/(m + 1), |s| < 0.172
    const double s = (m - 1) / (m + 1), s2 = s * s, s4 = s2 * s2, s8 = s4 * s4;
    const double a = 1. / 3 + s2 * (1. / 5), b = 1. / 7 + s2 * (1. / 9);
    const double c = 1. / 11 + s2 * (1. / 13), d = 1. / 15 + s2 * (1. / 17);
    const double tail =
        (a + s4 * b) + s8 * ((c + s4 * d) + s8 * (1. / 19 + s2 * (1. / 21)));
    return (double)k * 0x1.62e42fefa39efp-1 + (2 * s + 2 * s * s2 * tail);
}

// exp x for |x| < 700: relative error <= 3 + |x|/2.
static inline double quick_exp(double x)
{
    // The nearest integer to x/ln 2 by adding and taking off 1.5 * 2^52.
    const double big = 0x1.8p52, k = (x * 0x1.71547652b82fep+0 + big) - big;
    const double r = (x - k * 0x1.62e42fee00000p-1) - k * 0x1.a39ef35793c76p-33;
    const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const double a = 1 + r, b = 1. / 2 + r * (1. / 6), c = 1. / 24 + r * (1. / 120);
    const double d = 1. / 720 + r * (1. / 5040), e = 1. / 40320 + r * (1. / 362880);
    const double f = 1. / 3628800 + r * (1. / 39916800);
    const double g = 1. / 479001600 + r * (1. / 6227020800.);
    const double p = (a + r2 * b) + r4 * (c + r2 * d) + r8 * ((e + r2 * f) + r4 * g);
    const uint64_t bits = (uint64_t)((int64_t)k + 1023) << 52;
    double scale;
    memcpy(&scale, &bits, sizeof scale);
    return p * scale;
}

// x^y for a positive, normal x; 0 or infinity beyond exp(+-700). Relative error
// <= 3 |y log x| + 4.
static inline double quick_pow(double x, double y)
{
    const double e = y * quick_log(x);
    if (!(e > -700 && e < 700))
        return e > 0 ? HUGE_VAL : e <= 0 ? 0 : e;
    return quick_exp(e);
}

// atan2(y, x): relative error <= 4. atan(c) for c the quarter next to the ratio, and the
// series of the rest, which is at most 1/8.
static inline double quick_atan2(double y, double x)
{
    static const double quarters[] = {0, 0x1.f5b75f92c80ddp-3, 0x1.dac670561bb4fp-2,
                                      0x1.4978fa3269ee1p-1, 0x1.921fb54442d18p-1};
    static const double term[] = {1. / 21,  -1. / 19, 1. / 17, -1. / 15, 1. / 13,
                                  -1. / 11, 1. / 9,   -1. / 7, 1. / 5,   -1. / 3};
    const double ax = fabs(x), ay = fabs(y);
    const double num = ax < ay ? ax : ay, den = ax < ay ? ay : ax;
    if (!(0x1p-900 < den && den < HUGE_VAL))
        return det_atan2(y, x);
    const double k = floor(4 * (num / den) + 0.5), c = k * 0.25;
    const double t = (num - c * den) / (den + c * num), t2 = t * t;
    double p = term[0];
    for (int i = 1; i < 10; i++)
        p = p * t2 + term[i];
    double a = quarters[(int)k] + (t + (t * t2) * p);
    a = ax < ay ? 0x1.921fb54442d18p+0 - a : a;
    a = x < 0 ? 0x1.921fb54442d18p+1 - a : a;
    return copysign(a, y);
}

// sin and cos for |x| < 10^5: |error| <= 2.
static inline void quick_sincos(double x, double *sine, double *cosine)
{
    const double big = 0x1.8p52, k = (x * 0x1.45f306dc9c883p-1 + big) - big;
    // pi/2 in three parts, the first two with 33 bits
    double r = ((x - k * 0x1.921fb54400000p+0) - k * 0x1.0b4611a600000p-34) -
               k * 0x1.3198a2e037073p-69;
    const double r2 = r * r, r4 = r2 * r2, r8 = r4 * r4;
    const double s =
        (-1. / 6 + r2 * (1. / 120)) + r4 * (-1. / 5040 + r2 * (1. / 362880)) +
        r8 * ((-1. / 39916800 + r2 * (1. / 6227020800.)) + r4 * (-1. / 1307674368000.));
    const double c = (-1. / 2 + r2 * (1. / 24)) + r4 * (-1. / 720 + r2 * (1. / 40320)) +
                     r8 * ((-1. / 3628800 + r2 * (1. / 479001600)) +
                           r4 * (-1. / 87178291200. + r2 * (1. / 20922789888000.)));
    const double sr = r + r * r2 * s, cr = 1 + r2 * c;
    const int quadrant = (int)((int64_t)k & 3);
    const double a = quadrant & 1 ? cr : sr, b = quadrant & 1 ? sr : cr;
    *sine = quadrant & 2 ? -a : a;
    *cosine = (quadrant + 1) & 2 ? -b : b;
}

#endif
