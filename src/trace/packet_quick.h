#ifndef TRACE_PACKET_QUICK_H
#define TRACE_PACKET_QUICK_H

// Products (trace/packet_product.h) without the error bounds of each crossing: one bound on
// all of them, some thousand times too large, tells crossings apart nearly always. Lanes
// where it does not, or where a crossing is not clear (span8), are in doubt and are done
// again.
//
// A dt is at most A + B |t|, so that crossings at t and x can touch only where
// |x - t| <= 2.02 (A + B |t|), if B is small.
#include "math/gamma.h"
#include "trace/accel.h"
#include "trace/packet_shapes.h"

struct quick {
    struct real8 in[PRODUCT_LEAVES],
        out[PRODUCT_LEAVES];            // of the leaves' spans that matter
    struct real8 in_at[PRODUCT_LEAVES]; // 2 i for leaf i; its exit: 2 i + 1
    uint32_t count, solids; // the first are those of leaves that are no complements
    struct real8 t_min, t_max;
    struct real8 first, last, first_at,
        last_at;           // as in, out, in_at and out_at of product
    struct real8 from, to; // the stretch on which a complement matters
    struct real8 a, b;     // A and B
    struct real8 touching; // 2.02 (A + B |t_min|), and more
    struct mask8 near;     // the last leaf begins or ends where t_min may be
    struct mask8 doubt;
};

LANES_INLINE struct real8 quick_bound(const struct quick *q, double times, struct real8 t)
{
    return r8_mul(r8_set(times), r8_add(q->a, r8_mul(q->b, r8_abs(t))));
}

// How much the bounds must allow for in a space: that of the ray. `more` is what the
// rounding of the way there adds to coordinates and to speed.
LANES_INLINE void quick_space(struct quick *q, const struct accel_product *x,
                              const struct ray8 *ray, struct real8 more,
                              struct real8 more_speed)
{
    const struct real8 size = r8_add(ray->o_max, r8_set(x->extent));
    const struct real8 unit = r8_mul(r8_set(SPAN_CLEAR), ray->per_length);
    q->a = r8_max(r8_mul(unit, r8_add(size, more)), q->a);
    q->b = r8_max(r8_mul(unit, r8_add(v8_max_abs(ray->d), more_speed)), q->b);
    q->doubt = m8_or(q->doubt, r8_lt(r8_set(x->least), r8_mul(r8_set(GAMMA(17)), size)));
}

// The space of a leaf with a transform. moved_error of trace/sweep.c adds at most dt times
// GAMMA(32) / GAMMA(8) stretch (o + 2 offset + |t| speed) / o_max, o and speed those of the
// ray in the world and o_max in the leaf's space; dt is in proportion to o_max + extent
// there, which is at most 65 o_max where the lane is not in doubt.
LANES_INLINE void quick_moved(struct quick *q, const struct accel_product *x,
                              const struct leaf *l, const struct ray8 *ray,
                              const struct ray8 *own)
{
    enum { ROOM = 64 };
    const double share = (1 + ROOM) * 4.01 * l->stretch; // GAMMA(32) < 4.01 GAMMA(8)
    const struct real8 size =
        r8_add(ray->o_max, r8_set(2 * vec3_max_abs(l->transform->offset)));
    q->doubt =
        m8_or(q->doubt, r8_lt(r8_mul(r8_set(ROOM), own->o_max), r8_set(x->extent)));
    quick_space(q, x, own, r8_mul(r8_set(share), size),
                r8_mul(r8_set(share), v8_max_abs(ray->d)));
}

LANES_INLINE void quick_begin(struct quick *q, struct real8 t_min, struct real8 t_max)
{
    q->count = 0;
    q->t_min = t_min;
    q->t_max = t_max;
    q->first = r8_set(-INFINITY);
    q->last = r8_set(INFINITY);
    q->first_at = q->last_at = r8_set(-1);
    q->a = q->b = r8_set(0);
    q->doubt = m8_of(0);
}

// All spaces are known.
LANES_INLINE void quick_bounded(struct quick *q)
{
    q->doubt = m8_or(q->doubt, r8_lt(r8_set(0x1p-10), q->b));
    q->touching = quick_bound(q, 3, q->t_min);
}

// The span of leaf i is one that matters.
LANES_INLINE void quick_keep(struct quick *q, uint32_t i, struct mask8 met,
                             const struct span8 *x, double none)
{
    const struct real8 in = r8_select(met, x->in, r8_set(none));
    const struct real8 out = r8_select(met, x->out, r8_set(-none));
    q->in[q->count] = in;
    q->out[q->count] = out;
    q->in_at[q->count++] = r8_set(2 * i);
    q->near = m8_or(r8_le(r8_abs(r8_sub(in, q->t_min)), q->touching),
                    r8_le(r8_abs(r8_sub(out, q->t_min)), q->touching));
    q->doubt = m8_or(q->doubt, m8_without(met, x->clear));
}

// As product_add, of a leaf that is no complement.
LANES_INLINE unsigned quick_solid(struct quick *q, uint32_t i, bool bounded,
                                  const struct span8 *x)
{
    quick_keep(q, i, x->met, x, bounded ? INFINITY : -INFINITY);
    if (!bounded)
        q->doubt = m8_or(q->doubt, m8_without(m8_of(255), x->met));
    const struct real8 in = q->in[q->count - 1], out = q->out[q->count - 1];
    const struct mask8 later = r8_lt(q->first, in), sooner = r8_lt(out, q->last);
    q->first = r8_select(later, in, q->first);
    q->first_at = r8_select(later, r8_set(2 * i), q->first_at);
    q->last = r8_select(sooner, out, q->last);
    q->last_at = r8_select(sooner, r8_set(2 * i + 1), q->last_at);
    return m8_bits(r8_le(q->first, q->last));
}

// The solids are known: returns the lanes whose stretch in them lies ahead and begins before
// t, that of their nearest hit.
LANES_INLINE unsigned quick_solids_end(struct quick *q, struct real8 t)
{
    const struct real8 start = r8_max(q->t_min, q->first);
    const struct real8 margin = quick_bound(q, 3, r8_max(r8_abs(start), r8_abs(q->last)));
    q->solids = q->count;
    q->from = r8_sub(start, margin);
    q->to = r8_add(q->last, margin);
    return m8_bits(m8_and(r8_le(q->t_min, q->to), r8_le(q->from, r8_min(t, q->t_max))));
}

// As product_add, of a complement; false: it does not matter to any of `lanes`.
LANES_INLINE bool quick_complement(struct quick *q, uint32_t i, bool bounded,
                                   unsigned lanes, const struct span8 *x)
{
    if (!bounded)
        q->doubt = m8_or(q->doubt, m8_without(m8_of(255), x->met));
    const struct mask8 met =
        m8_and(x->met, m8_and(r8_le(x->in, q->to), r8_le(q->from, x->out)));
    if (!(m8_bits(met) & lanes))
        return false;
    quick_keep(q, i, met, x, INFINITY);
    return true;
}

// As product_advance.
LANES_INLINE void quick_advance(const struct quick *q, unsigned lanes, struct real8 *t,
                                struct real8 *at)
{
    for (unsigned moved = lanes; moved;) {
        moved = 0;
        for (uint32_t i = q->solids; i < q->count; i++) {
            const struct mask8 m = m8_and(r8_lt(q->in[i], *t), r8_lt(*t, q->out[i]));
            const unsigned bits = m8_bits(m) & lanes;
            if (!bits)
                continue;
            moved |= bits;
            *t = r8_select(m, q->out[i], *t);
            *at = r8_select(m, r8_add(q->in_at[i], r8_set(1)), *at);
        }
        moved &= m8_bits(r8_lt(*t, q->last));
    }
}

// As product_first.
LANES_INLINE unsigned quick_first(const struct quick *q, unsigned lanes, struct real8 *t,
                                  struct real8 *at, unsigned *doubt)
{
    lanes &= m8_bits(r8_le(q->first, q->last));
    *doubt = lanes & m8_bits(q->doubt);
    const struct mask8 ahead = r8_lt(q->t_min, q->first);
    *t = r8_select(ahead, q->first, q->t_min);
    *at = r8_select(ahead, q->first_at, r8_set(-1));
    quick_advance(q, lanes, t, at);
    const struct mask8 found = r8_lt(*t, q->last);
    const unsigned hit = lanes & m8_bits(found);
    if (lanes & ~hit) { // product_first: 2.5 times the sum of all bounds
        const struct real8 far = r8_max(r8_abs(q->first), r8_abs(q->last));
        *doubt |=
            lanes & ~hit &
            m8_bits(r8_le(r8_sub(q->last, q->first), quick_bound(q, 6. * q->count, far)));
    }
    if (!hit)
        return 0;
    const struct mask8 within = m8_and(found, r8_lt(*at, r8_set(0)));
    if (m8_bits(within) & hit) {
        struct real8 end = q->last, end_at = q->last_at;
        for (uint32_t i = q->solids; i < q->count; i++) {
            const struct mask8 m =
                m8_and(r8_lt(q->t_min, q->in[i]), r8_lt(q->in[i], end));
            end = r8_select(m, q->in[i], end);
            end_at = r8_select(m, q->in_at[i], end_at);
        }
        *t = r8_select(within, end, *t);
        *at = r8_select(within, end_at, *at);
    }
    const struct real8 touching = quick_bound(q, 3, *t);
    struct mask8 near = r8_le(r8_abs(r8_sub(q->t_max, *t)), touching);
    for (uint32_t i = 0; i < q->count; i++) {
        const struct mask8 in = r8_le(r8_abs(r8_sub(q->in[i], *t)), touching);
        const struct mask8 out = r8_le(r8_abs(r8_sub(q->out[i], *t)), touching);
        near = m8_or(near, m8_without(in, r8_eq(*at, q->in_at[i])));
        near = m8_or(near, m8_without(out, r8_eq(*at, r8_add(q->in_at[i], r8_set(1)))));
    }
    *doubt |= hit & m8_bits(near);
    return hit & ~*doubt;
}

#endif
