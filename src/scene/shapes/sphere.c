// sphere { centre, radius }

#include "scene/shapes/sphere.h"

#include "math/elementary.h"
#include "math/gamma.h"
#include "math/pi.h"
#include "math/quadratic.h"
#include "scene/args.h"
#include "scene/shape.h"

static bool build(void *shape, struct args *args)
{
    struct sphere *s = shape;
    if (!args_vec3(args, "centre", &s->centre) || !args_float(args, "radius", &s->radius))
        return false;
    s->radius = fabs(s->radius);
    s->to_uv = transform_identity.linear;
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct sphere *s = shape;
    double scale;
    if (!transform_is_similarity(t, &scale))
        return false;
    s->centre = transform_point(t, s->centre);
    s->radius *= scale;
    struct mat3 m;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            m.m[i][j] = t->inverse.m[i][0] * s->to_uv.m[0][j] +
                        t->inverse.m[i][1] * s->to_uv.m[1][j] +
                        t->inverse.m[i][2] * s->to_uv.m[2][j];
    s->to_uv = m;
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct sphere *s = shape;
    const struct vec3 r = vec3(s->radius, s->radius, s->radius);
    return (struct aabb){vec3_sub(s->centre, r), vec3_add(s->centre, r)};
}

static struct aabb placed_bounds(const void *shape, const struct transform *t)
{
    const struct sphere *s = shape;
    double e[3];
    for (int i = 0; i < 3; i++) {
        const double x = t->linear.m[0][i], y = t->linear.m[1][i], z = t->linear.m[2][i];
        e[i] = s->radius * sqrt(x * x + y * y + z * z);
    }
    return aabb_around(s->centre, e, t);
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct sphere *s = shape;
    const struct vec3 d = vec3_sub(p, s->centre);
    return vec3_dot(d, d) <= s->radius * s->radius;
}

// oc = o - centre, a = d.d, s = (d.oc)/a, near = oc - s*d, rest = r*r - near.near,
// reach = sqrt(rest/a), t = -s -+ reach. The squared distance from the centre to the
// line, rather than b*b - a*c, keeps the digits when the ray starts far from a small
// sphere (research 4.6; Haines et al., Ray Tracing Gems ch. 7).
//
// Error: the point near is known to e_p (roundings of o, the centre and s*d), so rest
// is wrong by 2*r*e_p + e_p^2 and the rounding of its squares, and t by e_p/|d| plus
// the error of the root.
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct sphere *sphere = shape;
    const struct vec3 oc = vec3_sub(ray->o, sphere->centre);
    const double r = sphere->radius;
    const double a = vec3_dot(ray->d, ray->d);
    const double s = vec3_dot(ray->d, oc) / a;
    const struct vec3 near = vec3_mad(oc, -s, ray->d);
    const double rest = r * r - vec3_dot(near, near);
    if (!(rest > 0))
        return;
    const double reach = sqrt(rest / a);
    const double e_p = GAMMA(8) * (vec3_max_abs(oc) + vec3_max_abs(sphere->centre) + r);
    const double dt = (e_p + sqrt_error(rest, e_p * (4 * r + 2 * e_p))) / sqrt(a);
    boundary_list_add(out, -s - reach, dt, CROSS_ENTER, 0);
    boundary_list_add(out, -s + reach, dt, CROSS_EXIT, 0);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    const struct sphere *s = shape;
    const struct vec3 n = vec3_normalize(vec3_sub(p, s->centre));
    out->p = vec3_mad(s->centre, s->radius, n);
    out->ng = out->ns = n;
    if (!out->want_uv)
        return;
    const struct mat3 *m = &s->to_uv;
    const double x = n.x * m->m[0][0] + n.y * m->m[1][0] + n.z * m->m[2][0];
    const double y = n.x * m->m[0][1] + n.y * m->m[1][1] + n.z * m->m[2][1];
    const double z = n.x * m->m[0][2] + n.y * m->m[1][2] + n.z * m->m[2][2];
    const double turn = x == 0 && z == 0 ? 0 : det_atan2(z, x) / (2 * PI);
    const double sine = y / sqrt(x * x + y * y + z * z);
    out->uv.u = turn < 0 ? turn + 1 : turn;
    out->uv.v = 0.5 + det_asin(fmax(-1, fmin(1, sine))) / PI;
}

static void print(const void *shape, FILE *out)
{
    const struct sphere *s = shape;
    fputs("sphere { ", out);
    shape_print_vec3(out, s->centre);
    fputs(", ", out);
    shape_print_number(out, s->radius);
}

const struct shape_ops sphere_ops = {
    .keyword = "sphere",
    .size = sizeof(struct sphere),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_CONVEX | SHAPE_UV,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .placed_bounds = placed_bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
