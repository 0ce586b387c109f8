// sor { n, <r, h>, ... [open] }: r^2 is a cubic of the height between the points.

#include "base/arena.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/revolve.h"

struct sor {
    struct revolve revolve;
    const struct vec2 *point;
    long count;
};

// r^2 with values and slopes (per height) at both ends, as a cubic in w = (h - h1)/(h2 - h1).
static void make_segment(const struct vec2 *p, struct revolve_segment *s)
{
    const double dh = p[2].v - p[1].v, y0 = p[1].u * p[1].u, y1 = p[2].u * p[2].u;
    const double m0 = dh * 2 * p[1].u * (p[2].u - p[0].u) / (p[2].v - p[0].v);
    const double m1 = dh * 2 * p[2].u * (p[3].u - p[1].u) / (p[3].v - p[1].v);
    s->h_degree = 1;
    s->h[0] = p[1].v;
    s->h[1] = dh;
    s->r2_degree = 3;
    s->r2[0] = y0;
    s->r2[1] = m0;
    s->r2[2] = 3 * (y1 - y0) - 2 * m0 - m1;
    s->r2[3] = 2 * (y0 - y1) + m0 + m1;
    s->h_end[0] = p[1].v;
    s->h_end[1] = p[2].v;
    s->r2_end[0] = y0;
    s->r2_end[1] = y1;
}

static bool check_points(const struct sor *s, struct args *args)
{
    const struct vec2 *p = s->point;
    for (long i = 0; i < s->count; i++) {
        bool falls = i >= 2 && i <= s->count - 2 && !(p[i].v > p[i - 1].v);
        bool flat = i >= 2 && p[i].v == p[i - 2].v;
        if (p[i].u < 0 || falls || flat) {
            args_reject(args, p[i].u < 0 ? "a radius is negative"
                                         : "the heights of the points must rise");
            return false;
        }
    }
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct sor *s = shape;
    if (!args_int(args, "number of points", &s->count))
        return false;
    if (s->count < 4) {
        args_reject(args, "at least four points are needed");
        return false;
    }
    struct vec2 *p = arena_new_array(args_arena(args), struct vec2, (size_t)s->count);
    s->point = p;
    for (long i = 0; i < s->count; i++)
        if (!args_vec2(args, "point", &p[i]))
            return false;
    if (!check_points(s, args))
        return false;
    s->revolve.caps_drawn = !args_word(args, "open");
    s->revolve.count = (uint32_t)s->count - 3;
    struct revolve_segment *g =
        arena_new_array(args_arena(args), struct revolve_segment, s->revolve.count);
    for (uint32_t i = 0; i < s->revolve.count; i++)
        make_segment(p + i, &g[i]);
    s->revolve.segment = g;
    revolve_prepare(&s->revolve, args_arena(args));
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct sor *s = shape;
    return revolve_bounds(&s->revolve);
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct sor *s = shape;
    return revolve_inside(&s->revolve, p);
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct sor *s = shape;
    revolve_intersect(&s->revolve, ray, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return revolve_closest8(k, &sor_ops, shape, rays, lanes, any, out);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct sor *s = shape;
    revolve_surface(&s->revolve, b, p, out);
}

static void print(const void *shape, FILE *out)
{
    const struct sor *s = shape;
    fprintf(out, "sor { %ld", s->count);
    for (long i = 0; i < s->count; i++) {
        fputs(", ", out);
        shape_print_vec2(out, s->point[i]);
    }
    if (!s->revolve.caps_drawn)
        fputs(" open", out);
}

const struct shape_ops sor_ops = {
    .keyword = "sor",
    .size = sizeof(struct sor),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_BOUNDED | SHAPE_STURM | SHAPE_UV |
             SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .surface = surface,
    .print = print,
};
