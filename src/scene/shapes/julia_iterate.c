// The iterations of julia_fractal, their escape and its gradient.
#include <float.h>
#include <math.h>

#include "math/elementary.h"
#include "math/quick.h"
#include "scene/shapes/julia.h"

// ---- complex numbers ----------------------------------------------------

static struct complex cx(double re, double im) { return (struct complex){re, im}; }
static struct complex c_add(struct complex a, struct complex b)
{
    return cx(a.re + b.re, a.im + b.im);
}
static struct complex c_scale(double k, struct complex a)
{
    return cx(k * a.re, k * a.im);
}
static struct complex c_mul(struct complex a, struct complex b)
{
    return cx(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}
static double c_norm(struct complex a) { return a.re * a.re + a.im * a.im; }
static struct complex c_inverse(struct complex a)
{
    const double n = c_norm(a);
    return n > 0 ? cx(a.re / n, -a.im / n) : cx(0, 0);
}
static struct complex c_div(struct complex a, struct complex b)
{
    return c_mul(a, c_inverse(b));
}
// i times a
static struct complex c_turn(struct complex a) { return cx(-a.im, a.re); }

static struct complex c_sqrt(struct complex a)
{
    const double m = sqrt(c_norm(a));
    if (m == 0)
        return cx(0, 0);
    const double big = sqrt(0.5 * (m + fabs(a.re))), small = 0.5 * a.im / big;
    return a.re >= 0 ? cx(big, small) : cx(fabs(small), copysign(big, a.im));
}
// Iterates within the ball have small arguments; beyond it any may come.
static double exp_of(double x) { return x > -700 && x < 700 ? quick_exp(x) : det_exp(x); }

static void sincos_of(double x, double *s, double *c)
{
    if (x > -1e5 && x < 1e5) {
        quick_sincos(x, s, c);
    } else {
        *s = det_sin(x);
        *c = det_cos(x);
    }
}

static struct complex c_exp(struct complex a)
{
    double s, c;
    const double r = exp_of(a.re);
    sincos_of(a.im, &s, &c);
    return cx(r * c, r * s);
}
static struct complex c_ln(struct complex a)
{
    const double n = c_norm(a);
    const bool plain = n > DBL_MIN && n <= DBL_MAX;
    return n > 0 ? cx(0.5 * (plain ? quick_log(n) : det_log(n)), det_atan2(a.im, a.re))
                 : cx(0, 0);
}
static void c_sincos(struct complex a, struct complex *sine, struct complex *cosine)
{
    double s, c;
    const double e = exp_of(a.im), ch = 0.5 * (e + 1 / e), sh = 0.5 * (e - 1 / e);
    sincos_of(a.re, &s, &c);
    *sine = cx(s * ch, c * sh);
    *cosine = cx(c * ch, -s * sh);
}
static void c_sinhcosh(struct complex a, struct complex *sine, struct complex *cosine)
{
    double s, c;
    const double e = exp_of(a.re), ch = 0.5 * (e + 1 / e), sh = 0.5 * (e - 1 / e);
    sincos_of(a.im, &s, &c);
    *sine = cx(sh * c, ch * s);
    *cosine = cx(ch * c, sh * s);
}

// ln(z + root), whose derivative is 1/root.
static struct complex log_of_sum(struct complex z, struct complex root, struct complex *d)
{
    *d = c_inverse(root);
    return c_ln(c_add(z, root));
}

static struct complex power(struct complex z, struct complex c, struct complex *d)
{
    if (c_norm(z) == 0)
        return *d = cx(0, 0);
    const struct complex f = c_exp(c_mul(c, c_ln(z)));
    *d = c_mul(c, c_div(f, z));
    return f;
}

// f(z) and its derivative; principal branches.
static struct complex apply(const struct julia *j, struct complex z, struct complex *d)
{
    const struct complex one = {1, 0}, z2 = c_mul(z, z);
    struct complex f, g;
    switch (j->function) {
    case JULIA_SQR: *d = c_scale(2, z); return z2;
    case JULIA_CUBE: *d = c_scale(3, z2); return c_mul(z2, z);
    case JULIA_EXP: return *d = c_exp(z);
    case JULIA_RECIPROCAL:
        f = c_inverse(z);
        *d = c_scale(-1, c_mul(f, f));
        return f;
    case JULIA_SIN: c_sincos(z, &f, d); return f;
    case JULIA_COS:
        c_sincos(z, &g, &f);
        *d = c_scale(-1, g);
        return f;
    case JULIA_SINH: c_sinhcosh(z, &f, d); return f;
    case JULIA_COSH: c_sinhcosh(z, d, &f); return f;
    case JULIA_TAN:
        c_sincos(z, &f, &g);
        g = c_inverse(g);
        *d = c_mul(g, g);
        return c_mul(f, g);
    case JULIA_TANH:
        c_sinhcosh(z, &f, &g);
        g = c_inverse(g);
        *d = c_mul(g, g);
        return c_mul(f, g);
    case JULIA_ASINH: return log_of_sum(z, c_sqrt(c_add(z2, one)), d);
    case JULIA_ACOSH: return log_of_sum(z, c_sqrt(c_add(z2, cx(-1, 0))), d);
    case JULIA_ASIN: // -i ln(iz + sqrt(1 - z^2))
        g = c_sqrt(c_add(one, c_scale(-1, z2)));
        *d = c_inverse(g);
        return c_scale(-1, c_turn(c_ln(c_add(c_turn(z), g))));
    case JULIA_ACOS: // -i ln(z + sqrt(z^2 - 1))
        f = log_of_sum(z, c_sqrt(c_add(z2, cx(-1, 0))), d);
        *d = c_scale(-1, c_turn(*d));
        return c_scale(-1, c_turn(f));
    case JULIA_ATANH:
        *d = c_inverse(c_add(one, c_scale(-1, z2)));
        return c_scale(0.5, c_ln(c_div(c_add(one, z), c_add(one, c_scale(-1, z)))));
    case JULIA_ATAN: // (i/2) ln((1 - iz)/(1 + iz))
        *d = c_inverse(c_add(one, z2));
        g = c_turn(z);
        f = c_ln(c_div(c_add(one, c_scale(-1, g)), c_add(one, g)));
        return c_scale(0.5, c_turn(f));
    case JULIA_LN: *d = c_inverse(z); return c_ln(z);
    case JULIA_PWR: return power(z, j->power, d);
    }
    return *d = cx(0, 0);
}

// ---- hypercomplex -------------------------------------------------------

// A hypercomplex number x, y, z, w as the pair (x - w) + i (y + z), (x + w) + i (y - z).
struct pair {
    struct complex a, b;
};

static struct pair pair_of(double x, double y, double z, double w)
{
    return (struct pair){{x - w, y + z}, {x + w, y - z}};
}

static double pair_norm(const struct pair *h)
{
    return 0.5 * (c_norm(h->a) + c_norm(h->b));
}

// Half the derivative of |h|^2 when the start moves by s: h moves by slope * s.
static double growth(const struct pair *h, const struct pair *slope, struct pair s)
{
    const struct complex da = c_mul(slope->a, s.a), db = c_mul(slope->b, s.b);
    return 0.5 * (h->a.re * da.re + h->a.im * da.im + h->b.re * db.re + h->b.im * db.im);
}

static void pair_step(const struct julia *j, struct pair *h, struct pair *slope)
{
    struct complex da, db;
    // Inlined squares: most julia_fractals are of them.
    if (j->function == JULIA_SQR) {
        const double ca = j->c[0] - j->c[3], cb = j->c[0] + j->c[3];
        slope->a = c_scale(2, c_mul(slope->a, h->a));
        slope->b = c_scale(2, c_mul(slope->b, h->b));
        h->a = c_add(c_mul(h->a, h->a), cx(ca, j->c[1] + j->c[2]));
        h->b = c_add(c_mul(h->b, h->b), cx(cb, j->c[1] - j->c[2]));
        return;
    }
    const struct pair c = pair_of(j->c[0], j->c[1], j->c[2], j->c[3]);
    h->a = c_add(apply(j, h->a, &da), c.a);
    h->b = c_add(apply(j, h->b, &db), c.b);
    slope->a = c_mul(slope->a, da);
    slope->b = c_mul(slope->b, db);
}

static double w_at(const struct julia *j, struct vec3 p)
{
    return j->start[3] + j->start[0] * p.x + j->start[1] * p.y + j->start[2] * p.z;
}

// How the start moves with x, y or z.
static struct pair pair_axis(const struct julia *j, int axis)
{
    return pair_of(axis == 0, axis == 1, axis == 2, j->start[axis]);
}

static int hyper_escape(const struct julia *j, struct vec3 p, struct vec3 d, double *step,
                        double *length)
{
    struct pair h = pair_of(p.x, p.y, p.z, w_at(j, p)), slope = {{1, 0}, {1, 0}};
    for (int k = 0; k < j->iterations; k++) {
        const double norm = *length = pair_norm(&h);
        if (!(norm <= j->escape)) {
            const double w = vec3_dot(vec3(j->start[0], j->start[1], j->start[2]), d);
            const double fall = -2 * growth(&h, &slope, pair_of(d.x, d.y, d.z, w));
            const double delta = 1 / j->precision;
            const bool usable =
                fall > 2e-8 && delta * fall < norm && norm < 30 * delta * fall;
            if (step)
                *step = usable ? norm / fall : 0;
            return k;
        }
        pair_step(j, &h, &slope);
    }
    return j->iterations;
}

static struct vec3 hyper_gradient(const struct julia *j, struct vec3 p, int n)
{
    struct pair h = pair_of(p.x, p.y, p.z, w_at(j, p)), slope = {{1, 0}, {1, 0}};
    for (int k = 0; k < n; k++)
        pair_step(j, &h, &slope);
    return vec3(growth(&h, &slope, pair_axis(j, 0)), growth(&h, &slope, pair_axis(j, 1)),
                growth(&h, &slope, pair_axis(j, 2)));
}

// ---- quaternions --------------------------------------------------------

static void quaternion_step(const struct julia *j, double h[4])
{
    const double x = h[0], q = h[1] * h[1] + h[2] * h[2] + h[3] * h[3];
    const bool cube = j->function == JULIA_CUBE;
    const double k = cube ? 3 * x * x - q : 2 * x;
    h[0] = (cube ? x * (x * x - 3 * q) : x * x - q) + j->c[0];
    h[1] = k * h[1] + j->c[1];
    h[2] = k * h[2] + j->c[2];
    h[3] = k * h[3] + j->c[3];
}

// The derivative d of h, moved along by one step (before h).
static void quaternion_slope(const struct julia *j, const double h[4], double d[4])
{
    const double x = h[0], q = h[1] * h[1] + h[2] * h[2] + h[3] * h[3], dx = d[0];
    const double half_dq = h[1] * d[1] + h[2] * d[2] + h[3] * d[3];
    const bool cube = j->function == JULIA_CUBE;
    const double k = cube ? 3 * x * x - q : 2 * x;
    const double dk = cube ? 6 * x * dx - 2 * half_dq : 2 * dx;
    d[0] = cube ? 3 * (x * x - q) * dx - 6 * x * half_dq : 2 * x * dx - 2 * half_dq;
    for (int i = 1; i < 4; i++)
        d[i] = dk * h[i] + k * d[i];
}

static double norm4(const double h[4])
{
    return h[0] * h[0] + h[1] * h[1] + h[2] * h[2] + h[3] * h[3];
}

// The same for squares, which most julia_fractals are of.
static int square_escape(const struct julia *j, struct vec3 p, double *step,
                         double *length)
{
    const double c0 = j->c[0], c1 = j->c[1], c2 = j->c[2], c3 = j->c[3];
    double x = p.x, y = p.y, z = p.z, w = w_at(j, p), product = 1, scale = 1;
    for (int k = 0; k < j->iterations; k++) {
        const double x2 = x * x, q = y * y + z * z + w * w, norm = *length = x2 + q;
        scale *= 2;
        if (!(norm <= j->escape)) {
            if (step)
                *step = quick_log(norm) / (scale * sqrt(product));
            return k;
        }
        product *= norm;
        const double twice = 2 * x;
        x = x2 - q + c0;
        y = twice * y + c1;
        z = twice * z + c2;
        w = twice * w + c3;
    }
    return j->iterations;
}

static int quaternion_escape(const struct julia *j, struct vec3 p, double *step,
                             double *length)
{
    double h[4] = {p.x, p.y, p.z, w_at(j, p)}, product = 1;
    double power = j->function == JULIA_CUBE ? 3 : 2, scale = 1;
    for (int k = 0; k < j->iterations; k++) {
        const double norm = *length = norm4(h);
        scale *= power;
        if (!(norm <= j->escape)) {
            if (step)
                *step = quick_log(norm) / (scale * sqrt(product));
            return k;
        }
        product *= norm;
        quaternion_step(j, h);
    }
    return j->iterations;
}

static struct vec3 quaternion_gradient(const struct julia *j, struct vec3 p, int n)
{
    double h[4] = {p.x, p.y, p.z, w_at(j, p)}, d[3][4] = {{0}}, g[3];
    for (int i = 0; i < 3; i++) {
        d[i][i] = 1;
        d[i][3] = j->start[i];
    }
    for (int k = 0; k < n; k++) {
        for (int i = 0; i < 3; i++)
            quaternion_slope(j, h, d[i]);
        quaternion_step(j, h);
    }
    for (int i = 0; i < 3; i++)
        g[i] = h[0] * d[i][0] + h[1] * d[i][1] + h[2] * d[i][2] + h[3] * d[i][3];
    return vec3(g[0], g[1], g[2]);
}

int julia_escape(const struct julia *j, struct vec3 p, struct vec3 d, double *step,
                 double *norm)
{
    if (j->hypercomplex)
        return hyper_escape(j, p, d, step, norm);
    return j->function == JULIA_SQR ? square_escape(j, p, step, norm)
                                    : quaternion_escape(j, p, step, norm);
}

struct vec3 julia_gradient(const struct julia *j, struct vec3 p, int k)
{
    return j->hypercomplex ? hyper_gradient(j, p, k) : quaternion_gradient(j, p, k);
}

// What arguments and logarithms are made of is not among the functions of math/quick_lanes.h
// that have the bits of their one-point forms.
bool julia_has_lanes(const struct julia *j)
{
    switch (j->function) {
    case JULIA_SQR:
    case JULIA_CUBE:
    case JULIA_EXP:
    case JULIA_RECIPROCAL:
    case JULIA_SIN:
    case JULIA_SINH:
    case JULIA_COS:
    case JULIA_COSH:
    case JULIA_TAN:
    case JULIA_TANH: return true;
    default: return false;
    }
}
