#ifndef MATH_INTERVAL_H
#define MATH_INTERVAL_H

#include <math.h>
#include <stdbool.h>

// Interval arithmetic with guaranteed bounds (Moore, Kearfott, Cloud: Introduction to
// Interval Analysis, 2009): a result holds the real value and the double that the same
// expression computes, for all arguments in the operands. Ends are widened by the
// rounding of the operation instead of switching the rounding mode; errors below the
// smallest normal number are left out.
//
// The whole line also stands for "may be no number at all": an operation that can leave
// its domain returns it, and everything computed from it stays the whole line until a
// comparison has looked at it.
struct interval {
    double lo, hi;
};

#define INTERVAL_ROUNDING   0x1p-52 // + - * / sqrt, and one more for safety
#define INTERVAL_ELEMENTARY 0x1p-50 // det_* functions: below 1 ulp, not monotone in it
// A power as a bound: quick_pow is off by 3 |y log x| + 4 roundings, 2104 at most; 4096 are allowed.
#define INTERVAL_POWER 0x1p-41

static inline struct interval interval(double lo, double hi)
{
    return (struct interval){lo, hi};
}
static inline struct interval interval_point(double v) { return interval(v, v); }
static inline struct interval interval_whole(void)
{
    return interval(-INFINITY, INFINITY);
}
static inline bool interval_is_whole(struct interval a)
{
    return a.lo == -INFINITY && a.hi == INFINITY;
}
static inline bool interval_is_point(struct interval a) { return a.lo == a.hi; }
static inline bool interval_has(struct interval a, double v)
{
    return a.lo <= v && v <= a.hi;
}
static inline bool interval_is_zero(struct interval a) { return a.lo == 0 && a.hi == 0; }
static inline double interval_middle(struct interval a) { return 0.5 * (a.lo + a.hi); }
static inline double interval_width(struct interval a) { return a.hi - a.lo; }
static inline double interval_size(struct interval a) // largest absolute value
{
    return fmax(fabs(a.lo), fabs(a.hi));
}

// Ends as computed, widened; ends that are no numbers give the whole line.
static inline struct interval interval_widened(double lo, double hi, double relative)
{
    lo -= fabs(lo) * relative;
    hi += fabs(hi) * relative;
    return lo <= hi ? interval(lo, hi) : interval_whole();
}
static inline struct interval interval_hull(struct interval a, struct interval b)
{
    return interval(a.lo < b.lo ? a.lo : b.lo, a.hi > b.hi ? a.hi : b.hi);
}
static inline struct interval interval_negate(struct interval a)
{
    return interval(-a.hi, -a.lo);
}
static inline struct interval interval_add(struct interval a, struct interval b)
{
    return interval_widened(a.lo + b.lo, a.hi + b.hi, INTERVAL_ROUNDING);
}
static inline struct interval interval_subtract(struct interval a, struct interval b)
{
    return interval_widened(a.lo - b.hi, a.hi - b.lo, INTERVAL_ROUNDING);
}
struct interval interval_multiply(struct interval a, struct interval b);
struct interval interval_divide(struct interval a, struct interval b);
struct interval interval_square(struct interval a);
struct interval interval_abs(struct interval a);
struct interval interval_min(struct interval a, struct interval b);
struct interval interval_max(struct interval a, struct interval b);
struct interval interval_floor(struct interval a);
struct interval interval_ceil(struct interval a);
struct interval interval_sqrt(struct interval a);
struct interval interval_exp(struct interval a);
struct interval interval_log(struct interval a);
struct interval interval_log10(struct interval a);
struct interval interval_sin(struct interval a);
struct interval interval_cos(struct interval a);
struct interval interval_tan(struct interval a);
struct interval interval_asin(struct interval a);
struct interval interval_acos(struct interval a);
struct interval interval_atan(struct interval a);
struct interval interval_atan2(struct interval y, struct interval x);
struct interval interval_sinh(struct interval a);
struct interval interval_cosh(struct interval a);
struct interval interval_tanh(struct interval a);
struct interval interval_asinh(struct interval a);
struct interval interval_acosh(struct interval a);
struct interval interval_atanh(struct interval a);
struct interval interval_mod(struct interval a, struct interval b); // C's fmod
struct interval interval_pow(struct interval a, struct interval b); // C's pow

#endif
