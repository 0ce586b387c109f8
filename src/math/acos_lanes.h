#ifndef MATH_ACOS_LANES_H
#define MATH_ACOS_LANES_H

// det_acos in lanes, operation by operation as math/trig.c: the same bits.
#include "math/trig.h"
#include "math/trig_lanes.h"

LANES_INLINE struct dd8 dd8_from(struct dd less, struct dd8 x)
{
    return dd8_add(dd8_set(less), (struct dd8){r8_neg(x.hi), r8_neg(x.lo)});
}

// atan_ratio.
LANES_INLINE struct dd8 atan_ratio8(struct dd8 num, struct dd8 den)
{
    double k[8], hi[8], lo[8];
    const struct real8 kd =
        r8_floor(r8_add(r8_mul(r8_set(8), r8_div(num.hi, den.hi)), r8_set(0.5)));
    r8_store(k, kd);
    for (int i = 0; i < 8; i++) {
        hi[i] = trig_atan_eighth[(int)k[i]].hi;
        lo[i] = trig_atan_eighth[(int)k[i]].lo;
    }
    const struct real8 c = r8_mul(kd, r8_set(0.125));
    const struct dd8 cd = dd8_two_prod(c, den.hi);
    const struct dd8 top = dd8_two_sum(r8_sub(r8_sub(num.hi, cd.hi), cd.lo),
                                       r8_sub(num.lo, r8_mul(c, den.lo)));
    const struct dd8 bottom = dd8_two_sum(den.hi, r8_mul(c, num.hi));
    const struct real8 t = r8_div(top.hi, bottom.hi);
    const struct dd8 q = dd8_two_prod(t, bottom.hi);
    const struct real8 below = r8_add(r8_add(bottom.lo, den.lo), r8_mul(c, num.lo));
    const struct real8 rest =
        r8_add(r8_sub(r8_sub(top.hi, q.hi), q.lo), r8_sub(top.lo, r8_mul(t, below)));
    const struct real8 t_low = r8_div(rest, bottom.hi), t2 = r8_mul(t, t);
    struct real8 p = r8_set(0);
#pragma GCC unroll 7
    for (int n = 15; n >= 3; n -= 2)
        p = r8_add(r8_set((n & 2 ? -1. : 1.) / n), r8_mul(t2, p));
    const struct dd8 s = dd8_two_sum(r8_load(hi), t);
    return dd8_fast_sum(
        s.hi, r8_add(s.lo, r8_add(r8_add(r8_load(lo), t_low), r8_mul(r8_mul(t, t2), p))));
}

// |x| <= 1 in all lanes.
static inline struct real8 det_acos8(struct real8 x)
{
    const struct real8 none = r8_set(0), one = r8_set(1);
    // cosine_of
    const struct dd8 a = dd8_two_sum(one, r8_neg(x)), b = dd8_two_sum(one, x);
    const struct dd8 ab = dd8_two_prod(a.hi, b.hi);
    const struct dd8 w = dd8_fast_sum(
        ab.hi, r8_add(ab.lo, r8_add(r8_mul(a.hi, b.lo), r8_mul(a.lo, b.hi))));
    const struct real8 s = r8_sqrt(w.hi);
    const struct dd8 q = dd8_two_prod(s, s);
    const struct real8 off =
        r8_div(r8_add(r8_sub(r8_sub(w.hi, q.hi), q.lo), w.lo), r8_mul(r8_set(2), s));
    const struct dd8 y =
        dd8_select(r8_eq(s, none), (struct dd8){none, none}, dd8_fast_sum(s, off));
    // angle
    const struct dd8 ax = {r8_abs(x), none};
    const struct mask8 low = r8_le(y.hi, ax.hi);
    const struct dd8 ratio = atan_ratio8(dd8_select(low, y, ax), dd8_select(low, ax, y));
    const struct dd8 angle = dd8_select(low, ratio, dd8_from(trig_half_pi, ratio));
    const struct dd pi = {2 * trig_half_pi.hi, 2 * trig_half_pi.lo};
    return r8_select(r8_lt(x, none), dd8_from(pi, angle).hi, angle.hi);
}

#endif
