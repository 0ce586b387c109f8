// plane { normal, distance }: the half space below a plane

#include "scene/shapes/plane.h"

#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"

static bool build(void *shape, struct args *args)
{
    struct plane *p = shape;
    struct span where = args_where(args);
    struct vec3 n;
    double d;
    if (!args_vec3(args, "normal", &n) || !args_float(args, "distance", &d))
        return false;
    if (vec3_dot(n, n) == 0) {
        diag_at(args_diags(args), DIAG_NORMAL_ZERO, where, args_owner(args));
        return false;
    }
    p->normal = vec3_normalize(n);
    p->point = vec3_scale(d, p->normal);
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct plane *p = shape;
    p->normal = vec3_normalize(transform_normal(t, p->normal));
    p->point = transform_point(t, p->point);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct plane *p = shape;
    struct aabb b = aabb_infinite();
    const struct vec3 n = p->normal;
    if (n.y == 0 && n.z == 0)
        *(n.x > 0 ? &b.max.x : &b.min.x) = p->point.x;
    else if (n.x == 0 && n.z == 0)
        *(n.y > 0 ? &b.max.y : &b.min.y) = p->point.y;
    else if (n.x == 0 && n.y == 0)
        *(n.z > 0 ? &b.max.z : &b.min.z) = p->point.z;
    return b;
}

static bool inside(const void *shape, struct vec3 at)
{
    const struct plane *p = shape;
    return vec3_dot(p->normal, vec3_sub(at, p->point)) <= 0;
}

// down = n.d, t = (n.(point - o)) / down; none along the plane. Entering when
// down < 0. The difference point - o comes first, so that a plane far from the origin
// but near the ray keeps its digits.
//
// Error: the distance is known to a few roundings of o and point, and the direction
// to a few of its own, which counts |t| times.
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct plane *p = shape;
    const double down = vec3_dot(p->normal, ray->d);
    if (RUNS_ALONG(down, vec3_max_abs(ray->d)))
        return;
    const double t = vec3_dot(p->normal, vec3_sub(p->point, ray->o)) / down;
    const double size =
        vec3_max_abs(ray->o) + vec3_max_abs(p->point) + fabs(t) * vec3_max_abs(ray->d);
    boundary_list_add(out, t, GAMMA(12) * size / fabs(down),
                      down < 0 ? CROSS_ENTER : CROSS_EXIT, 0);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 at,
                    struct surface_point *out)
{
    (void)b;
    const struct plane *p = shape;
    const double off = vec3_dot(p->normal, vec3_sub(at, p->point));
    out->p = vec3_mad(at, -off, p->normal);
    out->ng = out->ns = p->normal;
}

static void print(const void *shape, FILE *out)
{
    const struct plane *p = shape;
    fputs("plane { ", out);
    shape_print_vec3(out, p->normal);
    fputs(", ", out);
    shape_print_number(out, vec3_dot(p->normal, p->point));
}

const struct shape_ops plane_ops = {
    .keyword = "plane",
    .size = sizeof(struct plane),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_CONVEX,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
