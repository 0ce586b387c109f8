#ifndef MATH_POLYNOMIAL_LANES_H
#define MATH_POLYNOMIAL_LANES_H

// The first sign change of eight polynomials of one degree, each on its own stretch.
//
// A lane looks at stretches from left to right, each a half, a quarter ... of its whole: the
// Bernstein polygon has at least as many sign changes as there are roots, and more by an even
// number only (Farouki & Rajan 1987). None: on to the next stretch, twice as long where that
// fits; one: there is the root; more: the first half of it. Where coefficients are within their
// rounding, halves may tell more; where they would not, as at double roots, a lane is left
// unsure. The first coefficient has the sign that the stretch before ended with.
#include "math/gamma.h"
#include "math/lanes.h"
#include "math/polynomial.h"

enum { LEVELS_MAX = 44, LOOKS_MAX = 400, STEPS_MAX = 120 };

struct brackets8 {
    struct real8 a, b, guess; // of the lanes found: one root between, the first
    struct real8 sign;        // before it, -1 or 1
    unsigned found;
    unsigned unsure; // what they do is below the rounding, or beyond all numbers
};

LANES_INLINE struct real8 poly8_value(const struct real8 *c, int n, struct real8 t)
{
    struct real8 v = c[n];
    for (int i = n - 1; i >= 0; i--)
        v = r8_add(r8_mul(v, t), c[i]);
    return v;
}

// The sum of the terms' sizes.
LANES_INLINE struct real8 poly8_size(const struct real8 *c, int n, struct real8 t)
{
    struct real8 v = r8_abs(c[n]);
    t = r8_abs(t);
    for (int i = n - 1; i >= 0; i--)
        v = r8_add(r8_mul(v, t), r8_abs(c[i]));
    return v;
}

// Where a bound on the rounding of a polygon is much larger than that of values: within the
// stretch, near its end closest to zero, or at its far end. Halves have more to say there.
struct rough8 {
    struct mask8 within, end;
};

// The Bernstein coefficients on [a, a + w], from the end that is nearer to zero; returns a
// bound on their rounding: up to 6 n roundings of sums no larger than the polynomial's terms
// at |end| + w.
LANES_INLINE struct real8 poly8_polygon(const struct real8 *c, int n, struct real8 a,
                                        struct real8 w, struct real8 *b)
{
    const struct real8 end = r8_add(a, w), zero = r8_set(0);
    const struct mask8 turned = r8_lt(r8_add(a, end), zero);
    const struct real8 from = r8_select(turned, end, a);
    struct real8 scale = r8_set(1);
    w = r8_select(turned, r8_neg(w), w);
    for (int i = 0; i <= n; i++)
        b[i] = c[i];
    for (int i = 0; i < n; i++) // Taylor shift
        for (int k = n - 1; k >= i; k--)
            b[k] = r8_add(b[k], r8_mul(from, b[k + 1]));
    for (int i = 0; i < n; i++) { // to [0, 1], over the binomials
        scale = r8_mul(r8_mul(scale, w), r8_set((i + 1.) / (n - i)));
        b[i + 1] = r8_mul(b[i + 1], scale);
    }
    for (int i = 0; i < n; i++) // sums of the scaled powers
        for (int k = n; k > i; k--)
            b[k] = r8_add(b[k], b[k - 1]);
    if (m8_bits(turned))
        for (int i = 0; i < n - i; i++) {
            const struct real8 x = b[i], y = b[n - i];
            b[i] = r8_select(turned, y, x);
            b[n - i] = r8_select(turned, x, y);
        }
    const struct real8 size = poly8_size(c, n, r8_add(r8_abs(from), r8_abs(w)));
    return r8_mul(r8_set((6 * n + 8) * ROUNDOFF), size);
}

// Given that bound. Where all signs are clear it is not asked for.
LANES_INLINE struct rough8 poly8_rough(const struct real8 *c, int n, struct real8 a,
                                       struct real8 end, struct real8 noise)
{
    const struct real8 near = r8_max(r8_max(a, r8_neg(end)), r8_set(0));
    const struct real8 least = r8_mul(r8_set(0.25 / ((6 * n + 8) * ROUNDOFF)), noise);
    return (struct rough8){r8_lt(poly8_size(c, n, near), least),
                           r8_lt(poly8_size(c, n, end), least)};
}

LANES_INLINE struct mask8 poly8_clear(const struct real8 *b, int n, struct real8 noise)
{
    struct mask8 clear = r8_lt(noise, r8_abs(b[1]));
    for (int i = 2; i <= n; i++)
        clear = m8_and(clear, r8_lt(noise, r8_abs(b[i])));
    return clear;
}

// How often the polygon's sign changes from the first on, the place of the first change as a
// share of the stretch. A first sign of zero becomes that of the first coefficient with one.
// clear: the lanes where all coefficients but the first, which has its sign from before, have
// a sign; murky: those where some have none, and halves would not help.
LANES_INLINE struct real8 poly8_changes(const struct real8 *b, int n, struct real8 noise,
                                        struct real8 *first_sign, struct real8 *at,
                                        const struct rough8 *rough,
                                        struct mask8 *all_clear, struct mask8 *murky)
{
    struct real8 sign = *first_sign;
    const struct real8 zero = r8_set(0), one = r8_set(1);
    struct real8 changes = zero, before = sign, from = one, to = one, index = zero;
    struct mask8 coarse = m8_of(0);
    *all_clear = m8_of(255);
    for (int i = 0; i <= n; i++) {
        const struct mask8 clear = r8_lt(noise, r8_abs(b[i]));
        const struct mask8 turns = m8_and(clear, r8_lt(r8_mul(sign, b[i]), zero));
        const struct mask8 first = m8_and(turns, r8_eq(changes, zero));
        from = r8_select(first, before, from);
        to = r8_select(first, b[i], to);
        index = r8_select(first, r8_set(i - 1), index);
        changes = r8_select(turns, r8_add(changes, one), changes);
        if (i > 0) {
            *all_clear = m8_and(*all_clear, clear);
            coarse = m8_or(coarse, m8_without(i < n ? rough->within : rough->end, clear));
        }
        sign = r8_select(clear, r8_copysign(one, b[i]), sign);
        *first_sign = r8_select(r8_eq(*first_sign, zero), sign, *first_sign);
        before = b[i];
    }
    *murky = m8_without(m8_without(m8_of(255), *all_clear), coarse);
    *at = r8_mul(r8_add(index, r8_div(from, r8_sub(from, to))), r8_set(1. / n));
    return changes;
}

// A quartic is (t^2 + c3/2 t + s)^2 and a parabola, whatever s is, and not below the parabola: with
// one that opens upwards all roots are between its roots, where `lo` and `hi` go. The s with the
// least discriminant, by the quartic's resolvent, tells all quartics apart that have no root but for
// `margin`, which is far more than rounding.
struct narrowed8 {
    unsigned none; // lanes without a root
    unsigned both; // where both ends were moved: mostly there are two roots between them
};

LANES_INLINE struct narrowed8 quartic8_narrow(const struct real8 *c, struct real8 *lo,
                                              struct real8 *hi)
{
    const struct real8 zero = r8_set(0), half = r8_set(0.5), margin = r8_set(0x1p-20);
    const struct real8 per = r8_div(r8_set(1), c[4]);
    const struct real8 c0 = r8_mul(per, c[0]), c1 = r8_mul(per, c[1]),
                       c2 = r8_mul(per, c[2]), c3 = r8_mul(per, c[3]);
    const struct real8 invariant = r8_add(
        r8_mul(c2, c2), r8_mul(r8_set(3), r8_sub(r8_mul(r8_set(4), c0), r8_mul(c1, c3))));
    const struct real8 s =
        r8_mul(r8_set(1. / 6), r8_sub(c2, r8_sqrt(r8_max(invariant, zero))));
    const struct real8 h3 = r8_mul(half, c3), taken = r8_mul(h3, h3), s2 = r8_add(s, s);
    const struct real8 a_size = r8_add(r8_add(r8_abs(c2), taken), r8_abs(s2));
    const struct real8 a = r8_sub(r8_sub(r8_sub(c2, taken), s2), r8_mul(margin, a_size));
    const struct real8 h1 = r8_mul(half, c1), turn = r8_mul(h3, s), ss = r8_mul(s, s);
    const struct real8 b = r8_sub(h1, turn), c_size = r8_add(r8_abs(c0), ss);
    const struct real8 b_most =
        r8_add(r8_abs(b), r8_mul(margin, r8_add(r8_abs(h1), r8_abs(turn))));
    const struct real8 least = r8_sub(r8_sub(c0, ss), r8_mul(margin, c_size));
    const struct real8 under = r8_sub(r8_mul(b_most, b_most), r8_mul(a, least));
    const struct mask8 opens = r8_lt(zero, a);
    const struct real8 reach = r8_sqrt(r8_max(under, zero));
    const struct real8 wide = r8_add(reach, r8_mul(margin, r8_add(b_most, reach)));
    const struct real8 from = r8_div(r8_neg(r8_add(b, wide)), a);
    const struct real8 to = r8_div(r8_sub(wide, b), a);
    const struct mask8 later = m8_and(opens, r8_lt(*lo, from));
    const struct mask8 sooner = m8_and(opens, r8_lt(to, *hi));
    *lo = r8_select(later, from, *lo);
    *hi = r8_select(sooner, to, *hi);
    return (struct narrowed8){m8_bits(m8_and(opens, r8_lt(under, zero))),
                              m8_bits(m8_and(later, sooner))};
}

// sign: at lo, -1 or 1; 0: what it is right behind. halved: lanes that begin with half of their
// stretch. odd: a stretch with any odd number of roots will do. The degree is n, or less where leading coefficients are zero.
LANES_INLINE struct brackets8 poly8_isolate(const struct real8 *c, int n, struct real8 lo,
                                            struct real8 hi, struct real8 sign,
                                            unsigned lanes, unsigned halved, bool odd,
                                            const volatile bool *cancel)
{
    const struct real8 zero = r8_set(0), one = r8_set(1), half = r8_set(0.5);
    const struct real8 width = r8_sub(hi, lo);
    struct real8 b[POLYNOMIAL_DEGREE_MAX + 1];
    struct real8 from = zero; // of the width, exact, as is
    struct real8 share = r8_select(m8_of(halved), half, one);
    struct brackets8 r = {lo, hi, lo, sign, 0, 0};
    for (int i = 0; i < LOOKS_MAX && lanes && !(cancel && *cancel); i++) {
        const struct real8 a = r8_add(lo, r8_mul(width, from)), w = r8_mul(width, share);
        struct real8 at, before = r.sign;
        struct rough8 rough = {m8_of(0), m8_of(0)};
        struct mask8 clear, murky;
        const struct real8 noise = poly8_polygon(c, n, a, w, b);
        if (lanes & ~m8_bits(poly8_clear(b, n, noise)))
            rough = poly8_rough(c, n, a, r8_add(a, w), noise);
        const struct real8 changes =
            poly8_changes(b, n, noise, &before, &at, &rough, &clear, &murky);
        const struct real8 halves = r8_floor(r8_mul(changes, half));
        const unsigned is_odd = m8_bits(r8_lt(r8_add(halves, halves), changes));
        const unsigned none = lanes & m8_bits(m8_and(clear, r8_eq(changes, zero)));
        // The number is odd whatever those between are.
        const unsigned ends = lanes & m8_bits(r8_lt(noise, r8_abs(b[n])));
        const unsigned one_root =
            odd ? ends & is_odd : lanes & m8_bits(m8_and(clear, r8_eq(changes, one)));
        const unsigned unsure =
            lanes & ~one_root &
            (m8_bits(murky) | ~m8_bits(r8_lt(noise, r8_set(INFINITY))));
        r.sign = r8_select(m8_of(none | one_root), before, r.sign);
        if (one_root) {
            const struct mask8 m = m8_of(one_root);
            r.a = r8_select(m, a, r.a);
            r.b = r8_select(m, r8_min(r8_add(a, w), hi), r.b);
            r.guess = r8_select(m, r8_add(a, r8_mul(w, at)), r.guess);
            r.found |= one_root;
            lanes &= ~one_root;
        }
        r.unsure |= unsure;
        lanes &= ~unsure;
        const struct mask8 on = m8_of(none);
        from = r8_select(on, r8_add(from, share), from);
        lanes &= ~(none & m8_bits(r8_le(one, from)));
        // Twice as long where the next stretch begins on a multiple of that, once a step.
        const struct real8 twice = r8_div(from, r8_add(share, share));
        const struct mask8 grows = m8_and(on, r8_eq(twice, r8_floor(twice)));
        share = r8_select(grows, r8_add(share, share), share);
        share = r8_select(m8_of(lanes & ~none), r8_mul(share, half), share);
        const unsigned small =
            lanes & m8_bits(r8_lt(share, r8_set(1 / (double)(1ull << LEVELS_MAX))));
        r.unsure |= small;
        lanes &= ~small;
    }
    r.unsure |= lanes;
    return r;
}

// The roots in their brackets: Newton's method, kept inside them (as root_between of
// math/polynomial.c).
LANES_INLINE struct real8 poly8_refine(const struct real8 *c, int n,
                                       const struct brackets8 *r, unsigned lanes)
{
    const struct real8 zero = r8_set(0), endless = r8_set(INFINITY);
    struct real8 lo = r->a, hi = r->b, t = r8_max(lo, r8_min(r->guess, hi)),
                 last = endless;
    const struct mask8 rises = r8_lt(r->sign, zero);
    for (int i = 0; i < STEPS_MAX && lanes; i++) {
        struct real8 v = c[n], slope = zero;
        for (int k = n - 1; k >= 0; k--) {
            slope = r8_add(r8_mul(slope, t), v);
            v = r8_add(r8_mul(v, t), c[k]);
        }
        const struct mask8 above = r8_lt(zero, v);
        const struct mask8 beyond =
            m8_or(m8_and(above, rises), m8_without(m8_without(m8_of(255), above), rises));
        hi = r8_select(beyond, t, hi);
        lo = r8_select(beyond, lo, t);
        struct real8 next = r8_sub(t, r8_div(v, slope)), step = r8_abs(r8_sub(next, t));
        const struct mask8 in = m8_and(r8_lt(lo, next), r8_lt(next, hi));
        next = r8_select(in, next, r8_mul(r8_set(0.5), r8_add(lo, hi)));
        step = r8_select(in, step, endless);
        const struct mask8 inner =
            m8_without(m8_and(r8_lt(lo, next), r8_lt(next, hi)), r8_eq(next, t));
        // Steps shrink quadratically: two of them foretell the next.
        const struct mask8 quick = m8_and(r8_lt(step, last), r8_lt(last, endless));
        const struct mask8 small =
            r8_le(r8_mul(r8_mul(step, step), step),
                  r8_mul(r8_mul(r8_set(0x1p-54), r8_abs(next)), r8_mul(last, last)));
        const unsigned exact = lanes & m8_bits(r8_eq(v, zero));
        t = r8_select(m8_of(lanes & ~exact), next, t);
        last = step;
        lanes &= m8_bits(m8_without(inner, m8_and(quick, small))) & ~exact;
    }
    return t;
}

// As polynomial_root_error; infinite where the root is not simple.
LANES_INLINE struct real8 poly8_root_error(const struct real8 *c, int n, struct real8 t,
                                           struct real8 error)
{
    struct real8 bend = r8_set(0), slope = bend, v = bend;
    for (int i = n; i >= 0; i--) {
        bend = r8_add(r8_mul(bend, t), slope);
        slope = r8_add(r8_mul(slope, t), v);
        v = r8_add(r8_mul(v, t), c[i]);
    }
    const struct real8 simple = r8_div(r8_add(error, error), r8_abs(slope));
    const struct real8 twofold = r8_mul(r8_set(2), r8_sqrt(r8_div(error, r8_abs(bend))));
    return r8_select(r8_lt(r8_add(simple, simple), twofold), simple, r8_set(INFINITY));
}

#endif
