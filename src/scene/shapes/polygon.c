// polygon { n, point ... }: loops in one plane, each closed by repeating its first point

#include <math.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shapes/polygon.h"

// Points closer than this, relative to the polygon's coordinates, are the same; points
// farther from the plane than the second are not in it (spec/shapes 4.18).
static const double same_point = 1e-10, off_plane = 1e-6;

static double size_of(const struct polygon *s)
{
    double size = 0;
    for (uint32_t i = 0; i < s->count; i++)
        size = fmax(size, vec3_max_abs(s->point[i]));
    return size;
}

// Marks the ends of loops; an open last loop gets its first point again.
static void close_loops(struct polygon *s, struct args *args)
{
    const double near = same_point * size_of(s);
    uint32_t first = 0;
    for (uint32_t i = 1; i < s->count; i++)
        if (i > first && vec3_length(vec3_sub(s->point[i], s->point[first])) <= near) {
            s->point[i] = s->point[first];
            s->last[i] = true;
            first = i + 1;
        }
    if (first < s->count) {
        args_warn(args, "the polygon is not closed; closed it");
        s->point[s->count] = s->point[first];
        s->last[s->count++] = true;
    }
}

// The plane through the first three points that span one.
static bool find_plane(struct polygon *s)
{
    const double size = size_of(s), near = same_point * size;
    struct vec3 a = {0, 0, 0}, n = {0, 0, 0};
    s->origin = s->point[0];
    for (uint32_t i = 1; i < s->count; i++) {
        const struct vec3 b = vec3_sub(s->point[i], s->origin);
        if (vec3_length(a) <= near) {
            a = b;
            continue;
        }
        n = vec3_cross(a, b);
        if (vec3_length(n) > near * size)
            break;
    }
    if (!(vec3_length(n) > near * size))
        return false;
    s->normal = vec3_normalize(n);
    for (uint32_t i = 0; i < s->count; i++)
        if (fabs(vec3_dot(s->normal, vec3_sub(s->point[i], s->origin))) >
            off_plane * size)
            return false;
    return true;
}

static void choose_axes(struct polygon *s)
{
    const double x = fabs(s->normal.x), y = fabs(s->normal.y), z = fabs(s->normal.z);
    const int k = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    s->u = (k + 1) % 3;
    s->v = (k + 2) % 3;
}

static bool build(void *shape, struct args *args)
{
    struct polygon *s = shape;
    long n;
    if (!args_int(args, "number of points", &n))
        return false;
    if (n < 3) {
        args_reject(args, "a polygon needs three points");
        return false;
    }
    s->point = arena_new_array(args_arena(args), struct vec3, (size_t)n + 1);
    s->last = arena_new_array(args_arena(args), bool, (size_t)n + 1);
    for (; s->count < (uint32_t)n; s->count++)
        if (!args_vec3(args, "point", &s->point[s->count]))
            return false;
    close_loops(s, args);
    s->drawn = find_plane(s);
    if (!s->drawn)
        args_warn(args, "the points do not lie in one plane; it is not drawn");
    choose_axes(s);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct polygon *s = shape;
    struct aabb b = aabb_empty();
    for (uint32_t i = 0; i < s->count; i++)
        b = aabb_add(b, s->point[i]);
    return aabb_pad(b);
}

static bool inside(const void *shape, struct vec3 p)
{
    (void)shape;
    (void)p;
    return false;
}

// Even-odd over all loops; an edge holds its lower end and not its upper one, so that a
// corner counts once.
static bool covers(const struct polygon *s, struct vec3 p)
{
    const double pu = vec3_axis(p, s->u), pv = vec3_axis(p, s->v);
    bool in = false;
    for (uint32_t i = 0; i + 1 < s->count; i++) {
        if (s->last[i])
            continue;
        const double av = vec3_axis(s->point[i], s->v);
        const double bv = vec3_axis(s->point[i + 1], s->v);
        if ((av > pv) == (bv > pv))
            continue;
        const double au = vec3_axis(s->point[i], s->u);
        const double bu = vec3_axis(s->point[i + 1], s->u);
        in ^= pu < au + (pv - av) / (bv - av) * (bu - au);
    }
    return in;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct polygon *s = shape;
    const double down = vec3_dot(s->normal, ray->d);
    const double t = vec3_dot(s->normal, vec3_sub(s->origin, ray->o)) / down;
    if (!s->drawn || !isfinite(t) || !covers(s, ray_at(ray, t)))
        return;
    const double size =
        vec3_max_abs(ray->o) + vec3_max_abs(s->origin) + fabs(t) * vec3_max_abs(ray->d);
    boundary_list_add(out, t, GAMMA(12) * size / fabs(down), CROSS_TOUCH, 0);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    (void)any;
    return k->polygon(shape, rays, lanes, out);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    const struct polygon *s = shape;
    out->p = vec3_mad(p, -vec3_dot(s->normal, vec3_sub(p, s->origin)), s->normal);
    out->ng = out->ns = s->normal;
}

static void print(const void *shape, FILE *out)
{
    const struct polygon *s = shape;
    fprintf(out, "polygon { %u", (unsigned)s->count);
    for (uint32_t i = 0; i < s->count; i++) {
        fputs(", ", out);
        shape_print_vec3(out, s->point[i]);
    }
}

const struct shape_ops polygon_ops = {
    .keyword = "polygon",
    .size = sizeof(struct polygon),
    .flags = SHAPE_BOUNDED | SHAPE_FLAT,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .surface = surface,
    .print = print,
};
