#include "math/polynomial.h"

#include <limits.h>
#include <math.h>
#include <stdbool.h>
#include <string.h>

#include "math/quadratic.h"

static const double roundoff = 0x1p-53;

enum { BERNSTEIN_MAX = 8 };

// Inlined where the degree is a constant, so that the loops unroll: the quartics of tori
// and blobs are solved for every ray.
#define UNROLLED static inline __attribute__((always_inline))
#define UNROLL   _Pragma("GCC unroll 8")

UNROLLED double value(const double *c, int degree, double t)
{
    double v = c[degree];
    UNROLL
    for (int i = degree - 1; i >= 0; i--)
        v = v * t + c[i];
    return v;
}

double polynomial_value(const double *c, int degree, double t)
{
    return value(c, degree, t);
}

double polynomial_root_bound(const double *c, int degree)
{
    while (degree > 0 && c[degree] == 0)
        degree--;
    int most = INT_MIN, en;
    frexp(c[degree], &en);
    for (int i = 0; i < degree; i++) {
        if (c[i] == 0)
            continue;
        // |c_i / c_n|^(1/(n-i)) up to the next power of two, without pow.
        int ei;
        frexp(c[i], &ei);
        const int above = ei - en + 1, n = degree - i;
        const int e = above > 0 ? (above + n - 1) / n : -(-above / n);
        most = e > most ? e : most;
    }
    return most == INT_MIN ? 0 : ldexp(1, most + 1);
}

// Sum of |c_i t^i|: the scale of the rounding errors of the value.
UNROLLED double magnitude(const double *c, int degree, double t)
{
    double v = fabs(c[degree]);
    t = fabs(t);
    UNROLL
    for (int i = degree - 1; i >= 0; i--)
        v = v * t + fabs(c[i]);
    return v;
}

// The one root of a stretch: Newton from `t`, kept inside the bracket. Stops early within
// `enough` of the root: an extremum that is off by a small share of the stretch changes
// the value there by the square of it. Steps shrink quadratically, so two of them foretell
// the next: where that is less than a rounding it is not taken.
UNROLLED double root_between(const double *c, const double *d, int degree, double lo,
                             double hi, double t, bool rising, double enough)
{
    double last = INFINITY;
    for (int i = 0; i < 200; i++) {
        double v = value(c, degree, t);
        if (v == 0)
            return t;
        if ((v > 0) == rising)
            hi = t;
        else
            lo = t;
        double next = t - v / value(d, degree - 1, t), step = fabs(next - t);
        if (!(next > lo && next < hi)) {
            next = 0.5 * (lo + hi);
            step = INFINITY;
        }
        if (next == t || next <= lo || next >= hi || step <= enough)
            return next;
        if (step < last && last < INFINITY &&
            step * step * step <= 0x1p-54 * fabs(next) * (last * last))
            return next;
        t = next;
        last = step;
    }
    return t;
}

double polynomial_root_between(const double *c, int degree, double lo, double hi,
                               bool rising)
{
    double d[POLYNOMIAL_DEGREE_MAX + 1] = {0};
    for (int i = 0; i < degree; i++)
        d[i] = (i + 1) * c[i + 1];
    return root_between(c, d, degree, lo, hi, 0.5 * (lo + hi), rising, 0);
}

// The coefficients in the Bernstein basis on [lo, hi], whose polygon follows the graph:
// the roots are at most as many as its sign changes, and as many but for an even number
// (Farouki & Rajan 1987). Returns the changes; -1: a sign is not clear of rounding.
UNROLLED int bernstein(const double *c, int degree, double lo, double hi, double *b)
{
    double size = 0;
    const double width = hi - lo;
    UNROLL
    for (int i = 0; i <= degree; i++)
        b[i] = c[i];
    UNROLL
    for (int i = 0; i < degree; i++) // Taylor shift to lo
        UNROLL
    for (int k = degree - 1; k >= i; k--)
        b[k] += lo * b[k + 1];
    double scale = 1;
    UNROLL
    for (int i = 0; i <= degree; i++) { // to [0, 1], over the binomials
        b[i] *= scale;
        scale *= width * ((i + 1.) / (degree - i));
        size += fabs(b[i]);
    }
    UNROLL
    for (int i = 0; i < degree; i++) // sums of the scaled powers
        UNROLL
    for (int k = degree; k > i; k--)
        b[k] += b[k - 1];
    const double noise =
        64 * roundoff * (size + magnitude(c, degree, fmax(fabs(lo), fabs(hi))));
    int changes = 0;
    UNROLL
    for (int i = 0; i <= degree; i++) {
        if (!(fabs(b[i]) > noise))
            return -1;
        changes += i > 0 && (b[i] > 0) != (b[i - 1] > 0);
    }
    return changes;
}

// Between two roots, given the Bernstein polygon with two sign changes: on the way from its
// lowest (or highest) corner to the extremum the value soon has the sign of the middle.
// Also where a parabola there has its roots. False: the extremum is too near zero, or
// there are no roots.
struct middle {
    double t, left, right;
};

UNROLLED bool between_roots(double (*chain)[POLYNOMIAL_DEGREE_MAX + 1], int degree,
                            double lo, double hi, const double *b, struct middle *at)
{
    enum { STEPS = 4 };
    const double sign = b[0] > 0 ? 1 : -1;
    int lowest = 1;
    UNROLL
    for (int i = 2; i < degree; i++)
        if (sign * b[i] < sign * b[lowest])
            lowest = i;
    double t = lo + (hi - lo) * lowest / degree;
    for (int i = 0; i < STEPS; i++) {
        const double v = sign * value(chain[0], degree, t);
        const double slope = sign * value(chain[1], degree - 1, t);
        const double bend = sign * value(chain[2], degree - 2, t);
        if (v < -2 * degree * roundoff * magnitude(chain[0], degree, t)) {
            const double reach = sqrt(slope * slope - 2 * v * bend);
            *at = (struct middle){t, t - (slope + reach) / bend,
                                  t - (slope - reach) / bend};
            if (!(at->left > lo && at->left < t))
                at->left = 0.5 * (lo + t);
            if (!(at->right > t && at->right < hi))
                at->right = 0.5 * (t + hi);
            return true;
        }
        if (!(bend > 0))
            return false;
        t -= slope / bend;
        if (!(t > lo && t < hi))
            return false;
    }
    return false;
}

// The roots where the Bernstein polygon b tells how many there are; -1: it does not.
UNROLLED int polygon_roots(double (*chain)[POLYNOMIAL_DEGREE_MAX + 1], int degree,
                           double lo, double hi, const double *b, int changes,
                           double *root)
{
    const double *c = chain[0], *d = chain[1];
    const bool rising = b[0] < 0;
    if (changes == 1)
        root[0] = root_between(c, d, degree, lo, hi, 0.5 * (lo + hi), rising, 0);
    if (changes != 2)
        return changes > 2 ? -1 : changes;
    struct middle m;
    if (!between_roots(chain, degree, lo, hi, b, &m))
        return -1;
    root[0] = root_between(c, d, degree, lo, m.t, m.left, rising, 0);
    root[1] = root_between(c, d, degree, m.t, hi, m.right, !rising, 0);
    return 2;
}

// The same of the stretch whole or, where its polygon goes to and fro, of its halves.
UNROLLED int certain_roots(double (*chain)[POLYNOMIAL_DEGREE_MAX + 1], int degree,
                           double lo, double hi, double *root, bool *first_rising)
{
    double b[BERNSTEIN_MAX + 1];
    int changes = bernstein(chain[0], degree, lo, hi, b);
    *first_rising = b[0] < 0;
    if (changes <= 2)
        return polygon_roots(chain, degree, lo, hi, b, changes, root);
    int n = 0;
    for (int half = 0; half < 2; half++) {
        const double middle = 0.5 * (lo + hi);
        const double from = half ? middle : lo, to = half ? hi : middle;
        changes = bernstein(chain[0], degree, from, to, b);
        const int found = polygon_roots(chain, degree, from, to, b, changes, root + n);
        if (found < 0)
            return -1;
        n += found;
    }
    return n;
}

// The extrema's candidates for a quadratic: both roots by the stable formula.
static int quadratic_stops(const double c[3], double lo, double hi, double root[2])
{
    const double b = 0.5 * c[1], d = b * b - c[2] * c[0];
    if (!(d > 0))
        return 0;
    const double q = -(b + copysign(sqrt(d), b));
    double t[2] = {q / c[2], c[0] / q};
    if (t[0] > t[1]) {
        const double swap = t[0];
        t[0] = t[1];
        t[1] = swap;
    }
    int n = 0;
    for (int i = 0; i < 2; i++)
        if (t[i] > lo && t[i] < hi)
            root[n++] = t[i];
    return n;
}

// Sign changes of c on (lo, hi), given those of its derivative d.
UNROLLED int refine(const double *c, const double *d, int degree, double lo, double hi,
                    const double *stop, int stops, double *root, bool *first_rising,
                    double enough)
{
    int n = 0;
    double a = lo;
    bool above = value(c, degree, lo) >= 0;
    *first_rising = !above;
    for (int i = 0; i <= stops; i++) {
        double b = i < stops ? stop[i] : hi;
        // Within its rounding error an extremum touches zero and does not cross it.
        double v = value(c, degree, b);
        double noise = 2 * degree * roundoff * magnitude(c, degree, b);
        bool above_b = i < stops && fabs(v) <= noise ? above : v >= 0;
        if (above_b != above)
            root[n++] = root_between(c, d, degree, a, b, 0.5 * (a + b), above_b, enough);
        above = above_b;
        a = b;
    }
    return n;
}

// How far a root may be off when the value is off by `error`. Near a double root that is as
// far as beyond its twin, where error = bend t^2 / 2 - slope t, so that the two overlap when
// they may be none. Near an m-fold root the first m - 1 derivatives vanish and the m-th bounds
// it: (m! error / |p^(m)|)^(1/m), rounded up to a power of two.
static double error_of_root(double (*chain)[POLYNOMIAL_DEGREE_MAX + 1], int degree,
                            double t, double error)
{
    const double slope = fabs(polynomial_value(chain[1], degree - 1, t));
    double dt = error / slope, factorial = 2;
    if (degree < 2)
        return dt;
    // A simple root: over dt the slope changes by little, and the first bound is the best.
    const double bend = fabs(polynomial_value(chain[2], degree - 2, t));
    if (4 * dt * bend < slope)
        return dt;
    dt = (slope + sqrt(slope * slope + 2 * bend * error)) / bend;
    for (int m = 3; m <= degree && m <= 4; m++) {
        factorial *= m;
        const double derivative = fabs(polynomial_value(chain[m], degree - m, t));
        if (!(derivative > 0))
            continue;
        const double q = factorial * error / derivative;
        int e;
        frexp(q, &e);
        dt = fmin(dt, 2 * ldexp(1, (int)ceil(e / (double)m)));
    }
    return dt;
}

double polynomial_root_error(const double *c, int degree, double t, double error)
{
    double slope = 0, half_bend = 0, v = 0;
    for (int i = degree; i >= 0; i--) {
        half_bend = half_bend * t + slope;
        slope = slope * t + v;
        v = v * t + c[i];
    }
    // slope x - half_bend x^2 = error: the first while the root is simple.
    const double simple = 2 * error / fabs(slope);
    const double twofold = 2 * sqrt(error / fabs(half_bend));
    return 2 * simple < twofold ? simple : 2 * twofold;
}

// Every root, between the extrema, which are the roots of the derivative, and so on.
static int isolated_roots(double (*chain)[POLYNOMIAL_DEGREE_MAX + 1], int degree,
                          double lo, double hi, double *root, bool *rising)
{
    double buffer[2][POLYNOMIAL_DEGREE_MAX + 1];
    int stops = 0, use = 0, first = degree - 1;
    *rising = false;
    if (degree > 2 && chain[degree - 2][2] != 0) {
        stops = quadratic_stops(chain[degree - 2], lo, hi, buffer[0]);
        first = degree - 3;
    }
    for (int k = first; k >= 0; k--) {
        const double enough = k > 0 ? 0x1p-30 * (hi - lo) : 0;
        const double *c = chain[k], *d = chain[k + 1], *from = buffer[use];
        double *to = k > 0 ? buffer[!use] : root;
        switch (degree - k) {
        case 3: stops = refine(c, d, 3, lo, hi, from, stops, to, rising, enough); break;
        case 4: stops = refine(c, d, 4, lo, hi, from, stops, to, rising, enough); break;
        default:
            stops = refine(c, d, degree - k, lo, hi, from, stops, to, rising, enough);
        }
        use = !use;
    }
    return stops;
}

typedef double polynomial_chain[POLYNOMIAL_DEGREE_MAX + 1][POLYNOMIAL_DEGREE_MAX + 1];

// The roots without their errors, given c[degree] != 0; fills the derivatives.
static int find_roots(const double *c, int degree, double lo, double hi,
                      polynomial_chain chain, double *root, bool *rising)
{
    memcpy(chain[0], c, (size_t)(degree + 1) * sizeof *c);
    for (int k = 1; k < degree; k++)
        for (int i = 0; i <= degree - k; i++)
            chain[k][i] = (i + 1) * chain[k - 1][i + 1];
    chain[degree][0] = chain[degree - 1][1];
    int count = -1;
    if (degree == 3)
        count = certain_roots(chain, 3, lo, hi, root, rising);
    else if (degree == 4)
        count = certain_roots(chain, 4, lo, hi, root, rising);
    else if (degree > 2 && degree <= BERNSTEIN_MAX)
        count = certain_roots(chain, degree, lo, hi, root, rising);
    return count < 0 ? isolated_roots(chain, degree, lo, hi, root, rising) : count;
}

int polynomial_roots(const double *coefficient, int degree, double lo, double hi,
                     double rounding, struct polynomial_root *out)
{
    polynomial_chain chain;
    double root[POLYNOMIAL_DEGREE_MAX + 1];
    bool rising;
    while (degree > 0 && coefficient[degree] == 0)
        degree--;
    if (degree < 1 || degree > POLYNOMIAL_DEGREE_MAX || !(lo < hi))
        return 0;
    const int count = find_roots(coefficient, degree, lo, hi, chain, root, &rising);
    for (int i = 0; i < count; i++) {
        const double t = root[i];
        const double error =
            (2 * degree + rounding) * roundoff * magnitude(coefficient, degree, t);
        out[i] =
            (struct polynomial_root){t, error_of_root(chain, degree, t, error), rising};
        rising = !rising;
    }
    return count;
}

int polynomial_sign_changes(const double *coefficient, int degree, double lo, double hi,
                            struct polynomial_root *out)
{
    polynomial_chain chain;
    double root[POLYNOMIAL_DEGREE_MAX + 1];
    bool rising;
    while (degree > 0 && coefficient[degree] == 0)
        degree--;
    if (degree > POLYNOMIAL_DEGREE_MAX || !(lo < hi))
        return 0;
    int found = degree, n = 0;
    if (degree > 2)
        found = find_roots(coefficient, degree, lo, hi, chain, root, &rising);
    else if (degree == 2)
        found =
            quadratic_roots(coefficient[2], 0.5 * coefficient[1], coefficient[0], root);
    else if (degree == 1)
        root[0] = -coefficient[0] / coefficient[1];
    if (degree <= 2)
        rising = (coefficient[degree] > 0) == (found == 1);
    for (int i = 0; i < found; i++, rising = !rising)
        if (degree > 2 || (root[i] > lo && root[i] < hi))
            out[n++] = (struct polynomial_root){.t = root[i], .rising = rising};
    return n;
}
