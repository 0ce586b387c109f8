// The crossings of a line with a blob: on a ray a component is a quartic on one interval, so
// between two neighbouring interval ends the sum is one quartic, whose roots are isolated;
// the sign is carried from stretch to stretch, so that crossings alternate whatever the
// rounding at the joints.
#include <math.h>

#include "base/arena.h"
#include "math/gamma.h"
#include "math/polynomial.h"
#include "scene/shapes/blob.h"

// The ray in the component's space, t unchanged.
static bool stretch_of(const struct blob_component *c, struct vec3 o, struct vec3 d,
                       struct blob_stretch *out)
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
    *out = (struct blob_stretch){
        at - reach, at + reach, c->s, top, at, -a / r2, c->s > 0 ? c->s * top * top : 0};
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
static double add_quartic(const struct blob_stretch *s, double m, double c[5])
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

static void cross(struct blob_walk *w, double t, double dt)
{
    const struct boundary b = {.t = (t + w->line.shift) / w->line.length,
                               .dt = (dt + w->line.noise + GAMMA(4) * fabs(t)) /
                                     w->line.length,
                               .crossing = w->in ? CROSS_EXIT : CROSS_ENTER,
                               .drawn = 1};
    if (w->out)
        *boundary_list_add(w->out, b.t, b.dt, CROSS_ENTER, 0) = b;
    else if (!w->found && b.t > w->line.t_min)
        *w->first = b;
    w->found |= b.t > w->line.t_min;
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

// The field of a component is nowhere above between two t of its stretch.
static double peak_between(const struct blob_stretch *s, double lo, double hi)
{
    if (!(s->s > 0) || (lo <= s->at && s->at <= hi))
        return s->peak;
    const double by = (lo > s->at ? lo : hi) - s->at, q = s->top + s->bend * by * by;
    return s->s * q * q;
}

// Mostly the components around are too weak to reach the threshold.
static bool is_weak_between(const struct blob_walk *w, double lo, double hi)
{
    double most = 0;
    for (uint32_t i = 0; i < w->count; i++)
        if (w->at[i].lo <= lo && w->at[i].hi >= hi)
            most += peak_between(&w->at[i], lo, hi);
    return most < w->blob->threshold * (1 - 0x1p-30);
}

static void sum_between(const struct blob_walk *w, double lo, double hi,
                        struct blob_piece *p)
{
    const double m = 0.5 * (lo + hi);
    double bend = 0; // -1/radius^2
    double sum = fabs(w->blob->threshold);
    *p = (struct blob_piece){.c = {-w->blob->threshold}, .m = m, .half = 0.5 * (hi - lo)};
    for (uint32_t i = 0; i < w->count; i++)
        if (w->at[i].lo <= lo && w->at[i].hi >= hi) {
            sum += add_quartic(&w->at[i], m, p->c);
            bend = fmax(bend, fabs(w->at[i].bend));
        }
    p->lost = GAMMA(8) * sum; // in the sum that became c[0]
    // A place that is off by e changes s q^2 by up to 4 s e/radius.
    p->rounding = 16 + 4 * (w->line.noise / ROUNDOFF) * sqrt(bend);
}

void blob_walk_over(struct blob_walk *w, const struct blob_piece *p)
{
    const double half = p->half, lo = p->m - half;
    struct polynomial_root root[4];
    const int n = polynomial_roots(p->c, 4, -half, half, p->rounding, root);
    const bool starts_in = n > 0 ? !root[0].rising : p->c[0] > 0;
    if (!w->known)
        w->in = starts_in;
    w->known = true;
    if (starts_in != w->in) // the sign changed near the joint, by rounding
        cross(w, lo,
              GAMMA(64) * (fabs(lo) + half) +
                  polynomial_root_error(p->c, 4, -half,
                                        rounding_at(p->c, -half, p->rounding) + p->lost));
    for (int i = 0; i < n; i++)
        cross(w, p->m + root[i].t,
              root[i].dt + polynomial_root_error(p->c, 4, root[i].t, p->lost));
}

void blob_walk_past(struct blob_walk *w, bool in)
{
    w->in = in;
    w->known = true;
}

void blob_walk_to(struct blob_walk *w, const struct blob_piece *p, bool in, double t,
                  double dt)
{
    blob_walk_past(w, in);
    cross(w, p->m + t, dt);
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

struct collection {
    const struct blob *blob;
    struct vec3 o, d;
    struct blob_stretch *at;
    uint32_t count, max;
};

static void collect_one(struct collection *c, uint32_t i)
{
    struct blob_stretch s;
    if (!stretch_of(&c->blob->at[i], c->o, c->d, &s))
        return;
    if (c->count < c->max)
        c->at[c->count] = s;
    c->count++;
}

// The stretches of all components that the line meets; returns their number.
static uint32_t collect(const struct blob *b, struct vec3 o, struct vec3 d,
                        struct blob_stretch *at, uint32_t max)
{
    struct collection c = {b, o, d, at, 0, max};
    const struct bvh8 *tree = &b->tree;
    if (!tree->node) {
        for (uint32_t i = 0; i < b->count; i++)
            collect_one(&c, i);
        return c.count;
    }
    struct bvh8_ray way;
    struct bvh8_walk walk;
    const struct ray line = {o, d, -HUGE_VAL, HUGE_VAL};
    if (!bvh8_ray_begin(tree, &line, -HUGE_VAL, HUGE_VAL, &way))
        return 0;
    bvh8_walk_begin(&walk, tree);
    for (uint32_t first, n; bvh8_walk_next(&walk, tree, &way, &first, &n);)
        for (uint32_t k = first; k < first + n; k++)
            collect_one(&c, tree->item[k]);
    return c.count;
}

static void begin(struct blob_walk *w, double *end)
{
    uint32_t n = 0;
    for (uint32_t i = 0; i < w->count; i++) {
        end[n++] = w->at[i].lo;
        end[n++] = w->at[i].hi;
    }
    sort(end, n);
    w->end = end;
    w->next = 1;
    // The first crossing alone: stretches behind the ray's start, and what follows the
    // crossing, are left out.
    const struct blob_line *l = &w->line;
    w->start = w->first_only ? l->t_min * l->length - l->shift : -HUGE_VAL;
    w->stop = w->first_only ? l->t_max * l->length - l->shift : HUGE_VAL;
}

void blob_walk_begin(struct blob_walk *w, const struct blob *b,
                     const struct blob_line *line, const struct blob_stretch *at,
                     uint32_t count, double *end, struct boundary *first)
{
    *w = (struct blob_walk){.blob = b,
                            .at = at,
                            .count = count,
                            .in = 0 > b->threshold,
                            .known = true,
                            .line = *line,
                            .first_only = true,
                            .first = first};
    begin(w, end);
}

bool blob_walk_next(struct blob_walk *w, struct blob_piece *piece)
{
    const uint32_t n = 2 * w->count;
    while (w->next < n && !(w->first_only && w->found)) {
        const double lo = w->end[w->next - 1], hi = w->end[w->next];
        if (lo > w->stop)
            return false;
        w->next++;
        if (!(lo < hi))
            continue;
        if (hi < w->start) {
            w->known = false;
            continue;
        }
        if (0.5 * (hi - lo) <= GAMMA(4) * fabs(0.5 * (lo + hi)))
            continue; // joints that rounding has parted
        if ((!w->known || !w->in) && is_weak_between(w, lo, hi)) {
            blob_walk_past(w, false);
            continue;
        }
        sum_between(w, lo, hi, piece);
        return true;
    }
    if (n && w->next == n && !(w->first_only && w->found) && w->known &&
        w->in != (0 > w->blob->threshold)) // beyond the last component
        cross(w, w->end[n - 1], GAMMA(64) * fabs(w->end[n - 1]));
    return false;
}

static void walk_all(struct blob_walk *w, double *end)
{
    struct blob_piece piece;
    begin(w, end);
    while (blob_walk_next(w, &piece))
        blob_walk_over(w, &piece);
}

void blob_intersect(const struct blob *b, const struct ray *ray,
                    struct boundary_list *out)
{
    struct blob_walk w = {
        .blob = b, .known = true, .first_only = out->first_only, .out = out};
    struct blob_line *l = &w.line;
    l->length = vec3_length(ray->d);
    l->t_min = ray->t_min;
    l->t_max = ray->t_max;
    const struct vec3 u = vec3_scale(1 / l->length, ray->d);
    // Parameters from the point of the line nearest to the first component.
    const struct vec3 first = transform_point(&b->at[0].transform, b->at[0].c);
    l->shift = vec3_dot(vec3_sub(first, ray->o), u);
    l->noise = GAMMA(8) * (fabs(l->shift) + vec3_max_abs(first) + vec3_max_abs(ray->o));
    const struct vec3 o = vec3_mad(ray->o, l->shift, u);
    w.in = 0 > b->threshold;
    struct blob_stretch at[ON_STACK];
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
    struct blob_stretch *all = arena_new_array(more, struct blob_stretch, w.count);
    collect(b, o, u, all, w.count);
    w.at = all;
    walk_all(&w, arena_new_array(more, double, 2 * w.count));
    arena_free(more);
}
