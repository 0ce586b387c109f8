#include "math/polynomial.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

static const double roundoff = 0x1p-53;

double polynomial_value(const double *c, int degree, double t)
{
    double v = c[degree];
    for (int i = degree - 1; i >= 0; i--)
        v = v * t + c[i];
    return v;
}

double polynomial_root_bound(const double *c, int degree)
{
    while (degree > 0 && c[degree] == 0)
        degree--;
    double bound = 0;
    for (int i = 0; i < degree; i++) {
        if (c[i] == 0)
            continue;
        // |c_i / c_n|^(1/(n-i)) up to the next power of two, without pow.
        int ei, en;
        frexp(c[i], &ei);
        frexp(c[degree], &en);
        int e = (int)ceil((ei - en + 1.) / (degree - i));
        bound = fmax(bound, ldexp(1, e));
    }
    return 2 * bound;
}

// Sum of |c_i t^i|: the scale of the rounding errors of the value.
static double magnitude(const double *c, int degree, double t)
{
    double v = fabs(c[degree]);
    t = fabs(t);
    for (int i = degree - 1; i >= 0; i--)
        v = v * t + fabs(c[i]);
    return v;
}

// The one root of a monotone stretch: Newton from the middle, kept inside the bracket.
static double root_between(const double *c, const double *d, int degree, double lo,
                           double hi, bool rising)
{
    double t = 0.5 * (lo + hi);
    for (int i = 0; i < 200; i++) {
        double v = polynomial_value(c, degree, t);
        if (v == 0)
            return t;
        if ((v > 0) == rising)
            hi = t;
        else
            lo = t;
        double next = t - v / polynomial_value(d, degree - 1, t);
        if (!(next > lo && next < hi))
            next = 0.5 * (lo + hi);
        if (next == t || next <= lo || next >= hi)
            return next;
        t = next;
    }
    return t;
}

// Sign changes of c on (lo, hi), given those of its derivative d.
static int refine(const double *c, const double *d, int degree, double lo, double hi,
                  const double *stop, int stops, double *root, bool *first_rising)
{
    int n = 0;
    double a = lo;
    bool above = polynomial_value(c, degree, lo) >= 0;
    *first_rising = !above;
    for (int i = 0; i <= stops; i++) {
        double b = i < stops ? stop[i] : hi;
        // Within its rounding error an extremum touches zero and does not cross it.
        double v = polynomial_value(c, degree, b);
        double noise = 2 * degree * roundoff * magnitude(c, degree, b);
        bool above_b = i < stops && fabs(v) <= noise ? above : v >= 0;
        if (above_b != above)
            root[n++] = root_between(c, d, degree, a, b, above_b);
        above = above_b;
        a = b;
    }
    return n;
}

int polynomial_roots(const double *coefficient, int degree, double lo, double hi,
                     double rounding, struct polynomial_root *out)
{
    double chain[POLYNOMIAL_DEGREE_MAX + 1][POLYNOMIAL_DEGREE_MAX + 1];
    double buffer[2][POLYNOMIAL_DEGREE_MAX + 1];
    while (degree > 0 && coefficient[degree] == 0)
        degree--;
    if (degree < 1 || degree > POLYNOMIAL_DEGREE_MAX || !(lo < hi))
        return 0;
    memcpy(chain[0], coefficient, (size_t)(degree + 1) * sizeof *coefficient);
    for (int k = 1; k < degree; k++)
        for (int i = 0; i <= degree - k; i++)
            chain[k][i] = (i + 1) * chain[k - 1][i + 1];
    chain[degree][0] = chain[degree - 1][1];

    int stops = 0, use = 0;
    bool rising = false;
    for (int k = degree - 1; k >= 0; k--) {
        stops = refine(chain[k], chain[k + 1], degree - k, lo, hi, buffer[use], stops,
                       buffer[!use], &rising);
        use = !use;
    }
    for (int i = 0; i < stops; i++) {
        const double t = buffer[use][i];
        const double error =
            (2 * degree + rounding) * roundoff * magnitude(coefficient, degree, t);
        const double slope = fabs(polynomial_value(chain[1], degree - 1, t));
        // Near a double root the slope vanishes and the curvature bounds the error.
        double dt = error / slope;
        if (degree > 1) {
            const double curve = fabs(polynomial_value(chain[2], degree - 2, t));
            if (curve > 0)
                dt = fmin(dt, 2 * sqrt(2 * error / curve));
        }
        out[i] = (struct polynomial_root){t, dt, rising};
        rising = !rising;
    }
    return stops;
}
