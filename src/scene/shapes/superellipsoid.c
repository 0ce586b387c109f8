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
#include "scene/shapes/superellipsoid.h"

// The p-norm (a^p + b^p)^(1/p) of a, b >= 0 and its derivatives. With w = (small/big)^p and
// c = (1 + w)^(1/p) it is c big, its derivatives c/(1 + w) and that times w big/small.
static double norm2(double a, double b, double p, double *da, double *db)
{
    const bool turned = a < b;
    const double big = turned ? b : a, small = turned ? a : b;
    double c = 1, by_big = 1, by_small = 0;
    if (small > 0x1p-1000 * big) {
        const double q = small / big, w = quick_pow(q, p);
        c = quick_pow(1 + w, 1 / p);
        by_big = c / (1 + w);
        by_small = by_big * w / q;
    }
    *da = turned ? by_small : by_big;
    *db = turned ? by_big : by_small;
    return c * big;
}

struct sample {
    double f, slope; // F and its derivative along the line
};

static struct vec3 gradient(const struct superellipsoid *s, struct vec3 p, double *f)
{
    double dx, dy, da, dz;
    const double a = norm2(fabs(p.x), fabs(p.y), s->p, &dx, &dy);
    *f = norm2(a, fabs(p.z), s->q, &da, &dz) - 1;
    return vec3(copysign(da * dx, p.x), copysign(da * dy, p.y), copysign(dz, p.z));
}

struct line {
    const struct superellipsoid *s;
    struct vec3 o, u; // unit direction, o nearest to the centre
    double shift, length;
    double noise; // bound on the error of F: its numbers are near one, and see quick_pow
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

static struct boundary crossing_at(const struct line *l, double t, double slope,
                                   enum crossing c)
{
    double dt = 2 * l->noise / fmax(fabs(slope), 0x1p-26);
    dt += GAMMA(4) * (fabs(l->shift) + fabs(t));
    return (struct boundary){.t = (t + l->shift) / l->length,
                             .dt = dt / l->length,
                             .crossing = (uint8_t)c,
                             .drawn = 1};
}

static void add(const struct line *l, double t, double slope, enum crossing c,
                struct boundary_list *out)
{
    *boundary_list_add(out, 0, 0, c, 0) = crossing_at(l, t, slope, c);
}

// The root between outside (F > 0) and inside, Newton from t on, kept in the bracket; *slope is
// F's near it.
static double root_between(const struct line *l, double outside, double inside, double t,
                           double *slope)
{
    for (int i = 0; i < 100; i++) {
        const struct sample v = at(l, t);
        *slope = v.slope;
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

// The root of a convex F next to the outside point t, looking towards `to`, by Newton's
// method, which comes from outside and does not pass it; false: there is none. *slope is
// F's there.
static bool approach(const struct line *l, double t, double to, double *root,
                     double *slope)
{
    const double way = to > t ? 1 : -1, noise = l->noise;
    for (int i = 0; i < 100; i++) {
        const struct sample v = at(l, t);
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

static void convex(const struct line *l, double a, double b, struct boundary_list *out)
{
    double first, last, slope_a, slope_b;
    if (!approach(l, a, b, &first, &slope_a))
        return;
    if (!approach(l, b, first, &last, &slope_b))
        last = first;
    add(l, first, slope_a, CROSS_ENTER, out);
    add(l, last, slope_b, CROSS_EXIT, out);
}

// Where the line meets the planes x = 0, x = y, x = -y and so on, sorted, ends included.
enum { STOPS = 11, PIECES = 4, CROSSINGS = 2 * STOPS * PIECES };

static int kinks(const struct line *l, double a, double b, double stop[STOPS])
{
    static const struct vec3 plane[9] = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                                         {1, 1, 0},  {1, -1, 0}, {1, 0, 1},
                                         {1, 0, -1}, {0, 1, 1},  {0, 1, -1}};
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

// A place where F was looked at.
struct place {
    double t, f;
};

// The secant's root is nearer than the ends.
static void cross(const struct line *l, struct place a, struct place b, bool enters,
                  struct boundary_list *out)
{
    double start = a.t + (b.t - a.t) * (a.f / (a.f - b.f)), slope;
    if (!(start > a.t && start < b.t)) // the line leaves the cube where F is below zero
        start = 0.5 * (a.t + b.t);
    const double root = enters ? root_between(l, a.t, b.t, start, &slope)
                               : root_between(l, b.t, a.t, start, &slope);
    add(l, root, slope, enters ? CROSS_ENTER : CROSS_EXIT, out);
}

// Where a line is sampled, and what F is there; eight places at a time, if there are kernels.
enum { PLACES = (STOPS - 1) * PIECES + 1, ROOM = (PLACES + 7) / 8 * 8 };

struct samples {
    const struct line *line;
    const struct shape_kernels *kernels; // NULL: one place at a time
    int count;
    double t[ROOM], f[ROOM], slope[ROOM];
};

static void samples_place(struct samples *s, double a, double b)
{
    double stop[STOPS];
    const int n = kinks(s->line, a, b, stop);
    s->count = 0;
    s->t[s->count++] = a;
    for (int i = 1; i < n; i++)
        for (int k = 1; k <= PIECES; k++)
            s->t[s->count++] = stop[i - 1] + (stop[i] - stop[i - 1]) * k / PIECES;
    for (int i = s->count; i % 8; i++)
        s->t[i] = b;
}

static struct sample sample_of(struct samples *s, int i)
{
    if (!s->kernels)
        return at(s->line, s->t[i]);
    if (i % 8 == 0)
        s->kernels->superellipsoid_samples(s->line->s, s->line->o, s->line->u, s->t + i,
                                           s->f + i, s->slope + i);
    return (struct sample){s->f[i], s->slope[i]};
}

// F and its slope at eight places of the line.
static void eight_samples(const struct line *l, const struct shape_kernels *k,
                          const double t[8], double f[8], double slope[8])
{
    if (k) {
        k->superellipsoid_samples(l->s, l->o, l->u, t, f, slope);
        return;
    }
    for (int i = 0; i < 8; i++) {
        const struct sample v = at(l, t[i]);
        f[i] = v.f;
        slope[i] = v.slope;
    }
}

// A point between a and b on the other side of F than both, where the slopes at the ends
// say there may be one: F turns between them, in one eighth of the stretch.
static bool find_turn(const struct line *l, const struct shape_kernels *k, double a,
                      double b, bool in, struct place *turn)
{
    for (int step = 0; step < 8; step++) {
        double t[8], f[8], slope[8];
        for (int i = 0; i < 8; i++)
            t[i] = a + (b - a) * (i + 1) / 8; // the last is not looked at
        eight_samples(l, k, t, f, slope);
        int i = 0;
        while (i < 7 && (f[i] < 0) == in && (slope[i] > 0) == in)
            i++;
        if (i < 7 && (f[i] < 0) != in) {
            *turn = (struct place){t[i], f[i]};
            return true;
        }
        a = i ? t[i - 1] : a;
        b = i < 7 ? t[i] : b;
    }
    return false;
}

// Crossings up to the first behind `enough`.
static void sampled(const struct line *l, const struct shape_kernels *kernels, double a,
                    double b, double enough, struct boundary_list *out)
{
    struct samples s;
    s.line = l;
    s.kernels = kernels;
    samples_place(&s, a, b);
    struct sample before = sample_of(&s, 0);
    struct place last = {a, before.f}, turn;
    bool in = false;
    for (int i = 1; i < s.count; i++) {
        const struct sample here = sample_of(&s, i);
        const bool now = here.f < 0 && i + 1 < s.count;
        if (now != in) {
            cross(l, last, (struct place){s.t[i], here.f}, now, out);
        } else if ((before.slope > 0) == in && (here.slope > 0) != in &&
                   find_turn(l, kernels, last.t, s.t[i], in, &turn)) {
            cross(l, last, turn, !in, out);
            cross(l, turn, (struct place){s.t[i], here.f}, in, out);
        }
        in = now;
        last = (struct place){s.t[i], here.f};
        before = here;
        if (out->count && out->at[out->count - 1].t > enough)
            return;
    }
}

static struct line line_of(const void *shape, const struct ray *ray)
{
    struct line l = {.s = shape, .length = vec3_length(ray->d)};
    l.u = vec3_scale(1 / l.length, ray->d);
    // w^p is known to 3 |log w^p| + 4 roundings, and w^p |log w^p| < 1.
    l.noise = GAMMA(64);
    l.shift = -vec3_dot(ray->o, l.u);
    l.o = vec3_mad(ray->o, l.shift, l.u);
    return l;
}

static bool is_convex(const struct superellipsoid *s) { return s->p >= 1 && s->q >= 1; }

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct line l = line_of(shape, ray);
    double a, b;
    if (!in_cube(&l, &a, &b))
        return;
    if (is_convex(l.s))
        convex(&l, a, b, out);
    else
        sampled(&l, NULL, a, b, HUGE_VAL, out);
}

// The first crossing that the ray may see; those behind need not be found.
static bool closest_sampled(const struct shape_kernels *k, const void *shape,
                            const struct ray *ray, struct boundary *out)
{
    const struct line l = line_of(shape, ray);
    struct boundary room[CROSSINGS];
    struct boundary_list list = {.at = room, .capacity = CROSSINGS};
    double a, b;
    if (!in_cube(&l, &a, &b))
        return false;
    sampled(&l, k, a, b, ray->t_min, &list);
    for (uint32_t i = 0; i < list.count; i++)
        if (room[i].t > ray->t_min && room[i].t < ray->t_max) {
            *out = room[i];
            return true;
        }
    return false;
}

static bool has_lanes(const void *shape)
{
    (void)shape;
    return true;
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    if (is_convex(shape))
        return k->superellipsoid(shape, rays, lanes, any, out);
    unsigned met = 0;
    for (; lanes && !shape_hits_give_up(out); lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        const struct ray ray = shape_rays_lane(rays, lane);
        struct boundary b;
        if (!closest_sampled(k, shape, &ray, &b))
            continue;
        shape_hits_put(out, lane, &b);
        met |= lanes & -lanes;
    }
    return met;
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
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .print = print,
};
