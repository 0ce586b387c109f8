// superellipsoid { <e, n> }: (|x|^(2/e) + |y|^(2/e))^(e/n) + |z|^(2/n) = 1
//
// As F(p) = g(g(|x|, |y|; 2/e), |z|; 2/n) - 1 with the p-norm g(a, b; p), F + 1 is
// homogeneous of degree one. For e, n <= 2 it is a norm, so F is convex on every line
// and its two roots are found without a miss; for pinched ones (e or n > 2) the line is
// sampled between the planes on which F has kinks.
#include <math.h>

#include "math/gamma.h"
#include "math/quick.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/superellipsoid_walk.h"

static double power(double x, const struct exponent *e)
{
    if (e->squares < 0)
        return quick_pow(x, e->p);
    for (int i = 0; i < e->squares; i++)
        x *= x;
    return x;
}

static double root(double x, const struct exponent *e)
{
    if (e->squares < 0)
        return quick_pow(x, 1 / e->p);
    for (int i = 0; i < e->squares; i++)
        x = sqrt(x);
    return x;
}

// The p-norm (a^p + b^p)^(1/p) of a, b >= 0 and its derivatives. With w = (small/big)^p and
// c = (1 + w)^(1/p) it is c big, its derivatives c/(1 + w) and that times w big/small.
static double norm2(double a, double b, const struct exponent *p, double *da, double *db)
{
    const bool turned = a < b;
    const double big = turned ? b : a, small = turned ? a : b;
    double c = 1, by_big = 1, by_small = 0;
    if (small > 0x1p-1000 * big) {
        const double q = small / big, w = power(q, p), sum = 1 + w;
        c = sum > 1 ? root(sum, p) : 1;
        by_big = c / sum;
        by_small = by_big * w / q;
    }
    *da = turned ? by_small : by_big;
    *db = turned ? by_big : by_small;
    return c * big;
}

struct vec3 superellipsoid_gradient(const struct superellipsoid *s, struct vec3 p,
                                    double *f)
{
    double dx, dy, da, dz;
    const double a = norm2(fabs(p.x), fabs(p.y), &s->p, &dx, &dy);
    *f = norm2(a, fabs(p.z), &s->q, &da, &dz) - 1;
    return vec3(copysign(da * dx, p.x), copysign(da * dy, p.y), copysign(dz, p.z));
}

struct superellipsoid_sample superellipsoid_at(const struct superellipsoid_line *l,
                                               double t)
{
    struct superellipsoid_sample r;
    const struct vec3 g = superellipsoid_gradient(l->s, vec3_mad(l->o, t, l->u), &r.f);
    r.slope = vec3_dot(g, l->u);
    return r;
}

bool superellipsoid_in_cube(const struct superellipsoid_line *l, double *a, double *b)
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

static struct boundary crossing_at(const struct superellipsoid_line *l, double t,
                                   double slope, enum crossing c)
{
    double dt = 2 * l->noise / fmax(fabs(slope), 0x1p-26);
    dt += GAMMA(4) * (fabs(l->shift) + fabs(t));
    return (struct boundary){.t = (t + l->shift) / l->length,
                             .dt = dt / l->length,
                             .crossing = (uint8_t)c,
                             .drawn = 1};
}

static void add(const struct superellipsoid_line *l, double t, double slope,
                enum crossing c, struct boundary_list *out)
{
    *boundary_list_add(out, 0, 0, c, 0) = crossing_at(l, t, slope, c);
}

// The root between outside (F > 0) and inside, Newton from t on, kept in the bracket; *slope is
// F's near it.
static double root_between(const struct superellipsoid_line *l, double outside,
                           double inside, double t, double *slope)
{
    for (int i = 0; i < 100; i++) {
        const struct superellipsoid_sample v = superellipsoid_at(l, t);
        *slope = v.slope;
        if (v.f > 0)
            outside = t;
        else
            inside = t;
        const double lo = fmin(outside, inside), hi = fmax(outside, inside);
        double next = t - v.f / v.slope;
        if (next == t) // an end of the bracket by then, whose other end may be far
            return t;
        if (!(next > lo && next < hi))
            next = 0.5 * (lo + hi);
        if (next <= lo || next >= hi || fabs(next - t) < GAMMA(2))
            return next;
        t = next;
    }
    return t;
}

// The root of a convex F next to the outside point t, looking towards `to`, by Newton's
// method, which comes from outside and does not pass it; false: there is none. *slope is
// F's there.
static bool approach(const struct superellipsoid_line *l, double t, double to,
                     double *root, double *slope)
{
    const double way = to > t ? 1 : -1, noise = l->noise;
    for (int i = 0; i < 100; i++) {
        const struct superellipsoid_sample v = superellipsoid_at(l, t);
        *slope = v.slope;
        *root = t;
        if (v.f <= noise)
            return true;
        const double next = t - v.f / v.slope;
        if (!(v.slope * way < 0) || !((to - next) * way >= 0))
            return false;
        if (next == t)
            return true;
        t = next;
    }
    return true; // a graze, where steps only halve
}

static void convex(const struct superellipsoid_line *l, double a, double b,
                   struct boundary_list *out)
{
    double first, last, slope_a, slope_b;
    if (!approach(l, a, b, &first, &slope_a))
        return;
    if (!approach(l, b, first, &last, &slope_b))
        last = first;
    add(l, first, slope_a, CROSS_ENTER, out);
    add(l, last, slope_b, CROSS_EXIT, out);
}

bool superellipsoid_is_convex(const struct superellipsoid *s)
{
    return s->p.p >= 1 && s->q.p >= 1;
}

void superellipsoid_add_ends(const struct superellipsoid_ends *e, int lane,
                             struct boundary_list *out)
{
    for (int k = 0; k < 2; k++)
        *boundary_list_add(out, 0, 0, CROSS_TOUCH, 0) =
            (struct boundary){.t = e->t[k][lane],
                              .dt = e->dt[k][lane],
                              .crossing = k ? CROSS_EXIT : CROSS_ENTER,
                              .drawn = 1};
}

struct superellipsoid_line superellipsoid_line(const struct superellipsoid *s,
                                               const struct ray *ray)
{
    struct superellipsoid_line l = {.s = s, .length = vec3_length(ray->d)};
    l.u = vec3_scale(1 / l.length, ray->d);
    // w^p is known to 3 |log w^p| + 4 roundings, and w^p |log w^p| < 1.
    l.noise = GAMMA(64);
    l.shift = -vec3_dot(ray->o, l.u);
    l.o = vec3_mad(ray->o, l.shift, l.u);
    return l;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct ray whole = {ray->o, ray->d, -HUGE_VAL, HUGE_VAL};
    struct superellipsoid_walk w;
    struct superellipsoid_bracket x;
    if (superellipsoid_is_convex(shape)) {
        const struct superellipsoid_line l = superellipsoid_line(shape, ray);
        double a, b;
        if (superellipsoid_in_cube(&l, &a, &b))
            convex(&l, a, b, out);
        return;
    }
    if (!superellipsoid_walk_begin(&w, NULL, shape, &whole))
        return;
    while (superellipsoid_walk_next(&w, &x)) {
        const double from = x.enters ? x.a.t : x.b.t, to = x.enters ? x.b.t : x.a.t;
        double slope;
        const double t =
            root_between(&w.s.line, from, to, superellipsoid_first_guess(&x), &slope);
        add(&w.s.line, t, slope, x.enters ? CROSS_ENTER : CROSS_EXIT, out);
    }
}

// The next bracket of a lane that is not behind the ray; false: there is none.
static bool next_ahead(struct superellipsoid_walk *w, const struct ray *ray,
                       struct superellipsoid_bracket *x)
{
    const struct superellipsoid_line *l = &w->s.line;
    const double lo = ray->t_min * l->length - l->shift;
    while (superellipsoid_walk_next(w, x))
        if (x->b.t > lo - 0x1p-40 * (fabs(lo) + fabs(l->shift)))
            return true;
    return false;
}

// Whether all of a bracket is within the ray's range.
static bool is_within(const struct superellipsoid_line *l,
                      const struct superellipsoid_bracket *x, const struct ray *ray)
{
    return (x->a.t + l->shift) / l->length > ray->t_min &&
           (x->b.t + l->shift) / l->length < ray->t_max;
}

static void roots_add(struct superellipsoid_roots *r, int lane,
                      const struct superellipsoid_line *l,
                      const struct superellipsoid_bracket *x)
{
    for (int k = 0; k < 3; k++) {
        r->o[k][lane] = vec3_axis(l->o, k);
        r->u[k][lane] = vec3_axis(l->u, k);
    }
    r->outside[lane] = x->enters ? x->a.t : x->b.t;
    r->inside[lane] = x->enters ? x->b.t : x->a.t;
    r->t[lane] = superellipsoid_first_guess(x);
}

// Eight walks, bracket by bracket, of which the roots are found together.
static unsigned closest_sampled(const struct shape_kernels *k, const void *shape,
                                const struct shape_rays *rays, unsigned lanes, bool any,
                                struct shape_hits *out)
{
    struct superellipsoid_walk w[8];
    struct ray ray[8];
    struct superellipsoid_bracket x[8];
    struct superellipsoid_roots roots = {0};
    unsigned met = 0, on = 0;
    for (; lanes; lanes &= lanes - 1) {
        const int i = __builtin_ctz(lanes);
        ray[i] = shape_rays_lane(rays, i);
        on |= superellipsoid_walk_begin(&w[i], k, shape, &ray[i]) ? 1u << i : 0;
    }
    while (on && !shape_hits_give_up(out)) {
        unsigned sought = 0;
        for (unsigned m = on; m; m &= m - 1) {
            const int i = __builtin_ctz(m);
            const struct superellipsoid_line *l = &w[i].s.line;
            if (!next_ahead(&w[i], &ray[i], &x[i]))
                continue;
            const enum crossing c = x[i].enters ? CROSS_ENTER : CROSS_EXIT;
            if (any && is_within(l, &x[i], &ray[i])) {
                const struct boundary b =
                    crossing_at(l, superellipsoid_first_guess(&x[i]), 1, c);
                shape_hits_put(out, i, &b);
                met |= 1u << i;
                continue;
            }
            roots_add(&roots, i, l, &x[i]);
            sought |= 1u << i;
        }
        if (sought)
            k->superellipsoid_roots(shape, sought, &roots);
        on = 0;
        for (unsigned m = sought; m; m &= m - 1) {
            const int i = __builtin_ctz(m);
            const struct boundary b =
                crossing_at(&w[i].s.line, roots.t[i], roots.slope[i],
                            x[i].enters ? CROSS_ENTER : CROSS_EXIT);
            if (b.t <= ray[i].t_min) {
                on |= 1u << i;
            } else if (b.t < ray[i].t_max) {
                shape_hits_put(out, i, &b);
                met |= 1u << i;
            }
        }
    }
    return met;
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    if (superellipsoid_is_convex(shape))
        return k->superellipsoid(shape, rays, lanes, any, out);
    return closest_sampled(k, shape, rays, lanes, any, out);
}

static struct exponent exponent_of(double e)
{
    enum { SQUARES = 6 }; // more are no quicker
    int n;
    const bool power_of_two = frexp(2 / e, &n) == 0.5 && n >= 1 && n <= SQUARES + 1;
    return (struct exponent){2 / e, power_of_two ? n - 1 : -1};
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
    s->p = exponent_of(e.u);
    s->q = exponent_of(e.v);
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
    superellipsoid_gradient(shape, p, &f);
    return f <= 0;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    double f;
    out->p = p;
    out->ng = out->ns = vec3_normalize(superellipsoid_gradient(shape, p, &f));
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
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .surface = surface,
    .print = print,
};
