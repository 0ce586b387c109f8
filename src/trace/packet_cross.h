#ifndef TRACE_PACKET_CROSS_H
#define TRACE_PACKET_CROSS_H

// The boundaries of eight lines with one shape in full: operation by operation as in
// scene/shapes/NAME.c, so that t, dt, u and v have the same bits.
#include "scene/boundary.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/triangle.h"
#include "trace/packet_shapes.h"

// Up to two crossings, ascending; of a plane, a disc or a triangle the second is never
// drawn.
struct cross8 {
    struct real8 t[2], dt[2], part[2], u, v;
    struct mask8 met, drawn[2];
    struct mask8 enters; // the first is an entry, the second an exit; else the reverse
    struct mask8 odd;    // lanes that only the one-ray form can tell; not met
    bool sheet;          // neither entry nor exit
};

LANES_INLINE struct mask8 m8_not(struct mask8 m) { return m8_without(m8_of(255), m); }

// As sqrt_error of math/quadratic.h.
LANES_INLINE struct real8 sqrt_error8(struct real8 x, struct real8 e)
{
    return r8_div(r8_mul(r8_set(1.5), e), r8_sqrt(r8_add(x, e)));
}

LANES_INLINE struct cross8 cross8_none(void)
{
    const struct real8 zero = r8_set(0);
    const struct mask8 none = m8_of(0), all = m8_of(255);
    return (struct cross8){.t = {zero, zero},
                           .dt = {zero, zero},
                           .part = {zero, zero},
                           .u = zero,
                           .v = zero,
                           .met = none,
                           .drawn = {all, all},
                           .enters = all,
                           .odd = none,
                           .sheet = false};
}

// Each lane its own sphere.
LANES_INLINE struct cross8 cross8_ball(struct vec8 centre, struct real8 r,
                                       const struct ray8 *ray)
{
    struct cross8 x = cross8_none();
    const struct vec8 oc = v8_sub(ray->o, centre);
    const struct real8 at = r8_div(v8_dot(ray->d, oc), ray->dd);
    const struct vec8 near = v8_mad(oc, r8_neg(at), ray->d);
    const struct real8 rest = r8_sub(r8_mul(r, r), v8_dot(near, near));
    x.met = r8_lt(r8_set(0), rest);
    const struct real8 reach = r8_sqrt(r8_div(rest, ray->dd));
    const struct real8 e_p =
        r8_mul(r8_set(GAMMA(8)), r8_add(r8_add(v8_max_abs(oc), v8_max_abs(centre)), r));
    const struct real8 e =
        r8_mul(e_p, r8_add(r8_mul(r8_set(4), r), r8_mul(r8_set(2), e_p)));
    x.dt[0] = x.dt[1] = r8_div(r8_add(e_p, sqrt_error8(rest, e)), r8_sqrt(ray->dd));
    x.t[0] = r8_sub(r8_neg(at), reach);
    x.t[1] = r8_add(r8_neg(at), reach);
    return x;
}

LANES_INLINE struct cross8 cross8_sphere(const struct sphere *s, const struct ray8 *ray)
{
    return cross8_ball(V8_SET(s->centre), r8_set(s->radius), ray);
}

LANES_INLINE struct cross8 cross8_plane(const struct plane *p, const struct ray8 *ray)
{
    struct cross8 x = cross8_none();
    const struct vec8 n = V8_SET(p->normal);
    const struct real8 down = v8_dot(n, ray->d), speed = v8_max_abs(ray->d);
    x.met = m8_not(runs_along8(down, speed));
    x.t[0] = x.t[1] = r8_div(v8_dot(n, v8_sub(V8_SET(p->point), ray->o)), down);
    const struct real8 size = r8_add(r8_add(ray->o_max, r8_set(vec3_max_abs(p->point))),
                                     r8_mul(r8_abs(x.t[0]), speed));
    x.dt[0] = x.dt[1] = r8_div(r8_mul(r8_set(GAMMA(12)), size), r8_abs(down));
    x.enters = r8_lt(down, r8_set(0));
    x.drawn[1] = m8_of(0);
    return x;
}

LANES_INLINE struct cross8 cross8_disc(const struct disc *s, const struct ray8 *ray)
{
    struct cross8 x = cross8_none();
    const struct vec8 n = V8_SET(s->normal);
    const struct real8 down = v8_dot(n, ray->d), speed = v8_max_abs(ray->d);
    x.met = m8_not(runs_along8(down, speed));
    const struct vec8 to = v8_sub(V8_SET(s->centre), ray->o);
    const struct real8 t = r8_div(v8_dot(n, to), down);
    const struct vec8 q = {r8_sub(r8_mul(t, ray->d.x), to.x),
                           r8_sub(r8_mul(t, ray->d.y), to.y),
                           r8_sub(r8_mul(t, ray->d.z), to.z)};
    const struct real8 d2 = v8_dot(q, q);
    const struct real8 size = r8_add(r8_add(ray->o_max, r8_set(vec3_max_abs(s->centre))),
                                     r8_mul(r8_abs(t), speed));
    x.t[0] = x.t[1] = t;
    x.dt[0] = x.dt[1] = r8_div(r8_mul(r8_set(GAMMA(12)), size), r8_abs(down));
    x.enters = r8_lt(down, r8_set(0));
    x.drawn[0] = m8_and(r8_le(d2, r8_set(s->radius * s->radius)),
                        r8_le(r8_set(s->hole * s->hole), d2));
    x.drawn[1] = m8_of(0);
    return x;
}

// ---- boxes ------------------------------------------------------------------------------

struct slabs8 {
    struct real8 in, out, in_axis, out_axis, in_d, out_d;
};

LANES_INLINE void slabs8_axis(struct slabs8 *s, int axis, double min, double max,
                              struct real8 o, struct real8 d, struct real8 longest)
{
    struct span8 x;
    slab8(min, max, o, d, longest, r8_set(0), &x, true);
    const struct mask8 later = r8_lt(s->in, x.in), sooner = r8_lt(x.out, s->out);
    s->in = r8_select(later, x.in, s->in);
    s->in_axis = r8_select(later, r8_set(axis), s->in_axis);
    s->in_d = r8_select(later, d, s->in_d);
    s->out = r8_select(sooner, x.out, s->out);
    s->out_axis = r8_select(sooner, r8_set(axis), s->out_axis);
    s->out_d = r8_select(sooner, d, s->out_d);
}

LANES_INLINE struct cross8 cross8_box(const struct box *b, const struct ray8 *ray)
{
    struct cross8 x = cross8_none();
    const struct real8 longest = v8_max_abs(ray->d), zero = r8_set(0), one = r8_set(1);
    struct span8 first;
    slab8(b->min.x, b->max.x, ray->o.x, ray->d.x, longest, zero, &first, true);
    struct slabs8 s = {first.in, first.out, zero, zero, ray->d.x, ray->d.x};
    slabs8_axis(&s, 1, b->min.y, b->max.y, ray->o.y, ray->d.y, longest);
    slabs8_axis(&s, 2, b->min.z, b->max.z, ray->o.z, ray->d.z, longest);
    x.met = m8_and(r8_le(s.in, s.out), r8_lt(r8_set(-INFINITY), s.in));
    const struct real8 e = r8_mul(
        r8_set(GAMMA(12)),
        r8_add(ray->o_max, r8_set(larger(vec3_max_abs(b->min), vec3_max_abs(b->max)))));
    x.t[0] = s.in;
    x.t[1] = s.out;
    x.dt[0] = r8_div(e, r8_abs(s.in_d));
    x.dt[1] = r8_div(e, r8_abs(s.out_d));
    x.part[0] =
        r8_add(r8_add(s.in_axis, s.in_axis), r8_select(r8_lt(s.in_d, zero), one, zero));
    x.part[1] = r8_add(r8_add(s.out_axis, s.out_axis),
                       r8_select(r8_lt(zero, s.out_d), one, zero));
    return x;
}

// ---- around an axis -----------------------------------------------------------------------

// The stretch between two caps at 0 and `length`; across: the lines run along them.
struct caps8 {
    struct real8 t0, t1, base_first; // base_first: 1 where the base is met first
    struct mask8 across;
};

LANES_INLINE struct caps8 caps8(struct real8 o, struct real8 d, double length,
                                struct real8 longest)
{
    const struct real8 inv = r8_div(r8_set(1), d);
    const struct real8 ta = r8_mul(r8_sub(r8_set(0), o), inv);
    const struct real8 tb = r8_mul(r8_sub(r8_set(length), o), inv);
    const struct mask8 up = r8_lt(ta, tb);
    return (struct caps8){r8_select(up, ta, tb), r8_select(up, tb, ta),
                          r8_select(r8_lt(r8_set(0), d), r8_set(1), r8_set(0)),
                          runs_along8(d, longest)};
}

// What a cap taken or not makes of the two boundaries.
LANES_INLINE void cap_parts(struct cross8 *x, const struct caps8 *c, struct mask8 in,
                            struct mask8 out, int base, int top, bool open)
{
    const struct mask8 up = r8_lt(r8_set(0), c->base_first);
    const struct real8 first = r8_select(up, r8_set(base), r8_set(top));
    const struct real8 last = r8_select(up, r8_set(top), r8_set(base));
    x->part[0] = r8_select(in, first, r8_set(0));
    x->part[1] = r8_select(out, last, r8_set(0));
    if (open) {
        x->drawn[0] = m8_not(in);
        x->drawn[1] = m8_not(out);
    }
}

LANES_INLINE struct cross8 cross8_cylinder(const struct cylinder *c,
                                           const struct ray8 *ray)
{
    struct cross8 v = cross8_none();
    const struct vec8 o = frame8(&c->frame, v8_sub(ray->o, V8_SET(c->frame.origin)));
    const struct vec8 d = frame8(&c->frame, ray->d);
    const double r = c->radius;
    const struct real8 a = r8_add(r8_mul(d.x, d.x), r8_mul(d.y, d.y));
    const struct real8 longest = v8_max_abs(d), zero = r8_set(0);
    const struct mask8 along = runs_along8(r8_sqrt(a), longest);
    const struct real8 s = r8_div(r8_add(r8_mul(d.x, o.x), r8_mul(d.y, o.y)), a);
    const struct real8 x = r8_sub(o.x, r8_mul(s, d.x)), y = r8_sub(o.y, r8_mul(s, d.y));
    const struct real8 rest = r8_sub(r8_set(r * r), r8_add(r8_mul(x, x), r8_mul(y, y)));
    const struct real8 far = r8_add(r8_mul(o.x, o.x), r8_mul(o.y, o.y));
    v.met = m8_or(m8_without(r8_lt(zero, rest), along),
                  m8_and(along, r8_le(far, r8_set(r * r))));
    if (!m8_bits(v.met))
        return v;
    const struct real8 reach = r8_sqrt(r8_div(rest, a));
    v.t[0] = r8_select(along, r8_set(-INFINITY), r8_sub(r8_neg(s), reach));
    v.t[1] = r8_select(along, r8_set(INFINITY), r8_add(r8_neg(s), reach));
    const struct real8 e_p =
        r8_mul(r8_set(GAMMA(16)),
               r8_add(r8_add(r8_add(ray->o_max, r8_set(vec3_max_abs(c->frame.origin))),
                             r8_set(c->length)),
                      r8_set(r)));
    const struct real8 e = r8_mul(e_p, r8_add(r8_set(4 * r), r8_mul(r8_set(2), e_p)));
    const struct real8 side = r8_div(r8_add(e_p, sqrt_error8(rest, e)), r8_sqrt(a));
    const struct real8 cap = r8_div(e_p, r8_abs(d.z));

    const struct caps8 caps = caps8(o.z, d.z, c->length, longest);
    const struct mask8 later = m8_without(r8_lt(v.t[0], caps.t0), caps.across);
    const struct mask8 sooner = m8_without(r8_lt(caps.t1, v.t[1]), caps.across);
    v.t[0] = r8_select(later, caps.t0, v.t[0]);
    v.t[1] = r8_select(sooner, caps.t1, v.t[1]);
    v.dt[0] = r8_select(later, cap, side);
    v.dt[1] = r8_select(sooner, cap, side);
    cap_parts(&v, &caps, later, sooner, CYLINDER_BASE, CYLINDER_TOP, c->open);
    const struct mask8 between = m8_and(r8_le(zero, o.z), r8_le(o.z, r8_set(c->length)));
    v.met = m8_without(v.met, m8_without(caps.across, between));
    v.met =
        m8_and(v.met, m8_and(r8_le(v.t[0], v.t[1]), r8_lt(r8_set(-INFINITY), v.t[0])));
    return v;
}

// q = -(b + sign(b) root); the roots q / a and c / q, ascending.
LANES_INLINE void stable_roots8(struct real8 a, struct real8 b, struct real8 c,
                                struct real8 root, struct real8 *lo, struct real8 *hi)
{
    const struct real8 q = r8_neg(r8_add(b, r8_copysign(root, b)));
    const struct real8 t1 = r8_div(q, a), t2 = r8_div(c, q);
    const struct mask8 up = r8_lt(t1, t2);
    *lo = r8_select(up, t1, t2);
    *hi = r8_select(up, t2, t1);
}

LANES_INLINE struct cross8 cross8_cone(const struct cone *c, const struct ray8 *ray)
{
    struct cross8 x = cross8_none();
    const struct vec8 o = frame8(&c->frame, v8_sub(ray->o, V8_SET(c->frame.origin)));
    const struct vec8 d = frame8(&c->frame, ray->d);
    const struct real8 zero = r8_set(0), infinite = r8_set(INFINITY);
    const struct caps8 caps = caps8(o.z, d.z, c->length, v8_max_abs(d));
    const struct mask8 between = m8_and(r8_le(zero, o.z), r8_le(o.z, r8_set(c->length)));
    const struct real8 slab0 = r8_select(caps.across, r8_neg(infinite), caps.t0);
    const struct real8 slab1 = r8_select(caps.across, infinite, caps.t1);
    const double half = c->length / 2;
    const struct vec8 m = {o.x, o.y, r8_sub(o.z, r8_set(half))};
    const struct real8 shift = r8_div(r8_neg(v8_dot(m, d)), v8_dot(d, d));
    const struct vec8 near = v8_mad(m, shift, d);
    const struct real8 slope = r8_set(c->slope);
    const struct real8 rho =
        r8_add(r8_set(c->r0), r8_mul(slope, r8_add(r8_set(half), near.z)));
    const struct real8 kz = r8_mul(slope, d.z);
    const struct real8 a =
        r8_sub(r8_add(r8_mul(d.x, d.x), r8_mul(d.y, d.y)), r8_mul(kz, kz));
    const struct real8 b =
        r8_sub(r8_add(r8_mul(d.x, near.x), r8_mul(d.y, near.y)), r8_mul(kz, rho));
    const struct real8 cc =
        r8_sub(r8_add(r8_mul(near.x, near.x), r8_mul(near.y, near.y)), r8_mul(rho, rho));
    const struct real8 disc = r8_sub(r8_mul(b, b), r8_mul(a, cc));
    const struct mask8 real = r8_lt(zero, disc), flat = r8_eq(a, zero);
    const struct mask8 hollow =
        r8_lt(a, zero); // inside the double cone outside the roots
    struct real8 lo, hi;
    stable_roots8(a, b, cc, r8_sqrt(disc), &lo, &hi);
    x.odd = m8_and(flat, m8_or(m8_not(caps.across), between));
    // The first stretch: between the roots, before them, or all of the line.
    const struct real8 begin =
        r8_select(m8_without(real, hollow), r8_add(lo, shift), r8_neg(infinite));
    const struct real8 end =
        r8_select(real, r8_add(r8_select(hollow, lo, hi), shift), infinite);
    struct real8 in = r8_max(begin, slab0), out = r8_min(end, slab1);
    struct mask8 met = m8_and(r8_le(in, out), m8_or(real, hollow));
    // And the one behind them.
    const struct real8 in2 = r8_max(r8_add(hi, shift), slab0), out2 = slab1;
    struct mask8 second = m8_and(m8_and(real, hollow), r8_le(in2, out2));
    second =
        m8_and(second, m8_or(m8_not(met), r8_lt(r8_sub(out, in), r8_sub(out2, in2))));
    in = r8_select(second, in2, in);
    out = r8_select(second, out2, out);
    met = m8_or(met, second);
    met = m8_and(met, m8_and(r8_lt(r8_abs(in), infinite), r8_lt(r8_abs(out), infinite)));
    met = m8_without(met, m8_without(caps.across, between));
    x.met = m8_without(met, x.odd);

    const double r = larger(c->r0, c->r1);
    const struct real8 e_p =
        r8_mul(r8_set(GAMMA(24)),
               r8_add(r8_add(r8_add(ray->o_max, r8_set(vec3_max_abs(c->frame.origin))),
                             r8_set(c->length)),
                      r8_set(r)));
    const struct real8 wide = r8_add(r8_add(r8_set(r), r8_abs(rho)), v8_max_abs(near));
    const struct real8 e_f =
        r8_mul(e_p, r8_add(r8_mul(r8_set(4), wide), r8_mul(r8_set(2), e_p)));
    const struct real8 side =
        r8_div(e_f, r8_max(r8_mul(r8_set(2), r8_sqrt(r8_max(disc, zero))),
                           r8_sqrt(r8_mul(r8_abs(a), e_f))));
    const struct real8 cap = r8_div(e_p, r8_abs(d.z));
    const struct mask8 cap_in = m8_not(r8_lt(slab0, in)),
                       cap_out = m8_not(r8_lt(out, slab1));
    x.t[0] = in;
    x.t[1] = out;
    x.dt[0] = r8_select(cap_in, cap, side);
    x.dt[1] = r8_select(cap_out, cap, side);
    // slab_of turns the caps round where d.z < 0
    cap_parts(&x, &caps, cap_in, cap_out, CONE_BASE, CONE_TOP, c->open);
    return x;
}

// ---- quadrics -------------------------------------------------------------------------------

LANES_INLINE struct vec8 quadric8_times(const struct quadric *s, struct vec8 v)
{
    const struct real8 half = r8_set(0.5);
    const struct real8 xy = r8_set(s->xy), xz = r8_set(s->xz), yz = r8_set(s->yz);
    return (struct vec8){r8_add(r8_mul(r8_set(s->xx), v.x),
                                r8_mul(half, r8_add(r8_mul(xy, v.y), r8_mul(xz, v.z)))),
                         r8_add(r8_mul(r8_set(s->yy), v.y),
                                r8_mul(half, r8_add(r8_mul(xy, v.x), r8_mul(yz, v.z)))),
                         r8_add(r8_mul(r8_set(s->zz), v.z),
                                r8_mul(half, r8_add(r8_mul(xz, v.x), r8_mul(yz, v.y))))};
}

LANES_INLINE struct real8 quadric8_value(const struct quadric *s, struct vec8 q)
{
    return r8_add(r8_add(v8_dot(q, quadric8_times(s, q)), v8_dot(V8_SET(s->linear), q)),
                  r8_set(s->constant));
}

LANES_INLINE struct cross8 cross8_quadric(const struct quadric *s, const struct ray8 *ray)
{
    struct cross8 x = cross8_none();
    const struct vec8 d = ray->d, linear = V8_SET(s->linear);
    const struct vec8 oc = v8_sub(ray->o, V8_SET(s->centre));
    const struct real8 shift = r8_div(r8_neg(v8_dot(oc, d)), ray->dd), zero = r8_set(0);
    const struct vec8 o = v8_mad(oc, shift, d);
    const struct vec8 qd = quadric8_times(s, d), qo = quadric8_times(s, o);
    const struct real8 a = v8_dot(d, qd);
    const struct real8 b = r8_add(v8_dot(d, qo), r8_mul(r8_set(0.5), v8_dot(linear, d)));
    const struct real8 c =
        r8_add(r8_add(v8_dot(o, qo), v8_dot(linear, o)), r8_set(s->constant));
    const struct real8 disc = r8_sub(r8_mul(b, b), r8_mul(a, c));
    const struct mask8 real = r8_lt(zero, disc);
    if (!m8_bits(real))
        return x;
    const struct real8 root = r8_sqrt(disc), infinite = r8_set(INFINITY);
    struct real8 lo, hi;
    stable_roots8(a, b, c, root, &lo, &hi);
    // One root only, along an asymptote, or none that is a number.
    const struct mask8 plain = m8_and(
        m8_without(m8_and(r8_lt(r8_abs(lo), infinite), r8_lt(r8_abs(hi), infinite)),
                   r8_eq(a, zero)),
        real);
    x.odd = m8_without(real, plain);
    x.met = plain;
    const struct real8 e_p =
        r8_mul(r8_set(GAMMA(8)), r8_add(ray->o_max, r8_set(vec3_max_abs(s->centre))));
    const struct real8 size = v8_max_abs(o);
    const struct real8 slope =
        r8_add(r8_mul(r8_set(6), size), r8_set(vec3_max_abs(s->linear)));
    const struct real8 square = r8_mul(r8_mul(r8_set(6), size), size);
    const struct real8 e_f =
        r8_add(r8_mul(r8_set(GAMMA(24)), r8_add(r8_add(square, r8_mul(slope, size)),
                                                r8_set(fabs(s->constant)))),
               r8_mul(e_p, r8_add(r8_mul(r8_set(2), slope), r8_mul(r8_set(6), e_p))));
    const struct real8 dt =
        r8_div(e_f, r8_max(r8_mul(r8_set(2), root), r8_sqrt(r8_mul(r8_abs(a), e_f))));
    const struct real8 far = r8_abs(shift), unit = r8_set(GAMMA(4));
    x.t[0] = r8_add(lo, shift);
    x.t[1] = r8_add(hi, shift);
    x.dt[0] = r8_add(dt, r8_mul(unit, r8_add(r8_abs(lo), far)));
    x.dt[1] = r8_add(dt, r8_mul(unit, r8_add(r8_abs(hi), far)));
    x.enters = r8_lt(zero, a);
    return x;
}

// ---- triangles ------------------------------------------------------------------------------

// As triangle_ray; the axes differ from lane to lane.
struct shear8 {
    struct mask8 x_longest, y_longest; // else z
    struct vec8 o;
    struct real8 sx, sy, sz;
};

LANES_INLINE struct real8 turned8(const struct shear8 *r, struct real8 if_x,
                                  struct real8 if_y, struct real8 if_z)
{
    return r8_select(r->x_longest, if_x, r8_select(r->y_longest, if_y, if_z));
}

LANES_INLINE struct shear8 shear8_of(const struct ray8 *ray)
{
    const struct vec8 d = ray->d;
    const struct real8 x = r8_abs(d.x), y = r8_abs(d.y), z = r8_abs(d.z);
    const struct mask8 xy = r8_lt(y, x);
    struct shear8 r = {.x_longest = m8_and(xy, r8_lt(z, x)),
                       .y_longest = m8_without(r8_lt(z, y), xy),
                       .o = ray->o};
    const struct real8 dz = turned8(&r, d.x, d.y, d.z);
    r.sx = r8_div(turned8(&r, d.y, d.z, d.x), dz);
    r.sy = r8_div(turned8(&r, d.z, d.x, d.y), dz);
    r.sz = r8_div(r8_set(1), dz);
    return r;
}

LANES_INLINE struct real8 edge8(struct real8 ax, struct real8 ay, struct real8 bx,
                                struct real8 by)
{
    return r8_sub(r8_mul(ax, by), r8_mul(ay, bx));
}

// As triangle_meet; where no lane meets it the rest is undefined.
LANES_INLINE struct cross8 cross8_corners(const struct vec3 p[3], const struct shear8 *r,
                                          struct real8 o_max)
{
    struct cross8 c = cross8_none();
    struct real8 x[3], y[3], z[3];
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        const struct vec8 q = v8_sub(V8_SET(p[i]), r->o);
        z[i] = turned8(r, q.x, q.y, q.z);
        x[i] = r8_sub(turned8(r, q.y, q.z, q.x), r8_mul(r->sx, z[i]));
        y[i] = r8_sub(turned8(r, q.z, q.x, q.y), r8_mul(r->sy, z[i]));
    }
    const struct real8 u = edge8(x[2], y[2], x[1], y[1]), zero = r8_set(0);
    const struct real8 v = edge8(x[0], y[0], x[2], y[2]);
    const struct real8 w = edge8(x[1], y[1], x[0], y[0]);
    const struct mask8 below =
        m8_or(m8_or(r8_lt(u, zero), r8_lt(v, zero)), r8_lt(w, zero));
    const struct mask8 above =
        m8_or(m8_or(r8_lt(zero, u), r8_lt(zero, v)), r8_lt(zero, w));
    const struct real8 det = r8_add(r8_add(u, v), w);
    c.met = m8_without(m8_not(m8_and(below, above)), r8_eq(det, zero));
    if (!m8_bits(c.met))
        return c;
    c.u = r8_div(v, det);
    c.v = r8_div(w, det);
    const struct real8 sum =
        r8_add(r8_add(r8_mul(u, z[0]), r8_mul(v, z[1])), r8_mul(w, z[2]));
    c.t[0] = c.t[1] = r8_div(r8_mul(r->sz, sum), det);
    double corner = 0;
    struct real8 spread = zero, depth = zero;
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        corner = larger(vec3_max_abs(p[i]), corner);
        spread = r8_max(spread, r8_max(r8_abs(x[i]), r8_abs(y[i])));
        depth = r8_max(depth, r8_abs(r8_sub(z[i], z[(i + 1) % 3])));
    }
    const struct real8 size = r8_add(r8_set(corner), o_max);
    const struct real8 slant = r8_div(r8_mul(depth, spread), r8_abs(det));
    const struct real8 dt = r8_mul(r8_mul(r8_mul(r8_set(GAMMA(12)), size), r8_abs(r->sz)),
                                   r8_add(r8_set(2), slant));
    const struct real8 most =
        r8_mul(r8_abs(r->sz), r8_add(r8_mul(r8_set(2 * GAMMA(12)), size), depth));
    c.dt[0] = c.dt[1] = r8_min(most, dt);
    c.drawn[1] = m8_of(0);
    c.sheet = true;
    return c;
}

// ---- spans of convex shapes -------------------------------------------------------------------

// Odd lanes get the whole line, so that they stay in play until they are looked at.
LANES_INLINE struct span8 span8_of(const struct cross8 *x, struct mask8 met,
                                   struct mask8 odd)
{
    const struct real8 infinite = r8_set(INFINITY), zero = r8_set(0);
    return (struct span8){r8_select(odd, r8_neg(infinite), x->t[0]),
                          r8_select(odd, infinite, x->t[1]),
                          r8_select(odd, zero, x->dt[0]),
                          r8_select(odd, zero, x->dt[1]),
                          m8_or(met, odd),
                          m8_of(0)};
}

LANES_INLINE struct span8 span8_cone(const struct cone *c, const struct ray8 *ray,
                                     struct mask8 *odd)
{
    const struct cross8 x = cross8_cone(c, ray);
    *odd = x.odd;
    return span8_of(&x, x.met, x.odd);
}

// Where the line is inside between its two crossings. A line without crossings is outside,
// but for the rounding of a touch: see start_leaf in trace/sweep.c.
LANES_INLINE struct span8 span8_quadric(const struct quadric *s, const struct ray8 *ray,
                                        struct mask8 *odd)
{
    const struct cross8 x = cross8_quadric(s, ray);
    const struct real8 at_o = quadric8_value(s, v8_sub(ray->o, V8_SET(s->centre)));
    const struct mask8 inside = r8_le(at_o, r8_set(0));
    *odd = m8_or(x.odd, m8_or(m8_without(x.met, x.enters), m8_without(inside, x.met)));
    return span8_of(&x, x.met, *odd);
}

#endif
