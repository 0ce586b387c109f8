// exp, log, pow and the hyperbolic functions; trigonometry is in trig.c.
#include "math/elementary.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "math/power.h"

static const struct dd LOG10_E = {0x1.bcb7b1526e50ep-2, 0x1.95355baaafad3p-57};

// exp(x.hi + x.lo) = (result) * 2^*k, |x.hi| < 2^11. Relative error below 2^-60:
// the Taylor series to r^14 on |r| <= ln2/2 with the 1 + r taken exactly.
static struct dd exp_parts(struct dd x, int *k)
{
    double kd = floor(x.hi * INV_LN2 + 0.5);
    double r = x.hi - kd * LN2_HIGH;
    struct dd a = dd_two_sum(r, x.lo - kd * LN2_LOW.hi);
    // Even and odd powers apart: two short chains of operations instead of a long one.
    const double square = a.hi * a.hi;
    double q = EXP_TERMS[12], odd = EXP_TERMS[11];
    for (int i = 10; i > 0; i -= 2) {
        q = q * square + EXP_TERMS[i];
        odd = odd * square + EXP_TERMS[i - 1];
    }
    q = (q * square + EXP_TERMS[0] + a.hi * odd) * square;
    struct dd s = dd_fast_sum(1, a.hi);
    *k = (int)kd;
    return dd_fast_sum(s.hi, s.lo + (q + a.lo + a.lo * a.hi));
}

// ldexp of numbers near 1.
static double scaled(double v, int k)
{
    const uint64_t bits = (uint64_t)(k + 1023) << 52;
    double power;
    if (k < -1000 || k > 1000)
        return ldexp(v, k);
    memcpy(&power, &bits, sizeof bits);
    return v * power;
}

static double exp_dd(struct dd x)
{
    if (!(x.hi < 710))
        return x.hi != x.hi ? x.hi : HUGE_VAL;
    if (x.hi < -746)
        return 0;
    int k;
    struct dd e = exp_parts(x, &k);
    return scaled(e.hi, k);
}

// frexp of a positive, normal x.
static double split(double x, int *k)
{
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    *k = (int)(bits >> 52) - 1022;
    bits = (bits & 0x000fffffffffffff) | 0x3fe0000000000000;
    memcpy(&x, &bits, sizeof bits);
    return x;
}

// Natural logarithm of a positive, normal x, relative error below 2^-63:
// log m = 2 atanh s, s = (m-1)/(m+1), the first two terms in double-double.
static struct dd log_dd(struct dd x)
{
    int k;
    double m = split(x.hi, &k);
    if (m < SQRT_HALF) {
        m *= 2;
        k--;
    }
    double low = x.lo != 0 ? ldexp(x.lo, -k) : 0;
    struct dd den = dd_two_sum(m, 1);
    den.lo += low;
    struct dd s = dd_div(dd_two_sum(m - 1, low), den);
    struct dd s2 = dd_mul(s, s);
    // As in exp_parts.
    const double square = s2.hi * s2.hi;
    double p = 2. / 25, odd = 2. / 23;
    for (int n = 21; n > 5; n -= 4) {
        p = p * square + 2. / n;
        odd = odd * square + 2. / (n - 2);
    }
    p = p * square + 2. / 5 + s2.hi * odd;
    struct dd t = dd_add(TWO_THIRDS, dd_fast_sum(p * s2.hi, 0));
    struct dd series = dd_mul(s, dd_mul(s2, t));
    struct dd log_m = dd_add((struct dd){2 * s.hi, 2 * s.lo}, series);
    struct dd log_k = dd_scale(k, LN2_LOW);
    return dd_add(dd_add(dd_two_sum(k * LN2_HIGH, 0), log_k), log_m);
}

static struct dd log_double(double x)
{
    if (x >= DBL_MIN)
        return log_dd((struct dd){x, 0});
    struct dd l = log_dd((struct dd){x * 0x1p54, 0});
    struct dd shift = dd_add(dd_two_sum(-54 * LN2_HIGH, 0), dd_scale(-54, LN2_LOW));
    return dd_add(shift, l);
}

double det_exp(double x) { return exp_dd((struct dd){x, 0}); }

double det_log(double x)
{
    if (x > 0 && x <= DBL_MAX)
        return log_double(x).hi;
    return x == 0 ? -HUGE_VAL : x > 0 ? x : (x - x) / 0.0;
}

double det_log10(double x)
{
    if (x > 0 && x <= DBL_MAX)
        return dd_mul(log_double(x), LOG10_E).hi;
    return det_log(x);
}

static int is_odd_integer(double y)
{
    return fabs(y) < 0x1p53 && floor(y) == y && fmod(fabs(y), 2) == 1;
}

// C's pow, including its special cases (C11 F.10.4.4).
double det_pow(double x, double y)
{
    if (y == 0 || x == 1)
        return 1;
    if (x != x || y != y)
        return x + y;
    double ax = fabs(x);
    const int odd = signbit(x) && is_odd_integer(y);
    if (ax == 0 || ax > DBL_MAX) {
        double r = (ax == 0) == (y < 0) ? HUGE_VAL : 0;
        return odd ? -r : r;
    }
    if (fabs(y) > DBL_MAX)
        return ax == 1 ? 1 : (ax > 1) == (y > 0) ? HUGE_VAL : 0;
    if (x < 0 && floor(y) != y)
        return (x - x) / 0.0;
    double clamped = y > 0x1p64 ? 0x1p64 : y < -0x1p64 ? -0x1p64 : y;
    double r = exp_dd(dd_scale(clamped, log_double(ax)));
    return odd ? -r : r;
}

// exp(|x|) as a double-double and its reciprocal; |x| < 700.
static struct dd exp_wide(double x)
{
    int k;
    struct dd e = exp_parts((struct dd){x, 0}, &k);
    return (struct dd){ldexp(e.hi, k), ldexp(e.lo, k)};
}

static struct dd reciprocal(struct dd a) { return dd_div((struct dd){1, 0}, a); }

// exp(x) / 2 without overflow below 710.4
static double exp_half(double x)
{
    static const struct dd minus_ln2 = {-0x1.62e42fefa39efp-1, -0x1.abc9e3b39803fp-56};
    return exp_dd(dd_add((struct dd){x, 0}, minus_ln2));
}

double det_sinh(double x)
{
    double ax = fabs(x), r;
    if (ax < 0.5) { // odd Taylor series to x^17: the difference would cancel
        double x2 = x * x, p = 0;
        for (int n = 17; n >= 3; n -= 2)
            p = (p * x2 + 1) / (double)(n * (n - 1));
        return x + x * (x2 * p);
    }
    if (ax > 40)
        r = exp_half(ax);
    else {
        struct dd e = exp_wide(ax), i = reciprocal(e);
        r = dd_add(e, (struct dd){-i.hi, -i.lo}).hi / 2;
    }
    return x < 0 ? -r : r;
}

double det_cosh(double x)
{
    double ax = fabs(x);
    if (ax > 40)
        return exp_half(ax);
    struct dd e = exp_wide(ax);
    return dd_add(e, reciprocal(e)).hi / 2;
}

double det_tanh(double x)
{
    double ax = fabs(x), r;
    if (ax > 22)
        r = 1;
    else if (ax < 0.5)
        r = det_sinh(ax) / det_cosh(ax);
    else {
        struct dd e = exp_wide(2 * ax); // 1 - 2/(e^2x + 1)
        struct dd t = reciprocal(dd_add(e, (struct dd){1, 0}));
        r = dd_add((struct dd){1, 0}, (struct dd){-2 * t.hi, -2 * t.lo}).hi;
    }
    return x < 0 ? -r : r;
}

// sqrt of a non-negative double-double, one Newton step from the double root.
static struct dd dd_sqrt(struct dd a)
{
    double s = sqrt(a.hi);
    if (s == 0)
        return (struct dd){0, 0};
    struct dd q = dd_two_prod(s, s);
    return dd_fast_sum(s, ((a.hi - q.hi) - q.lo + a.lo) / (2 * s));
}

double det_asinh(double x)
{
    double ax = fabs(x);
    if (ax < 0x1p-27 || !(ax <= DBL_MAX))
        return x;
    double r;
    if (ax > 0x1p100)
        r = det_log(ax) + 0x1.62e42fefa39efp-1;
    else {
        struct dd root = dd_sqrt(dd_add(dd_two_prod(ax, ax), (struct dd){1, 0}));
        r = log_dd(dd_add(root, (struct dd){ax, 0})).hi;
    }
    return x < 0 ? -r : r;
}

double det_acosh(double x)
{
    if (!(x >= 1))
        return (x - x) / 0.0;
    if (x > 0x1p100)
        return det_log(x) + 0x1.62e42fefa39efp-1;
    struct dd root = dd_sqrt(dd_add(dd_two_prod(x, x), (struct dd){-1, 0}));
    return log_dd(dd_add(root, (struct dd){x, 0})).hi;
}

double det_atanh(double x)
{
    double ax = fabs(x);
    if (ax < 0x1p-27)
        return x;
    if (!(ax < 1))
        return ax == 1 ? x / 0.0 : (x - x) / 0.0;
    double r = log_dd(dd_div(dd_two_sum(1, ax), dd_two_sum(1, -ax))).hi / 2;
    return x < 0 ? -r : r;
}
