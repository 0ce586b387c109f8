// blob { [threshold T] sphere { c, r, s } cylinder { a, b, r, s } component s, r, c ... }
//
// Each component has the field s (1 - d^2/r^2)^2 within its radius; the surface is where
// the sum is T. A cylinder is a straight piece and two half balls. On a ray a component
// is a quartic on one interval, so between two neighbouring interval ends the sum is one
// quartic, whose roots are isolated; the sign is carried from stretch to stretch, so
// that crossings alternate whatever the rounding at the joints.
#include <math.h>
#include <string.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "math/polynomial.h"
#include "math/transform.h"
#include "scene/args.h"
#include "scene/shape.h"

enum part_kind { PART_BALL, PART_STRAIGHT, PART_BASE, PART_APEX };

struct component {
    enum part_kind kind;
    // Centre, or base of a cylinder, from where all its parts measure their share of the
    // axis, so that none overlap and no gap is left; unit axis towards the apex.
    struct vec3 c, axis;
    double length, r, s;
    struct transform transform; // blob from component space
    const struct texture *texture; // NULL: the blob's
};

struct blob {
    struct component *at;
    uint32_t count, capacity;
    double threshold;
};

// A component on a line: q(t) = 1 - d^2/r^2 = top + bend (t - at)^2 for lo < t < hi. About the
// nearest point, so that a thin component keeps its digits on a line from afar.
struct stretch {
    double lo, hi, s, top, at, bend;
    double peak; // the field is never above
};

// The ray in the component's space, t unchanged.
static bool stretch_of(const struct component *c, struct vec3 o, struct vec3 d,
                       struct stretch *out)
{
    if (!c->transform.identity) {
        o = transform_inverse_point(&c->transform, o);
        d = transform_inverse_vector(&c->transform, d);
    }
    struct vec3 v = vec3_sub(o, c->c);
    const double along = vec3_dot(v, c->axis), slope = vec3_dot(d, c->axis);
    if (c->kind == PART_STRAIGHT) { // distances from the axis
        v = vec3_mad(v, -along, c->axis);
        d = vec3_mad(d, -slope, c->axis);
    } else if (c->kind == PART_APEX) {
        v = vec3_mad(v, -c->length, c->axis);
    }
    const double r2 = c->r * c->r, a = vec3_dot(d, d), b = vec3_dot(v, d);
    const double at = a > 0 ? -b / a : 0;
    const struct vec3 near = vec3_mad(v, at, d);
    const double rest = r2 - vec3_dot(near, near), top = rest / r2;
    if (!(rest > 0))
        return false;
    const double reach = sqrt(rest / a); // infinite along the axis of a cylinder
    *out = (struct stretch){at - reach, at + reach, c->s, top, at, -a / r2,
                            c->s > 0 ? c->s * top * top : 0};
    if (c->kind == PART_BALL)
        return true;
    // Which part of the axis counts: low <= along + slope t <= high.
    const double low = c->kind == PART_BASE       ? -HUGE_VAL
                       : c->kind == PART_STRAIGHT ? 0
                                                  : c->length;
    const double high = c->kind == PART_BASE       ? 0
                        : c->kind == PART_STRAIGHT ? c->length
                                                   : HUGE_VAL;
    if (slope == 0)
        return along >= low && along < high && out->lo < out->hi;
    const double t0 = (low - along) / slope, t1 = (high - along) / slope;
    out->lo = fmax(out->lo, fmin(t0, t1));
    out->hi = fmin(out->hi, fmax(t0, t1));
    return out->lo < out->hi;
}

// Adds s q^2 about t = m to ascending coefficients; returns what the first gains at most.
static double add_quartic(const struct stretch *s, double m, double c[5])
{
    const double by = m - s->at, sink = s->bend * by * by;
    const double q0 = s->top + sink, q1 = 2 * by * s->bend, q2 = s->bend;
    c[0] += s->s * q0 * q0;
    c[1] += s->s * 2 * q0 * q1;
    c[2] += s->s * (q1 * q1 + 2 * q0 * q2);
    c[3] += s->s * 2 * q1 * q2;
    c[4] += s->s * q2 * q2;
    return fabs(s->s) * (s->top * s->top + fabs(q0 * sink));
}

struct walk {
    const struct blob *blob;
    const struct stretch *at;
    uint32_t count;
    bool in, known; // the state; whether it is known
    double shift, length, noise;
    const struct ray *ray;
    struct boundary_list *out;
};

static void cross(struct walk *w, double t, double dt)
{
    boundary_list_add(w->out, (t + w->shift) / w->length,
                      (dt + w->noise + GAMMA(4) * fabs(t)) / w->length,
                      w->in ? CROSS_EXIT : CROSS_ENTER, 0);
    w->in = !w->in;
}

// The rounding of a quartic's value at t.
static double rounding_at(const double c[5], double t, double rounding)
{
    double size = 0;
    for (int k = 4; k >= 0; k--)
        size = size * fabs(t) + fabs(c[k]);
    return rounding * ROUNDOFF * size;
}

static void walk_between(struct walk *w, double lo, double hi)
{
    const double m = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
    if (half <= GAMMA(4) * fabs(m)) // joints that rounding has parted
        return;
    double c[5] = {-w->blob->threshold}, most = 0;
    if (!w->known || !w->in) { // mostly the components around are too weak to reach the threshold
        for (uint32_t i = 0; i < w->count; i++)
            if (w->at[i].lo <= lo && w->at[i].hi >= hi)
                most += w->at[i].peak;
        if (most < w->blob->threshold * (1 - 0x1p-30)) {
            w->known = true;
            w->in = false;
            return;
        }
    }
    double bend = 0; // -1/radius^2
    double sum = fabs(w->blob->threshold);
    for (uint32_t i = 0; i < w->count; i++)
        if (w->at[i].lo <= lo && w->at[i].hi >= hi) {
            sum += add_quartic(&w->at[i], m, c);
            bend = fmax(bend, fabs(w->at[i].bend));
        }
    const double lost = GAMMA(8) * sum; // in the sum that became c[0]
    // A place that is off by e changes s q^2 by up to 4 s e/radius.
    const double rounding = 16 + 4 * (w->noise / ROUNDOFF) * sqrt(bend);
    struct polynomial_root root[4];
    const int n = polynomial_roots(c, 4, -half, half, rounding, root);
    const bool starts_in = n > 0 ? !root[0].rising : c[0] > 0;
    if (!w->known)
        w->in = starts_in;
    w->known = true;
    if (starts_in != w->in) // the sign changed near the joint, by rounding
        cross(w, lo,
              GAMMA(64) * (fabs(lo) + half) +
                  polynomial_root_error(c, 4, -half,
                                        rounding_at(c, -half, rounding) + lost));
    for (int i = 0; i < n; i++)
        cross(w, m + root[i].t,
              root[i].dt + polynomial_root_error(c, 4, root[i].t, lost));
}

enum { ON_STACK = 64 };

static void sort(double *v, uint32_t n)
{
    for (uint32_t i = 1; i < n; i++) {
        const double x = v[i];
        uint32_t j = i;
        for (; j > 0 && v[j - 1] > x; j--)
            v[j] = v[j - 1];
        v[j] = x;
    }
}

static uint32_t collect(const struct blob *b, struct vec3 o, struct vec3 d,
                        struct stretch *at, uint32_t max)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        struct stretch s;
        if (!stretch_of(&b->at[i], o, d, &s))
            continue;
        if (n < max)
            at[n] = s;
        n++;
    }
    return n;
}

static void walk_all(struct walk *w, double *end)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        end[n++] = w->at[i].lo;
        end[n++] = w->at[i].hi;
    }
    sort(end, n);
    // The first drawn crossing alone: stretches behind the ray's start, and what follows the
    // crossing, are left out.
    const bool first_only = w->out->first_only;
    const double start = first_only ? w->ray->t_min * w->length - w->shift : -HUGE_VAL;
    const double stop = first_only ? w->ray->t_max * w->length - w->shift : HUGE_VAL;
    for (uint32_t i = 1; i < n; i++) {
        if (!(end[i - 1] < end[i]))
            continue;
        if (end[i] < start) {
            w->known = false;
            continue;
        }
        const uint32_t before = w->out->count;
        walk_between(w, end[i - 1], end[i]);
        for (uint32_t k = before; first_only && k < w->out->count; k++)
            if (w->out->at[k].t > w->ray->t_min)
                return;
        if (end[i] > stop)
            return;
    }
    if (w->known && w->in != (0 > w->blob->threshold)) // beyond the last component
        cross(w, end[n - 1], GAMMA(64) * fabs(end[n - 1]));
}

static void intersect(const void *shape, const struct ray *ray, struct boundary_list *out)
{
    const struct blob *b = shape;
    struct walk w = {.blob = b, .length = vec3_length(ray->d), .known = true, .ray = ray,
                     .out = out};
    const struct vec3 u = vec3_scale(1 / w.length, ray->d);
    // Parameters from the point of the line nearest to the first component.
    const struct vec3 first = transform_point(&b->at[0].transform, b->at[0].c);
    w.shift = vec3_dot(vec3_sub(first, ray->o), u);
    w.noise = GAMMA(8) * (fabs(w.shift) + vec3_max_abs(first) + vec3_max_abs(ray->o));
    const struct vec3 o = vec3_mad(ray->o, w.shift, u);
    w.in = 0 > b->threshold;
    struct stretch at[ON_STACK];
    double end[2 * ON_STACK];
    w.count = collect(b, o, u, at, ON_STACK);
    w.at = at;
    if (w.count == 0)
        return;
    if (w.count <= ON_STACK) {
        walk_all(&w, end);
        return;
    }
    struct arena *more = arena_new(w.count * (sizeof *at + 2 * sizeof *end));
    struct stretch *all = arena_new_array(more, struct stretch, w.count);
    collect(b, o, u, all, w.count);
    w.at = all;
    walk_all(&w, arena_new_array(more, double, 2 * w.count));
    arena_free(more);
}

// 1 - d^2/r^2 of one component at a point, or 0 where it does not reach; *v goes from its
// nearest part to the point, in its own space.
static double reach(const struct component *c, struct vec3 p, struct vec3 *v)
{
    *v = vec3_sub(transform_inverse_point(&c->transform, p), c->c);
    const double along = vec3_dot(*v, c->axis);
    if ((c->kind == PART_STRAIGHT && !(along >= 0 && along < c->length)) ||
        (c->kind == PART_BASE && along >= 0) ||
        (c->kind == PART_APEX && along < c->length))
        return 0;
    if (c->kind == PART_STRAIGHT || c->kind == PART_APEX)
        *v = vec3_mad(*v, c->kind == PART_APEX ? -c->length : -along, c->axis);
    const double k = 1 - vec3_dot(*v, *v) / (c->r * c->r);
    return k > 0 ? k : 0;
}

// The field and its gradient at a point.
static double field(const struct blob *b, struct vec3 p, struct vec3 *gradient)
{
    double sum = 0;
    *gradient = vec3(0, 0, 0);
    for (uint32_t i = 0; i < b->count; i++) {
        const struct component *c = &b->at[i];
        struct vec3 v;
        const double k = reach(c, p, &v);
        if (!(k > 0))
            continue;
        sum += c->s * k * k;
        const struct vec3 g = vec3_scale(-4 * c->s * k / (c->r * c->r), v);
        *gradient = vec3_add(*gradient, transform_normal(&c->transform, g));
    }
    return sum;
}

static const struct texture *part_texture(const void *shape, uint32_t i)
{
    const struct blob *b = shape;
    for (uint32_t k = 0; k < b->count; k++)
        if (b->at[k].texture && i-- == 0)
            return b->at[k].texture;
    return NULL;
}

// Every component counts with its share of the field, without regard to sign.
static void textures_at(const void *shape, const struct boundary *at, struct vec3 p,
                        shape_texture_visit *visit, void *user)
{
    (void)at;
    const struct blob *b = shape;
    struct vec3 v;
    double sum = 0;
    for (uint32_t i = 0; i < b->count; i++) {
        const double k = reach(&b->at[i], p, &v);
        sum += fabs(b->at[i].s) * k * k;
    }
    if (!(sum > 0)) {
        visit(user, NULL, 1);
        return;
    }
    for (uint32_t i = 0; i < b->count; i++) {
        const double k = reach(&b->at[i], p, &v);
        if (k > 0 && b->at[i].s != 0)
            visit(user, b->at[i].texture, fabs(b->at[i].s) * k * k / sum);
    }
}

static struct aabb bounds(const void *shape)
{
    const struct blob *b = shape;
    struct aabb box = aabb_empty();
    if (0 > b->threshold)
        return aabb_infinite();
    for (uint32_t i = 0; i < b->count; i++) {
        const struct component *c = &b->at[i];
        const struct vec3 r = vec3(c->r, c->r, c->r);
        struct aabb one = {vec3_sub(c->c, r), vec3_add(c->c, r)};
        if (c->kind == PART_STRAIGHT || c->kind == PART_APEX) {
            const struct vec3 end = vec3_mad(c->c, c->length, c->axis);
            one = aabb_join(one, (struct aabb){vec3_sub(end, r), vec3_add(end, r)});
        }
        if (c->s > 0)
            box = aabb_join(box, aabb_transform(one, &c->transform));
    }
    return box;
}

static bool inside(const void *shape, struct vec3 p)
{
    struct vec3 gradient;
    const struct blob *b = shape;
    return field(b, p, &gradient) >= b->threshold;
}

static void surface(const void *shape, const struct boundary *b, struct vec3 p,
                    struct surface_point *out)
{
    (void)b;
    struct vec3 gradient;
    field(shape, p, &gradient);
    struct vec3 n = vec3_normalize(vec3_neg(gradient));
    if (vec3_dot(n, n) == 0)
        n = vec3(1, 0, 0);
    out->p = p;
    out->ng = out->ns = n;
    out->uv = (struct vec2){p.x, p.y};
}

// ---- reading ------------------------------------------------------------

static struct component *add(struct blob *b, struct arena *a)
{
    if (b->count == b->capacity) {
        b->capacity = b->capacity ? 2 * b->capacity : 16;
        struct component *more = arena_new_array(a, struct component, b->capacity);
        if (b->count)
            memcpy(more, b->at, b->count * sizeof *more);
        b->at = more;
    }
    struct component *c = &b->at[b->count++];
    c->transform = transform_identity;
    c->axis = vec3(0, 0, 1);
    return c;
}

static bool read_ball(struct blob *b, struct args *block, struct arena *a)
{
    struct component c = {.kind = PART_BALL, .axis = {0, 0, 1}};
    if (!args_vec3(block, "centre", &c.c) || !args_float(block, "radius", &c.r))
        return false;
    args_word(block, "strength");
    if (!args_float(block, "strength", &c.s) || !args_part(block, &c.transform, &c.texture))
        return false;
    *add(b, a) = c;
    return true;
}

static bool read_cylinder(struct blob *b, struct args *block, struct arena *a)
{
    struct component c = {.kind = PART_STRAIGHT};
    struct vec3 end;
    if (!args_vec3(block, "base", &c.c) || !args_vec3(block, "apex", &end) ||
        !args_float(block, "radius", &c.r))
        return false;
    args_word(block, "strength");
    if (!args_float(block, "strength", &c.s) || !args_part(block, &c.transform, &c.texture))
        return false;
    const struct vec3 along = vec3_sub(end, c.c);
    c.length = vec3_length(along);
    if (!(c.length > 0)) {
        args_reject(block, "the ends of the cylinder coincide");
        return false;
    }
    c.axis = vec3_scale(1 / c.length, along);
    *add(b, a) = c;
    c.kind = PART_BASE;
    *add(b, a) = c;
    c.kind = PART_APEX;
    *add(b, a) = c;
    return true;
}

static bool build(void *shape, struct args *args)
{
    struct blob *b = shape;
    struct arena *a = args_arena(args);
    b->threshold = 1;
    for (;;) {
        struct args *block;
        if (args_word(args, "threshold")) {
            if (!args_float(args, "threshold", &b->threshold))
                return false;
        } else if (args_word(args, "component")) {
            struct component c = {.kind = PART_BALL, .axis = {0, 0, 1},
                                  .transform = transform_identity};
            if (!args_float(args, "strength", &c.s) ||
                !args_float(args, "radius", &c.r) || !args_vec3(args, "centre", &c.c))
                return false;
            *add(b, a) = c;
        } else if ((block = args_block(args, "sphere"))) {
            if (!read_ball(b, block, a))
                return false;
        } else if ((block = args_block(args, "cylinder"))) {
            if (!read_cylinder(b, block, a))
                return false;
        } else {
            break;
        }
    }
    if (b->count == 0) {
        args_reject(args, "a blob needs at least one component");
        return false;
    }
    return true;
}

static void print_component(const struct component *c, FILE *out)
{
    fputs(c->kind == PART_STRAIGHT ? " cylinder { " : " sphere { ", out);
    shape_print_vec3(out, c->c);
    if (c->kind == PART_STRAIGHT) {
        fputs(", ", out);
        shape_print_vec3(out, vec3_mad(c->c, c->length, c->axis));
    }
    fputs(", ", out);
    shape_print_number(out, c->r);
    fputs(", ", out);
    shape_print_number(out, c->s);
    if (!c->transform.identity) {
        const struct mat3 *m = &c->transform.linear;
        fputs(" matrix <", out);
        for (int i = 0; i < 9; i++) {
            shape_print_number(out, m->m[i / 3][i % 3]);
            fputs(", ", out);
        }
        const struct vec3 o = c->transform.offset;
        shape_print_number(out, o.x);
        fputs(", ", out);
        shape_print_number(out, o.y);
        fputs(", ", out);
        shape_print_number(out, o.z);
        fputs(">", out);
    }
    fputs(" }", out);
}

static void print(const void *shape, FILE *out)
{
    const struct blob *b = shape;
    fputs("blob { threshold ", out);
    shape_print_number(out, b->threshold);
    for (uint32_t i = 0; i < b->count; i++)
        if (b->at[i].kind == PART_BALL || b->at[i].kind == PART_STRAIGHT)
            print_component(&b->at[i], out);
}

const struct shape_ops blob_ops = {
    .keyword = "blob",
    .size = sizeof(struct blob),
    .flags = SHAPE_SOLID | SHAPE_STURM | SHAPE_HIERARCHY,
    .build = build,
    .bounds = bounds,
    .inside = inside,
    .intersect = intersect,
    .surface = surface,
    .texture = part_texture,
    .textures_at = textures_at,
    .print = print,
};
