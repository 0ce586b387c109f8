// cylinder { end, end, radius [open] }

#include "scene/shapes/cylinder.h"

#include "math/gamma.h"
#include "math/quadratic.h"
#include "scene/args.h"
#include "scene/shape.h"

static bool build(void *shape, struct args *args)
{
    struct cylinder *c = shape;
    struct vec3 a, b;
    struct span where = args_where(args);
    if (!args_vec3(args, "first end", &a) || !args_vec3(args, "second end", &b) ||
        !args_float(args, "radius", &c->radius))
        return false;
    const struct vec3 axis = vec3_sub(b, a);
    c->length = vec3_length(axis);
    c->radius = fabs(c->radius);
    c->frame = frame_around(a, axis);
    c->open = args_word(args, "open");
    if (c->length == 0) {
        diag_at(args_diags(args), DIAG_ENDS_EQUAL, where, args_owner(args));
        return false;
    }
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct cylinder *c = shape;
    double scale;
    if (!transform_is_similarity(t, &scale))
        return false;
    frame_transform(&c->frame, t);
    c->length *= scale;
    c->radius *= scale;
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct cylinder *c = shape;
    const struct frame *f = &c->frame;
    const double r = c->radius;
    const struct vec3 e = vec3(r * sqrt(f->e1.x * f->e1.x + f->e2.x * f->e2.x),
                               r * sqrt(f->e1.y * f->e1.y + f->e2.y * f->e2.y),
                               r * sqrt(f->e1.z * f->e1.z + f->e2.z * f->e2.z));
    const struct vec3 top = vec3_mad(f->origin, c->length, f->e3);
    struct aabb b = {vec3_sub(f->origin, e), vec3_add(f->origin, e)};
    return aabb_pad(aabb_add(aabb_add(b, vec3_sub(top, e)), vec3_add(top, e)));
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct cylinder *c = shape;
    const struct vec3 q = frame_coordinates(&c->frame, vec3_sub(p, c->frame.origin));
    return q.x * q.x + q.y * q.y <= c->radius * c->radius && q.z >= 0 && q.z <= c->length;
}

// o = frame coordinates of the origin, d = of the direction.
// Caps: inv = 1/d.z, ta = (0 - o.z)*inv, tb = (length - o.z)*inv.
// Side: a = d.x^2 + d.y^2, s = (d.x*o.x + d.y*o.y)/a, near = o.xy - s*d.xy,
// rest = r*r - near.near, reach = sqrt(rest/a), t = -s -+ reach.
// The line is inside on [max of the entries, min of the exits]; a tie takes the side.
// Along the axis or the caps: all or nothing, closed.
//
// Error: as for the sphere, with e_p the uncertainty of the point in the frame.
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct cylinder *c = shape;
    const struct vec3 o = frame_coordinates(&c->frame, vec3_sub(ray->o, c->frame.origin));
    const struct vec3 d = frame_coordinates(&c->frame, ray->d);
    const double r = c->radius;

    const double a = d.x * d.x + d.y * d.y, longest = vec3_max_abs(d);
    double entry = -INFINITY, leave = INFINITY, rest = 0;
    if (RUNS_ALONG(sqrt(a), longest)) {
        if (!(o.x * o.x + o.y * o.y <= r * r))
            return;
    } else {
        const double s = (d.x * o.x + d.y * o.y) / a;
        const double x = o.x - s * d.x, y = o.y - s * d.y;
        rest = r * r - (x * x + y * y);
        if (!(rest > 0))
            return;
        const double reach = sqrt(rest / a);
        entry = -s - reach;
        leave = -s + reach;
    }

    uint32_t entry_part = CYLINDER_SIDE, leave_part = CYLINDER_SIDE;
    if (RUNS_ALONG(d.z, longest)) {
        if (!(o.z >= 0 && o.z <= c->length))
            return;
    } else {
        const double inv = 1 / d.z;
        const double ta = (0 - o.z) * inv, tb = (c->length - o.z) * inv;
        const double t0 = ta < tb ? ta : tb, t1 = ta < tb ? tb : ta;
        if (t0 > entry) {
            entry = t0;
            entry_part = d.z > 0 ? CYLINDER_BASE : CYLINDER_TOP;
        }
        if (t1 < leave) {
            leave = t1;
            leave_part = d.z > 0 ? CYLINDER_TOP : CYLINDER_BASE;
        }
    }
    if (!(entry <= leave) || entry == -INFINITY)
        return;

    const double e_p = GAMMA(16) * (vec3_max_abs(ray->o) + vec3_max_abs(c->frame.origin) +
                                    c->length + r);
    const double dt_side = (e_p + sqrt_error(rest, e_p * (4 * r + 2 * e_p))) / sqrt(a);
    const double dt_cap = e_p / fabs(d.z);
    struct boundary *b =
        boundary_list_add(out, entry, entry_part == CYLINDER_SIDE ? dt_side : dt_cap,
                          CROSS_ENTER, entry_part);
    b->drawn = entry_part == CYLINDER_SIDE || !c->open;
    b = boundary_list_add(out, leave, leave_part == CYLINDER_SIDE ? dt_side : dt_cap,
                          CROSS_EXIT, leave_part);
    b->drawn = leave_part == CYLINDER_SIDE || !c->open;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct cylinder *c = shape;
    const struct frame *f = &c->frame;
    struct vec3 q = frame_coordinates(f, vec3_sub(p, f->origin));
    if (b->part == CYLINDER_SIDE) {
        const double length = sqrt(q.x * q.x + q.y * q.y);
        const double x = length > 0 ? q.x / length : 1, y = length > 0 ? q.y / length : 0;
        out->ng = frame_vector(f, x, y, 0);
        q.x = c->radius * x;
        q.y = c->radius * y;
    } else {
        out->ng = b->part == CYLINDER_TOP ? f->e3 : vec3_neg(f->e3);
        q.z = b->part == CYLINDER_TOP ? c->length : 0;
    }
    out->ng = vec3_normalize(out->ng);
    out->ns = out->ng;
    out->p = vec3_add(f->origin, frame_vector(f, q.x, q.y, q.z));
}

static void print(const void *shape, FILE *out)
{
    const struct cylinder *c = shape;
    fputs("cylinder { ", out);
    shape_print_vec3(out, c->frame.origin);
    fputs(", ", out);
    shape_print_vec3(out, vec3_mad(c->frame.origin, c->length, c->frame.e3));
    fputs(", ", out);
    shape_print_number(out, c->radius);
    if (c->open)
        fputs(" open", out);
}

const struct shape_ops cylinder_ops = {
    .keyword = "cylinder",
    .size = sizeof(struct cylinder),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_BOUNDED | SHAPE_CONVEX | SHAPE_BOUND_BOX,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
