#ifndef MATH_DD_LANES_H
#define MATH_DD_LANES_H

// math/dd.h in lanes, operation by operation.

#include "math/dd.h"
#include "math/lanes.h"

struct dd8 {
    struct real8 hi, lo;
};

LANES_INLINE struct dd8 dd8_set(struct dd v)
{
    return (struct dd8){r8_set(v.hi), r8_set(v.lo)};
}
LANES_INLINE struct dd8 dd8_select(struct mask8 m, struct dd8 x, struct dd8 y)
{
    return (struct dd8){r8_select(m, x.hi, y.hi), r8_select(m, x.lo, y.lo)};
}
LANES_INLINE struct dd8 dd8_fast_sum(struct real8 a, struct real8 b)
{
    const struct real8 s = r8_add(a, b);
    return (struct dd8){s, r8_sub(b, r8_sub(s, a))};
}
LANES_INLINE struct dd8 dd8_two_sum(struct real8 a, struct real8 b)
{
    const struct real8 s = r8_add(a, b), t = r8_sub(s, a);
    return (struct dd8){s, r8_add(r8_sub(a, r8_sub(s, t)), r8_sub(b, t))};
}
// The square; a below 2^900.
LANES_INLINE struct dd8 dd8_square(struct real8 a)
{
    const struct real8 c = r8_mul(r8_set(134217729.0), a), h = r8_sub(c, r8_sub(c, a)),
                       l = r8_sub(a, h), p = r8_mul(a, a);
    const struct real8 hl = r8_mul(h, l), lh = r8_mul(l, h);
    return (struct dd8){
        p, r8_add(r8_add(r8_add(r8_sub(r8_mul(h, h), p), hl), lh), r8_mul(l, l))};
}
LANES_INLINE struct dd8 dd8_add(struct dd8 a, struct dd8 b)
{
    const struct dd8 s = dd8_two_sum(a.hi, b.hi);
    return dd8_fast_sum(s.hi, r8_add(s.lo, r8_add(a.lo, b.lo)));
}
LANES_INLINE struct dd8 dd8_two_prod(struct real8 a, struct real8 b)
{
    const struct real8 split = r8_set(134217729.0); // 2^27 + 1
    const struct real8 ca = r8_mul(split, a), ah = r8_sub(ca, r8_sub(ca, a)),
                       al = r8_sub(a, ah);
    const struct real8 cb = r8_mul(split, b), bh = r8_sub(cb, r8_sub(cb, b)),
                       bl = r8_sub(b, bh);
    const struct real8 p = r8_mul(a, b);
    struct real8 low = r8_add(r8_sub(r8_mul(ah, bh), p), r8_mul(ah, bl));
    low = r8_add(low, r8_mul(al, bh));
    return (struct dd8){p, r8_add(low, r8_mul(al, bl))};
}
LANES_INLINE struct dd8 dd8_mul(struct dd8 a, struct dd8 b)
{
    const struct dd8 p = dd8_two_prod(a.hi, b.hi);
    const struct real8 mixed = r8_add(r8_mul(a.hi, b.lo), r8_mul(a.lo, b.hi));
    return dd8_fast_sum(p.hi, r8_add(p.lo, mixed));
}
LANES_INLINE struct dd8 dd8_scale(struct real8 s, struct dd8 a)
{
    const struct dd8 p = dd8_two_prod(s, a.hi);
    return dd8_fast_sum(p.hi, r8_add(p.lo, r8_mul(s, a.lo)));
}
LANES_INLINE struct dd8 dd8_div(struct dd8 a, struct dd8 b)
{
    const struct real8 q = r8_div(a.hi, b.hi);
    const struct dd8 p = dd8_two_prod(q, b.hi);
    const struct real8 rest =
        r8_add(r8_sub(r8_sub(a.hi, p.hi), p.lo), r8_sub(a.lo, r8_mul(q, b.lo)));
    return dd8_fast_sum(q, r8_div(rest, b.hi));
}

#endif
