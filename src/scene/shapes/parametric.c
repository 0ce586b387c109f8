// parametric { function { X }, function { Y }, function { Z } <u1, v1>, <u2, v2> ... }
//
// A ray is taken down a tree of (u, v) rectangles by their boxes. In a rectangle where the
// derivatives hardly turn, the two equations "on the ray" have one root at most when the
// bounds of their determinant exclude zero; Newton finds it from the middle (Toth, On Ray
// Tracing Parametric Surfaces, 1985). Where they do turn down to the smallest rectangles
// (poles, cusps, functions without bounds) Newton starts from several points.
#include "scene/shapes/parametric.h"

#include "math/gamma.h"
#include "scene/args.h"

enum {
    NEWTON_MAX = 16,
    PRECOMPUTE_MAX = 20,
    EVALUATIONS_MAX = 6000, // of one ray: past this the rest is left out
};
static const double ACCURACY = 0.001, MAX_GRADIENT = 1;
// A root may lie this share of a cell's side outside it; the neighbour finds it as well.
static const double OVERLAP = 1e-6;
// Two roots this near, in shares of the whole rectangle, are one.
static const double SAME = 1e-7;

// ---- the ray ------------------------------------------------------------------------

struct line {
    const struct parametric *p;
    struct vec3 o, d, n[2]; // o nearest to the middle of the container; n across the ray
    double shift, from, to; // t of o; stretch in the container, from o
    uint32_t first;
    uint64_t last_evaluation;
    struct boundary_list *out;
};

// A point's place across the ray.
static void across(const struct line *l, struct vec3 s, double f[2])
{
    const struct vec3 r = vec3_sub(s, l->o);
    f[0] = vec3_dot(l->n[0], r);
    f[1] = vec3_dot(l->n[1], r);
}

static double along(const struct line *l, struct vec3 s)
{
    return vec3_dot(vec3_sub(s, l->o), l->d) / vec3_dot(l->d, l->d);
}

static bool known(const struct line *l, const struct boundary *b)
{
    const double du = SAME * (l->p->high.u - l->p->low.u);
    const double dv = SAME * (l->p->high.v - l->p->low.v);
    for (uint32_t i = l->first; i < l->out->count; i++) {
        const struct boundary *c = &l->out->at[i];
        if (fabs(b->t - c->t) <= b->dt + c->dt ||
            (fabs(b->u - c->u) <= du && fabs(b->v - c->v) <= dv))
            return true;
    }
    return false;
}

// How far the point of (u, v) is from the true one, with its rounding.
static double error_of(const struct parametric *p, double u, double v)
{
    const struct interval at[3] = {interval_point(u), interval_point(v),
                                   interval_point(0)};
    double e = 0;
    for (int i = 0; i < 3; i++) {
        const struct interval s = tape_bounds(p->f[i], at);
        e = fmax(e, tape_is_opaque(p->f[i]) ? 0 : interval_width(s));
    }
    return e;
}

static void add(struct line *l, double u, double v, struct vec3 s, double off,
                struct vec3 by_u, struct vec3 by_v)
{
    const struct parametric *p = l->p;
    const double t = along(l, s), length = vec3_length(l->d);
    const struct vec3 n = vec3_cross(by_u, by_v);
    const double slope = fabs(vec3_dot(n, l->d)) / (vec3_length(n) * length);
    const double e = (error_of(p, u, v) + off) / fmax(slope, 1e-3) / length;
    struct boundary b = {.t = t + l->shift, .dt = e, .u = u, .v = v, .drawn = 1};
    b.dt += GAMMA(8) * (fabs(l->shift) + fabs(t));
    if (!(t >= l->from - b.dt && t <= l->to + b.dt) || !isfinite(b.dt) || known(l, &b))
        return;
    struct boundary *a = boundary_list_add(l->out, b.t, b.dt, CROSS_TOUCH, 0);
    a->u = u;
    a->v = v;
}

enum newton_end { NEWTON_LOST, NEWTON_OUTSIDE, NEWTON_FOUND };

// Newton's steps from (u, v), kept near the cell: whether they came to rest, and in it.
static enum newton_end newton(struct line *l, const struct uv_cell *c, double u, double v)
{
    const struct parametric *p = l->p;
    const double su = OVERLAP * (c->u[1] - c->u[0]), sv = OVERLAP * (c->v[1] - c->v[0]);
    double best = INFINITY;
    for (int i = 0; i < NEWTON_MAX; i++) {
        struct vec3 by_u, by_v;
        double f[2];
        l->out->evaluations += 3;
        const struct vec3 s = uv_point(p, u, v, &by_u, &by_v);
        across(l, s, f);
        const double a = vec3_dot(l->n[0], by_u), b = vec3_dot(l->n[0], by_v);
        const double d = vec3_dot(l->n[1], by_u), e = vec3_dot(l->n[1], by_v);
        const double det = a * e - b * d, off = fabs(f[0]) + fabs(f[1]);
        const double du = (f[0] * e - f[1] * b) / det, dv = (f[1] * a - f[0] * d) / det;
        const bool rests = fabs(du) <= 4 * ROUNDOFF * fmax(fabs(u), c->u[1] - c->u[0]) &&
                           fabs(dv) <= 4 * ROUNDOFF * fmax(fabs(v), c->v[1] - c->v[0]);
        const double size = vec3_max_abs(s) + vec3_max_abs(l->o);
        if (rests || (off <= GAMMA(32) * size && off >= 0.5 * best) || off == 0) {
            if (u < c->u[0] - su || u > c->u[1] + su || v < c->v[0] - sv ||
                v > c->v[1] + sv)
                return NEWTON_OUTSIDE;
            if (off > 1e-9 * size)
                return NEWTON_LOST;
            u = fmin(fmax(u, p->low.u), p->high.u);
            v = fmin(fmax(v, p->low.v), p->high.v);
            add(l, u, v, s, off, by_u, by_v);
            return NEWTON_FOUND;
        }
        if (!isfinite(du) || !isfinite(dv))
            return NEWTON_LOST;
        best = fmin(best, off);
        const double wu = c->u[1] - c->u[0], wv = c->v[1] - c->v[0];
        u = fmin(fmax(u - du, c->u[0] - wu), c->u[1] + wu);
        v = fmin(fmax(v - dv, c->v[0] - wv), c->v[1] + wv);
    }
    return NEWTON_LOST;
}

static struct interval dotted(struct vec3 n, float x[3][2])
{
    struct interval sum = interval_point(0);
    for (int i = 0; i < 3; i++)
        sum = interval_add(sum,
                           interval_multiply(interval_point(vec3_axis(n, i)),
                                             interval((double)x[i][0], (double)x[i][1])));
    return sum;
}

// Whether the cell's surface, seen along the ray, misses it: by the point of the middle
// and the slopes. *regular: one root at most.
static bool misses(const struct line *l, struct uv_cell *c, bool *regular)
{
    const double hu = 0.5 * (c->u[1] - c->u[0]), hv = 0.5 * (c->v[1] - c->v[0]);
    struct interval j[2][2];
    double f[2];
    across(l, vec3(c->middle[0], c->middle[1], c->middle[2]), f);
    bool miss = false;
    for (int i = 0; i < 2; i++) {
        for (int k = 0; k < 2; k++)
            j[i][k] = dotted(l->n[i], c->slope[k]);
        const double reach = interval_size(j[i][0]) * hu + interval_size(j[i][1]) * hv;
        miss |= fabs(f[i]) > reach * (1 + 1e-9);
    }
    const struct interval det = interval_subtract(interval_multiply(j[0][0], j[1][1]),
                                                  interval_multiply(j[0][1], j[1][0]));
    *regular = !interval_has(det, 0);
    return miss;
}

// The smaller parts of a leaf in which the ray may have more than one root, or Newton got
// lost: they are made like all cells, down to a depth.
enum { SPLIT_MAX = 7 };

static void visit(struct line *l, struct uv_cell *c, int depth);

static void leaf(struct line *l, struct uv_cell *c, int depth)
{
    bool regular = false;
    if (!l->p->opaque && misses(l, c, &regular))
        return;
    const double um = 0.5 * (c->u[0] + c->u[1]), vm = 0.5 * (c->v[0] + c->v[1]);
    const enum newton_end end = newton(l, c, um, vm);
    if (regular && (end == NEWTON_FOUND || (end == NEWTON_OUTSIDE && c->flat)))
        return;
    if (depth < SPLIT_MAX && !l->p->opaque) {
        struct uv_cell *child = uv_children(l->p, c, depth);
        for (int i = 0; i < 8; i++)
            visit(l, &child[i], depth + 1);
        return;
    }
    for (int i = 0; i < 4; i++)
        newton(l, c, c->u[0] + (i & 1 ? 0.85 : 0.15) * (c->u[1] - c->u[0]),
               c->v[0] + (i & 2 ? 0.85 : 0.15) * (c->v[1] - c->v[0]));
}

static bool box_misses(const struct line *l, float box[3][2])
{
    double from = l->from, to = l->to;
    for (int i = 0; i < 3; i++) {
        const double o = vec3_axis(l->o, i), d = vec3_axis(l->d, i);
        const double lo = (double)box[i][0] - o, hi = (double)box[i][1] - o;
        if (d == 0) {
            if (lo > 0 || hi < 0)
                return true;
            continue;
        }
        const double a = lo / d, b = hi / d;
        from = fmax(from, fmin(a, b));
        to = fmin(to, fmax(a, b));
    }
    return from - GAMMA(8) * fabs(from) > to + GAMMA(8) * fabs(to);
}

static void visit(struct line *l, struct uv_cell *c, int depth)
{
    if (l->out->evaluations > l->last_evaluation || boundary_list_gives_up(l->out) ||
        box_misses(l, c->box))
        return;
    if (c->leaf) {
        leaf(l, c, depth);
        return;
    }
    struct uv_cell *child = uv_children(l->p, c, depth);
    for (int i = 0; i < 8; i++)
        visit(l, &child[i], depth + 1);
}

static void sort(struct boundary *b, uint32_t n)
{
    for (uint32_t i = 1; i < n; i++)
        for (uint32_t k = i; k > 0 && b[k - 1].t > b[k].t; k--) {
            const struct boundary swap = b[k];
            b[k] = b[k - 1];
            b[k - 1] = swap;
        }
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct parametric *p = shape;
    struct line l = {.p = p, .d = ray->d, .first = out->count, .out = out};
    p->container.ops->intersect(&p->container.shape, ray, out);
    if (out->count < l.first + 2)
        return;
    const struct boundary enter = out->at[l.first], leave = out->at[l.first + 1];
    out->count = l.first;
    const struct vec3 middle = vec3_scale(0.5, vec3_add(p->bounds.min, p->bounds.max));
    l.shift = vec3_dot(vec3_sub(middle, ray->o), ray->d) / vec3_dot(ray->d, ray->d);
    l.o = vec3_mad(ray->o, l.shift, ray->d);
    l.from = enter.t - enter.dt - l.shift;
    l.to = leave.t + leave.dt - l.shift;
    const struct vec3 u = vec3_normalize(ray->d);
    const struct vec3 a = fabs(u.x) < 0.6 ? vec3(1, 0, 0) : vec3(0, 1, 0);
    l.n[0] = vec3_normalize(vec3_cross(u, a));
    l.n[1] = vec3_cross(u, l.n[0]);
    l.last_evaluation = out->evaluations + EVALUATIONS_MAX;
    visit(&l, p->root, 0);
    sort(out->at + l.first, out->count - l.first);
}

// ---- the shape ----------------------------------------------------------------------

static void order(double *a, double *b)
{
    const double lo = fmin(*a, *b);
    *b = fmax(*a, *b);
    *a = lo;
}

static bool read_precompute(struct args *args)
{
    long depth;
    struct vec3 which;
    if (!args_word(args, "precompute"))
        return false;
    if (!args_int(args, "depth", &depth))
        return true;
    if (depth < 1 || depth > PRECOMPUTE_MAX)
        args_reject(args, "precompute takes a depth of 1 to 20");
    while (args_at_vector(args) && args_vec3(args, "x, y or z", &which))
        ;
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct parametric *p = shape;
    p->accuracy = ACCURACY;
    p->max_gradient = MAX_GRADIENT;
    p->container = container_default();
    for (int i = 0; i < 3; i++) {
        if (!(p->f[i] = args_function(args, "function")))
            return false;
        p->opaque |= tape_is_opaque(p->f[i]);
    }
    if (!args_vec2(args, "first corner of (u, v)", &p->low) ||
        !args_vec2(args, "second corner of (u, v)", &p->high))
        return false;
    order(&p->low.u, &p->high.u);
    order(&p->low.v, &p->high.v);
    while (container_read(args, &p->container) ||
           container_hint(args, "accuracy", ACCURACY, &p->accuracy) ||
           container_hint(args, "max_gradient", MAX_GRADIENT, &p->max_gradient) ||
           read_precompute(args))
        ;
    p->bounds = container_bounds(&p->container);
    p->root = uv_tree_new(args_arena(args), p);
    return true;
}

static struct aabb bounds(const void *shape)
{
    const struct parametric *p = shape;
    return p->bounds;
}

static bool inside(const void *shape, struct vec3 at)
{
    (void)shape;
    (void)at;
    return false;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 at,
                    struct surface_point *out)
{
    const struct parametric *p = shape;
    struct vec3 by_u, by_v;
    uv_point(p, b->u, b->v, &by_u, &by_v);
    struct vec3 n = vec3_cross(by_u, by_v);
    if (!(vec3_length(n) > 0 && vec3_length(n) < INFINITY)) {
        // A pole: the normal a little way into the surface.
        const double u = 0.5 * (p->low.u + p->high.u), v = 0.5 * (p->low.v + p->high.v);
        uv_point(p, b->u + 1e-6 * (u - b->u), b->v + 1e-6 * (v - b->v), &by_u, &by_v);
        n = vec3_cross(by_u, by_v);
    }
    if (!(vec3_length(n) > 0 && vec3_length(n) < INFINITY))
        n = vec3(0, 1, 0);
    out->p = at;
    out->ng = out->ns = vec3_normalize(n);
    out->uv = (struct vec2){b->u, b->v};
}

static void print(const void *shape, FILE *out)
{
    const struct parametric *p = shape;
    fputs("parametric {", out);
    for (int i = 0; i < 3; i++) {
        fputs(i ? ", function { " : " function { ", out);
        tape_print(p->f[i], out);
        fputs(" }", out);
    }
    fputc(' ', out);
    shape_print_vec2(out, p->low);
    fputs(", ", out);
    shape_print_vec2(out, p->high);
    container_print(&p->container, out);
    fputs(" accuracy ", out);
    shape_print_number(out, p->accuracy);
    fputs(" max_gradient ", out);
    shape_print_number(out, p->max_gradient);
}

const struct shape_ops parametric_ops = {
    .keyword = "parametric",
    .size = sizeof(struct parametric),
    .flags = SHAPE_BOUNDED | SHAPE_UV | SHAPE_BOUND_BOX,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .print = print,
};
