// lathe { [linear|quadratic|cubic|bezier]_spline n, <r, h>, ... }

#include "base/arena.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/revolve.h"

enum spline { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_BEZIER };

struct lathe {
    struct revolve revolve;
    enum spline spline;
    const struct vec2 *point; // radius, height
    long count;
};

static const char *const spline_word[] = {"linear_spline", "quadratic_spline",
                                          "cubic_spline", "bezier_spline"};

// One coordinate of a segment in ascending powers of w (spec/shapes.md 4.9).
static int coefficients(enum spline spline, const double p[4], double c[4])
{
    switch (spline) {
    case SPLINE_LINEAR:
        c[0] = p[0];
        c[1] = p[1] - p[0];
        return 1;
    case SPLINE_QUADRATIC:
        c[0] = p[1];
        c[1] = (p[2] - p[0]) / 2;
        c[2] = (p[0] - 2 * p[1] + p[2]) / 2;
        return 2;
    case SPLINE_CUBIC:
        c[0] = p[1];
        c[1] = (p[2] - p[0]) / 2;
        c[2] = p[0] - 2.5 * p[1] + 2 * p[2] - p[3] / 2;
        c[3] = (-p[0] + 3 * p[1] - 3 * p[2] + p[3]) / 2;
        return 3;
    case SPLINE_BEZIER:
        c[0] = p[0];
        c[1] = 3 * (p[1] - p[0]);
        c[2] = 3 * (p[2] - 2 * p[1] + p[0]);
        c[3] = p[3] - p[0] + 3 * (p[1] - p[2]);
        return 3;
    }
    return 0;
}

static void make_segment(const struct lathe *l, const struct vec2 *p, int points, int a,
                         int b, struct revolve_segment *s)
{
    double r[4] = {0}, h[4] = {0}, c[4];
    for (int i = 0; i < points; i++) {
        r[i] = p[i].u;
        h[i] = p[i].v;
    }
    s->h_degree = coefficients(l->spline, h, s->h);
    const int n = coefficients(l->spline, r, c);
    s->r2_degree = 2 * n;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= n; j++)
            s->r2[i + j] += c[i] * c[j];
    s->h_end[0] = p[a].v;
    s->h_end[1] = p[b].v;
    s->r2_end[0] = p[a].u * p[a].u;
    s->r2_end[1] = p[b].u * p[b].u;
}

static bool read_points(struct lathe *l, struct args *args)
{
    static const long least[] = {2, 3, 4, 4};
    static const char *const too_few[] = {
        "a linear_spline takes 2 points or more",
        "a quadratic_spline takes 3 points or more",
        "a cubic_spline takes 4 points or more",
        "a bezier_spline takes 4 points for each of its pieces"};
    for (int i = 0; i < 4; i++)
        if (args_word(args, spline_word[i]))
            l->spline = (enum spline)i;
    if (!args_int(args, "number of points", &l->count))
        return false;
    if (l->count < least[l->spline] || (l->spline == SPLINE_BEZIER && l->count % 4)) {
        args_reject(args, too_few[l->spline]);
        return false;
    }
    struct vec2 *p = arena_new_array(args_arena(args), struct vec2, (size_t)l->count);
    l->point = p;
    for (long i = 0; i < l->count; i++) {
        if (!args_vec2(args, "point", &p[i]))
            return false;
        if (p[i].u < 0 && i > 0 && i < l->count - 1) {
            args_reject(args, "a radius is negative");
            return false;
        }
    }
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct lathe *l = shape;
    if (!read_points(l, args))
        return false;
    const long n =
        l->spline == SPLINE_BEZIER ? l->count / 4 : l->count - 1 - (long)l->spline;
    struct revolve_segment *s =
        arena_new_array(args_arena(args), struct revolve_segment, (size_t)n);
    for (long i = 0; i < n; i++) {
        if (l->spline == SPLINE_BEZIER)
            make_segment(l, l->point + 4 * i, 4, 0, 3, &s[i]);
        else if (l->spline == SPLINE_LINEAR)
            make_segment(l, l->point + i, 2, 0, 1, &s[i]);
        else
            make_segment(l, l->point + i, 2 + (int)l->spline, 1, 2, &s[i]);
    }
    l->revolve.segment = s;
    l->revolve.count = (uint32_t)n;
    l->revolve.closed =
        s[0].h_end[0] == s[n - 1].h_end[1] && s[0].r2_end[0] == s[n - 1].r2_end[1];
    revolve_prepare(&l->revolve, args_arena(args));
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct lathe *l = shape;
    return revolve_bounds(&l->revolve);
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct lathe *l = shape;
    return revolve_inside(&l->revolve, p);
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct lathe *l = shape;
    revolve_intersect(&l->revolve, ray, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return revolve_closest8(k, &lathe_ops, shape, rays, lanes, any, out);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct lathe *l = shape;
    revolve_surface(&l->revolve, b, p, out);
}

static void print(const void *shape, FILE *out)
{
    const struct lathe *l = shape;
    fprintf(out, "lathe { %s %ld", spline_word[l->spline], l->count);
    for (long i = 0; i < l->count; i++) {
        fputs(", ", out);
        shape_print_vec2(out, l->point[i]);
    }
}

const struct shape_ops lathe_ops = {
    .keyword = "lathe",
    .size = sizeof(struct lathe),
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
