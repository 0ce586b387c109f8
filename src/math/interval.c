// Interval arithmetic (interval.h).
#include "math/interval.h"

#include <float.h>

#include "math/elementary.h"
#include "math/pi.h"
#include "math/quick.h"

struct interval interval_multiply(struct interval a, struct interval b)
{
    const double p = a.lo * b.lo, q = a.lo * b.hi, r = a.hi * b.lo, s = a.hi * b.hi;
    if (p != p || q != q || r != r || s != s) // 0 * infinity
        return interval_whole();
    const double lo1 = p < q ? p : q, lo2 = r < s ? r : s;
    const double hi1 = p > q ? p : q, hi2 = r > s ? r : s;
    return interval_widened(lo1 < lo2 ? lo1 : lo2, hi1 > hi2 ? hi1 : hi2,
                            INTERVAL_ROUNDING);
}

struct interval interval_divide(struct interval a, struct interval b)
{
    if (b.lo > 0 || b.hi < 0) {
        const double p = a.lo / b.lo, q = a.lo / b.hi, r = a.hi / b.lo, s = a.hi / b.hi;
        if (p != p || q != q || r != r || s != s)
            return interval_whole();
        return interval_widened(fmin(fmin(p, q), fmin(r, s)),
                                fmax(fmax(p, q), fmax(r, s)), INTERVAL_ROUNDING);
    }
    // The sign of a zero decides between the two infinities: nothing is known.
    return interval_whole();
}

struct interval interval_square(struct interval a)
{
    if (interval_is_whole(a))
        return a;
    const double p = a.lo * a.lo, q = a.hi * a.hi;
    const double lo = a.lo > 0 ? p : a.hi < 0 ? q : 0;
    return interval_widened(lo, p > q ? p : q, INTERVAL_ROUNDING);
}

struct interval interval_abs(struct interval a)
{
    if (a.lo >= 0 || interval_is_whole(a))
        return a;
    return a.hi <= 0 ? interval_negate(a) : interval(0, fmax(-a.lo, a.hi));
}

struct interval interval_min(struct interval a, struct interval b)
{
    if (interval_is_whole(a) || interval_is_whole(b))
        return interval_whole();
    return interval(a.lo < b.lo ? a.lo : b.lo, a.hi < b.hi ? a.hi : b.hi);
}

struct interval interval_max(struct interval a, struct interval b)
{
    if (interval_is_whole(a) || interval_is_whole(b))
        return interval_whole();
    return interval(a.lo > b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi);
}

struct interval interval_floor(struct interval a)
{
    return interval(floor(a.lo), floor(a.hi));
}

struct interval interval_ceil(struct interval a)
{
    return interval(ceil(a.lo), ceil(a.hi));
}

struct interval interval_sqrt(struct interval a)
{
    if (!(a.lo >= 0))
        return interval_whole();
    return interval_widened(sqrt(a.lo), sqrt(a.hi), INTERVAL_ROUNDING);
}

// Of an increasing f, where a lies in its domain.
static struct interval increasing(double (*f)(double), struct interval a)
{
    if (interval_is_whole(a))
        return a;
    return interval_widened(f(a.lo), f(a.hi), INTERVAL_ELEMENTARY);
}

static struct interval clamped(struct interval a, double lo, double hi)
{
    return interval(a.lo < lo ? lo : a.lo, a.hi > hi ? hi : a.hi);
}

struct interval interval_exp(struct interval a)
{
    // Results below the normal numbers are not exact to a relative bound.
    struct interval r = increasing(det_exp, a);
    if (r.lo < 0x1p-1000 && !interval_is_whole(a))
        r.lo = 0;
    if (r.hi < 0x1p-1000)
        r.hi = 0x1p-1000;
    return r;
}

struct interval interval_log(struct interval a)
{
    return a.lo > 0 ? increasing(det_log, a) : interval_whole();
}

struct interval interval_log10(struct interval a)
{
    return a.lo > 0 ? increasing(det_log10, a) : interval_whole();
}

// Where `a` may reach a quarter turn q = first (mod 4).
static bool reaches_quarter(struct interval a, int first)
{
    const double slack = 1e-13, from = a.lo / (PI / 2), to = a.hi / (PI / 2);
    const double n = ceil((from - fabs(from) * slack - slack - first) / 4);
    return 4 * n + first <= to + fabs(to) * slack + slack;
}

// sin(x + quarters * pi/2) for |x| < QUICK_MAX, wrong by less than QUICK_ERROR: the rest of
// x by pi/2 is off by k * 2^-86 and its own rounding, the series by less than 2^-53 each.
#define QUICK_MAX   1e5
#define QUICK_ERROR 0x1p-48

static double quick_sin(double x, int quarters)
{
    static const double s[] = {
        -1. / 6,         1. / 120,         -1. / 5040,          1. / 362880,
        -1. / 39916800., 1. / 6227020800., -1. / 1307674368000.};
    static const double c[] = {-1. / 2,           1. / 24,        -1. / 720,
                               1. / 40320,        -1. / 3628800., 1. / 479001600.,
                               -1. / 87178291200.};
    const double k = floor(x * (2 / PI) + 0.5);
    const double r = x - k * 0x1.921fb54400000p+0 - k * 0x1.0b4611a626331p-34, r2 = r * r;
    const int q = ((int)k + quarters) & 3;
    const double *p = q & 1 ? c : s;
    double v = p[6];
    for (int i = 5; i >= 0; i--)
        v = v * r2 + p[i];
    v = (q & 1 ? 1 : r) * (1 + r2 * v);
    return q & 2 ? -v : v;
}

static struct interval quick_wave(struct interval a, int quarters, bool rises, bool falls)
{
    const double p = quick_sin(a.lo, quarters), q = quick_sin(a.hi, quarters);
    return interval(falls ? -1 : fmax((p < q ? p : q) - QUICK_ERROR, -1),
                    rises ? 1 : fmin((p < q ? q : p) + QUICK_ERROR, 1));
}

static struct interval wave(double (*f)(double), struct interval a, int top, int bottom)
{
    if (!(interval_size(a) < 1e9))
        return interval_size(a) < INFINITY ? interval(-1, 1) : interval_whole();
    const bool rises = reaches_quarter(a, top), falls = reaches_quarter(a, bottom);
    if (rises && falls)
        return interval(-1, 1);
    if (interval_size(a) < QUICK_MAX)
        return quick_wave(a, top == 0, rises, falls);
    const double p = f(a.lo), q = f(a.hi);
    struct interval r = interval(p < q ? p : q, p > q ? p : q);
    r = clamped(interval_widened(r.lo, r.hi, INTERVAL_ELEMENTARY), -1, 1);
    return interval(falls ? -1 : r.lo, rises ? 1 : r.hi);
}

struct interval interval_sin(struct interval a) { return wave(det_sin, a, 1, 3); }
struct interval interval_cos(struct interval a) { return wave(det_cos, a, 0, 2); }

struct interval interval_tan(struct interval a)
{
    if (!(interval_size(a) < 1e9) || reaches_quarter(a, 1) || reaches_quarter(a, 3))
        return interval_whole();
    return increasing(det_tan, a);
}

struct interval interval_asin(struct interval a)
{
    return a.lo >= -1 && a.hi <= 1 ? increasing(det_asin, a) : interval_whole();
}

struct interval interval_acos(struct interval a)
{
    if (!(a.lo >= -1 && a.hi <= 1))
        return interval_whole();
    return interval_widened(det_acos(a.hi), det_acos(a.lo), INTERVAL_ELEMENTARY);
}

struct interval interval_atan(struct interval a) { return increasing(det_atan, a); }

struct interval interval_atan2(struct interval y, struct interval x)
{
    const struct interval all = interval_widened(-PI, PI, INTERVAL_ELEMENTARY);
    if (interval_is_whole(y) || interval_is_whole(x))
        return interval_whole();
    if (x.lo <= 0 && y.lo <= 0 && y.hi >= 0) // the cut or the origin
        return all;
    // The angle grows with y right of the y axis, with x below the x axis.
    const double low_y = y.lo >= 0   ? (x.hi > 0 ? y.lo : y.hi)
                         : y.hi <= 0 ? (x.lo > 0 ? y.lo : y.hi)
                                     : y.lo;
    const double high_y = y.lo >= 0   ? (x.lo > 0 ? y.hi : y.lo)
                          : y.hi <= 0 ? (x.hi > 0 ? y.hi : y.lo)
                                      : y.hi;
    const double low_x = low_y >= 0 ? x.hi : x.lo, high_x = high_y >= 0 ? x.lo : x.hi;
    return interval_widened(det_atan2(low_y, low_x), det_atan2(high_y, high_x),
                            INTERVAL_ELEMENTARY);
}

struct interval interval_sinh(struct interval a) { return increasing(det_sinh, a); }

struct interval interval_cosh(struct interval a)
{
    return increasing(det_cosh, interval_abs(a));
}

struct interval interval_tanh(struct interval a)
{
    const struct interval r = increasing(det_tanh, a);
    return interval_is_whole(a) ? r : clamped(r, -1, 1);
}

struct interval interval_asinh(struct interval a) { return increasing(det_asinh, a); }

struct interval interval_acosh(struct interval a)
{
    return a.lo >= 1 ? increasing(det_acosh, a) : interval_whole();
}

struct interval interval_atanh(struct interval a)
{
    return a.lo > -1 && a.hi < 1 ? increasing(det_atanh, a) : interval_whole();
}

struct interval interval_mod(struct interval a, struct interval b)
{
    const struct interval size = interval_abs(b);
    if (!(size.lo > 0) || !(interval_size(a) < INFINITY))
        return interval_whole();
    if (interval_is_point(size) && trunc(a.lo / size.lo) == trunc(a.hi / size.lo)) {
        // One branch, unless the quotient was rounded to the next whole number.
        const double p = fmod(a.lo, size.lo), q = fmod(a.hi, size.lo);
        if (p <= q && (a.lo >= 0 || a.hi <= 0 || interval_size(a) < size.lo) &&
            q - p >= (a.hi - a.lo) * 0.5)
            return interval(p, q);
    }
    const double most = fmin(size.hi, interval_size(a));
    return interval(a.lo >= 0 ? 0 : -most, a.hi <= 0 ? 0 : most);
}

// a to a whole number, a of any sign.
static struct interval whole_power(struct interval a, double n)
{
    if (n < 0 && !(a.lo > 0 || a.hi < 0))
        return interval_whole();
    const bool even = fmod(n, 2) == 0;
    const double p = det_pow(a.lo, n), q = det_pow(a.hi, n);
    double lo = p < q ? p : q;
    if (even && a.lo <= 0 && a.hi >= 0)
        lo = 0;
    return interval_widened(lo, p > q ? p : q, INTERVAL_ELEMENTARY);
}

static double power(double x, double y)
{
    if (x >= DBL_MIN && x <= DBL_MAX) {
        const double e = y * quick_log(x);
        if (fabs(e) < 700)
            return quick_exp(e);
    }
    return det_pow(x, y);
}

struct interval interval_pow(struct interval a, struct interval b)
{
    if (interval_is_whole(a) || interval_is_whole(b) || !(interval_size(b) < INFINITY))
        return interval_whole();
    if (interval_is_point(b) && b.lo == floor(b.lo) && fabs(b.lo) < 0x1p52 &&
        interval_size(a) < INFINITY)
        return whole_power(a, b.lo);
    if (!(a.lo > 0 || (a.lo == 0 && b.lo > 0)))
        return interval_whole();
    const bool constant = interval_is_point(b);
    const double p = power(a.lo, b.lo), q = constant ? p : power(a.lo, b.hi);
    const double r = power(a.hi, b.lo), s = constant ? r : power(a.hi, b.hi);
    // Monotone in each argument, whatever the other: the extremes are at corners.
    struct interval v = interval_widened(fmin(fmin(p, q), fmin(r, s)),
                                         fmax(fmax(p, q), fmax(r, s)), INTERVAL_POWER);
    if (v.lo < 0x1p-1000)
        v.lo = 0;
    return v;
}
