// sphere_sweep { linear_spline|b_spline|cubic_spline n, <c>, r, ... [tolerance t] }
//
// The union of the balls about C(u) of radius R(u). On a line of direction D, ball u covers
// the parameters tau(u) -+ sqrt(w(u)): tau the projection of C(u), w = R^2 - d^2 with d the
// distance of C(u) from the line, both polynomials. Where w >= 0 from u1 to u2 these
// stretches move continuously, so together they cover one stretch from the least to the
// greatest end: a line meets a segment in as many stretches as w has intervals of u, and
// nothing can slip between the balls. The ends lie where the derivative of tau -+ sqrt(w)
// vanishes, 4 tau'^2 w = w'^2, or at the ends of the interval; there an error of u counts in
// the second order only.
#include <math.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "math/polynomial.h"
#include "scene/args.h"
#include "scene/shapes/extrude.h"
#include "scene/shapes/sphere_sweep.h"

static const char *const spline_word[] = {"linear_spline", "b_spline", "cubic_spline"};

// ---- building -------------------------------------------------------------------------

static struct sweep_ball mix(const struct sweep_ball *p, const double weight[4], int n)
{
    struct sweep_ball sum = {{0, 0, 0}, 0};
    for (int i = 0; i < n; i++) {
        sum.c = vec3_mad(sum.c, weight[i], p[i].c);
        sum.r += weight[i] * p[i].r;
    }
    return sum;
}

// Weights of consecutive balls in the powers of u, and in the Bezier points, whose balls'
// convex hull holds the segment.
static const double catmull_rom[4][4] = {
    {0, 1, 0, 0}, {-.5, 0, .5, 0}, {1, -2.5, 2, -.5}, {-.5, 1.5, -1.5, .5}};
static const double b_spline[4][4] = {{1. / 6, 4. / 6, 1. / 6, 0},
                                      {-.5, 0, .5, 0},
                                      {.5, -1, .5, 0},
                                      {-1. / 6, .5, -.5, 1. / 6}};
static const double from_powers[4][4] = {
    {1, 0, 0, 0}, {1, 1. / 3, 0, 0}, {1, 2. / 3, 1. / 3, 0}, {1, 1, 1, 1}};

static void make_segment(struct sweep *s, const struct sweep_ball *p,
                         struct sweep_segment *g)
{
    struct sweep_ball power[4] = {{{0}, 0}}, hull[4];
    if (s->spline == SPLINE_LINEAR) {
        power[0] = p[0];
        power[1] = (struct sweep_ball){vec3_sub(p[1].c, p[0].c), p[1].r - p[0].r};
    }
    g->degree = s->spline == SPLINE_LINEAR ? 1 : 3;
    for (int k = 0; k < 4; k++) {
        if (s->spline != SPLINE_LINEAR)
            power[k] = mix(p, s->spline == SPLINE_B ? b_spline[k] : catmull_rom[k], 4);
        g->c[k] = power[k].c;
        g->r[k] = power[k].r;
    }
    struct aabb box = aabb_empty();
    for (int k = 0; k < 4; k++) {
        hull[k] = mix(power, from_powers[k], 4);
        const double r = fabs(hull[k].r);
        box = aabb_add(box, vec3_sub(hull[k].c, vec3(r, r, r)));
        box = aabb_add(box, vec3_add(hull[k].c, vec3(r, r, r)));
    }
    g->around = (struct sweep_ball){vec3_scale(0.5, vec3_add(box.min, box.max)), 0};
    for (int k = 0; k < 4; k++)
        g->around.r = fmax(g->around.r, vec3_length(vec3_sub(hull[k].c, g->around.c)) +
                                            fabs(hull[k].r));
    g->around.r *= 1 + 0x1p-40;
    g->empty = g->r[0] == 0 && g->r[1] == 0 && g->r[2] == 0 && g->r[3] == 0;
    s->bounds = aabb_join(s->bounds, box);
}

static void make_segments(struct sweep *s)
{
    s->bounds = aabb_empty();
    for (uint32_t i = 0; i < s->segments; i++)
        make_segment(s, s->ball + i, &s->segment[i]);
    s->bounds = aabb_pad(s->bounds);
}

static bool read_spline(struct sweep *s, struct args *args)
{
    for (int i = 0; i < 3; i++)
        if (args_word(args, spline_word[i])) {
            s->spline = (enum sweep_spline)i;
            return true;
        }
    args_reject(args, "linear_spline, b_spline or cubic_spline must come first");
    return false;
}

static bool build(void *shape, struct args *args)
{
    struct sweep *s = shape;
    double tolerance;
    if (!read_spline(s, args) || !args_int(args, "number of spheres", &s->count))
        return false;
    const long least = s->spline == SPLINE_LINEAR ? 2 : 4;
    if (s->count < least || s->count > 10000000) {
        args_reject(args, least == 2 ? "at least two spheres are needed"
                                     : "at least four spheres are needed");
        return false;
    }
    struct arena *arena = args_arena(args);
    s->ball = arena_new_array(arena, struct sweep_ball, (size_t)s->count);
    for (long i = 0; i < s->count; i++)
        if (!args_vec3(args, "centre", &s->ball[i].c) ||
            !args_float(args, "radius", &s->ball[i].r))
            return false;
    if (args_word(args, "tolerance") && !args_float(args, "tolerance", &tolerance))
        return false;
    s->segments = (uint32_t)(s->count - (least == 2 ? 1 : 3));
    s->segment = arena_new_array(arena, struct sweep_segment, s->segments);
    make_segments(s);
    return true;
}

// ---- rays -----------------------------------------------------------------------------

// Balls thinner than that share of the segment: w is 1e-7 of the terms it is a sum of.
#define THIN 0x1p-12

// One segment on one line.
struct chord {
    const double *r;
    struct vec3 across[4]; // from the line to C(u)
    double tau[4], w[7];
    int tau_degree, w_degree;
    double least, most, at_least, at_most; // ends of the stretch, and their u
};

static void multiply(const double *a, int n, const double *b, int m, double factor,
                     double *sum)
{
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= m; j++)
            sum[i + j] += factor * a[i] * b[j];
}

static void differentiate(const double *a, int n, double *d)
{
    for (int i = 1; i <= n; i++)
        d[i - 1] = i * a[i];
}

// w = r^2 - |p|^2 for a vector polynomial p.
static void excess(const struct sweep_segment *g, const struct vec3 p[4], double w[7])
{
    multiply(g->r, g->degree, g->r, g->degree, 1, w);
    for (int i = 0; i <= g->degree; i++)
        for (int j = 0; j <= g->degree; j++)
            w[i + j] -= vec3_dot(p[i], p[j]);
}

// w(u) without its polynomial, whose terms are of the size of the segment.
static double excess_at(const struct chord *c, double u)
{
    struct vec3 v = c->across[c->tau_degree];
    for (int k = c->tau_degree - 1; k >= 0; k--)
        v = vec3_mad(c->across[k], u, v);
    const double r = polynomial_value(c->r, c->tau_degree, u);
    return r * r - vec3_dot(v, v);
}

static void try_u(struct chord *c, double u)
{
    const double tau = polynomial_value(c->tau, c->tau_degree, u);
    const double reach = sqrt(fmax(0, excess_at(c, u)));
    if (tau - reach < c->least) {
        c->least = tau - reach;
        c->at_least = u;
    }
    if (tau + reach > c->most) {
        c->most = tau + reach;
        c->at_most = u;
    }
}

static void try_roots(struct chord *c, const double *f, int degree, double lo, double hi)
{
    struct polynomial_root root[POLYNOMIAL_DEGREE_MAX];
    for (int n = polynomial_sign_changes(f, degree, lo, hi, root); n > 0; n--)
        try_u(c, root[n - 1].t);
}

// The stretch that the balls from u = lo to hi cover.
static void cover(struct chord *c, double lo, double hi)
{
    double dt[3] = {0}, dw[6] = {0}, dt2[5] = {0}, f[11] = {0};
    c->least = HUGE_VAL;
    c->most = -HUGE_VAL;
    try_u(c, lo);
    try_u(c, hi);
    differentiate(c->tau, c->tau_degree, dt);
    differentiate(c->w, c->w_degree, dw);
    const int n = c->tau_degree - 1, m = c->w_degree - 1;
    multiply(dt, n, dt, n, 4, dt2);
    multiply(dt2, 2 * n, c->w, c->w_degree, 1, f);
    multiply(dw, m, dw, m, -1, f);
    try_roots(c, f, 2 * n + c->w_degree > 2 * m ? 2 * n + c->w_degree : 2 * m, lo, hi);
    // In a graze both ends turn at nearly the same u, about the greatest ball, and the roots
    // above are twins that may be missed: there w is a parabola and tau a line.
    const bool graze = hi - lo < 0x1p-8;
    struct polynomial_root root[POLYNOMIAL_DEGREE_MAX];
    double dw2[6] = {0};
    differentiate(dw, m, dw2);
    for (int i = polynomial_sign_changes(dw, m, lo, hi, root); i > 0; i--) {
        const double u = root[i - 1].t, slope = polynomial_value(dt, n, u);
        const double bend = -polynomial_value(dw2, m - 1, u) / 2;
        try_u(c, u);
        if (!graze || !(bend > 0))
            continue;
        const double by =
            slope * sqrt(fmax(0, excess_at(c, u)) / (bend * (bend + slope * slope)));
        try_u(c, fmax(lo, u - fabs(by)));
        try_u(c, fmin(hi, u + fabs(by)));
    }
}

// The sign change of w between a and b, by bisection.
static double change_between(const struct chord *c, double a, double b, bool in_a)
{
    for (int i = 0; i < 60 && b - a > 0x1p-53; i++) {
        const double u = 0.5 * (a + b);
        *((excess_at(c, u) >= 0) == in_a ? &a : &b) = u;
    }
    return 0.5 * (a + b);
}

// Where w changes its sign; *in: whether it begins positive. Where the balls are so small that
// the rounding of the polynomial matters, by the signs between its extrema.
static int changes(const struct chord *c, double size, double u[7], bool *in)
{
    struct polynomial_root root[POLYNOMIAL_DEGREE_MAX];
    double r = 0, dw[6];
    for (int k = 0; k <= c->tau_degree; k++)
        r += fabs(c->r[k]);
    int n = 0;
    if (r > THIN * size) {
        n = polynomial_sign_changes(c->w, c->w_degree, 0, 1, root);
        *in = n > 0 ? !root[0].rising : polynomial_value(c->w, c->w_degree, 0.5) >= 0;
        for (int i = 0; i < n; i++)
            u[i] = root[i].t;
        return n;
    }
    differentiate(c->w, c->w_degree, dw);
    const int stops = polynomial_sign_changes(dw, c->w_degree - 1, 0, 1, root);
    double from = 0;
    bool state = *in = excess_at(c, 0) >= 0;
    for (int i = 0; i <= stops; i++) {
        const double to = i < stops ? root[i].t : 1;
        const bool now = excess_at(c, to) >= 0;
        if (now != state)
            u[n++] = change_between(c, from, to, state);
        state = now;
        from = to;
    }
    return n;
}

struct line {
    const struct ray *ray;
    struct vec3 d; // unit
    double length;
    struct boundary_list *out;
};

static struct line line_of(const struct ray *ray, struct boundary_list *out)
{
    const double length = vec3_length(ray->d);
    return (struct line){ray, vec3_scale(1 / length, ray->d), length, out};
}

static void end(const struct line *l, double t, double shift, double dt, double u,
                uint32_t part, enum crossing kind)
{
    struct boundary *b =
        boundary_list_add(l->out, (t + shift) / l->length, dt / l->length, kind, part);
    b->v = u;
}

// w is off by `noise`, so half the chord of the ball that ends there, h = sqrt(w), by
// noise/2h or at most its root.
static double chord_error(const struct chord *c, double u, double noise)
{
    const double w = excess_at(c, u);
    return w > noise ? fmin(noise / sqrt(w), 2 * sqrt(noise)) : 2 * sqrt(noise);
}

static void meet_segment(const struct line *l, const struct sweep_segment *g,
                         uint32_t part)
{
    const struct vec3 to = vec3_sub(g->around.c, l->ray->o);
    const double shift = vec3_dot(to, l->d);
    const struct vec3 off = vec3_mad(to, -shift, l->d); // from the line to the middle
    const double r = g->around.r;
    if (g->empty ||
        vec3_dot(off, off) > r * r * (1 + 0x1p-30) + GAMMA(16) * vec3_dot(to, to))
        return;
    const struct vec3 o = vec3_mad(l->ray->o, shift, l->d);
    struct chord c = {.r = g->r, .tau_degree = g->degree, .w_degree = 2 * g->degree};
    for (int k = 0; k <= g->degree; k++) {
        const struct vec3 v = k ? g->c[k] : vec3_sub(g->c[0], o);
        c.tau[k] = vec3_dot(v, l->d);
        c.across[k] = vec3_mad(v, -c.tau[k], l->d);
    }
    excess(g, c.across, c.w);
    double u[7];
    bool in;
    const int n = changes(&c, r, u, &in);
    const double error = GAMMA(32) * (fabs(shift) + r + vec3_max_abs(g->around.c));
    for (int i = 0; i <= n; i++, in = !in) {
        if (!in)
            continue;
        cover(&c, i ? u[i - 1] : 0, i < n ? u[i] : 1);
        const double noise = GAMMA(64) * r * (r + fabs(shift) * 0x1p-20) + error * r;
        end(l, c.least, shift, error + chord_error(&c, c.at_least, noise), c.at_least,
            part, CROSS_ENTER);
        end(l, c.most, shift, error + chord_error(&c, c.at_most, noise), c.at_most, part,
            CROSS_EXIT);
    }
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct sweep *s = shape;
    const struct line l = line_of(ray, out);
    const uint32_t from = out->count;
    for (uint32_t i = 0; i < s->segments; i++)
        meet_segment(&l, &s->segment[i], i);
    if (out->count - from <= 2)
        return;
    boundary_list_sort(out, from);
    boundary_list_merge(out, from);
}

// ---- the first crossing -----------------------------------------------------------------

enum { STRETCHES = 32 };

// What the segments met so far cover of a line.
struct cover {
    struct boundary at[2 * STRETCHES]; // entries and exits, in turn
    uint32_t count;
};

// The first end of their union behind t_min; NULL: none. Of equal ones that which is kept when
// all are merged.
static const struct boundary *first_end(const struct cover *c, double t_min)
{
    const struct boundary *enter = NULL, *leave = NULL;
    double covered = t_min;
    for (bool more = true; more;) {
        more = false;
        for (uint32_t i = 0; i < c->count; i += 2) {
            const struct boundary *b = &c->at[i];
            if (b[0].t <= covered && b[1].t > covered) {
                leave = &b[1];
                covered = b[1].t;
                more = true;
            } else if (leave && b[1].t == covered && b[1].part > leave->part) {
                leave = &b[1];
            } else if (b[0].t > t_min &&
                       (!enter || b[0].t < enter->t ||
                        (b[0].t == enter->t && b[0].part < enter->part))) {
                enter = &b[0];
            }
        }
    }
    return leave ? leave : enter;
}

static void sort_near(struct sweep_near *near, uint32_t n)
{
    for (uint32_t i = 1; i < n; i++) {
        const struct sweep_near x = near[i];
        uint32_t j = i;
        for (; j > 0 && near[j - 1].from > x.from; j--)
            near[j] = near[j - 1];
        near[j] = x;
    }
}

bool sweep_first(const struct sweep *s, const struct ray *ray, struct sweep_near *near,
                 uint32_t count, struct boundary *out, bool *odd)
{
    struct cover c;
    struct boundary_list list = {.at = c.at, .capacity = 2 * STRETCHES};
    const struct line l = line_of(ray, &list);
    const struct boundary *first = NULL;
    sort_near(near, count);
    for (uint32_t i = 0; i < count && !(first && near[i].from > first->t); i++) {
        if (list.count + 8 > list.capacity) { // a segment has four stretches at most
            *odd = true;
            return false;
        }
        const uint32_t before = list.count;
        meet_segment(&l, &s->segment[near[i].segment], near[i].segment);
        c.count = list.count;
        if (list.count > before)
            first = first_end(&c, ray->t_min);
    }
    if (!first || !(first->t <= ray->t_max))
        return false;
    *out = *first;
    return true;
}

// ---- the rest -------------------------------------------------------------------------

static struct aabb bounds(const void *shape)
{
    const struct sweep *s = shape;
    return s->bounds;
}

// Not by w(u) itself: its terms are of the size of the segment, and cancel where that is thin.
static bool inside_ball(const struct sweep_segment *g, double u, struct vec3 p)
{
    struct vec3 c = g->c[g->degree];
    for (int k = g->degree - 1; k >= 0; k--)
        c = vec3_mad(g->c[k], u, c);
    const struct vec3 v = vec3_sub(p, c);
    const double r = polynomial_value(g->r, g->degree, u);
    return vec3_dot(v, v) <= r * r;
}

// Some ball holds p when that of the greatest w does: at an end, or where w' vanishes.
static bool inside_segment(const struct sweep_segment *g, struct vec3 p)
{
    if (g->empty)
        return false;
    if (inside_ball(g, 0, p) || inside_ball(g, 1, p))
        return true;
    double w[7] = {0}, dw[6];
    struct vec3 v[4] = {{0, 0, 0}};
    for (int k = 0; k <= g->degree; k++)
        v[k] = k ? g->c[k] : vec3_sub(g->c[0], p);
    excess(g, v, w);
    differentiate(w, 2 * g->degree, dw);
    struct polynomial_root root[POLYNOMIAL_DEGREE_MAX];
    for (int n = polynomial_sign_changes(dw, 2 * g->degree - 1, 0, 1, root); n > 0; n--)
        if (inside_ball(g, root[n - 1].t, p))
            return true;
    return false;
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct sweep *s = shape;
    for (uint32_t i = 0; i < s->segments; i++) {
        const struct sweep_segment *g = &s->segment[i];
        const struct vec3 d = vec3_sub(p, g->around.c);
        if (vec3_dot(d, d) <= g->around.r * g->around.r && inside_segment(g, p))
            return true;
    }
    return false;
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    (void)any;
    unsigned odd;
    const unsigned met = k->sphere_sweep(shape, rays, lanes, out, &odd);
    return met | shape_lanes_alone(&sphere_sweep_ops, shape, rays, odd, out);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct sweep *s = shape;
    const struct sweep_segment *g = &s->segment[b->part];
    struct vec3 c = g->c[g->degree], along = vec3_scale(g->degree, c);
    for (int k = g->degree - 1; k >= 0; k--) {
        c = vec3_mad(g->c[k], b->v, c);
        if (k)
            along = vec3_mad(vec3_scale(k, g->c[k]), b->v, along);
    }
    struct vec3 n = vec3_normalize(vec3_sub(p, c));
    if (vec3_dot(n, n) == 0) // a point
        n = vec3_normalize(along);
    if (vec3_dot(n, n) == 0)
        n = vec3(1, 0, 0);
    out->p = p;
    out->ng = out->ns = n;
    out->uv = (struct vec2){p.x, p.y};
}

static void print(const void *shape, FILE *out)
{
    const struct sweep *s = shape;
    fprintf(out, "sphere_sweep { %s %ld", spline_word[s->spline], s->count);
    for (long i = 0; i < s->count; i++) {
        fputs(", ", out);
        shape_print_vec3(out, s->ball[i].c);
        fputs(", ", out);
        shape_print_number(out, s->ball[i].r);
    }
}

const struct shape_ops sphere_sweep_ops = {
    .keyword = "sphere_sweep",
    .size = sizeof(struct sweep),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .surface = surface,
    .print = print,
};
