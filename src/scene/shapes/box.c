// box { corner, corner }

#include "scene/shapes/box.h"

#include "math/gamma.h"
#include "scene/args.h"
#include "scene/shape.h"

static void sort(double *a, double *b)
{
    if (*a > *b) {
        double c = *a;
        *a = *b;
        *b = c;
    }
}

static void sort_corners(struct box *b)
{
    sort(&b->min.x, &b->max.x);
    sort(&b->min.y, &b->max.y);
    sort(&b->min.z, &b->max.z);
}

static bool build(void *shape, struct args *args)
{
    struct box *b = shape;
    if (!args_vec3(args, "corner", &b->min) ||
        !args_vec3(args, "opposite corner", &b->max))
        return false;
    sort_corners(b);
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct box *b = shape;
    if (!transform_is_diagonal(t))
        return false;
    b->min = transform_point(t, b->min);
    b->max = transform_point(t, b->max);
    sort_corners(b);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct box *b = shape;
    return (struct aabb){b->min, b->max};
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct box *b = shape;
    return p.x >= b->min.x && p.x <= b->max.x && p.y >= b->min.y && p.y <= b->max.y &&
           p.z >= b->min.z && p.z <= b->max.z;
}

// The stretch of the ray between one pair of faces. Along the faces all of
// the line or none of it is between them, which are closed.
static void slab(double min, double max, double o, double d, double longest, double *t0,
                 double *t1)
{
    if (RUNS_ALONG(d, longest)) {
        bool in = o >= min && o <= max;
        *t0 = in ? -INFINITY : INFINITY;
        *t1 = -*t0;
        return;
    }
    double inv = 1 / d;
    double a = (min - o) * inv, b = (max - o) * inv;
    *t0 = a < b ? a : b;
    *t1 = a < b ? b : a;
}

// Per axis x, y, z: inv = 1/d, a = (min - o)*inv, b = (max - o)*inv; the entry is the
// largest of the lesser ones, the exit the least of the greater; a tie keeps the
// earlier axis. Closed: entry == exit is a hit.
//
// Error: face - o, inv and the product round once each; o and the faces themselves are
// taken to be known to a few roundings of the largest coordinate near by.
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct box *b = shape;
    const double o[3] = {ray->o.x, ray->o.y, ray->o.z};
    const double d[3] = {ray->d.x, ray->d.y, ray->d.z};
    const double min[3] = {b->min.x, b->min.y, b->min.z};
    const double max[3] = {b->max.x, b->max.y, b->max.z};
    const double longest = vec3_max_abs(ray->d);
    double entry, leave;
    int entry_axis = 0, leave_axis = 0;
    slab(min[0], max[0], o[0], d[0], longest, &entry, &leave);
    for (int i = 1; i < 3; i++) {
        double t0, t1;
        slab(min[i], max[i], o[i], d[i], longest, &t0, &t1);
        if (t0 > entry) {
            entry = t0;
            entry_axis = i;
        }
        if (t1 < leave) {
            leave = t1;
            leave_axis = i;
        }
    }
    if (!(entry <= leave) || entry == -INFINITY)
        return;
    const double size =
        vec3_max_abs(ray->o) + fmax(vec3_max_abs(b->min), vec3_max_abs(b->max));
    boundary_list_add(out, entry, GAMMA(12) * size / fabs(d[entry_axis]), CROSS_ENTER,
                      (uint32_t)(2 * entry_axis + (d[entry_axis] < 0)));
    boundary_list_add(out, leave, GAMMA(12) * size / fabs(d[leave_axis]), CROSS_EXIT,
                      (uint32_t)(2 * leave_axis + (d[leave_axis] > 0)));
}

static double fraction(double p, double min, double max)
{
    return max > min ? (p - min) / (max - min) : 0;
}

// part: 2*axis, +1 for the face at max. uv: an unfolded cross (spec/shapes 5.1).
static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct box *box = shape;
    const double x = fraction(p.x, box->min.x, box->max.x);
    const double y = fraction(p.y, box->min.y, box->max.y);
    const double z = fraction(p.z, box->min.z, box->max.z);
    out->p = p;
    switch (b->part) {
    case 0:
        out->p.x = box->min.x;
        out->ng = vec3(-1, 0, 0);
        out->uv = (struct vec2){z / 4, (1 + y) / 3};
        break;
    case 1:
        out->p.x = box->max.x;
        out->ng = vec3(1, 0, 0);
        out->uv = (struct vec2){0.75 - z / 4, (1 + y) / 3};
        break;
    case 2:
        out->p.y = box->min.y;
        out->ng = vec3(0, -1, 0);
        out->uv = (struct vec2){(1 + x) / 4, z / 3};
        break;
    case 3:
        out->p.y = box->max.y;
        out->ng = vec3(0, 1, 0);
        out->uv = (struct vec2){(1 + x) / 4, 1 - z / 3};
        break;
    case 4:
        out->p.z = box->min.z;
        out->ng = vec3(0, 0, -1);
        out->uv = (struct vec2){1 - x / 4, (1 + y) / 3};
        break;
    default:
        out->p.z = box->max.z;
        out->ng = vec3(0, 0, 1);
        out->uv = (struct vec2){(1 + x) / 4, (1 + y) / 3};
        break;
    }
    out->ns = out->ng;
}

static void print(const void *shape, FILE *out)
{
    const struct box *b = shape;
    fputs("box { ", out);
    shape_print_vec3(out, b->min);
    fputs(", ", out);
    shape_print_vec3(out, b->max);
}

const struct shape_ops box_ops = {
    .keyword = "box",
    .size = sizeof(struct box),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_BOUNDED | SHAPE_CONVEX | SHAPE_UV,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
