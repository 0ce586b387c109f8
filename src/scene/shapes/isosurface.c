// isosurface { function { F } contained_by { ... } ... }: where F <= threshold.
//
// Bounds of F and of its derivatives find the surface whatever its slope is, so that
// max_gradient, accuracy, evaluate and max_trace are not needed; they matter for functions
// whose bounds say nothing alone (images, fractals, tilings). All crossings are found, as CSG wants them.
#include "scene/shapes/isosurface.h"
#include "scene/shapes/isosurface_open.h"

#include "base/arena.h"
#include "scene/args.h"
#include "scene/shape_kernels.h"
#include "scene/tape_kernel.h"

enum { MAX_TRACE = 10 };
// Roots are found closer than this share of the container: where the gradient would need a
// longer way to 0 the function jumps.
#define JUMP_SHARE 0x1p-18
static const double ACCURACY = 0.001, MAX_GRADIENT = 1.1;

bool isosurface_is_open(const void *shape)
{
    return ((const struct isosurface *)shape)->open;
}

static bool read_max_trace(struct args *args, struct isosurface *s)
{
    if (args_word(args, "all_intersections")) {
        s->max_trace = MAX_TRACE;
        return true;
    }
    if (!args_word(args, "max_trace"))
        return false;
    if (!args_int(args, "max_trace", &s->max_trace))
        return true;
    if (s->max_trace < 1) {
        args_warn(args, "max_trace must be at least 1: 1 is used");
        s->max_trace = 1;
    } else if (s->max_trace > MAX_TRACE) {
        args_warn(args, "max_trace may be at most 10: 10 is used");
        s->max_trace = MAX_TRACE;
    }
    return true;
}

static bool read_item(struct args *args, struct isosurface *s)
{
    if (container_read(args, &s->container) ||
        container_hint(args, "accuracy", ACCURACY, &s->accuracy) ||
        container_hint(args, "max_gradient", MAX_GRADIENT, &s->max_gradient) ||
        read_max_trace(args, s))
        return true;
    if (args_word(args, "open"))
        return s->open = true;
    if (args_word(args, "threshold")) {
        args_float(args, "threshold", &s->threshold);
        return true;
    }
    if (!args_word(args, "evaluate"))
        return false;
    for (int i = 0; i < 3; i++)
        if (!args_float(args, "evaluate", &s->evaluate[i]))
            break;
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct isosurface *s = shape;
    s->accuracy = ACCURACY;
    s->max_gradient = MAX_GRADIENT;
    s->max_trace = 1;
    s->container = container_default();
    if (!(s->f = args_function(args, "function")))
        return false;
    while (read_item(args, s))
        ;
    s->bounds = container_bounds(&s->container);
    s->root = iso_tree_of(s, args_arena(args), args_shared(args));
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct isosurface *s = shape;
    return s->bounds;
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct isosurface *s = shape;
    return s->container.ops->inside(&s->container.shape, p) && iso_value(s, p) <= 0;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    iso_walk(shape, ray, out);
}

static unsigned closest8(const struct shape_kernels *k, const void *shape,
                         const struct shape_rays *rays, unsigned lanes, bool any,
                         struct shape_hits *out)
{
    return k->isosurface(shape, rays, lanes, any, out);
}

static bool has_lanes(const void *shape)
{
    const struct isosurface *s = shape;
    return !tape_is_opaque(s->f) && tape_has_lanes(s->f);
}

// Across the point, so that a jump of the function is seen whichever side of it the point
// is on.
static struct vec3 differences(const struct isosurface *s, struct vec3 p)
{
    const double a = s->accuracy;
    return vec3(
        iso_value(s, vec3(p.x + a, p.y, p.z)) - iso_value(s, vec3(p.x - a, p.y, p.z)),
        iso_value(s, vec3(p.x, p.y + a, p.z)) - iso_value(s, vec3(p.x, p.y - a, p.z)),
        iso_value(s, vec3(p.x, p.y, p.z + a)) - iso_value(s, vec3(p.x, p.y, p.z - a)));
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct isosurface *s = shape;
    if (b->part >= ISO_CONTAINER) {
        struct boundary face = *b;
        face.part -= ISO_CONTAINER;
        s->container.ops->surface(&s->container.shape, &face, p, out);
        out->uv = (struct vec2){p.x, p.y};
        return;
    }
    double g[3] = {0}, f = 0;
    if (!tape_is_opaque(s->f))
        f = tape_gradient(s->f, (const double[]){p.x, p.y, p.z}, 3, g) - s->threshold;
    struct vec3 n = vec3(g[0], g[1], g[2]);
    double length = vec3_length(n);
    const double near = JUMP_SHARE * vec3_max_abs(vec3_sub(s->bounds.max, s->bounds.min));
    if (!(length > 0 && length < INFINITY) || fabs(f) > near * length) {
        n = differences(s, p);
        length = vec3_length(n);
    }
    if (!(length > 0 && length < INFINITY))
        n = vec3(1, 0, 0);
    out->p = p;
    out->ng = out->ns = vec3_normalize(n);
    out->uv = (struct vec2){p.x, p.y};
}

static void print_hint(FILE *out, const char *word, double v)
{
    fprintf(out, " %s ", word);
    shape_print_number(out, v);
}

static void print(const void *shape, FILE *out)
{
    const struct isosurface *s = shape;
    fputs("isosurface { function { ", out);
    tape_print(s->f, out);
    fputs(" }", out);
    container_print(&s->container, out);
    print_hint(out, "threshold", s->threshold);
    print_hint(out, "accuracy", s->accuracy);
    print_hint(out, "max_gradient", s->max_gradient);
    fprintf(out, " max_trace %ld%s", s->max_trace, s->open ? " open" : "");
}

const struct shape_ops isosurface_ops = {
    .keyword = "isosurface",
    .size = sizeof(struct isosurface),
    .flags = SHAPE_SOLID | SHAPE_BOUNDED | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .closest8 = closest8,
    .has_lanes = has_lanes,
    .surface = surface,
    .print = print,
};
