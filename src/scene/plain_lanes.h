#ifndef SCENE_PLAIN_LANES_H
#define SCENE_PLAIN_LANES_H

// Patterns that are a few operations, at eight points: `value` of scene/patterns/NAME.c for
// each, in the same order.
#include "math/lanes_gather.h"
#include "math/lanes_vec.h"
#include "scene/pattern_math.h"

LANES_INLINE struct real8 plain_length(struct vec8 v) { return r8_sqrt(v8_dot(v, v)); }

LANES_INLINE struct real8 plain_fade(struct real8 r)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    return r8_select(r8_lt(r, zero), one, r8_select(r8_lt(one, r), zero, r8_sub(one, r)));
}

// fmod(v, 1) of what is not negative: exact.
LANES_INLINE struct real8 plain_part(struct real8 v) { return r8_sub(v, r8_floor(v)); }

LANES_INLINE struct real8 plain_gradient(const struct pattern *p, struct vec8 v)
{
    const struct real8 t = v8_dot(v, V8_SET(p->vector));
    return r8_select(r8_lt(r8_set(1), t), plain_part(t), t);
}

LANES_INLINE struct real8 plain_checker(struct vec8 v)
{
    const struct real8 edge = r8_set(PATTERN_EDGE);
    const struct real8 cell =
        r8_add(r8_add(r8_floor(r8_add(v.x, edge)), r8_floor(r8_add(v.y, edge))),
               r8_floor(r8_add(v.z, edge)));
    const struct real8 half = r8_mul(r8_set(0.5), cell);
    return r8_select(r8_eq(half, r8_floor(half)), r8_set(0), r8_set(1));
}

LANES_INLINE struct real8 plain_fraction(struct real8 t)
{
    const struct real8 rest = r8_sub(t, r8_copysign(r8_floor(r8_abs(t)), t));
    return r8_select(r8_lt(rest, r8_set(0)), r8_add(rest, r8_set(1)), rest);
}

LANES_INLINE struct real8 plain_brick(const struct pattern *p, struct vec8 v)
{
    const float m = (float)(p->value[0] - 2 * PATTERN_EDGE);
    const struct vec3 s = p->vector;
    const struct real8 move = r8_set(PATTERN_EDGE + m), half = r8_set(0.5),
                       zero = r8_set(0);
    const struct real8 x = r8_div(r8_add(v.x, move), r8_set(s.x)),
                       y = r8_div(r8_add(v.y, move), r8_set(s.y)),
                       z = r8_div(r8_add(v.z, move), r8_set(s.z));
    const struct mask8 even = r8_le(plain_fraction(r8_mul(half, y)), half);
    const struct real8 along = r8_select(even, x, r8_add(x, half)),
                       across = r8_select(even, r8_add(z, half), z);
    const struct mask8 inner = m8_and(r8_lt(r8_set(m / s.x), plain_fraction(along)),
                                      r8_lt(r8_set(m / s.z), plain_fraction(across)));
    return r8_select(r8_le(plain_fraction(y), r8_set(m / s.y)), zero,
                     r8_select(inner, r8_set(1), zero));
}

// Whole numbers that are odd; those that are no numbers, too.
LANES_INLINE struct mask8 plain_odd(struct real8 v)
{
    const struct real8 half = r8_mul(r8_set(0.5), v);
    return m8_without(m8_of(255), r8_eq(half, r8_floor(half)));
}

LANES_INLINE struct real8 plain_square(struct vec8 v)
{
    const struct mask8 z_odd = plain_odd(r8_floor(v.z));
    return r8_select(plain_odd(r8_floor(v.x)), r8_select(z_odd, r8_set(2), r8_set(3)),
                     r8_select(z_odd, r8_set(1), r8_set(0)));
}

// fold.
LANES_INLINE struct real8 plain_fold(struct real8 a, double p)
{
    return r8_sub(a, r8_mul(r8_set(p), r8_floor(r8_div(a, r8_set(p)))));
}

// Whole numbers modulo 6, as C's % does.
LANES_INLINE struct real8 plain_rest6(struct real8 v)
{
    const struct real8 times = r8_div(v, r8_set(6));
    const struct real8 whole = r8_copysign(r8_floor(r8_abs(times)), times);
    return r8_sub(v, r8_mul(r8_set(6), whole));
}

// floor, but of whole negative numbers the one below.
LANES_INLINE struct real8 plain_below(struct real8 v)
{
    const struct real8 down = r8_sub(r8_neg(r8_floor(r8_neg(v))), r8_set(1));
    return r8_select(r8_le(r8_set(0), v), r8_floor(v), down);
}

LANES_INLINE struct real8 plain_hexagon(struct vec8 v)
{
    // By the row: left of a hexagon, in its middle, below and above a slanted side.
    static const double kind[24] = {0, 1, 1, 2, 2, 0, 2, 2, 0, 0, 1, 1,
                                    0, 2, 1, 0, 2, 1, 2, 1, 0, 2, 1, 0};
    const struct real8 one = r8_set(1), zero = r8_set(0);
    const struct real8 u = plain_fold(r8_div(r8_abs(v.x), r8_set(0.5)), 6);
    const struct real8 z = r8_select(r8_le(zero, v.z), v.z,
                                     r8_sub(r8_set(PATTERN_THREE_ROOT3), r8_abs(v.z)));
    const struct real8 w = plain_fold(r8_div(z, r8_set(PATTERN_HALF_ROOT3)), 6);
    const struct real8 i = plain_rest6(plain_below(u)), row = plain_below(w);
    struct real8 j = plain_rest6(r8_add(plain_rest6(row), r8_set(6)));
    j = r8_select(r8_lt(j, r8_set(6)), j, zero); // where it is no number
    const struct mask8 left = m8_or(r8_eq(i, zero), r8_eq(i, r8_set(5)));
    const struct mask8 middle = m8_or(r8_eq(i, r8_set(2)), r8_eq(i, r8_set(3)));
    const struct real8 sum = r8_add(i, j);
    const struct mask8 falls = m8_and(plain_odd(sum), r8_lt(zero, sum));
    const struct real8 rises = r8_sub(u, i);
    struct real8 a = r8_select(falls, r8_sub(one, rises), rises);
    a = r8_select(r8_eq(a, zero), r8_set(0.0001), a);
    const struct mask8 below = r8_lt(r8_div(r8_sub(w, row), a), one);
    const struct real8 table =
        r8_select(left, zero,
                  r8_select(middle, r8_set(6), r8_select(below, r8_set(12), r8_set(18))));
    return r8_gather(kind, r8_add(table, j));
}

LANES_INLINE struct real8 plain_triangular(struct vec8 v)
{
    const struct real8 zero = r8_set(0), one = r8_set(1), root = r8_set(PATTERN_ROOT3);
    const struct real8 along = plain_fold(v.x, 3), a = r8_floor(along);
    const struct real8 x = r8_sub(along, a), k = r8_sub(one, x);
    struct real8 z = plain_fold(v.z, PATTERN_ROOT3);
    const struct mask8 upper = r8_le(r8_set(PATTERN_ROOT3 / 2), z);
    z = r8_select(upper, r8_sub(root, z), z);
    const struct mask8 edge = m8_or(r8_eq(x, zero), r8_eq(k, zero));
    const struct mask8 left = r8_lt(r8_div(z, x), root),
                       right = r8_lt(r8_div(z, k), root);
    const struct mask8 low = m8_without(m8_and(left, right), edge);
    const struct mask8 third = m8_without(m8_without(left, right), edge);
    const struct real8 twice = r8_mul(r8_set(2), a);
    const struct real8 odd = r8_add(r8_select(third, r8_set(3), one), twice);
    const struct real8 r = plain_rest6(r8_select(low, r8_sub(r8_set(6), twice), odd));
    return r8_select(upper, r8_sub(r8_set(5), r), r);
}

// Whether v is at least as large as the other two.
LANES_INLINE struct mask8 plain_leads(struct real8 v, struct real8 a, struct real8 b)
{
    return m8_and(m8_and(r8_le(r8_set(0), v), r8_le(a, v)), r8_le(b, v));
}

LANES_INLINE struct mask8 plain_trails(struct real8 v, struct real8 a, struct real8 b)
{
    return m8_and(m8_and(r8_lt(v, r8_set(0)), r8_le(v, r8_neg(a))), r8_le(v, r8_neg(b)));
}

LANES_INLINE struct real8 plain_cubic(struct vec8 v)
{
    const struct real8 x = r8_abs(v.x), y = r8_abs(v.y), z = r8_abs(v.z);
    struct real8 n = r8_select(plain_trails(v.y, x, z), r8_set(4), r8_set(5));
    n = r8_select(plain_trails(v.x, y, z), r8_set(3), n);
    n = r8_select(plain_leads(v.z, x, y), r8_set(2), n);
    n = r8_select(plain_leads(v.y, x, z), r8_set(1), n);
    return r8_select(plain_leads(v.x, y, z), r8_set(0), n);
}

// The vectors from the middles of the cells; the cushions' profile there.
LANES_INLINE struct vec8 plain_cushion(const struct pattern *p, struct vec8 v,
                                       struct real8 *height)
{
    const struct real8 half = r8_set(0.5), three = r8_set(3);
    const struct vec8 w = {r8_sub(r8_sub(v.x, plain_below(v.x)), half),
                           r8_sub(r8_sub(v.y, plain_below(v.y)), half),
                           r8_sub(r8_sub(v.z, plain_below(v.z)), half)};
    const struct real8 t = plain_length(w), s = r8_sub(r8_set(1), t),
                       t3 = r8_mul(three, t);
    const struct real8 b0 = r8_mul(r8_mul(r8_mul(t3, s), s), r8_set(p->value[0])),
                       b1 = r8_mul(r8_mul(r8_mul(t3, t), s), r8_set(p->value[1]));
    const struct real8 sum = r8_add(r8_add(r8_mul(r8_mul(t, t), t), b0), b1);
    *height = r8_mul(sum, r8_set(PATTERN_CUSHION));
    return w;
}

LANES_INLINE struct real8 plain_quilted(const struct pattern *p, struct vec8 v)
{
    struct real8 b;
    const struct vec8 w = plain_cushion(p, v, &b);
    return r8_div(r8_add(r8_add(r8_abs(r8_mul(b, w.x)), r8_abs(r8_mul(b, w.y))),
                         r8_abs(r8_mul(b, w.z))),
                  r8_set(3));
}

LANES_INLINE struct real8 plain_value(const struct pattern *p, struct vec8 v)
{
    switch (p->ops->plain) {
    case PLAIN_GRADIENT: return plain_gradient(p, v);
    case PLAIN_CHECKER: return plain_checker(v);
    case PLAIN_BRICK: return plain_brick(p, v);
    case PLAIN_ONION: return plain_part(plain_length(v));
    case PLAIN_SPHERICAL: return plain_fade(plain_length(v));
    case PLAIN_CYLINDRICAL:
        return plain_fade(r8_sqrt(r8_add(r8_mul(v.x, v.x), r8_mul(v.z, v.z))));
    case PLAIN_PLANAR: return plain_fade(r8_abs(v.y));
    case PLAIN_BOXED: return plain_fade(v8_max_abs(v));
    case PLAIN_SQUARE: return plain_square(v);
    case PLAIN_HEXAGON: return plain_hexagon(v);
    case PLAIN_TRIANGULAR: return plain_triangular(v);
    case PLAIN_CUBIC: return plain_cubic(v);
    case PLAIN_QUILTED: return plain_quilted(p, v);
    case PLAIN_NONE: break;
    }
    return r8_set(0);
}

#endif
