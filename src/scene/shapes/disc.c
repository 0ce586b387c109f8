// disc { centre, normal, radius [, hole] }
//
// In CSG a disc is the whole half space opposite to its normal; only the disc is seen.

#include "scene/shapes/disc.h"

#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"

static bool build(void *shape, struct args *args)
{
    struct disc *s = shape;
    struct span where = args_where(args);
    struct vec3 n;
    if (!args_vec3(args, "centre", &s->centre) || !args_vec3(args, "normal", &n) ||
        !args_float(args, "radius", &s->radius) ||
        (args_at_number(args) && !args_float(args, "radius of the hole", &s->hole)))
        return false;
    if (vec3_dot(n, n) == 0) {
        diag_at(args_diags(args), DIAG_NORMAL_ZERO, where, args_owner(args));
        return false;
    }
    s->normal = vec3_normalize(n);
    s->radius = fabs(s->radius);
    s->hole = fabs(s->hole);
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct disc *s = shape;
    double scale;
    if (!transform_is_similarity(t, &scale))
        return false;
    s->centre = transform_point(t, s->centre);
    s->normal = vec3_normalize(transform_normal(t, s->normal));
    s->radius *= scale;
    s->hole *= scale;
    return true;
}

static struct aabb bounds(const void *shape)
{
    (void)shape;
    return aabb_infinite();
}

static struct aabb surface_bounds(const void *shape)
{
    const struct disc *s = shape;
    const struct vec3 n = s->normal;
    const struct vec3 e = vec3(s->radius * sqrt(fmax(0, 1 - n.x * n.x)),
                               s->radius * sqrt(fmax(0, 1 - n.y * n.y)),
                               s->radius * sqrt(fmax(0, 1 - n.z * n.z)));
    return aabb_pad((struct aabb){vec3_sub(s->centre, e), vec3_add(s->centre, e)});
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct disc *s = shape;
    return vec3_dot(s->normal, vec3_sub(p, s->centre)) <= 0;
}

// down = n.d, t = (n.(centre - o)) / down; q = o + t d - centre, drawn when
// hole^2 <= q.q <= radius^2.
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct disc *s = shape;
    const double down = vec3_dot(s->normal, ray->d);
    if (RUNS_ALONG(down, vec3_max_abs(ray->d)))
        return;
    const struct vec3 to = vec3_sub(s->centre, ray->o);
    const double t = vec3_dot(s->normal, to) / down;
    const struct vec3 q = vec3_sub(vec3_scale(t, ray->d), to);
    const double d2 = vec3_dot(q, q);
    const double size =
        vec3_max_abs(ray->o) + vec3_max_abs(s->centre) + fabs(t) * vec3_max_abs(ray->d);
    struct boundary *b = boundary_list_add(out, t, GAMMA(12) * size / fabs(down),
                                           down < 0 ? CROSS_ENTER : CROSS_EXIT, 0);
    b->drawn = d2 <= s->radius * s->radius && d2 >= s->hole * s->hole;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    const struct disc *s = shape;
    const double off = vec3_dot(s->normal, vec3_sub(p, s->centre));
    out->p = vec3_mad(p, -off, s->normal);
    out->ng = out->ns = s->normal;
}

static void print(const void *shape, FILE *out)
{
    const struct disc *s = shape;
    fputs("disc { ", out);
    shape_print_vec3(out, s->centre);
    fputs(", ", out);
    shape_print_vec3(out, s->normal);
    fputs(", ", out);
    shape_print_number(out, s->radius);
    fputs(", ", out);
    shape_print_number(out, s->hole);
}

const struct shape_ops disc_ops = {
    .keyword = "disc",
    .size = sizeof(struct disc),
    .flags = SHAPE_SOLID | SHAPE_FLAT,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .surface_bounds = surface_bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
