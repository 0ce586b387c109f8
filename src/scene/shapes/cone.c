// cone { end, radius, end, radius [open] }

#include "scene/shapes/cone.h"

#include "math/gamma.h"
#include "math/quadratic.h"
#include "scene/args.h"
#include "scene/shape.h"

static bool build(void *shape, struct args *args)
{
    struct cone *c = shape;
    struct vec3 a, b;
    struct span where = args_where(args);
    if (!args_vec3(args, "first end", &a) || !args_float(args, "first radius", &c->r0) ||
        !args_vec3(args, "second end", &b) || !args_float(args, "second radius", &c->r1))
        return false;
    const struct vec3 axis = vec3_sub(b, a);
    c->length = vec3_length(axis);
    if (c->length == 0) {
        diag_at(args_diags(args), DIAG_ENDS_EQUAL, where, args_owner(args));
        return false;
    }
    c->r0 = fabs(c->r0);
    c->r1 = fabs(c->r1);
    c->slope = (c->r1 - c->r0) / c->length;
    c->frame = frame_around(a, axis);
    c->open = args_word(args, "open");
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct cone *c = shape;
    double scale;
    if (!transform_is_similarity(t, &scale))
        return false;
    frame_transform(&c->frame, t);
    c->length *= scale;
    c->r0 *= scale;
    c->r1 *= scale;
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct cone *c = shape;
    const struct frame *f = &c->frame;
    const struct vec3 e = vec3(sqrt(f->e1.x * f->e1.x + f->e2.x * f->e2.x),
                               sqrt(f->e1.y * f->e1.y + f->e2.y * f->e2.y),
                               sqrt(f->e1.z * f->e1.z + f->e2.z * f->e2.z));
    const struct vec3 top = vec3_mad(f->origin, c->length, f->e3);
    struct aabb b = {vec3_mad(f->origin, -c->r0, e), vec3_mad(f->origin, c->r0, e)};
    b = aabb_add(aabb_add(b, vec3_mad(top, -c->r1, e)), vec3_mad(top, c->r1, e));
    return aabb_pad(b);
}

static bool inside(const void *shape, struct vec3 p)
{
    const struct cone *c = shape;
    const struct vec3 q = frame_coordinates(&c->frame, vec3_sub(p, c->frame.origin));
    const double r = c->r0 + c->slope * q.z;
    return q.z >= 0 && q.z <= c->length && q.x * q.x + q.y * q.y <= r * r;
}

// The stretches of the line inside the double cone f <= 0, f = a t^2 + 2 b t + c, from
// the point of the line nearest to the middle of the axis.
struct stretch {
    double t[2]; // entry and exit; entry > exit: none
};

static int double_cone(double a, double b, double c, struct stretch s[2], double *disc)
{
    const double d = b * b - a * c;
    *disc = d;
    if (!(d > 0)) {
        s[0] = (struct stretch){{-INFINITY, INFINITY}};
        return a < 0 || (a == 0 && c <= 0); // all inside, or all outside
    }
    const double q = -(b + copysign(sqrt(d), b));
    const double t1 = q / a, t2 = c / q; // a == 0: t1 is infinite, on the right side
    const double lo = t1 < t2 ? t1 : t2, hi = t1 < t2 ? t2 : t1;
    if (a > 0) {
        s[0] = (struct stretch){{lo, hi}};
        return 1;
    }
    if (a == 0) { // the side where b t falls
        s[0] =
            b > 0 ? (struct stretch){{-INFINITY, t2}} : (struct stretch){{t2, INFINITY}};
        return 1;
    }
    s[0] = (struct stretch){{-INFINITY, lo}};
    s[1] = (struct stretch){{hi, INFINITY}};
    return 2;
}

struct slab {
    double t[2];
    uint32_t part[2];
};

static bool slab_of(const struct cone *c, struct vec3 o, struct vec3 d, struct slab *s)
{
    *s = (struct slab){{-INFINITY, INFINITY}, {CONE_BASE, CONE_TOP}};
    if (RUNS_ALONG(d.z, vec3_max_abs(d)))
        return o.z >= 0 && o.z <= c->length;
    const double inv = 1 / d.z;
    const double ta = (0 - o.z) * inv, tb = (c->length - o.z) * inv;
    s->t[0] = ta < tb ? ta : tb;
    s->t[1] = ta < tb ? tb : ta;
    if (d.z < 0) {
        s->part[0] = CONE_TOP;
        s->part[1] = CONE_BASE;
    }
    return true;
}

// o = frame coordinates of the origin relative to the middle of the axis, moved by s
// along d to the point nearest to it; rho = r0 + slope * length/2 + slope * o.z.
// a = d.x^2 + d.y^2 - (slope d.z)^2, b = d.x o.x + d.y o.y - slope d.z rho,
// c = o.x^2 + o.y^2 - rho^2. Within the caps only one nappe of the double cone lies.
static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct cone *c = shape;
    const struct vec3 o = frame_coordinates(&c->frame, vec3_sub(ray->o, c->frame.origin));
    const struct vec3 d = frame_coordinates(&c->frame, ray->d);
    struct slab slab;
    if (!slab_of(c, o, d, &slab))
        return;
    const double half = c->length / 2, dd = vec3_dot(d, d);
    const struct vec3 m = vec3(o.x, o.y, o.z - half);
    const double shift = -vec3_dot(m, d) / dd;
    const struct vec3 near = vec3_mad(m, shift, d);
    const double rho = c->r0 + c->slope * (half + near.z), kz = c->slope * d.z;
    const double a = d.x * d.x + d.y * d.y - kz * kz;
    const double b = d.x * near.x + d.y * near.y - kz * rho;
    const double cc = near.x * near.x + near.y * near.y - rho * rho;
    struct stretch s[2];
    double disc;
    const int n = double_cone(a, b, cc, s, &disc);
    int best = -1;
    double entry = 0, leave = 0;
    for (int i = 0; i < n; i++) {
        const double t0 = fmax(s[i].t[0] + shift, slab.t[0]);
        const double t1 = fmin(s[i].t[1] + shift, slab.t[1]);
        if (t0 <= t1 && (best < 0 || t1 - t0 > leave - entry)) {
            best = i;
            entry = t0;
            leave = t1;
        }
    }
    if (best < 0 || !isfinite(entry) || !isfinite(leave))
        return;

    const double r = fmax(c->r0, c->r1);
    const double e_p = GAMMA(24) * (vec3_max_abs(ray->o) + vec3_max_abs(c->frame.origin) +
                                    c->length + r);
    const double e_f = e_p * (4 * (r + fabs(rho) + vec3_max_abs(near)) + 2 * e_p);
    const double dt_side = e_f / fmax(2 * sqrt(fmax(disc, 0)), sqrt(fabs(a) * e_f));
    const double dt_cap = e_p / fabs(d.z);
    const bool side_in = entry > slab.t[0], side_out = leave < slab.t[1];
    struct boundary *at =
        boundary_list_add(out, entry, side_in ? dt_side : dt_cap, CROSS_ENTER,
                          side_in ? CONE_SIDE : slab.part[0]);
    at->drawn = side_in || !c->open;
    at = boundary_list_add(out, leave, side_out ? dt_side : dt_cap, CROSS_EXIT,
                           side_out ? CONE_SIDE : slab.part[1]);
    at->drawn = side_out || !c->open;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct cone *c = shape;
    const struct frame *f = &c->frame;
    const struct vec3 q = frame_coordinates(f, vec3_sub(p, f->origin));
    out->p = p;
    if (b->part == CONE_SIDE) {
        const double length = sqrt(q.x * q.x + q.y * q.y);
        // At the apex the axis stands for the normal.
        const double x = length > 0 ? q.x / length : 0, y = length > 0 ? q.y / length : 0;
        out->ng = frame_vector(f, x, y, length > 0 ? -c->slope : (c->slope > 0 ? -1 : 1));
    } else {
        out->ng = b->part == CONE_TOP ? f->e3 : vec3_neg(f->e3);
    }
    out->ng = vec3_normalize(out->ng);
    out->ns = out->ng;
}

static void print(const void *shape, FILE *out)
{
    const struct cone *c = shape;
    fputs("cone { ", out);
    shape_print_vec3(out, c->frame.origin);
    fputs(", ", out);
    shape_print_number(out, c->r0);
    fputs(", ", out);
    shape_print_vec3(out, vec3_mad(c->frame.origin, c->length, c->frame.e3));
    fputs(", ", out);
    shape_print_number(out, c->r1);
    if (c->open)
        fputs(" open", out);
}

const struct shape_ops cone_ops = {
    .keyword = "cone",
    .size = sizeof(struct cone),
    .flags = SHAPE_SOLID | SHAPE_FLAT | SHAPE_BOUNDED | SHAPE_CONVEX | SHAPE_BOUND_BOX,
    .build = build,
    .absorb = absorb,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
