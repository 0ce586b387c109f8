// julia_fractal { c [quaternion|hypercomplex] [function] [max_iteration n] [precision p]
//                 [slice v, d] }
//
// A three-dimensional slice of a Julia set. No formula gives its surface on a line: the line
// is sampled at steps of the estimated distance, at least 1/precision, so thinner parts are
// met or not as in POV-Ray; where the state changes the place is found by bisection to the
// last bit.
#include <math.h>

#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/julia.h"

static const char *const function_word[] = {
    "sqr", "cube", "exp", "reciprocal", "sin", "asin", "sinh", "asinh", "cos", "acos",
    "cosh", "acosh", "tan", "atan", "tanh", "atanh", "ln", "pwr"};

enum { FUNCTIONS = sizeof function_word / sizeof function_word[0] };

static bool read_slice(struct julia *j, struct args *args)
{
    double v[4];
    if (!args_vec4(args, "slice", v) || !args_float(args, "distance of the slice", &j->distance))
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
    return vec3_dot(p, p) <= j->radius * j->radius &&
           julia_escape(j, p, vec3(0, 0, 1), NULL) == j->iterations;
}

struct march {
    const struct julia *j;
    struct vec3 o, d; // unit direction
};

static bool in_at(const struct march *m, double t, double *step)
{
    return julia_escape(m->j, vec3_mad(m->o, t, m->d), m->d, step) == m->j->iterations;
}

// Where the state changes between lo, of state `in`, and hi: the inner one of two neighbours;
// *outer is the other.
static double bisect(const struct march *m, double lo, double hi, bool in, double *outer)
{
    for (int i = 0; i < 60; i++) {
        const double t = 0.5 * (lo + hi);
        if (!(t > lo && t < hi))
            break;
        if (in_at(m, t, NULL) == in)
            lo = t;
        else
            hi = t;
    }
    *outer = in ? hi : lo;
    return in ? lo : hi;
}

// Which iterate's gradient is the normal at t: the last, as POV-Ray has it, unless it points
// into the solid, as it may on thin parts; then the one that leaves the ball.
static uint32_t normal_of(const struct march *m, double t, bool in, double outside)
{
    const int n = m->j->iterations;
    const struct vec3 g = julia_gradient(m->j, vec3_mad(m->o, t, m->d), n);
    if ((vec3_dot(g, m->d) > 0) == in)
        return (uint32_t)n;
    return (uint32_t)julia_escape(m->j, vec3_mad(m->o, outside, m->d), m->d, NULL);
}

// Crossings with t > ray->t_min, up to `limit` of them. The ball is left at its surface.
static void march(const struct julia *j, const struct ray *ray, uint32_t limit,
                  struct boundary_list *out)
{
    const double length = vec3_length(ray->d), least = 1 / j->precision;
    const struct vec3 u = vec3_scale(1 / length, ray->d);
    const double shift = -vec3_dot(ray->o, u);
    const struct march m = {j, vec3_mad(ray->o, shift, u), u};
    const double reach2 = j->radius * j->radius - vec3_dot(m.o, m.o);
    if (!(reach2 > 0))
        return;
    const double end = sqrt(reach2), error = GAMMA(32) * (fabs(shift) + j->radius);
    double t = fmax(-end, ray->t_min * length - shift), step = 0;
    if (!(t < end))
        return;
    bool in = in_at(&m, t, &step) && t > -end;
    while (t < end && limit > 0) {
        const double next = fmin(end, t + fmax(step, least));
        bool now = false;
        double ahead = 0;
        if (next < end)
            now = in_at(&m, next, &ahead);
        if (now != in) {
            double outer = next;
            const double at = next < end ? bisect(&m, t, next, in, &outer) : next;
            boundary_list_add(out, (at + shift) / length, error / length,
                              in ? CROSS_EXIT : CROSS_ENTER, normal_of(&m, at, in, outer));
            limit--;
        }
        in = now;
        t = next;
        step = now ? 0 : ahead;
    }
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    march(shape, ray, UINT32_MAX, out);
}

static bool closest(const void *shape, const struct ray *ray, struct boundary *out)
{
    struct boundary room[2];
    struct boundary_list l = {.at = room, .capacity = 2};
    march(shape, ray, 1, &l);
    if (l.count == 0 || !(room[0].t > ray->t_min && room[0].t < ray->t_max))
        return false;
    const uint32_t leaf = out->leaf;
    *out = room[0];
    out->leaf = leaf;
    return true;
}

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
    .closest = closest,
    .surface = surface,
    .print = print,
};
