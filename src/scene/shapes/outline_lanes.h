#ifndef SCENE_SHAPES_OUTLINE_LANES_H
#define SCENE_SHAPES_OUTLINE_LANES_H

// Eight lines and a piece of an outline: outline_roots and outline_passes_by of
// scene/shapes/outline.h operation by operation, with the same bits.
#include "math/gamma.h"
#include "math/lanes.h"
#include "scene/shapes/outline.h"

struct line8 {
    struct real8 k[3]; // k.(u, v, 1) = 0
    struct real8 norm; // |(k0, k1)|
    struct real8 near; // how far off the rounding may put a point
};

struct point8 {
    struct real8 u, v;
};

// The roots of the lanes in met[i] are w[i]; ascending.
struct outline_roots8 {
    unsigned met[OUTLINE_ROOTS];
    struct real8 w[OUTLINE_ROOTS];
};

LANES_INLINE void line8_size(struct line8 *l, struct real8 size)
{
    l->near = r8_mul(r8_set(GAMMA(32)), r8_add(r8_mul(l->norm, size), r8_abs(l->k[2])));
}

// The lanes that may meet the piece.
LANES_INLINE unsigned outline_near8(const struct outline_segment *s,
                                    const struct line8 *l)
{
    const struct real8 off = r8_add(r8_add(r8_mul(l->k[0], r8_set(s->middle.u)),
                                           r8_mul(l->k[1], r8_set(s->middle.v))),
                                    l->k[2]);
    const struct real8 most = r8_add(r8_mul(r8_set(s->radius), l->norm), l->near);
    return m8_bits(r8_le(r8_abs(off), most));
}

LANES_INLINE struct real8 outline_value8(double a, double b, double c, double d,
                                         struct real8 w)
{
    struct real8 v = r8_add(r8_mul(r8_set(a), w), r8_set(b));
    v = r8_add(r8_mul(v, w), r8_set(c));
    return r8_add(r8_mul(v, w), r8_set(d));
}

LANES_INLINE struct point8 outline_point8(const struct outline_segment *s, struct real8 w)
{
    return (struct point8){outline_value8(s->c3.u, s->c2.u, s->c1.u, s->a.u, w),
                           outline_value8(s->c3.v, s->c2.v, s->c1.v, s->a.v, w)};
}

LANES_INLINE struct real8 side8(const struct line8 *l, struct vec2 p)
{
    return r8_add(r8_add(r8_mul(l->k[0], r8_set(p.u)), r8_mul(l->k[1], r8_set(p.v))),
                  l->k[2]);
}

LANES_INLINE unsigned above8(struct real8 x) { return m8_bits(r8_le(r8_set(0), x)); }

struct cubic8 {
    struct real8 c[4]; // ascending powers
};

LANES_INLINE struct real8 cubic8_value(const struct cubic8 *f, struct real8 w)
{
    struct real8 v = r8_add(r8_mul(f->c[3], w), f->c[2]);
    v = r8_add(r8_mul(v, w), f->c[1]);
    return r8_add(r8_mul(v, w), f->c[0]);
}

LANES_INLINE struct real8 cubic8_slope(const struct cubic8 *f, struct real8 w)
{
    const struct real8 a = r8_mul(r8_set(3), f->c[3]), b = r8_mul(r8_set(2), f->c[2]);
    return r8_add(r8_mul(r8_add(r8_mul(a, w), b), w), f->c[1]);
}

LANES_INLINE struct real8 root_between8(const struct cubic8 *f, unsigned lanes,
                                        unsigned rising, struct real8 lo, struct real8 hi)
{
    const struct real8 half = r8_set(0.5), zero = r8_set(0);
    const struct real8 from = cubic8_value(f, lo), to = cubic8_value(f, hi);
    struct real8 w = r8_add(lo, r8_mul(r8_sub(hi, lo), r8_div(from, r8_sub(from, to))));
    w = r8_select(m8_and(r8_lt(lo, w), r8_lt(w, hi)), w, r8_mul(half, r8_add(lo, hi)));
    for (int i = 0; i < 80 && lanes; i++) {
        const struct real8 v = cubic8_value(f, w), along = cubic8_slope(f, w);
        lanes &= ~m8_bits(r8_eq(v, zero));
        const struct mask8 beyond = m8_of(~(m8_bits(r8_lt(zero, v)) ^ rising));
        hi = r8_select(beyond, w, hi);
        lo = r8_select(beyond, lo, w);
        struct real8 next = r8_sub(w, r8_div(v, along));
        lanes &= ~m8_bits(r8_eq(next, w));
        const struct mask8 in = m8_and(r8_lt(lo, next), r8_lt(next, hi));
        const struct real8 step = r8_select(in, r8_sub(next, w), r8_set(INFINITY));
        next = r8_select(in, next, r8_mul(half, r8_add(lo, hi)));
        const struct real8 c3 = r8_mul(r8_set(6), f->c[3]);
        const struct real8 bend =
            r8_add(r8_abs(r8_add(r8_mul(c3, w), r8_mul(r8_set(2), f->c[2]))),
                   r8_abs(r8_mul(c3, step)));
        const struct mask8 last =
            r8_lt(r8_mul(r8_mul(step, step), bend),
                  r8_mul(r8_set(0x1p-54), r8_mul(next, r8_abs(along))));
        w = r8_select(m8_of(lanes), next, w);
        lanes &= ~m8_bits(m8_or(last, m8_or(r8_le(next, lo), r8_le(hi, next))));
    }
    return w;
}

// What parabola_root works with: the root where f rises and the one where it falls.
struct parabola_roots8 {
    struct real8 rising, falling;
};

LANES_INLINE struct parabola_roots8 parabola_roots8(const struct cubic8 *f)
{
    const struct real8 a = f->c[2], b = f->c[1], c = f->c[0], zero = r8_set(0);
    const struct real8 square = r8_sub(r8_mul(b, b), r8_mul(r8_set(4), r8_mul(a, c)));
    const struct real8 root = r8_sqrt(r8_select(r8_lt(square, zero), zero, square));
    const struct mask8 down = r8_lt(b, zero); // -0 is not, whatever its sign says
    const struct real8 q =
        r8_mul(r8_set(-0.5), r8_select(down, r8_sub(b, root), r8_add(b, root)));
    const struct real8 x = r8_div(q, a), y = r8_div(c, q);
    return (struct parabola_roots8){r8_select(down, x, y), r8_select(down, y, x)};
}

LANES_INLINE struct real8 parabola_root8(const struct parabola_roots8 *r, unsigned rising,
                                         struct real8 lo, struct real8 hi)
{
    struct real8 w = r8_select(m8_of(rising), r->rising, r->falling);
    w = r8_select(r8_lt(lo, w), w, lo);
    return r8_select(r8_lt(w, hi), w, hi);
}

// The extrema of f, ascending where both are inside (0, 1); bits of `kept` say which are.
LANES_INLINE void extrema8(const struct cubic8 *f, struct real8 w[2], unsigned kept[2])
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    const struct real8 a = r8_mul(r8_set(3), f->c[3]), b = f->c[2], c = f->c[1];
    const struct real8 d = r8_sub(r8_mul(b, b), r8_mul(a, c));
    const unsigned real = m8_bits(r8_lt(zero, d));
    kept[0] = kept[1] = 0;
    if (!real)
        return;
    const struct real8 q = r8_neg(r8_add(b, r8_copysign(r8_sqrt(d), b)));
    const struct real8 x = r8_div(q, a), y = r8_div(c, q);
    const struct mask8 in_x = m8_and(r8_lt(zero, x), r8_lt(x, one));
    const struct mask8 in_y = m8_and(r8_lt(zero, y), r8_lt(y, one));
    const struct mask8 swap = r8_lt(y, x);
    w[0] = r8_select(swap, y, x);
    w[1] = r8_select(swap, x, y);
    const unsigned x_is = m8_bits(in_x), y_is = m8_bits(in_y), swapped = m8_bits(swap);
    kept[0] = real & ((swapped & y_is) | (~swapped & x_is));
    kept[1] = real & ((swapped & x_is) | (~swapped & y_is));
}

// Lanes where all Bernstein coefficients have one sign, clear of rounding.
LANES_INLINE unsigned beside8(const struct cubic8 *f, struct real8 end)
{
    const struct real8 three = r8_set(3), a = f->c[0];
    const struct real8 b = r8_add(a, r8_div(f->c[1], three));
    const struct real8 c = r8_add(b, r8_div(r8_add(f->c[1], f->c[2]), three));
    const struct real8 sum =
        r8_add(r8_add(r8_add(r8_abs(a), r8_abs(f->c[1])), r8_abs(f->c[2])), r8_abs(end));
    const struct real8 noise = r8_mul(r8_set(GAMMA(16)), sum);
    const struct real8 least = r8_min(r8_min(a, b), r8_min(c, end));
    const struct real8 most = r8_max(r8_max(a, b), r8_max(c, end));
    return m8_bits(m8_or(r8_lt(noise, least), r8_lt(most, r8_neg(noise))));
}

// The one extremum of a parabola, as extrema8 has it.
LANES_INLINE struct real8 extremum8(const struct cubic8 *f, unsigned *kept)
{
    const struct real8 zero = r8_set(0), b = f->c[2];
    const struct real8 d = r8_mul(b, b);
    const struct real8 w = r8_div(f->c[1], r8_neg(r8_add(b, r8_copysign(r8_sqrt(d), b))));
    *kept = m8_bits(m8_and(r8_lt(zero, d), m8_and(r8_lt(zero, w), r8_lt(w, r8_set(1)))));
    return w;
}

LANES_INLINE struct cubic8 curve8(const struct outline_segment *s, const struct line8 *l,
                                  struct real8 fa)
{
    const struct real8 *k = l->k;
    struct cubic8 f = {{fa}};
    const struct vec2 *const c[4] = {NULL, &s->c1, &s->c2, &s->c3};
    for (int i = 1; i <= s->degree; i++)
        f.c[i] = r8_add(r8_mul(k[0], r8_set(c[i]->u)), r8_mul(k[1], r8_set(c[i]->v)));
    return f;
}

static void parabola_met8(const struct outline_segment *s, const struct line8 *l,
                          unsigned lanes, struct real8 fa, struct real8 fb,
                          struct outline_roots8 *out)
{
    const struct cubic8 f = curve8(s, l, fa);
    unsigned above = above8(fa), kept;
    const unsigned above_b = above8(fb);
    lanes &= (above ^ above_b) | ~beside8(&f, fb);
    if (!lanes)
        return;
    const struct real8 stop = extremum8(&f, &kept), zero = r8_set(0);
    const struct parabola_roots8 r = parabola_roots8(&f);
    kept &= lanes;
    if (kept) {
        const unsigned end = above8(cubic8_value(&f, stop));
        out->met[0] = kept & (above ^ end);
        if (out->met[0])
            out->w[0] = parabola_root8(&r, end, zero, stop);
        above = (above & ~kept) | (end & kept);
    }
    out->met[1] = lanes & (above ^ above_b);
    if (out->met[1])
        out->w[1] =
            parabola_root8(&r, above_b, r8_select(m8_of(kept), stop, zero), r8_set(1));
}

static void curve_roots8(const struct outline_segment *s, const struct line8 *l,
                         unsigned lanes, struct real8 fa, struct real8 fb,
                         struct outline_roots8 *out)
{
    const struct cubic8 f = curve8(s, l, fa);
    unsigned above = above8(fa);
    const unsigned above_b = above8(fb);
    lanes &= (above ^ above_b) | ~beside8(&f, fb);
    if (!lanes)
        return;
    struct real8 stop[3], lo = r8_set(0);
    unsigned kept[3];
    extrema8(&f, stop, kept);
    stop[2] = r8_set(1);
    kept[2] = 255;
    for (int i = 0; i < 3; i++) {
        const unsigned here = lanes & kept[i];
        if (!here)
            continue;
        const unsigned end = i < 2 ? above8(cubic8_value(&f, stop[i])) : above_b;
        out->met[i] = here & (above ^ end);
        if (out->met[i])
            out->w[i] = root_between8(&f, out->met[i], end, lo, stop[i]);
        above = (above & ~here) | (end & here);
        lo = r8_select(m8_of(here), stop[i], lo);
    }
}

LANES_INLINE void outline_roots8(const struct outline_segment *s, const struct line8 *l,
                                 unsigned lanes, struct outline_roots8 *out)
{
    const struct real8 fa = side8(l, s->a), fb = side8(l, s->b);
    out->met[0] = out->met[1] = out->met[2] = 0;
    if (s->degree == 2) {
        parabola_met8(s, l, lanes, fa, fb, out);
        return;
    }
    if (s->degree == 3) {
        curve_roots8(s, l, lanes, fa, fb, out);
        return;
    }
    out->met[0] = lanes & (above8(fa) ^ above8(fb));
    if (!out->met[0])
        return;
    const struct real8 d = r8_sub(fa, fb), zero = r8_set(0);
    const struct real8 w = r8_max(zero, r8_min(r8_set(1), r8_div(fa, d)));
    out->w[0] = r8_select(r8_eq(d, zero), zero, w);
}

#endif
