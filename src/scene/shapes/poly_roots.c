// The sign changes of a polynomial of a high order along a line.
//
// Expanded about one point of the line, terms of x^35 grow to 1e17 where they cancel to 1, and
// roots are lost. So each stretch is expanded about its own middle, in units of its half length,
// and looked at by its Bernstein coefficients, which are as wrong as the polynomial's terms are
// large there at most: no change of their signs, and there is no root; one, and there is one
// (Farouki & Rajan 1987); more, or a sign that is not clear of rounding: its halves. Where
// halves would say no more, the signs on both sides decide; what they agree on is a touch.
#include <math.h>

#include "math/gamma.h"
#include "scene/shapes/poly.h"

enum { LOOKS_MAX = 4000, POLISH_STEPS = 3, STACK = 128 };

struct stretch {
    double a, b;
    double coefficient[POLYNOMIAL_DEGREE_MAX + 1]; // of Bernstein
    double noise;                                  // of them; 0: they are not known
    double size;                                   // of the terms within, at most
    int degree;
};

struct search {
    const struct poly *s;
    struct vec3 o, u;
    double reach; // lengths of less than a rounding of this are nothing
    struct polynomial_root *root;
    int count, looks;
    int sign;    // of the last stretch that has one; 0: none yet
    bool doubt;  // about what lies behind it, from
    double from; // here
};

static struct vec3 point(const struct search *x, double t)
{
    return vec3_mad(x->o, t, x->u);
}

static double size_near(const struct search *x, struct vec3 p, double half)
{
    return poly_magnitude(x->s, vec3(fabs(p.x) + half * fabs(x->u.x),
                                     fabs(p.y) + half * fabs(x->u.y),
                                     fabs(p.z) + half * fabs(x->u.z)));
}

static double away(double p, double by) { return fmax(fabs(p) - fabs(by), 0); }

// Multiplies by s = 2x - 1 in the Bernstein basis of degree n, which becomes n + 1.
static void times_s(double *b, int n)
{
    const double per = 1. / (n + 1);
    b[n + 1] = b[n];
    for (int i = n; i > 0; i--)
        b[i] = (i * b[i - 1] - (n + 1 - i) * b[i]) * per;
    b[0] = -b[0];
}

// About the middle, as powers of s from -1 to 1, then by Horner's scheme in the Bernstein basis,
// where a constant is as much in each coefficient and no coefficient of s^k is above 1.
static void expand(const struct search *x, struct stretch *r)
{
    const double m = 0.5 * (r->a + r->b), half = 0.5 * (r->b - r->a);
    const struct vec3 p = point(x, m);
    struct line_poly q;
    double *b = r->coefficient;
    poly_along(x->s, p, vec3_scale(half, x->u), &q);
    r->degree = q.degree;
    b[0] = q.c[q.degree];
    for (int k = q.degree - 1; k >= 0; k--) {
        const int n = q.degree - 1 - k;
        times_s(b, n);
        for (int i = 0; i <= n + 1; i++)
            b[i] += q.c[k];
    }
    r->size = size_near(x, p, half);
    r->noise = 12 * x->s->order * ROUNDOFF * r->size;
}

// The changes of sign; -1: some have none.
static int changes_of(const struct stretch *r)
{
    int changes = 0;
    for (int i = 0; i <= r->degree; i++) {
        const double b = r->coefficient[i];
        if (!(fabs(b) > r->noise))
            return -1;
        changes += i > 0 && (b > 0) != (r->coefficient[i - 1] > 0);
    }
    return changes;
}

// Whether halves would see no more: nothing is far above rounding, and the terms are nowhere much smaller.
static bool is_murky(const struct search *x, const struct stretch *r)
{
    const double m = 0.5 * (r->a + r->b), half = 0.5 * (r->b - r->a);
    const struct vec3 p = point(x, m);
    if (half <= 2 * ROUNDOFF * (fabs(r->a) + fabs(r->b) + x->reach))
        return true;
    for (int i = 0; i <= r->degree; i++)
        if (fabs(r->coefficient[i]) > 4 * r->noise)
            return false;
    const struct vec3 least = vec3(away(p.x, half * x->u.x), away(p.y, half * x->u.y),
                                   away(p.z, half * x->u.z));
    return !(poly_magnitude(x->s, least) < 0.25 * r->size);
}

static void add_root(struct search *x, double t, double dt, bool rising)
{
    if (x->count < POLYNOMIAL_DEGREE_MAX)
        x->root[x->count++] = (struct polynomial_root){t, dt, rising};
}

// The sign from t on.
static void tell(struct search *x, double t, int sign)
{
    if (x->sign && x->sign != sign) {
        const double from = x->doubt ? x->from : t;
        add_root(x, 0.5 * (from + t), 0.5 * (t - from), sign > 0);
    }
    x->sign = sign;
    x->doubt = false;
}

// The one root of a stretch, expanded about where it is thought to be until it stays there.
static void add_single(struct search *x, const struct stretch *r)
{
    const double m = 0.5 * (r->a + r->b), half = 0.5 * (r->b - r->a);
    const bool rising = r->coefficient[0] < 0;
    struct line_poly q;
    poly_along(x->s, point(x, m), vec3_scale(half, x->u), &q);
    double t = m + half * polynomial_root_between(q.c, q.degree, -1, 1, rising), dt = 0;
    for (int i = 0; i < POLISH_STEPS; i++) {
        const struct vec3 p = point(x, t);
        poly_along(x->s, p, x->u, &q);
        const double lost = 4 * x->s->order * ROUNDOFF * size_near(x, p, 0);
        const double by = q.degree > 0 ? -q.c[0] / q.c[1] : 0;
        dt = polynomial_root_error(q.c, q.degree, 0, lost);
        if (!(fabs(by) > 0.25 * dt) || !(t + by >= r->a && t + by <= r->b))
            break;
        t += by;
    }
    add_root(x, t, fmin(dt, r->b - r->a), rising);
    x->sign = rising ? 1 : -1;
}

// By de Casteljau's scheme.
static void halve(const struct stretch *r, struct stretch half[2])
{
    const int n = r->degree;
    half[1] = half[0] = *r;
    half[0].b = half[1].a = 0.5 * (r->a + r->b);
    double *left = half[0].coefficient, *right = half[1].coefficient;
    for (int i = 1; i <= n; i++) {
        for (int k = 0; k <= n - i; k++)
            right[k] = 0.5 * (right[k] + right[k + 1]);
        left[i] = right[0];
    }
    half[0].noise = half[1].noise = r->noise * (1 + 0x1p-10);
}

// Where to part a stretch that is expanded anew: at zero, then at the mean of the orders of
// magnitude (a line nearly along an axis may have roots at 1 and at 1e100), then in the middle.
static double part(const struct search *x, const struct stretch *r)
{
    const double a = fabs(r->a), b = fabs(r->b), most = fmax(a, b);
    const double least = fmax(fmin(a, b), fmax(x->reach, 0x1p-60 * most));
    if (most <= 16 * least)
        return 0.5 * (r->a + r->b);
    if (r->a < 0 && r->b > 0)
        return 0;
    return copysign(sqrt(least) * sqrt(most), b > a ? r->b : r->a);
}

// What is known of a stretch; false: it is halved. full: it cannot be.
static bool look(struct search *x, struct stretch *r, bool full, struct stretch half[2])
{
    if (r->noise == 0)
        expand(x, r);
    const int changes = changes_of(r);
    const double *b = r->coefficient;
    if (changes == 0 || changes == 1) {
        tell(x, r->a, b[0] > 0 ? 1 : -1);
        if (changes)
            add_single(x, r);
        return true;
    }
    if (++x->looks > LOOKS_MAX || full || (changes < 0 && is_murky(x, r))) {
        x->from = x->doubt ? x->from : r->a;
        x->doubt = true;
        return true;
    }
    halve(r, half);
    if (changes < 0) {
        half[0].b = half[1].a = part(x, r);
        half[0].noise = half[1].noise = 0;
    }
    return false;
}

int poly_line_roots(const struct poly *s, struct vec3 o, struct vec3 u, double lo,
                    double hi, struct polynomial_root *root)
{
    struct search x = {.s = s, .o = o, .u = u, .reach = vec3_max_abs(o), .root = root};
    struct stretch wait[STACK];
    int waiting = 1;
    wait[0] = (struct stretch){.a = lo, .b = hi};
    while (waiting) {
        struct stretch r = wait[--waiting], half[2];
        if (look(&x, &r, waiting + 2 > STACK, half))
            continue;
        wait[waiting++] = half[1];
        wait[waiting++] = half[0];
    }
    return x.count;
}
