#ifndef MATH_POLYNOMIAL_H
#define MATH_POLYNOMIAL_H

#include <stdbool.h>

// Real roots of a polynomial of any degree on an interval, by isolation: between two
// neighbouring roots of the derivative a polynomial is monotone and crosses zero at
// most once, where its sign changes. So nothing is missed, and roots come ordered with
// alternating signs (Collins & Loos 1976; research 4.7).
enum { POLYNOMIAL_DEGREE_MAX = 35 };

struct polynomial_root {
    double t;
    double dt;  // bound on the error of t from the rounding of the evaluation
    int rising; // the sign goes from - to + with growing t
};

// coefficient[i] belongs to t^i. Roots in lo < t < hi at which the sign changes,
// ascending; a zero counts as positive, so that a touch from above is no root. Returns
// their number, at most degree. rounding: relative error of the coefficients, in
// units of roundoff, on top of the evaluation's own.
int polynomial_roots(const double *coefficient, int degree, double lo, double hi,
                     double rounding, struct polynomial_root *out);

// The same with no error bounds (dt), lines and parabolas by formula: for roots that are but
// a step on the way.
int polynomial_sign_changes(const double *coefficient, int degree, double lo, double hi,
                            struct polynomial_root *out);

// How far a root at t may be off when the value is off by `error`, more than polynomial_roots
// knows of: to first order where it is simple, to second at a double root.
double polynomial_root_error(const double *coefficient, int degree, double t,
                             double error);

// The one root between lo and hi, where the sign changes from - to + if it is rising.
double polynomial_root_between(const double *coefficient, int degree, double lo,
                               double hi, bool rising);

double polynomial_value(const double *coefficient, int degree, double t);

// A bound on |t| of every root (Fujiwara 1916); 0 for a constant.
double polynomial_root_bound(const double *coefficient, int degree);

#endif
