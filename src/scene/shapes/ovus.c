// ovus { Rb, Rt }: an egg. A ball of radius Rb about the origin below, a ball of radius Rt
// about <0, Rb, 0> above, and between the heights where they touch it the arc of a spindle
// torus (spec/shapes.md 4.23).
//
// All three parts are (rho + H)^2 + (y - V)^2 = R^2 with their own H >= 0, V and R, and the
// egg is convex, so along a line the distance sqrt((rho + H)^2 + (y - V)^2) - R is a convex
// function: Newton's method from outside meets its roots one-sidedly and none is missed.
#include <math.h>

#include "math/elementary.h"
#include "math/gamma.h"
#include "math/pi.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/ovus.h"

static void make_parts(struct ovus *s)
{
    const double b = s->bottom, t = s->top;
    double r, v, h;
    s->part[OVUS_TOP] = (struct ovus_part){0, b, t};
    s->part[OVUS_BOTTOM] = (struct ovus_part){0, 0, b};
    if (t >= 2 * b) { // the upper ball holds the lower one
        s->part[OVUS_BOTTOM] = s->part[OVUS_ARC] = s->part[OVUS_TOP];
        s->joint[0] = s->joint[1] = b;
        return;
    }
    if (b > t) {
        r = 2 * b;
        v = 2 * t - b - t * t / (2 * b);
        h = sqrt(fmax(0, (b - v) * (b + v)));
        s->joint[0] = -v;
        s->joint[1] = (b - v) * t / (r - t) + b;
    } else {
        r = 2 * t;
        v = -2 * t + b + 1.5 * t * t / b;
        h = sqrt(fmax(0, (t - (v - b)) * (t + (v - b))));
        s->joint[0] = -v * b / (r - b);
        s->joint[1] = 2 * b - v;
    }
    s->part[OVUS_ARC] = (struct ovus_part){h, v, r};
}

static struct aabb bounds(const void *shape)
{
    const struct ovus *s = shape;
    const struct ovus_part *arc = &s->part[OVUS_ARC];
    double r = fmax(s->part[OVUS_BOTTOM].r, s->top);
    if (arc->v >= s->joint[0] && arc->v <= s->joint[1]) // the widest place is on the arc
        r = fmax(r, arc->r - arc->h);
    const double low =
        fmin(-s->part[OVUS_BOTTOM].r + s->part[OVUS_BOTTOM].v, s->bottom - s->top);
    return aabb_pad((struct aabb){vec3(-r, low, -r), vec3(r, s->bottom + s->top, r)});
}

// The ball over the egg's height, as wide as its widest part needs.
static void make_ball(struct ovus *s)
{
    const struct aabb b = bounds(s);
    s->around.y = 0.5 * (b.min.y + b.max.y);
    const double tall = 0.5 * (b.max.y - b.min.y);
    s->around.r = sqrt(tall * tall + b.max.x * b.max.x) * (1 + 0x1p-40);
}

static bool build(void *shape, struct args *args)
{
    struct ovus *s = shape;
    if (!args_float(args, "bottom radius", &s->bottom) ||
        !args_float(args, "top radius", &s->top))
        return false;
    if (s->bottom < 0 || s->top < 0) {
        args_reject(args, "a radius is negative");
        return false;
    }
    if (s->top >= 2 * s->bottom)
        args_warn(args,
                  "the top radius is at least twice the bottom radius: the ovus is a "
                  "sphere");
    make_parts(s);
    make_ball(s);
    return true;
}

static int part_at(const struct ovus *s, double y)
{
    return y < s->joint[0] ? OVUS_BOTTOM : y > s->joint[1] ? OVUS_TOP : OVUS_ARC;
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct ovus *s = shape;
    const struct ovus_part *k = &s->part[part_at(s, p.y)];
    const double q = sqrt(p.x * p.x + p.z * p.z) + k->h, w = p.y - k->v;
    return q * q + w * w < k->r * k->r;
}

// A line of unit direction.
struct line {
    struct vec3 o, d;
    double noise; // bound on the error of the distance
};

static double distance(const struct line *l, const struct ovus_part *k, double t,
                       double *slope)
{
    const struct vec3 p = vec3_mad(l->o, t, l->d);
    const double rho = sqrt(p.x * p.x + p.z * p.z), q = rho + k->h, w = p.y - k->v;
    const double d = sqrt(q * q + w * w);
    const double out = rho > 0 ? (p.x * l->d.x + p.z * l->d.z) / rho : 0;
    *slope = d > 0 ? (q * out + w * l->d.y) / d : 0;
    return d - k->r;
}

// From t, outside, towards `to`: the first root, or false.
static bool approach(const struct line *l, const struct ovus_part *k, double t, double to,
                     double *root, double *slope)
{
    const double way = to > t ? 1 : -1;
    for (int i = 0; i < 100; i++) {
        const double g = distance(l, k, t, slope);
        if (g <= l->noise) {
            *root = t;
            return true;
        }
        if (!(*slope * way < 0))
            return false;
        const double next = t - g / *slope;
        if (!((to - next) * way >= 0))
            return false;
        if (next == t) {
            *root = t;
            return true;
        }
        t = next;
    }
    *root = t; // a graze: the steps only halve, and are below the noise long ago
    return true;
}

// What lies inside of one part between the parameters a and b.
struct stretch {
    double lo, hi, lo_slope, hi_slope;
    bool any;
};

static void add_part(const struct line *l, const struct ovus_part *k, double a, double b,
                     struct stretch *s)
{
    double slope_a, slope_b, lo = a, hi = b;
    if (!(a < b))
        return;
    const bool out_a = distance(l, k, a, &slope_a) > 0;
    const bool out_b = distance(l, k, b, &slope_b) > 0;
    if (out_a && !approach(l, k, a, b, &lo, &slope_a))
        return;
    if (out_b && !approach(l, k, b, lo, &hi, &slope_b))
        hi = lo;
    if (!s->any || lo < s->lo) {
        s->lo = lo;
        s->lo_slope = slope_a;
    }
    if (!s->any || hi > s->hi) {
        s->hi = hi;
        s->hi_slope = slope_b;
    }
    s->any = true;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct ovus *s = shape;
    const double size = fmax(s->bottom + s->top, 2 * s->top);
    const double length = vec3_length(ray->d);
    const struct vec3 u = vec3_scale(1 / length, ray->d);
    const struct vec3 middle = vec3(0, s->around.y, 0);
    const double shift = vec3_dot(vec3_sub(middle, ray->o), u);
    const struct line l = {vec3_mad(ray->o, shift, u), u,
                           GAMMA(8) * (2 * size + fabs(shift))};
    const struct vec3 off = vec3_sub(l.o, middle);
    const double reach2 = s->around.r * s->around.r - vec3_dot(off, off);
    if (!(reach2 > 0))
        return;
    const double reach = sqrt(reach2);
    double stop[4] = {-reach, reach, reach, reach};
    int first = part_at(s, l.o.y), step = 0, n = 1;
    if (!RUNS_ALONG(u.y, 1)) {
        const double t0 = (s->joint[0] - l.o.y) / u.y, t1 = (s->joint[1] - l.o.y) / u.y;
        stop[1] = fmax(-reach, fmin(reach, fmin(t0, t1)));
        stop[2] = fmax(-reach, fmin(reach, fmax(t0, t1)));
        first = u.y > 0 ? OVUS_BOTTOM : OVUS_TOP;
        step = u.y > 0 ? 1 : -1;
        n = OVUS_PARTS;
    }
    struct stretch in = {.any = false};
    for (int i = 0; i < n; i++)
        add_part(&l, &s->part[first + i * step], stop[i], stop[i + 1], &in);
    if (!in.any)
        return;
    for (int i = 0; i < 2; i++) {
        // Along a graze the surface bends away by at least 1/R: t is off by sqrt(2 R noise).
        const double slope = fabs(i ? in.hi_slope : in.lo_slope);
        const double dt = fmin(2 * l.noise / slope, 2 * sqrt(2 * l.noise * 2 * size));
        boundary_list_add(out, ((i ? in.hi : in.lo) + shift) / length,
                          (dt + GAMMA(4) * fabs(shift)) / length,
                          i ? CROSS_EXIT : CROSS_ENTER, 0);
    }
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    (void)any;
    return k->ovus(shape, rays, lanes, out);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    const struct ovus *s = shape;
    const struct ovus_part *k = &s->part[part_at(s, p.y)];
    const double rho = sqrt(p.x * p.x + p.z * p.z),
                 grow = rho > 0 ? (rho + k->h) / rho : 0;
    const struct vec3 n = vec3_normalize(vec3(grow * p.x, p.y - k->v, grow * p.z));
    out->p = p;
    out->ng = out->ns = vec3_dot(n, n) > 0 ? n : vec3(0, 1, 0);
    if (!out->want_uv)
        return;
    const struct vec3 q = vec3_normalize(vec3(p.x, p.y - 0.5 * s->top, p.z));
    const double turn = rho > 0 ? det_atan2(p.z, p.x) / (2 * PI) : 0;
    out->uv.u = turn < 0 ? turn + 1 : turn;
    out->uv.v = 0.5 + det_atan2(q.y, sqrt(q.x * q.x + q.z * q.z)) / PI;
}

static void print(const void *shape, FILE *out)
{
    const struct ovus *s = shape;
    fputs("ovus { ", out);
    shape_print_number(out, s->bottom);
    fputs(", ", out);
    shape_print_number(out, s->top);
}

const struct shape_ops ovus_ops = {
    .keyword = "ovus",
    .size = sizeof(struct ovus),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_STURM | SHAPE_UV | SHAPE_CONVEX |
             SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .surface = surface,
    .print = print,
};
