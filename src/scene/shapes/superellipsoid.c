// superellipsoid { <e, n> }: (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1
//
// As F(p) = g(g(|x|, |y|; 2/e), |z|; 2/n) - 1 with the p-norm g(a, b; p), F + 1 is
// homogeneous of degree one. For e, n <= 2 it is a norm, so F is convex on every line
// and its two roots are found without a miss; for pinched ones (e or n > 2) the line is
// sampled between the planes on which F has kinks.
#include <math.h>

#include "math/elementary.h"
#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"

struct superellipsoid {
    double p, q; // 2/e and 2/n
    double e, n;
};

static double norm2(double a, double b, double p)
{
    const double big = fmax(a, b), small = fmin(a, b);
    if (small == 0)
        return big;
    return big * det_pow(1 + det_pow(small / big, p), 1 / p);
}

struct sample {
    double f, slope; // F and its derivative along the line
};

static struct vec3 gradient(const struct superellipsoid *s, struct vec3 p, double *f)
{
    const double x = fabs(p.x), y = fabs(p.y), z = fabs(p.z);
    const double a = norm2(x, y, s->p), v = norm2(a, z, s->q);
    *f = v - 1;
    if (v == 0)
        return vec3(0, 0, 0);
    const double da = a > 0 ? det_pow(a / v, s->q - 1) : 0;
    const double dx = x > 0 ? da * det_pow(x / a, s->p - 1) : 0;
    const double dy = y > 0 ? da * det_pow(y / a, s->p - 1) : 0;
    const double dz = z > 0 ? det_pow(z / v, s->q - 1) : 0;
    return vec3(copysign(dx, p.x), copysign(dy, p.y), copysign(dz, p.z));
}

struct line {
    const struct superellipsoid *s;
    struct vec3 o, u; // unit direction, o nearest to the centre
    double shift, length;
};

static struct sample at(const struct line *l, double t)
{
    struct sample r;
    const struct vec3 g = gradient(l->s, vec3_mad(l->o, t, l->u), &r.f);
    r.slope = vec3_dot(g, l->u);
    return r;
}

// The stretch of the line within the cube that holds the surface.
static bool in_cube(const struct line *l, double *a, double *b)
{
    const double edge = 1 + 0x1p-20;
    *a = -2 * edge;
    *b = 2 * edge;
    for (int i = 0; i < 3; i++) {
        const double o = vec3_axis(l->o, i), u = vec3_axis(l->u, i);
        if (u == 0) {
            if (fabs(o) > edge)
                return false;
            continue;
        }
        const double t = (-copysign(edge, u) - o) / u, t2 = (copysign(edge, u) - o) / u;
        *a = fmax(*a, t);
        *b = fmin(*b, t2);
    }
    return *a < *b;
}

static void add(const struct line *l, double t, enum crossing c, struct boundary_list *out)
{
    const double slope = fabs(at(l, t).slope);
    // F is known to a few dozen roundings of numbers near one.
    double dt = GAMMA(64) / fmax(slope, 0x1p-26);
    dt += GAMMA(4) * (fabs(l->shift) + fabs(t));
    boundary_list_add(out, (t + l->shift) / l->length, dt / l->length, c, 0);
}

// The root between outside (F > 0) and inside, Newton kept in the bracket.
static double root_between(const struct line *l, double outside, double inside)
{
    double t = outside;
    for (int i = 0; i < 100; i++) {
        const struct sample v = at(l, t);
        if (v.f > 0)
            outside = t;
        else
            inside = t;
        const double lo = fmin(outside, inside), hi = fmax(outside, inside);
        double next = t - v.f / v.slope;
        if (!(next > lo && next < hi))
            next = 0.5 * (lo + hi);
        if (next == t || next <= lo || next >= hi || fabs(next - t) < GAMMA(2))
            return next;
        t = next;
    }
    return t;
}

// A point inside on a convex F, or false: the tangents at both ends bound it from below.
static bool find_inside(const struct line *l, double a, double b, double *inside)
{
    struct sample fa = at(l, a), fb = at(l, b);
    for (int i = 0; i < 100; i++) {
        if (fa.slope >= 0 || fb.slope <= 0)
            return false;
        const double t =
            (fb.f - fa.f + fa.slope * a - fb.slope * b) / (fa.slope - fb.slope);
        if (!(t > a && t < b) || fa.f + fa.slope * (t - a) > 0)
            return false;
        const struct sample f = at(l, t);
        if (f.f < 0) {
            *inside = t;
            return true;
        }
        if (f.slope < 0) {
            a = t;
            fa = f;
        } else {
            b = t;
            fb = f;
        }
    }
    return false;
}

static void convex(const struct line *l, double a, double b, struct boundary_list *out)
{
    double m;
    if (!find_inside(l, a, b, &m))
        return;
    add(l, root_between(l, a, m), CROSS_ENTER, out);
    add(l, root_between(l, b, m), CROSS_EXIT, out);
}

// Where the line meets the planes x = 0, x = y, x = -y and so on, sorted, ends included.
enum { STOPS = 11, PIECES = 16 };

static int kinks(const struct line *l, double a, double b, double stop[STOPS])
{
    static const struct vec3 plane[9] = {{1, 0, 0},  {0, 1, 0}, {0, 0, 1},
                                         {1, 1, 0},  {1, -1, 0}, {1, 0, 1},
                                         {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
    int n = 0;
    stop[n++] = a;
    for (int i = 0; i < 9; i++) {
        const double d = vec3_dot(plane[i], l->u), t = -vec3_dot(plane[i], l->o) / d;
        if (d != 0 && t > a && t < b)
            stop[n++] = t;
    }
    stop[n++] = b;
    for (int i = 1; i < n; i++)
        for (int j = i; j > 0 && stop[j - 1] > stop[j]; j--) {
            const double swap = stop[j];
            stop[j] = stop[j - 1];
            stop[j - 1] = swap;
        }
    return n;
}

static void sampled(const struct line *l, double a, double b, struct boundary_list *out)
{
    double stop[STOPS];
    const int n = kinks(l, a, b, stop);
    bool in = false;
    double last = a;
    for (int i = 1; i < n; i++)
        for (int k = 1; k <= PIECES; k++) {
            const double t = stop[i - 1] + (stop[i] - stop[i - 1]) * k / PIECES;
            const bool now = at(l, t).f < 0 && !(i == n - 1 && k == PIECES);
            if (now != in) {
                const double root = now ? root_between(l, last, t) : root_between(l, t, last);
                add(l, root, now ? CROSS_ENTER : CROSS_EXIT, out);
            }
            in = now;
            last = t;
        }
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    struct line l = {.s = shape, .length = vec3_length(ray->d)};
    l.u = vec3_scale(1 / l.length, ray->d);
    l.shift = -vec3_dot(ray->o, l.u);
    l.o = vec3_mad(ray->o, l.shift, l.u);
    double a, b;
    if (!in_cube(&l, &a, &b))
        return;
    if (l.s->p >= 1 && l.s->q >= 1)
        convex(&l, a, b, out);
    else
        sampled(&l, a, b, out);
}

static bool build(void *shape, struct args *args)
{
    struct superellipsoid *s = shape;
    struct vec2 e;
    if (!args_vec2(args, "exponents", &e))
        return false;
    if (!(e.u > 0 && e.v > 0)) {
        args_reject(args, "both exponents must be positive");
        return false;
    }
    s->e = e.u;
    s->n = e.v;
    s->p = 2 / e.u;
    s->q = 2 / e.v;
    return true;
}

static struct aabb bounds(const void *shape)
{
    (void)shape;
    return (struct aabb){vec3(-1, -1, -1), vec3(1, 1, 1)};
}

static bool inside(const void *shape, struct vec3 p)
{
    double f;
    gradient(shape, p, &f);
    return f <= 0;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    double f;
    out->p = p;
    out->ng = out->ns = vec3_normalize(gradient(shape, p, &f));
    out->uv = (struct vec2){p.x, p.y};
}

static void print(const void *shape, FILE *out)
{
    const struct superellipsoid *s = shape;
    fputs("superellipsoid { <", out);
    shape_print_number(out, s->e);
    fputs(", ", out);
    shape_print_number(out, s->n);
    fputs(">", out);
}

const struct shape_ops superellipsoid_ops = {
    .keyword = "superellipsoid",
    .size = sizeof(struct superellipsoid),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
