#ifndef TRACE_PACKET_SHAPES_H
#define TRACE_PACKET_SHAPES_H

// The crossings of eight lines with one convex shape, operation by operation as in
// scene/shapes/NAME.c, so that every t has the same bits.
#include "math/gamma.h"
#include "math/lanes.h"
#include "math/larger.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"

struct ray8 {
    struct vec8 o, d;
    struct real8 dd;         // d.d
    struct real8 per_length; // nearly 1 / |d|, and no less
    struct real8 o_max;      // the largest coordinate of o
};

// Where a span is `clear` no error bound dt is above SPAN_CLEAR (size + |t| speed) / |d|,
// size: the sum of the ray's and the shape's coordinates, speed: the largest component of
// d, provided that GAMMA(17) size is no more than the shape's radius.
#define SPAN_CLEAR (0x1p16 * GAMMA(17))

struct span8 {
    struct real8 in, out;     // -+infinity: does not begin, does not end
    struct real8 in_e, out_e; // at least the shape's error bounds dt
    struct mask8 met;
    struct mask8 clear; // of lanes that are met
};

// Squares of sines and of relative heights above the silhouette from which a crossing is
// clear: a dt grows with their inverses' roots.
static const double clear_square = 0x1p-12, clear_slope = 0x1p-12;

LANES_INLINE struct ray8 ray8_of(struct vec8 o, struct vec8 d)
{
    const struct real8 dd = v8_dot(d, d), one = r8_set(1);
    struct ray8 ray = {o, d, dd, r8_set(1 + 0x1p-40), v8_max_abs(o)};
    // Where all are of length 1, but for rounding, that is known.
    if (m8_bits(r8_le(r8_abs(r8_sub(dd, one)), r8_set(0x1p-44))) != 255)
        ray.per_length = r8_div(r8_set(1 + 0x1p-40), r8_sqrt(dd));
    return ray;
}

// RUNS_ALONG of math/gamma.h
LANES_INLINE struct mask8 runs_along8(struct real8 down, struct real8 size)
{
    return m8_without(m8_of(255), r8_lt(r8_mul(r8_set(GAMMA(12)), size), r8_abs(down)));
}

// Where errors are not wanted the compiler drops what computes them.
LANES_INLINE struct span8 span8_sphere(const struct sphere *s, const struct ray8 *ray)
{
    const struct vec8 oc = v8_sub(ray->o, V8_SET(s->centre));
    const double r = s->radius;
    const struct real8 at = r8_div(v8_dot(ray->d, oc), ray->dd);
    const struct vec8 near = v8_mad(oc, r8_neg(at), ray->d);
    const struct real8 rest = r8_sub(r8_set(r * r), v8_dot(near, near));
    struct span8 x = {.met = r8_lt(r8_set(0), rest)};
    if (!m8_bits(x.met)) {
        x.in = x.out = x.in_e = x.out_e = rest;
        return x;
    }
    x.clear = r8_le(r8_set(clear_square * r * r), rest);
    const struct real8 reach = r8_sqrt(r8_div(rest, ray->dd));
    x.in = r8_sub(r8_neg(at), reach);
    x.out = r8_add(r8_neg(at), reach);
    // sqrt_error(rest, e) < 1.5 e / sqrt(rest), and sqrt(rest) = reach |d|.
    const struct real8 e_p = r8_mul(
        r8_set(GAMMA(9)), r8_add(v8_max_abs(oc), r8_set(vec3_max_abs(s->centre) + r)));
    const struct real8 e = r8_mul(e_p, r8_add(r8_set(4 * r), r8_add(e_p, e_p)));
    const struct real8 root =
        r8_div(r8_mul(r8_mul(r8_set(1.5 + 0x1p-20), e), ray->per_length), reach);
    x.in_e = x.out_e = r8_mul(r8_add(e_p, root), ray->per_length);
    return x;
}

LANES_INLINE struct span8 span8_plane(const struct plane *p, const struct ray8 *ray)
{
    const struct vec8 n = V8_SET(p->normal);
    const struct real8 down = v8_dot(n, ray->d);
    const struct real8 t = r8_div(v8_dot(n, v8_sub(V8_SET(p->point), ray->o)), down);
    struct span8 x = {.met =
                          m8_without(m8_of(255), runs_along8(down, v8_max_abs(ray->d)))};
    x.clear = r8_le(r8_mul(r8_set(clear_slope), v8_max_abs(ray->d)), r8_abs(down));
    const struct mask8 enters = r8_lt(down, r8_set(0));
    x.in = r8_select(enters, t, r8_set(-INFINITY));
    x.out = r8_select(enters, r8_set(INFINITY), t);
    const struct real8 size = r8_add(r8_add(ray->o_max, r8_set(vec3_max_abs(p->point))),
                                     r8_mul(r8_abs(t), v8_max_abs(ray->d)));
    x.in_e = x.out_e = r8_div(r8_mul(r8_set(GAMMA(13)), size), r8_abs(down));
    return x;
}

LANES_INLINE struct vec8 frame8(const struct frame *f, struct vec8 v)
{
    return (struct vec8){v8_dot(V8_SET(f->e1), v), v8_dot(V8_SET(f->e2), v),
                         v8_dot(V8_SET(f->e3), v)};
}

// A closed cylinder.
LANES_INLINE struct span8 span8_cylinder(const struct cylinder *c, const struct ray8 *ray)
{
    const struct vec8 o = frame8(&c->frame, v8_sub(ray->o, V8_SET(c->frame.origin)));
    const struct vec8 d = frame8(&c->frame, ray->d);
    const double r = c->radius;
    const struct real8 a = r8_add(r8_mul(d.x, d.x), r8_mul(d.y, d.y));
    const struct real8 longest = v8_max_abs(d);
    const struct mask8 along = runs_along8(r8_sqrt(a), longest);
    const struct real8 s = r8_div(r8_add(r8_mul(d.x, o.x), r8_mul(d.y, o.y)), a);
    const struct real8 x = r8_sub(o.x, r8_mul(s, d.x)), y = r8_sub(o.y, r8_mul(s, d.y));
    const struct real8 rest = r8_sub(r8_set(r * r), r8_add(r8_mul(x, x), r8_mul(y, y)));
    struct span8 v = {.met = r8_lt(r8_set(0), rest)};
    if (m8_bits(along)) {
        const struct real8 far = r8_add(r8_mul(o.x, o.x), r8_mul(o.y, o.y));
        v.met = m8_or(m8_without(v.met, along), m8_and(along, r8_le(far, r8_set(r * r))));
    }
    if (!m8_bits(v.met)) {
        v.in = v.out = v.in_e = v.out_e = rest;
        return v;
    }
    v.clear = m8_or(along, m8_and(r8_le(r8_set(clear_square * r * r), rest),
                                  r8_le(r8_mul(r8_set(clear_square), ray->dd), a)));
    const struct real8 reach = r8_sqrt(r8_div(rest, a));
    v.in = r8_select(along, r8_set(-INFINITY), r8_sub(r8_neg(s), reach));
    v.out = r8_select(along, r8_set(INFINITY), r8_add(r8_neg(s), reach));
    const struct real8 e_p =
        r8_mul(r8_set(GAMMA(17)),
               r8_add(ray->o_max, r8_set(vec3_max_abs(c->frame.origin) + c->length + r)));
    const struct real8 e = r8_mul(e_p, r8_add(r8_set(4 * r), r8_add(e_p, e_p)));
    const struct real8 per_a = r8_div(r8_set(1 + 0x1p-40), r8_sqrt(a));
    const struct real8 root =
        r8_div(r8_mul(r8_mul(r8_set(1.5 + 0x1p-20), e), per_a), reach);
    v.in_e = v.out_e = r8_mul(r8_add(e_p, root), per_a);

    const struct mask8 across = runs_along8(d.z, longest);
    v.clear = m8_and(
        v.clear, m8_or(across, r8_le(r8_mul(r8_set(clear_slope), longest), r8_abs(d.z))));
    const struct real8 length = r8_set(c->length);
    const struct real8 inv = r8_div(r8_set(1), d.z);
    const struct real8 ta = r8_mul(r8_sub(r8_set(0), o.z), inv);
    const struct real8 tb = r8_mul(r8_sub(length, o.z), inv);
    const struct mask8 up = r8_lt(ta, tb);
    const struct real8 t0 = r8_select(up, ta, tb), t1 = r8_select(up, tb, ta);
    const struct real8 cap_e = r8_abs(r8_mul(e_p, inv));
    const struct mask8 later = m8_without(r8_lt(v.in, t0), across);
    const struct mask8 sooner = m8_without(r8_lt(t1, v.out), across);
    v.in = r8_select(later, t0, v.in);
    v.in_e = r8_select(later, cap_e, v.in_e);
    v.out = r8_select(sooner, t1, v.out);
    v.out_e = r8_select(sooner, cap_e, v.out_e);
    if (m8_bits(across))
        v.met = m8_without(
            v.met, m8_without(across, m8_and(r8_le(r8_set(0), o.z), r8_le(o.z, length))));
    v.met = m8_and(v.met, m8_and(r8_le(v.in, v.out), r8_lt(r8_set(-INFINITY), v.in)));
    return v;
}

LANES_INLINE void slab8(double min, double max, struct real8 o, struct real8 d,
                        struct real8 longest, struct real8 e, struct span8 *x, bool first)
{
    const struct mask8 flat = runs_along8(d, longest);
    const struct real8 inv = r8_div(r8_set(1), d);
    const struct real8 a = r8_mul(r8_sub(r8_set(min), o), inv);
    const struct real8 b = r8_mul(r8_sub(r8_set(max), o), inv);
    struct real8 t0 = r8_min(a, b);
    struct real8 t1 = r8_select(r8_lt(a, b), b, a);
    if (m8_bits(flat)) {
        const struct mask8 in = m8_and(r8_le(r8_set(min), o), r8_le(o, r8_set(max)));
        const struct real8 from = r8_select(in, r8_set(-INFINITY), r8_set(INFINITY));
        t0 = r8_select(flat, from, t0);
        t1 = r8_select(flat, r8_neg(from), t1);
    }
    const struct real8 dt = r8_abs(r8_mul(e, inv));
    const struct mask8 clear =
        m8_or(flat, r8_le(r8_mul(r8_set(clear_slope), longest), r8_abs(d)));
    if (first) {
        *x = (struct span8){t0, t1, dt, dt, m8_of(255), clear};
        return;
    }
    x->clear = m8_and(x->clear, clear);
    const struct mask8 later = r8_lt(x->in, t0), sooner = r8_lt(t1, x->out);
    x->in = r8_select(later, t0, x->in);
    x->in_e = r8_select(later, dt, x->in_e);
    x->out = r8_select(sooner, t1, x->out);
    x->out_e = r8_select(sooner, dt, x->out_e);
}

LANES_INLINE struct span8 span8_box(const struct box *b, const struct ray8 *ray)
{
    const struct real8 e = r8_mul(
        r8_set(GAMMA(14)),
        r8_add(ray->o_max, r8_set(larger(vec3_max_abs(b->min), vec3_max_abs(b->max)))));
    const struct real8 longest = v8_max_abs(ray->d);
    struct span8 x;
    slab8(b->min.x, b->max.x, ray->o.x, ray->d.x, longest, e, &x, true);
    slab8(b->min.y, b->max.y, ray->o.y, ray->d.y, longest, e, &x, false);
    slab8(b->min.z, b->max.z, ray->o.z, ray->d.z, longest, e, &x, false);
    x.met = m8_and(r8_le(x.in, x.out), r8_lt(r8_set(-INFINITY), x.in));
    return x;
}

#endif
