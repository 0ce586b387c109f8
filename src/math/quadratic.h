#ifndef MATH_QUADRATIC_H
#define MATH_QUADRATIC_H

#include <math.h>

// A bound on the error of sqrt(x) when x >= 0 is wrong by at most e. Far from zero it
// is e / (2 sqrt(x)) within a factor of 3; at zero it is sqrt(e) within a factor of
// 1.5. For any x' in [max(0, x - e), x + e]: |sqrt(x') - sqrt(x)| <= sqrt(2) e / sqrt(x + e).
static inline double sqrt_error(double x, double e) { return 1.5 * e / sqrt(x + e); }

// The real roots of a*t^2 + 2*b*t + c, ascending; 0 or 2. Nothing is returned for a
// double root or a == 0. No cancellation: one root by q = -(b + sign(b) sqrt(D)) over a,
// the other as c/q (Numerical Recipes 5.6; Kahan).
int quadratic_roots(double a, double b, double c, double root[2]);

#endif
