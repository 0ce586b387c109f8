// triangle { p, p, p } and smooth_triangle { p, n, p, n, p, n }

#include "scene/shapes/triangle.h"

#include "math/gamma.h"
#include "math/larger.h"
#include "scene/args.h"
#include "scene/shape.h"

struct triangle_ray triangle_ray_of(const struct ray *r)
{
    struct triangle_ray q = {.o = r->o};
    const double x = fabs(r->d.x), y = fabs(r->d.y), z = fabs(r->d.z);
    q.kz = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    q.kx = (q.kz + 1) % 3;
    q.ky = (q.kx + 1) % 3;
    const double dz = vec3_axis(r->d, q.kz);
    q.sx = vec3_axis(r->d, q.kx) / dz;
    q.sy = vec3_axis(r->d, q.ky) / dz;
    q.sz = 1 / dz;
    return q;
}

bool triangle_meet(const struct triangle_ray *r, const struct vec3 p[3],
                   struct triangle_hit *hit)
{
    double x[3], y[3], z[3];
    for (int i = 0; i < 3; i++) {
        const struct vec3 q = vec3_sub(p[i], r->o);
        const double k = vec3_axis(q, r->kz);
        x[i] = vec3_axis(q, r->kx) - r->sx * k;
        y[i] = vec3_axis(q, r->ky) - r->sy * k;
        z[i] = k;
    }
    const double u = x[2] * y[1] - y[2] * x[1];
    const double v = x[0] * y[2] - y[0] * x[2];
    const double w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0))
        return false;
    const double det = u + v + w;
    if (det == 0)
        return false; // edge on
    hit->u = v / det;
    hit->v = w / det;
    hit->t = r->sz * (u * z[0] + v * z[1] + w * z[2]) / det;
    // The corners are known to a few roundings of themselves and the origin; seen at a
    // slant (small det against the corners' spread) that counts more along the ray.
    double size = 0, spread = 0, depth = 0;
    for (int i = 0; i < 3; i++) {
        size = larger(vec3_max_abs(p[i]), size);
        spread = larger(larger(fabs(x[i]), fabs(y[i])), spread);
        depth = larger(fabs(z[i] - z[(i + 1) % 3]), depth);
    }
    size += vec3_max_abs(r->o);
    const double slant = depth * spread / fabs(det);
    hit->dt = GAMMA(12) * size * fabs(r->sz) * (2 + slant);
    // Nowhere but in the triangle: a ray along an edge meets slivers that it is seen as.
    const double most = fabs(r->sz) * (2 * GAMMA(12) * size + depth);
    hit->dt = most < hit->dt ? most : hit->dt;
    return true;
}

// The sign of the edge function of a and b after moving the ray by (e, -e*e) in the
// sheared plane, e > 0 as small as you like (Edelsbrunner & Muecke 1990).
static bool edge_positive(double ax, double ay, double bx, double by)
{
    const double e = ax * by - ay * bx;
    if (e != 0)
        return e > 0;
    return ay != by ? ay > by : ax > bx;
}

bool triangle_owns(const struct triangle_ray *r, const struct vec3 p[3])
{
    double x[3], y[3];
    for (int i = 0; i < 3; i++) {
        const struct vec3 q = vec3_sub(p[i], r->o);
        const double k = vec3_axis(q, r->kz);
        x[i] = vec3_axis(q, r->kx) - r->sx * k;
        y[i] = vec3_axis(q, r->ky) - r->sy * k;
    }
    const bool u = edge_positive(x[2], y[2], x[1], y[1]);
    const bool v = edge_positive(x[0], y[0], x[2], y[2]);
    const bool w = edge_positive(x[1], y[1], x[0], y[0]);
    return u == v && v == w;
}

struct vec3 triangle_normal(const struct vec3 p[3])
{
    return vec3_normalize(vec3_cross(vec3_sub(p[2], p[0]), vec3_sub(p[1], p[0])));
}

static void finish(struct triangle *s)
{
    s->face = triangle_normal(s->p);
    s->degenerate = vec3_dot(s->face, s->face) == 0;
    if (!s->smooth)
        return;
    int above = 0, below = 0;
    for (int i = 0; i < 3; i++) {
        const double d = vec3_dot(s->n[i], s->face);
        above += d > 0;
        below += d < 0;
    }
    s->degenerate |= above != 3 && below != 3;
}

static bool build(void *shape, struct args *args)
{
    struct triangle *s = shape;
    for (int i = 0; i < 3; i++)
        if (!args_vec3(args, "corner", &s->p[i]))
            return false;
    finish(s);
    if (s->degenerate)
        diag_at(args_diags(args), DIAG_DEGENERATE, args_where(args), args_owner(args));
    return true;
}

static bool build_smooth(void *shape, struct args *args)
{
    struct triangle *s = shape;
    s->smooth = true;
    for (int i = 0; i < 3; i++) {
        if (!args_vec3(args, "corner", &s->p[i]) || !args_vec3(args, "normal", &s->n[i]))
            return false;
        s->n[i] = vec3_normalize(s->n[i]);
    }
    finish(s);
    if (s->degenerate)
        diag_at(args_diags(args), DIAG_DEGENERATE, args_where(args), args_owner(args));
    return true;
}

static bool absorb(void *shape, const struct transform *t)
{
    struct triangle *s = shape;
    for (int i = 0; i < 3; i++) {
        s->p[i] = transform_point(t, s->p[i]);
        s->n[i] = transform_normal(t, s->n[i]);
        if (s->smooth)
            s->n[i] = vec3_normalize(s->n[i]);
    }
    s->face = vec3_normalize(transform_normal(t, s->face));
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct triangle *s = shape;
    struct aabb b = aabb_empty();
    for (int i = 0; i < 3; i++)
        b = aabb_add(b, s->p[i]);
    return aabb_pad(b);
}

static bool inside(const void *shape, struct vec3 p)
{
    (void)shape;
    (void)p;
    return false;
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct triangle *s = shape;
    const struct triangle_ray r = triangle_ray_of(ray);
    struct triangle_hit h;
    if (s->degenerate || !triangle_meet(&r, s->p, &h))
        return;
    struct boundary *b = boundary_list_add(out, h.t, h.dt, CROSS_TOUCH, 0);
    b->u = h.u;
    b->v = h.v;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    const struct triangle *s = shape;
    out->p = p;
    out->ng = out->ns = s->face;
    if (s->smooth) {
        const struct vec3 n =
            vec3_add(vec3_scale(1 - b->u - b->v, s->n[0]),
                     vec3_add(vec3_scale(b->u, s->n[1]), vec3_scale(b->v, s->n[2])));
        if (vec3_dot(n, n) > 0)
            out->ns = vec3_normalize(n);
    }
}

static void print(const void *shape, FILE *out)
{
    const struct triangle *s = shape;
    fputs(s->smooth ? "smooth_triangle { " : "triangle { ", out);
    for (int i = 0; i < 3; i++) {
        if (i)
            fputs(", ", out);
        shape_print_vec3(out, s->p[i]);
        if (s->smooth) {
            fputs(", ", out);
            shape_print_vec3(out, s->n[i]);
        }
    }
}

#define TRIANGLE_OPS(word, builder)                                                      \
    const struct shape_ops word##_ops = {                                                \
        .keyword = #word,                                                                \
        .size = sizeof(struct triangle),                                                 \
        .flags = SHAPE_BOUNDED | SHAPE_FLAT,                                             \
        .build = builder,                                                                \
        .absorb = absorb,                                                                \
        .bounds = bounds,                                                                \
        .inside = inside,                                                                \
        .intersect = intersect,                                                          \
        .surface = surface,                                                              \
        .print = print,                                                                  \
    }

TRIANGLE_OPS(triangle, build);
TRIANGLE_OPS(smooth_triangle, build_smooth);
