#ifndef MATH_LARGER_H
#define MATH_LARGER_H

// The larger and the smaller of two numbers, where fmax and fmin would be calls. A NaN gives
// way to the other only where it comes first.
static inline double larger(double a, double b) { return a > b ? a : b; }
static inline double smaller(double a, double b) { return a < b ? a : b; }

#endif
