#ifndef SCENE_PLAIN_LANES_H
#define SCENE_PLAIN_LANES_H

// Patterns that are a few operations, at eight points: `value` of scene/patterns/NAME.c for
// each, in the same order.
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
    case PLAIN_NONE: break;
    }
    return r8_set(0);
}

#endif
