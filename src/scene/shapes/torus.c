// torus { major, minor }: around the y axis
//
// With the origin moved to the point of the line nearest to the centre, a unit
// direction and lengths in units of R + r, the quartic has no cubic term:
// (t^2 + K)^2 = 4 R^2 (A t^2 + 2 B t + C), K = o.o + R^2 - r^2. Its roots are isolated
// on the chord of the bounding ball (research 4.7).
#include "scene/shapes/torus.h"

#include <math.h>

#include "math/elementary.h"
#include "math/gamma.h"
#include "math/pi.h"
#include "math/polynomial.h"
#include "scene/args.h"
#include "scene/shape.h"

static bool build(void *shape, struct args *args)
{
    struct torus *s = shape;
    if (!args_float(args, "major radius", &s->major) ||
        !args_float(args, "minor radius", &s->minor))
        return false;
    s->major = fabs(s->major);
    s->minor = fabs(s->minor);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct torus *s = shape;
    const double r = s->major + s->minor;
    return aabb_pad((struct aabb){vec3(-r, -s->minor, -r), vec3(r, s->minor, r)});
}

// A circle of radius R and a ball of radius r: their extents add up.
static struct aabb placed_bounds(const void *shape, const struct transform *t)
{
    const struct torus *s = shape;
    double e[3];
    for (int i = 0; i < 3; i++) {
        const double x = t->linear.m[0][i], y = t->linear.m[1][i], z = t->linear.m[2][i];
        e[i] = s->major * sqrt(x * x + z * z) + s->minor * sqrt(x * x + y * y + z * z);
    }
    return aabb_around(vec3(0, 0, 0), e, t);
}

// The quartic is the product of the two circles' functions. On a spindle torus (minor above
// major) the inner sheet, where the far circle's function vanishes, bounds a hollow: there
// both factors are negative.
static bool inside(const void *shape, struct vec3 p)
{
    const struct torus *s = shape;
    const double rho = sqrt(p.x * p.x + p.z * p.z), r2 = s->minor * s->minor;
    const double near = rho - s->major, far = rho + s->major, rest = p.y * p.y - r2;
    return near * near + rest <= 0 && far * far + rest >= 0;
}

// Whether a point of the surface is on the inner sheet, which ends where both sheets meet on
// the axis.
static bool on_inner_sheet(const struct torus *s, double rho, double y)
{
    const double half = s->minor * s->minor - y * y;
    return half > s->major * s->major && rho * rho < half;
}

// A root of the quartic brought closer by Newton's method on the distance to the tube,
// h = |(rho - R, y)| - r. The quartic's value is a product of h with lengths of the
// order of R, so a thin tube loses the digits of r/R in it; h loses none. h is wrong by
// `noise`, its second derivative at most 1/|(rho - R, y)| + 1/rho; where that leaves the
// slope in doubt (a graze) or the step leaves the bound (the inner sheet of a spindle
// torus, where h is not zero) the root stays as it is.
static void sharpen(struct vec3 o, struct vec3 u, double R, double r, double noise,
                    struct polynomial_root *root)
{
    double t = root->t, dt = root->dt;
    for (int i = 0; i < 3; i++) {
        const struct vec3 p = vec3_mad(o, t, u);
        const double rho = sqrt(p.x * p.x + p.z * p.z), w = rho - R;
        const double d = sqrt(w * w + p.y * p.y);
        const double h = d - r;
        const double slope = (w * (p.x * u.x + p.z * u.z) / rho + p.y * u.y) / d;
        const double bend = 1 / d + 1 / rho;
        if (!((noise + fabs(h)) * bend < 0.25 * slope * slope))
            return;
        t -= h / slope;
        dt = 2 * noise / fabs(slope);
        if (fabs(h) <= noise) // the next step would only move it within dt
            break;
    }
    if (fabs(t - root->t) <= 4 * root->dt && dt < root->dt) {
        root->t = t;
        root->dt = dt;
    }
}

// What a root may be off by because the coefficients are differences of numbers of the
// order of 1, of which little is left when the tube is thin.
static double coefficient_error(const double c[5], double t)
{
    const double error = GAMMA(128);
    const double slope = fabs(4 * t * t * t + 2 * c[2] * t + c[1]);
    const double curve = fabs(12 * t * t + 2 * c[2]);
    const double simple = 2 * error / slope, twofold = 2 * sqrt(2 * error / curve);
    return 2 * simple < twofold ? simple : 2 * twofold; // as polynomial_root_error
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct torus *s = shape;
    const double size = s->major + s->minor, length = vec3_length(ray->d);
    if (!(s->minor > 0)) // nothing, or a circle
        return;
    const struct vec3 u = vec3_scale(1 / length, ray->d);
    const double shift = -vec3_dot(ray->o, u);
    const struct vec3 o = vec3_scale(1 / size, vec3_mad(ray->o, shift, u));
    const double R = s->major / size, r = s->minor / size;
    const double oo = vec3_dot(o, o), reach = 1 - oo;
    if (!(reach > 0))
        return;
    // The chord of the ball, cut by the slab |y| <= r: wider by a share of the tube, as
    // nothing outside the torus changes the sign, and the quartic of a thin tube must be
    // clear of its rounding at the ends, or the outermost root is lost.
    const double chord = sqrt(reach) + TORUS_MARGIN * r + 0x1p-40;
    const double edge = r + TORUS_MARGIN * r + 0x1p-40;
    double lo = -chord, hi = chord;
    if (fabs(u.y) > 0x1p-20) {
        const double t0 = (-edge - o.y) / u.y, t1 = (edge - o.y) / u.y;
        lo = fmax(lo, fmin(t0, t1));
        hi = fmin(hi, fmax(t0, t1));
    } else if (fabs(o.y) > edge + 0x1p-19) {
        return;
    }
    if (!(lo < hi))
        return;
    const double k = oo + (R - r) * (R + r), q = 4 * R * R;
    // At t = 0 as the product of the two circles' terms, which keeps the digits.
    const double rho = sqrt(o.x * o.x + o.z * o.z), yr = (o.y - r) * (o.y + r);
    const double c[5] = {((rho - R) * (rho - R) + yr) * ((rho + R) * (rho + R) + yr),
                         -2 * q * (o.x * u.x + o.z * u.z),
                         2 * k - q * (u.x * u.x + u.z * u.z), 0, 1};
    struct polynomial_root root[4];
    const int n = polynomial_roots(c, 4, lo, hi, 8, root);
    const double noise = GAMMA(8) * (2 + fabs(shift) / size);
    double least = -HUGE_VAL; // sharpened apart, twins may have changed places
    for (int i = 0; i < n; i++) {
        root[i].dt += coefficient_error(c, root[i].t);
        sharpen(o, u, R, r, noise, &root[i]);
        const double t = fmax(least, size * root[i].t + shift);
        least = t;
        const double dt = size * root[i].dt + GAMMA(8) * (fabs(shift) + size);
        boundary_list_add(out, t / length, dt / length,
                          root[i].rising ? CROSS_EXIT : CROSS_ENTER, 0);
    }
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    const struct torus *s = shape;
    const double rho = sqrt(p.x * p.x + p.z * p.z);
    const double k = rho > 0 ? s->major / rho : 0;
    struct vec3 n = vec3(p.x - k * p.x, p.y, p.z - k * p.z);
    if (on_inner_sheet(s, rho, p.y)) // outward is into the hollow
        n = vec3(-p.x - k * p.x, -p.y, -p.z - k * p.z);
    if (vec3_dot(n, n) == 0)
        n = vec3(0, 1, 0);
    out->p = p;
    out->ng = out->ns = vec3_normalize(n);
    if (!out->want_uv)
        return;
    out->uv.u = 1 - (det_atan2(p.z, p.x) + PI) / (2 * PI);
    out->uv.v = (det_atan2(p.y, rho - s->major) + PI) / (2 * PI);
}

static void print(const void *shape, FILE *out)
{
    const struct torus *s = shape;
    fputs("torus { ", out);
    shape_print_number(out, s->major);
    fputs(", ", out);
    shape_print_number(out, s->minor);
}

const struct shape_ops torus_ops = {
    .keyword = "torus",
    .size = sizeof(struct torus),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_STURM | SHAPE_UV,
    .build = build,
    .bounds = bounds,
    .placed_bounds = placed_bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
