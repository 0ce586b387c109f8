// julia_fractal { c [quaternion|hypercomplex] [function] [max_iteration n] [precision p]
//                 [slice v, d] }
//
// A three-dimensional slice of a Julia set. No formula gives its surface on a line: the line
// is sampled at steps of the estimated distance, at least 1/precision, so thinner parts are
// met or not as in POV-Ray; where the state changes the place is found to its rounding
// error.
#include <math.h>

#include "math/elementary.h"
#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shape_kernels.h"
#include "scene/shapes/julia.h"

static const char *const function_word[] = {
    "sqr",  "cube", "exp",   "reciprocal", "sin",  "asin", "sinh",  "asinh", "cos",
    "acos", "cosh", "acosh", "tan",        "atan", "tanh", "atanh", "ln",    "pwr"};

enum { FUNCTIONS = sizeof function_word / sizeof function_word[0] };

static bool read_slice(struct julia *j, struct args *args)
{
    double v[4];
    if (!args_vec4(args, "slice", v) ||
        !args_float(args, "distance of the slice", &j->distance))
        return false;
    const double length = sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] + v[3] * v[3]);
    if (!(length > 1e-5) || !(fabs(v[3]) > 1e-10)) {
        args_reject(args, "the fourth component of the slice must not be zero");
        return false;
    }
    for (int i = 0; i < 4; i++)
        j->slice[i] = v[i] / length;
    return true;
}

static bool read_power(struct julia *j, struct args *call)
{
    j->function = JULIA_PWR;
    return args_float(call, "real part", &j->power.re) &&
           args_float(call, "imaginary part", &j->power.im);
}

static bool read_function(struct julia *j, struct args *args)
{
    for (int i = 0; i < FUNCTIONS; i++)
        if (i != JULIA_PWR && args_word(args, function_word[i])) {
            j->function = (enum julia_function)i;
            return true;
        }
    return false;
}

static bool read_items(struct julia *j, struct args *args)
{
    for (;;) {
        struct args *call;
        long n;
        if (args_word(args, "quaternion")) {
            j->hypercomplex = false;
        } else if (args_word(args, "hypercomplex")) {
            j->hypercomplex = true;
        } else if (args_word(args, "max_iteration")) {
            if (!args_int(args, "max_iteration", &n))
                return false;
            j->iterations = n < 1 ? 1 : (int)n;
        } else if (args_word(args, "precision")) {
            if (!args_float(args, "precision", &j->precision))
                return false;
        } else if (args_word(args, "slice")) {
            if (!read_slice(j, args))
                return false;
        } else if ((call = args_call(args, "pwr"))) {
            if (!read_power(j, call))
                return false;
        } else if (!read_function(j, args)) {
            return true;
        }
    }
}

// A ball that holds the set, for hypercomplex powers, where it is much smaller than the ball
// of escape and the steps are short. No iterate but the last may leave that ball; there the
// two complex numbers are shorter than sqrt(2 escape), and |z^m| <= B + |c| bounds the |z| of
// the iterate before. (Quaternions start where POV-Ray starts: thin parts depend on it.)
static double reach_of(const struct julia *j)
{
    if (!j->hypercomplex || (j->function != JULIA_SQR && j->function != JULIA_CUBE))
        return j->radius;
    const double *c = j->c, power = j->function == JULIA_SQR ? 2 : 3;
    const double re[2] = {c[0] - c[3], c[0] + c[3]}, im[2] = {c[1] + c[2], c[1] - c[2]};
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const double shift = sqrt(re[i] * re[i] + im[i] * im[i]);
        double bound = sqrt(2 * j->escape);
        for (int k = 1; k < j->iterations && k < 100; k++)
            bound = fmin(bound, det_pow(bound + shift, 1 / power));
        sum += 0.5 * bound * bound;
    }
    return fmin(j->radius, sqrt(sum) * (1 + 0x1p-40));
}

static bool build(void *shape, struct args *args)
{
    struct julia *j = shape;
    *j = (struct julia){.iterations = 20, .precision = 20, .slice = {0, 0, 0, 1}};
    if (!args_vec4(args, "parameter", j->c) || !read_items(j, args))
        return false;
    if (!j->hypercomplex && j->function != JULIA_SQR && j->function != JULIA_CUBE) {
        args_reject(args, "quaternions know the functions sqr and cube only; write "
                          "hypercomplex for others");
        return false;
    }
    j->precision = j->precision >= 1 ? j->precision : 1;
    for (int i = 0; i < 3; i++)
        j->start[i] = -j->slice[i] / j->slice[3];
    j->start[3] = j->distance / j->slice[3];
    double c2 = 0;
    for (int i = 0; i < 4; i++)
        c2 += j->c[i] * j->c[i];
    j->radius = j->hypercomplex ? 4 : fmin(2, 1 + sqrt(c2) + 1e-7);
    j->escape = j->radius * j->radius + (j->hypercomplex ? 0 : 1e-7);
    j->radius = reach_of(j);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct julia *j = shape;
    const double r = j->radius;
    return aabb_pad((struct aabb){vec3(-r, -r, -r), vec3(r, r, r)});
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct julia *j = shape;
    double norm;
    return vec3_dot(p, p) <= j->radius * j->radius &&
           julia_escape(j, p, vec3(0, 0, 1), NULL, &norm) == j->iterations;
}

struct march {
    const struct julia *j;
    struct vec3 o, d; // unit direction
    double shift, length;
};

// A sample of the line. While none but the last iterate leaves the ball, `over` is a smooth
// function, how far it is beyond the ball's radius.
struct sample {
    bool in, smooth;
    double over, step;
};

static struct sample sample_at(const struct march *m, double t, bool want_step)
{
    struct sample s = {.step = 0};
    double norm;
    const int k = julia_escape(m->j, vec3_mad(m->o, t, m->d), m->d,
                               want_step ? &s.step : NULL, &norm);
    s.in = k == m->j->iterations;
    s.smooth = k >= m->j->iterations - 1;
    s.over = norm - m->j->escape;
    return s;
}

// Where the state changes between lo and hi: a stretch no longer than `enough`, found by
// bisection, and by the Illinois method while the function is smooth.
static void narrow(const struct march *m, double *lo, double *hi, struct sample a,
                   struct sample b, double enough)
{
    int side = 0;
    for (int i = 0; i < 100 && *hi - *lo > enough; i++) {
        double t = 0.5 * (*lo + *hi);
        if (a.smooth && b.smooth && i % 8 != 7) {
            t = *lo + (*hi - *lo) * (a.over / (a.over - b.over));
            t = fmax(*lo + 0.5 * enough, fmin(*hi - 0.5 * enough, t));
        }
        if (!(t > *lo && t < *hi))
            break;
        const struct sample s = sample_at(m, t, false);
        if (s.in == a.in) {
            if (side == 1)
                b.over *= 0.5;
            *lo = t;
            a = s;
            side = 1;
        } else {
            if (side == 2)
                a.over *= 0.5;
            *hi = t;
            b = s;
            side = 2;
        }
    }
}

// The last, as POV-Ray has it, unless it points into the solid, as it may on thin parts; then
// the one that leaves the ball.
uint32_t julia_normal(const struct julia *j, struct vec3 o, struct vec3 d, double inner,
                      double outer, bool exits)
{
    const struct vec3 g = julia_gradient(j, vec3_mad(o, inner, d), j->iterations);
    if ((vec3_dot(g, d) > 0) == exits)
        return (uint32_t)j->iterations;
    double norm;
    return (uint32_t)julia_escape(j, vec3_mad(o, outer, d), d, NULL, &norm);
}

// Returns its t on the ray.
static double add(const struct march *m, double inner, double outer, bool exits,
                  double error, struct boundary_list *out)
{
    const double t = (inner + m->shift) / m->length;
    boundary_list_add(out, t, error / m->length, exits ? CROSS_EXIT : CROSS_ENTER,
                      julia_normal(m->j, m->o, m->d, inner, outer, exits));
    return t;
}

// Crossings from ray->t_min on, up to the `limit`th beyond it: one at the start itself may lie
// before it by rounding. The ball is left at its surface.
static void march(const struct julia *j, const struct ray *ray, uint32_t limit,
                  struct boundary_list *out)
{
    const double length = vec3_length(ray->d), least = 1 / j->precision;
    const struct vec3 u = vec3_scale(1 / length, ray->d);
    const double shift = -vec3_dot(ray->o, u);
    const struct march m = {j, vec3_mad(ray->o, shift, u), u, shift, length};
    const double reach2 = j->radius * j->radius - vec3_dot(m.o, m.o);
    if (!(reach2 > 0))
        return;
    const double end = sqrt(reach2), error = GAMMA(32) * (fabs(shift) + j->radius);
    double t = fmax(-end, ray->t_min * length - shift);
    if (!(t < end))
        return;
    struct sample here = sample_at(&m, t, true);
    here.in = here.in && t > -end;
    while (t < end && limit > 0 && !boundary_list_gives_up(out)) {
        const double next = fmin(end, t + fmax(here.in ? 0 : here.step, least));
        struct sample now = sample_at(&m, next, true);
        const bool leaves = next == end; // the ball, whatever the iterates say
        if (here.in && leaves && now.in) {
            add(&m, next, next, true, error, out);
            return;
        }
        now.in = now.in && !leaves;
        if (now.in != here.in) {
            double lo = t, hi = next;
            narrow(&m, &lo, &hi, here, now, 0.25 * error);
            const double at =
                add(&m, here.in ? lo : hi, here.in ? hi : lo, here.in, error, out);
            limit -= at > ray->t_min;
        }
        here = now;
        t = next;
    }
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    march(shape, ray, out->first_only ? 1 : UINT32_MAX, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return k->julia(shape, rays, lanes, any, out);
}

static bool has_lanes(const void *shape) { return julia_has_lanes(shape); }

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct julia *j = shape;
    struct vec3 n = vec3_normalize(julia_gradient(j, p, (int)b->part));
    if (!(vec3_dot(n, n) > 0.5)) // no direction, or too large for a number
        n = vec3_dot(p, p) > 0 ? vec3_normalize(p) : vec3(1, 0, 0);
    out->p = p;
    out->ng = out->ns = n;
    out->uv = (struct vec2){p.x, p.y};
}

static void print_vec4(FILE *out, const double v[4])
{
    for (int i = 0; i < 4; i++) {
        fputs(i ? ", " : "<", out);
        shape_print_number(out, v[i]);
    }
    fputs(">", out);
}

static void print(const void *shape, FILE *out)
{
    const struct julia *j = shape;
    fputs("julia_fractal { ", out);
    print_vec4(out, j->c);
    fprintf(out, " %s %s", j->hypercomplex ? "hypercomplex" : "quaternion",
            function_word[j->function]);
    if (j->function == JULIA_PWR) {
        fputs("(", out);
        shape_print_number(out, j->power.re);
        fputs(", ", out);
        shape_print_number(out, j->power.im);
        fputs(")", out);
    }
    fprintf(out, " max_iteration %d precision ", j->iterations);
    shape_print_number(out, j->precision);
    fputs(" slice ", out);
    print_vec4(out, j->slice);
    fputs(", ", out);
    shape_print_number(out, j->distance);
}

const struct shape_ops julia_fractal_ops = {
    .keyword = "julia_fractal",
    .size = sizeof(struct julia),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .print = print,
};
