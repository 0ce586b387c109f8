#ifndef TRACE_PACKET_TORUS_H
#define TRACE_PACKET_TORUS_H

// Eight lines and a torus, operation by operation as scene/shapes/torus.c and, of
// math/polynomial.c, the way through certain_roots with no root or two, of the chord whole
// or of each half. The other lanes (grazes, lines along the tube) are left to the one-ray
// form.
#include "scene/shapes/torus.h"
#include "trace/packet_cross.h"

enum { TORUS_MIDDLE_STEPS = 4, TORUS_ROOT_STEPS = 16, TORUS_SHARPEN_STEPS = 3 };

// t^4 + c2 t^2 + c1 t + c0
struct quartic8 {
    struct real8 c0, c1, c2;
};

LANES_INLINE struct real8 quartic8_value(const struct quartic8 *c, struct real8 t)
{
    const struct real8 v = r8_add(r8_mul(t, t), c->c2);
    return r8_add(r8_mul(r8_add(r8_mul(v, t), c->c1), t), c->c0);
}

LANES_INLINE struct real8 quartic8_slope(const struct quartic8 *c, struct real8 t)
{
    const struct real8 v = r8_add(r8_mul(r8_mul(r8_set(4), t), t), r8_add(c->c2, c->c2));
    return r8_add(r8_mul(v, t), c->c1);
}

LANES_INLINE struct real8 quartic8_bend(const struct quartic8 *c, struct real8 t)
{
    return r8_add(r8_mul(r8_mul(r8_set(12), t), t), r8_add(c->c2, c->c2));
}

LANES_INLINE struct real8 quartic8_magnitude(const struct quartic8 *c, struct real8 t)
{
    t = r8_abs(t);
    const struct real8 v = r8_add(r8_mul(t, t), r8_abs(c->c2));
    return r8_add(r8_mul(r8_add(r8_mul(v, t), r8_abs(c->c1)), t), r8_abs(c->c0));
}

// The Bernstein polygon of bernstein(); the lanes where its signs are clear and change
// never, those where they change twice or four times, from above to above, and once.
struct polygon8 {
    struct real8 b[5];
    unsigned none, two, four, one;
};

LANES_INLINE struct polygon8 polygon8_of(const struct quartic8 *c, struct real8 lo,
                                         struct real8 hi)
{
    struct polygon8 p = {.b = {c->c0, c->c1, c->c2, r8_set(0), r8_set(1)}};
    struct real8 *b = p.b;
    const struct real8 width = r8_sub(hi, lo), zero = r8_set(0);
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++)
#pragma GCC unroll 4
        for (int k = 3; k >= i; k--)
            b[k] = r8_add(b[k], r8_mul(lo, b[k + 1]));
    struct real8 scale = r8_set(1), size = zero;
#pragma GCC unroll 5
    for (int i = 0; i <= 4; i++) {
        b[i] = r8_mul(b[i], scale);
        if (i < 4)
            scale = r8_mul(scale, r8_mul(width, r8_set((i + 1.) / (4 - i))));
        size = r8_add(size, r8_abs(b[i]));
    }
#pragma GCC unroll 4
    for (int i = 0; i < 4; i++)
#pragma GCC unroll 4
        for (int k = 4; k > i; k--)
            b[k] = r8_add(b[k], b[k - 1]);
    const struct real8 noise =
        r8_mul(r8_set(64 * ROUNDOFF),
               r8_add(size, quartic8_magnitude(c, r8_max(r8_abs(lo), r8_abs(hi)))));
    unsigned clear = 255, sign[5];
#pragma GCC unroll 5
    for (int i = 0; i <= 4; i++) {
        clear &= m8_bits(r8_lt(noise, r8_abs(b[i])));
        sign[i] = m8_bits(r8_lt(zero, b[i]));
    }
    const unsigned d1 = sign[0] ^ sign[1], d2 = sign[1] ^ sign[2], d3 = sign[2] ^ sign[3],
                   d4 = sign[3] ^ sign[4];
    const unsigned any = d1 | d2 | d3 | d4, odd = d1 ^ d2 ^ d3 ^ d4,
                   all = d1 & d2 & d3 & d4;
    p.none = clear & ~any;
    p.two = clear & any & ~odd & ~all & sign[0];
    p.four = clear & all & sign[0];
    p.one = clear & odd & ~((d1 & d2) | (d3 & d4) | ((d1 | d2) & (d3 | d4)));
    return p;
}

LANES_INLINE struct real8 either8(unsigned lanes, struct real8 x, struct real8 y)
{
    return r8_select(m8_of(lanes), x, y);
}

struct middle8 {
    struct real8 t, left, right;
    struct real8 lowest; // where it has been sought last
    unsigned found;
};

// As between_roots.
LANES_INLINE struct middle8 middle8_of(const struct quartic8 *c, const struct polygon8 *p,
                                       struct real8 lo, struct real8 hi, unsigned lanes)
{
    const struct mask8 second = r8_lt(p->b[2], p->b[1]);
    const struct real8 low = r8_select(second, p->b[2], p->b[1]);
    const struct real8 lowest = r8_select(r8_lt(p->b[3], low), r8_set(3),
                                          r8_select(second, r8_set(2), r8_set(1)));
    const struct real8 half = r8_set(0.5), two = r8_set(2);
    struct middle8 m = {.t = lo, .left = lo, .right = hi, .found = 0};
    struct real8 t = r8_add(lo, r8_div(r8_mul(r8_sub(hi, lo), lowest), r8_set(4)));
    m.lowest = t;
    for (int i = 0; i < TORUS_MIDDLE_STEPS && lanes; i++) {
        const struct real8 v = quartic8_value(c, t), slope = quartic8_slope(c, t);
        const struct real8 bend = quartic8_bend(c, t);
        const struct mask8 below =
            r8_lt(v, r8_mul(r8_set(-8 * ROUNDOFF), quartic8_magnitude(c, t)));
        const unsigned here = lanes & m8_bits(below);
        if (here) {
            const struct mask8 in = m8_of(here);
            const struct real8 reach =
                r8_sqrt(r8_sub(r8_mul(slope, slope), r8_mul(r8_mul(two, v), bend)));
            struct real8 left = r8_sub(t, r8_div(r8_add(slope, reach), bend));
            struct real8 right = r8_sub(t, r8_div(r8_sub(slope, reach), bend));
            left = r8_select(m8_and(r8_lt(lo, left), r8_lt(left, t)), left,
                             r8_mul(half, r8_add(lo, t)));
            right = r8_select(m8_and(r8_lt(t, right), r8_lt(right, hi)), right,
                              r8_mul(half, r8_add(t, hi)));
            m.t = r8_select(in, t, m.t);
            m.left = r8_select(in, left, m.left);
            m.right = r8_select(in, right, m.right);
            m.found |= here;
        }
        lanes &= ~here & m8_bits(r8_lt(r8_set(0), bend));
        t = r8_sub(t, r8_div(slope, bend));
        lanes &= m8_bits(m8_and(r8_lt(lo, t), r8_lt(t, hi)));
        m.lowest = either8(lanes, t, m.lowest);
    }
    return m;
}

// As root_between; returns the lanes that arrived.
LANES_INLINE unsigned root8_between(const struct quartic8 *c, struct real8 lo,
                                    struct real8 hi, struct real8 t, bool rising,
                                    unsigned lanes, struct real8 *root)
{
    struct real8 last = r8_set(INFINITY);
    const struct real8 zero = r8_set(0), infinite = r8_set(INFINITY);
    unsigned arrived = 0;
    *root = t;
    for (int i = 0; i < TORUS_ROOT_STEPS && lanes; i++) {
        const struct real8 v = quartic8_value(c, t);
        const struct mask8 above = r8_lt(zero, v);
        const struct mask8 right = rising ? above : m8_not(above);
        hi = r8_select(right, t, hi);
        lo = r8_select(right, lo, t);
        struct real8 next = r8_sub(t, r8_div(v, quartic8_slope(c, t)));
        struct real8 step = r8_abs(r8_sub(next, t));
        const struct mask8 in = m8_and(r8_lt(lo, next), r8_lt(next, hi));
        next = r8_select(in, next, r8_mul(r8_set(0.5), r8_add(lo, hi)));
        step = r8_select(in, step, infinite);
        const struct mask8 cube =
            r8_le(r8_mul(r8_mul(step, step), step),
                  r8_mul(r8_mul(r8_set(0x1p-54), r8_abs(next)), r8_mul(last, last)));
        struct mask8 done =
            m8_or(r8_eq(next, t), m8_or(r8_le(next, lo), r8_le(hi, next)));
        done = m8_or(done, r8_le(step, zero));
        done =
            m8_or(done, m8_and(cube, m8_and(r8_lt(step, last), r8_lt(last, infinite))));
        const struct mask8 exact = r8_eq(v, zero);
        const struct mask8 end = m8_and(m8_or(done, exact), m8_of(lanes));
        *root = r8_select(end, r8_select(exact, t, next), *root);
        arrived |= m8_bits(end);
        lanes &= ~m8_bits(end);
        t = next;
        last = step;
    }
    return arrived;
}

struct tube8 {
    struct vec8 o, u; // the line, at the point nearest to the centre, in units of R + r
    double R, r;
    struct real8 noise;
};

// As sharpen.
LANES_INLINE void sharpen8(const struct tube8 *v, unsigned lanes, struct real8 *root,
                           struct real8 *root_dt)
{
    const struct real8 R = r8_set(v->R), one = r8_set(1);
    struct real8 t = *root, dt = *root_dt;
    unsigned done = 0;
    for (int i = 0; i < TORUS_SHARPEN_STEPS && lanes; i++) {
        const struct vec8 p = v8_mad(v->o, t, v->u);
        const struct real8 rho = r8_sqrt(r8_add(r8_mul(p.x, p.x), r8_mul(p.z, p.z)));
        const struct real8 w = r8_sub(rho, R);
        const struct real8 d = r8_sqrt(r8_add(r8_mul(w, w), r8_mul(p.y, p.y)));
        const struct real8 h = r8_sub(d, r8_set(v->r));
        const struct real8 across = r8_add(r8_mul(p.x, v->u.x), r8_mul(p.z, v->u.z));
        const struct real8 slope =
            r8_div(r8_add(r8_div(r8_mul(w, across), rho), r8_mul(p.y, v->u.y)), d);
        const struct real8 bend = r8_add(r8_div(one, d), r8_div(one, rho));
        const struct mask8 sure = r8_lt(r8_mul(r8_add(v->noise, r8_abs(h)), bend),
                                        r8_mul(r8_mul(r8_set(0.25), slope), slope));
        lanes &= m8_bits(sure); // the others stay as they are
        const struct mask8 on = m8_of(lanes);
        t = r8_select(on, r8_sub(t, r8_div(h, slope)), t);
        dt = r8_select(on, r8_div(r8_mul(r8_set(2), v->noise), r8_abs(slope)), dt);
        const unsigned still = lanes & m8_bits(r8_le(r8_abs(h), v->noise));
        done |= i + 1 < TORUS_SHARPEN_STEPS ? still : lanes;
        lanes &= ~still;
    }
    const struct mask8 near =
        r8_le(r8_abs(r8_sub(t, *root)), r8_mul(r8_set(4), *root_dt));
    const struct mask8 better = m8_and(m8_of(done), m8_and(near, r8_lt(dt, *root_dt)));
    *root = r8_select(better, t, *root);
    *root_dt = r8_select(better, dt, *root_dt);
}

// How far a root may be off: error_of_root and coefficient_error. Returns the lanes where
// it is simple.
LANES_INLINE unsigned root8_error(const struct quartic8 *c, struct real8 t,
                                  struct real8 *dt)
{
    const struct real8 error = r8_mul(r8_set(16 * ROUNDOFF), quartic8_magnitude(c, t));
    const struct real8 slope = r8_abs(quartic8_slope(c, t));
    const struct real8 bend = r8_abs(quartic8_bend(c, t));
    *dt = r8_div(error, slope);
    const struct mask8 simple = r8_lt(r8_mul(r8_mul(r8_set(4), *dt), bend), slope);
    const struct real8 twice = r8_add(c->c2, c->c2);
    const struct real8 cubic = r8_mul(r8_mul(r8_mul(r8_set(4), t), t), t);
    const struct real8 tilt = r8_abs(r8_add(r8_add(cubic, r8_mul(twice, t)), c->c1));
    const struct real8 one = r8_div(r8_set(2 * GAMMA(128)), tilt);
    const struct real8 twofold =
        r8_mul(r8_set(2), r8_sqrt(r8_div(r8_set(2 * GAMMA(128)), bend)));
    const struct mask8 sharp = r8_lt(r8_mul(r8_set(2), one), twofold);
    *dt = r8_add(*dt, r8_select(sharp, one, r8_mul(r8_set(2), twofold)));
    return m8_bits(simple);
}

// The stretch of the chord of the bounding ball within the slab; returns its lanes.
LANES_INLINE unsigned tube8_chord(const struct tube8 *v, struct real8 oo,
                                  struct real8 *lo, struct real8 *hi)
{
    const struct real8 reach = r8_sub(r8_set(1), oo), zero = r8_set(0);
    unsigned lanes = m8_bits(r8_lt(zero, reach));
    if (!lanes)
        return 0;
    const double edge = v->r + TORUS_MARGIN * v->r + 0x1p-40;
    const struct real8 chord =
        r8_add(r8_add(r8_sqrt(reach), r8_set(TORUS_MARGIN * v->r)), r8_set(0x1p-40));
    const struct mask8 down = r8_lt(r8_set(0x1p-20), r8_abs(v->u.y));
    const struct real8 t0 = r8_div(r8_sub(r8_set(-edge), v->o.y), v->u.y);
    const struct real8 t1 = r8_div(r8_sub(r8_set(edge), v->o.y), v->u.y);
    *lo = r8_neg(chord);
    *hi = chord;
    *lo = r8_select(down, r8_max(*lo, r8_min(t0, t1)), *lo);
    *hi = r8_select(down, r8_min(*hi, r8_max(t0, t1)), *hi);
    lanes &= ~m8_bits(m8_without(r8_lt(r8_set(edge + 0x1p-19), r8_abs(v->o.y)), down));
    return lanes & m8_bits(r8_lt(*lo, *hi));
}

// Where the tube is entered and left between lo and hi, or in which half of that it is
// entered first.
struct stretch8 {
    struct real8 lo, hi;
    struct middle8 m;
};

LANES_INLINE void stretch8_put(struct stretch8 *to, unsigned lanes,
                               const struct stretch8 *from)
{
    to->lo = either8(lanes, from->lo, to->lo);
    to->hi = either8(lanes, from->hi, to->hi);
    to->m.t = either8(lanes, from->m.t, to->m.t);
    to->m.left = either8(lanes, from->m.left, to->m.left);
    to->m.right = either8(lanes, from->m.right, to->m.right);
    to->m.found |= from->m.found & lanes;
}

// The lanes that pass the tube by: on both sides of the lowest value all is above zero, with
// room for rounding, so that isolated_roots finds no sign that changes.
LANES_INLINE unsigned misses8(const struct quartic8 *c, struct real8 lo, struct real8 hi,
                              struct real8 lowest)
{
    return polygon8_of(c, lo, lowest).none & polygon8_of(c, lowest, hi).none;
}

struct half8 {
    struct stretch8 at; // m.found: lanes that enter and leave the tube in it
    unsigned one;       // those that do one of both
    unsigned none;      // those whose polygon says that they do not meet it
    unsigned missed;    // those that do not, which the polygon does not say
};

LANES_INLINE struct half8 half8_of(const struct quartic8 *c, struct real8 lo,
                                   struct real8 hi, unsigned lanes)
{
    const struct polygon8 p = polygon8_of(c, lo, hi);
    struct half8 h = {.at = {lo, hi, middle8_of(c, &p, lo, hi, lanes & p.two)},
                      .one = lanes & p.one,
                      .none = lanes & p.none};
    const unsigned doubt = lanes & p.two & ~h.at.m.found;
    if (doubt)
        h.missed = doubt & misses8(c, lo, hi, h.at.m.lowest);
    return h;
}

// The stretches of the lanes: *at the first one, *next that of the lanes returned which have
// another behind it. Takes the lanes without any out of *lanes; at->m.found: those where
// this is certain.
LANES_INLINE unsigned stretches8(const struct quartic8 *c, struct real8 lo,
                                 struct real8 hi, unsigned *lanes, struct stretch8 *at,
                                 struct stretch8 *next)
{
    const struct polygon8 whole = polygon8_of(c, lo, hi);
    *lanes &= ~whole.none;
    *at = (struct stretch8){lo, hi, middle8_of(c, &whole, lo, hi, *lanes & whole.two)};
    const unsigned four = *lanes & whole.four, doubt = *lanes & whole.two & ~at->m.found;
    if (doubt)
        *lanes &= ~(doubt & misses8(c, lo, hi, at->m.lowest));
    *next = *at;
    if (!four)
        return 0;
    const struct real8 middle = r8_mul(r8_set(0.5), r8_add(lo, hi));
    const struct half8 a = half8_of(c, lo, middle, four),
                       b = half8_of(c, middle, hi, four);
    *next = b.at;
    const unsigned in_a = a.at.m.found, in_b = b.at.m.found;
    // Where the polygon of one half does not tell, isolated_roots finds those of the other.
    const unsigned sure = (a.none | in_a) & (b.none | in_b);
    *lanes &= ~((a.none | a.missed) & (b.none | b.missed));
    stretch8_put(at, sure & in_a, &a.at);
    stretch8_put(at, sure & ~in_a & in_b, &b.at);
    const struct real8 half = r8_set(0.5);
    const struct stretch8 both = {lo,
                                  hi,
                                  {.t = middle,
                                   .left = r8_mul(half, r8_add(lo, middle)),
                                   .right = r8_mul(half, r8_add(middle, hi)),
                                   .found = a.one & b.one}};
    stretch8_put(at, a.one & b.one, &both);
    return sure & in_a & in_b;
}

// A line in the terms of a torus: t = (size t' + shift) / length.
struct chord8 {
    struct tube8 tube;
    struct real8 shift, length;
    double size;
};

// The two crossings of a stretch; returns the lanes where they are simple.
LANES_INLINE unsigned stretch8_cross(const struct quartic8 *c, const struct chord8 *v,
                                     const struct stretch8 *at, unsigned lanes,
                                     struct real8 t[2], struct real8 dt[2])
{
    const struct middle8 *m = &at->m;
    lanes &= m->found;
    unsigned simple = root8_between(c, at->lo, m->t, m->left, false, lanes, &t[0]);
    simple &= root8_between(c, m->t, at->hi, m->right, true, lanes, &t[1]);
    for (int i = 0; i < 2; i++) {
        simple &= root8_error(c, t[i], &dt[i]);
        sharpen8(&v->tube, simple, &t[i], &dt[i]);
        t[i] = r8_div(r8_add(r8_mul(r8_set(v->size), t[i]), v->shift), v->length);
        const struct real8 e =
            r8_add(r8_mul(r8_set(v->size), dt[i]),
                   r8_mul(r8_set(GAMMA(8)), r8_add(r8_abs(v->shift), r8_set(v->size))));
        dt[i] = r8_div(e, v->length);
    }
    return simple;
}

// A line that goes through both sides of the tube has four crossings: the first two are
// given, or, where both are before t_min, the last two. Where `second` is not NULL: the first
// two, and the last two in it.
LANES_INLINE struct cross8 cross8_tube(const struct torus *s, const struct ray8 *ray,
                                       struct real8 t_min, struct cross8 *second)
{
    struct cross8 x = cross8_none();
    const double size = s->major + s->minor;
    if (!(s->minor > 0))
        return x;
    const struct real8 length = r8_sqrt(ray->dd), per = r8_set(1 / size);
    const struct real8 unit = r8_div(r8_set(1), length);
    const struct vec8 d = ray->d;
    struct chord8 chord = {.size = size, .length = length};
    struct tube8 *v = &chord.tube;
    v->R = s->major / size;
    v->r = s->minor / size;
    v->u = (struct vec8){r8_mul(unit, d.x), r8_mul(unit, d.y), r8_mul(unit, d.z)};
    const struct real8 shift = r8_neg(v8_dot(ray->o, v->u));
    const struct vec8 near = v8_mad(ray->o, shift, v->u);
    chord.shift = shift;
    v->o = (struct vec8){r8_mul(per, near.x), r8_mul(per, near.y), r8_mul(per, near.z)};
    const struct real8 oo = v8_dot(v->o, v->o), R = r8_set(v->R), r = r8_set(v->r);
    struct real8 lo, hi;
    unsigned lanes = tube8_chord(v, oo, &lo, &hi);
    if (!lanes)
        return x;
    const double q = 4 * v->R * v->R;
    const struct real8 k = r8_add(oo, r8_set((v->R - v->r) * (v->R + v->r)));
    const struct real8 rho =
        r8_sqrt(r8_add(r8_mul(v->o.x, v->o.x), r8_mul(v->o.z, v->o.z)));
    const struct real8 yr = r8_mul(r8_sub(v->o.y, r), r8_add(v->o.y, r));
    const struct real8 less = r8_sub(rho, R), more = r8_add(rho, R);
    const struct quartic8 c = {
        r8_mul(r8_add(r8_mul(less, less), yr), r8_add(r8_mul(more, more), yr)),
        r8_mul(r8_set(-2 * q), r8_add(r8_mul(v->o.x, v->u.x), r8_mul(v->o.z, v->u.z))),
        r8_sub(r8_mul(r8_set(2), k), r8_mul(r8_set(q), r8_add(r8_mul(v->u.x, v->u.x),
                                                              r8_mul(v->u.z, v->u.z))))};
    struct stretch8 at, next;
    const unsigned more_behind = stretches8(&c, lo, hi, &lanes, &at, &next);
    if (!at.m.found) {
        x.odd = m8_of(lanes);
        return x;
    }
    v->noise =
        r8_mul(r8_set(GAMMA(8)), r8_add(r8_set(2), r8_div(r8_abs(shift), r8_set(size))));
    unsigned two = stretch8_cross(&c, &chord, &at, lanes, x.t, x.dt);
    const unsigned behind =
        more_behind & two & (second ? 255 : m8_bits(r8_le(x.t[1], t_min)));
    if (behind) {
        struct real8 t[2], dt[2];
        unsigned found = stretch8_cross(&c, &chord, &next, behind, t, dt);
        found &= m8_bits(r8_lt(x.t[1], t[0])); // else twins that changed places
        two &= ~behind | found;
        struct cross8 *to = second ? second : &x;
        for (int i = 0; i < 2; i++) {
            to->t[i] = either8(found, t[i], to->t[i]);
            to->dt[i] = either8(found, dt[i], to->dt[i]);
        }
        if (second)
            second->met = m8_of(found);
    }
    x.met = m8_of(two);
    x.odd = m8_of(lanes & ~two);
    return x;
}

LANES_INLINE struct cross8 cross8_torus(const struct torus *s, const struct ray8 *ray,
                                        struct real8 t_min)
{
    return cross8_tube(s, ray, t_min, NULL);
}

#endif
