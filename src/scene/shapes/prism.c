// prism { [spline] [linear_sweep|conic_sweep] low, high, n, <x,z>, ... [open] }
//
// A closed curve in the xz plane swept along y. The curve may have several loops
// (even-odd); linear loops that are not closed are closed, others are left out.
#include <math.h>

#include "base/arena.h"
#include "scene/args.h"
#include "scene/shape.h"
#include "scene/shapes/extrude.h"
#include "scene/shapes/extrude_lanes.h"

enum spline { SPLINE_LINEAR, SPLINE_QUADRATIC, SPLINE_CUBIC, SPLINE_BEZIER };

struct prism {
    struct outline outline; // (u, v) = (x, z)
    double low, high;
    bool open, conic;
};

// Points closer than this share of the curve's size are meant to be the same.
static const double SAME_POINT = 1e-10;

struct points {
    struct vec2 *at;
    long count;
    double size;
};

static bool same(const struct points *p, struct vec2 a, struct vec2 b)
{
    return fabs(a.u - b.u) <= SAME_POINT * p->size &&
           fabs(a.v - b.v) <= SAME_POINT * p->size;
}

// Catmull-Rom and quadratic pieces as Bezier pieces with exact end points.
static void quadratic_piece(struct outline *o, const struct vec2 *p, struct vec2 end)
{
    // Runs p1 -> p2 with the slope (p2 - p0)/2 at p1: the control point is half a slope on.
    struct vec2 c = {p[1].u + (p[2].u - p[0].u) / 4, p[1].v + (p[2].v - p[0].v) / 4};
    outline_parabola(o, p[1], c, end);
}

static void cubic_piece(struct outline *o, const struct vec2 *p, struct vec2 end)
{
    struct vec2 c1 = {p[1].u + (p[2].u - p[0].u) / 6, p[1].v + (p[2].v - p[0].v) / 6};
    struct vec2 c2 = {p[2].u - (p[3].u - p[1].u) / 6, p[2].v - (p[3].v - p[1].v) / 6};
    outline_cubic(o, p[1], c1, c2, end);
}

// One loop from point i on; returns the first point after it. *closed says whether it is.
static long add_loop(struct outline *o, const struct points *p, enum spline spline,
                     long i, bool *closed)
{
    const long lead = spline == SPLINE_LINEAR ? 0 : 1;
    const long tail = spline == SPLINE_CUBIC ? 1 : 0;
    const long first = i + lead;
    long last = first + 1;
    while (last < p->count && !same(p, p->at[first], p->at[last]))
        last++;
    *closed = last + tail < p->count;
    if (!*closed && spline != SPLINE_LINEAR)
        return p->count;
    const long end = *closed ? last : p->count - 1;
    for (long k = first; k < end; k++) {
        struct vec2 to = *closed && k + 1 == last ? p->at[first] : p->at[k + 1];
        if (spline == SPLINE_LINEAR)
            outline_line(o, p->at[k], to);
        else if (spline == SPLINE_QUADRATIC)
            quadratic_piece(o, p->at + k - 1, to);
        else
            cubic_piece(o, p->at + k - 1, to);
    }
    if (!*closed)
        outline_line(o, p->at[end], p->at[first]);
    return last + tail + 1;
}

// Groups of four; a loop ends where a group's last point is the loop's first.
static bool add_bezier_loops(struct outline *o, const struct points *p)
{
    bool closed = true;
    struct vec2 start = {0, 0}, at = {0, 0};
    for (long i = 0; i + 3 < p->count; i += 4) {
        if (closed || !same(p, p->at[i], at)) {
            if (!closed)
                return false;
            start = at = p->at[i];
        }
        closed = same(p, p->at[i + 3], start);
        struct vec2 end = closed ? start : p->at[i + 3];
        outline_cubic(o, at, p->at[i + 1], p->at[i + 2], end);
        at = end;
    }
    return closed;
}

static void read_kind(struct args *args, enum spline *spline, bool *conic)
{
    *spline = SPLINE_LINEAR;
    *conic = false;
    for (;;) {
        if (args_word(args, "linear_spline"))
            *spline = SPLINE_LINEAR;
        else if (args_word(args, "quadratic_spline"))
            *spline = SPLINE_QUADRATIC;
        else if (args_word(args, "cubic_spline"))
            *spline = SPLINE_CUBIC;
        else if (args_word(args, "bezier_spline"))
            *spline = SPLINE_BEZIER;
        else if (args_word(args, "conic_sweep"))
            *conic = true;
        else if (args_word(args, "linear_sweep"))
            *conic = false;
        else
            return;
    }
}

static bool read_points(struct args *args, enum spline spline, struct points *p)
{
    static const long least[] = {3, 5, 6, 4};
    static const char *const too_few[] = {
        "a linear_spline takes 3 points or more",
        "a quadratic_spline takes 5 points or more",
        "a cubic_spline takes 6 points or more",
        "a bezier_spline takes 4 points for each of its pieces"};
    if (!args_int(args, "number of points", &p->count))
        return false;
    if (p->count < least[spline] || (spline == SPLINE_BEZIER && p->count % 4)) {
        args_reject(args, too_few[spline]);
        return false;
    }
    p->at = arena_new_array(args_arena(args), struct vec2, (size_t)p->count);
    for (long i = 0; i < p->count; i++) {
        if (!args_vec2(args, "point", &p->at[i]))
            return false;
        p->size = fmax(p->size, fmax(fabs(p->at[i].u), fabs(p->at[i].v)));
    }
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct prism *s = shape;
    enum spline spline;
    struct points p = {0};
    double h[2];
    read_kind(args, &spline, &s->conic);
    if (!args_float(args, "first height", &h[0]) ||
        !args_float(args, "second height", &h[1]) || !read_points(args, spline, &p))
        return false;
    s->open = args_word(args, "open");
    s->low = fmin(h[0], h[1]);
    s->high = fmax(h[0], h[1]);
    outline_init(&s->outline, args_arena(args));
    bool closed = true;
    if (spline == SPLINE_BEZIER)
        closed = add_bezier_loops(&s->outline, &p);
    else
        for (long i = 0; i < p.count && closed;)
            i = add_loop(&s->outline, &p, spline, i, &closed);
    if (!closed) {
        args_warn(args, spline == SPLINE_LINEAR
                            ? "the prism's last loop is not closed; a line closes it"
                            : "the prism's last loop is not closed and is left out");
        if (spline == SPLINE_BEZIER)
            outline_init(&s->outline, args_arena(args));
    }
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct prism *s = shape;
    const struct outline *o = &s->outline;
    if (s->conic && o->count) {
        struct aabb b = aabb_empty();
        const double h[2] = {s->low, s->high};
        for (int i = 0; i < 2; i++) {
            b = aabb_add(b, vec3(h[i] * o->min.u, h[i], h[i] * o->min.v));
            b = aabb_add(b, vec3(h[i] * o->max.u, h[i], h[i] * o->max.v));
        }
        return aabb_pad(b);
    }
    return (struct aabb){vec3(o->min.u, s->low, o->min.v),
                         vec3(o->max.u, s->high, o->max.v)};
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct prism *s = shape;
    if (s->conic)
        return conic_inside(&s->outline, s->low, s->high,
                            (const double[]){p.x, p.z, p.y});
    return p.y >= s->low && p.y <= s->high &&
           outline_inside(&s->outline, (struct vec2){p.x, p.z});
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct prism *s = shape;
    const struct extrude_ray e = {{ray->o.x, ray->o.z, ray->o.y},
                                  {ray->d.x, ray->d.z, ray->d.y}};
    if (s->conic)
        conic_intersect(&s->outline, s->low, s->high, s->open, &e, out);
    else
        extrude_intersect(&s->outline, s->low, s->high, s->open, &e, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    (void)any;
    const struct prism *s = shape;
    const struct extrude_solid e = {&s->outline, 1,        s->low,    s->high,
                                    s->open,     s->conic, {0, 2, 1}, NULL};
    unsigned odd;
    const unsigned met = k->extrude(&e, rays, lanes, out, &odd);
    return met | shape_lanes_alone(&prism_ops, s, rays, odd, out);
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct prism *s = shape;
    const struct vec3 n =
        s->conic ? conic_normal(&s->outline, b) : extrude_normal(&s->outline, b);
    out->p = p;
    out->ng = out->ns = vec3_normalize(vec3(n.x, n.z, n.y));
    out->uv = (struct vec2){p.x, p.y};
}

static void print(const void *shape, FILE *out)
{
    const struct prism *s = shape;
    fputs("prism { bezier_spline ", out);
    fputs(s->conic ? "conic_sweep " : "", out);
    shape_print_number(out, s->low);
    fputs(", ", out);
    shape_print_number(out, s->high);
    fprintf(out, ", %lu", 4ul * s->outline.count);
    for (uint32_t i = 0; i < s->outline.count; i++) {
        const struct outline_segment *g = &s->outline.segment[i];
        for (int k = 0; k < 4; k++) { // Bezier points from the power basis
            const double w = k / 3.;
            struct vec2 q = g->a;
            q.u += g->c1.u * w + (k == 2 ? g->c2.u / 3 : 0);
            q.v += g->c1.v * w + (k == 2 ? g->c2.v / 3 : 0);
            q = k == 3 ? g->b : q;
            fputs(", ", out);
            shape_print_vec2(out, q);
        }
    }
    if (s->open)
        fputs(" open", out);
}

const struct shape_ops prism_ops = {
    .keyword = "prism",
    .size = sizeof(struct prism),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_BOUNDED | SHAPE_STURM | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .surface = surface,
    .print = print,
};
