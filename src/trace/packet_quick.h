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

// ---- spans --------------------------------------------------------------------------------
//
// As span8_*, but for the error bounds. The lanes that matter are `bits`; where none of them
// can meet the shape, nothing is met.

// The squares of two lengths that differ by this share are told apart whatever the rounding.
static const double apart = 0x1p-45;

LANES_INLINE struct span8 quick_nothing(void)
{
    const struct real8 zero = r8_set(0);
    return (struct span8){.in = zero, .out = zero, .met = m8_of(0), .clear = m8_of(0)};
}

// Lines whose square of the distance from a centre is larger than that of the radius: it is
// oc.oc - (d.oc)^2 / d.d, and wants no division. In space, or across a cylinder's axis.
LANES_INLINE unsigned quick_missed(struct real8 oc_oc, struct real8 along,
                                   struct real8 dd, double radius)
{
    const struct real8 beyond =
        r8_sub(r8_mul(r8_set(1 - apart), oc_oc), r8_set((1 + apart) * radius * radius));
    return m8_bits(r8_lt(r8_mul(along, along), r8_mul(dd, beyond)));
}

LANES_INLINE struct span8 quick_sphere(const struct product_part *part,
                                       const struct ray8 *ray, unsigned bits)
{
    const struct sphere s = {.centre = part->centre, .radius = part->radius};
    const struct vec8 oc = v8_sub(ray->o, V8_SET(s.centre));
    const unsigned missed =
        quick_missed(v8_dot(oc, oc), v8_dot(ray->d, oc), ray->dd, s.radius);
    return bits & ~missed ? span8_sphere(&s, ray) : quick_nothing();
}

// Where no line runs close to along a side. inverse: 1 / d, if that is known.
LANES_INLINE struct span8 quick_box(const struct box *b, const struct ray8 *ray,
                                    const struct vec8 *inverse)
{
    const struct vec8 d = ray->d;
    const struct real8 least = r8_min(r8_abs(d.x), r8_min(r8_abs(d.y), r8_abs(d.z)));
    const struct real8 longest = v8_max_abs(d), one = r8_set(1);
    if (m8_bits(r8_le(r8_mul(r8_set(clear_slope), longest), least)) != 255)
        return span8_box(b, ray);
    const struct vec8 inv =
        inverse ? *inverse
                : (struct vec8){r8_div(one, d.x), r8_div(one, d.y), r8_div(one, d.z)};
    struct span8 x = {.clear = m8_of(255)};
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct real8 o = a == 0 ? ray->o.x : a == 1 ? ray->o.y : ray->o.z;
        const struct real8 by = a == 0 ? inv.x : a == 1 ? inv.y : inv.z;
        const struct real8 p = r8_mul(r8_sub(r8_set(vec3_axis(b->min, a)), o), by);
        const struct real8 q = r8_mul(r8_sub(r8_set(vec3_axis(b->max, a)), o), by);
        const struct real8 t0 = r8_min(p, q), t1 = r8_max(q, p);
        x.in = a == 0 ? t0 : r8_max(t0, x.in);
        x.out = a == 0 ? t1 : r8_min(t1, x.out);
    }
    x.met = m8_and(r8_le(x.in, x.out), r8_lt(r8_set(-INFINITY), x.in));
    return x;
}

// Where no line runs close to along the side or the caps.
LANES_INLINE struct span8 quick_cylinder(const struct cylinder *c, const struct ray8 *ray,
                                         unsigned bits)
{
    const struct vec8 o = frame8(&c->frame, v8_sub(ray->o, V8_SET(c->frame.origin)));
    const struct vec8 d = frame8(&c->frame, ray->d);
    const struct real8 zero = r8_set(0), length = r8_set(c->length);
    const struct real8 a = r8_add(r8_mul(d.x, d.x), r8_mul(d.y, d.y));
    const struct mask8 steep =
        m8_and(r8_le(r8_mul(r8_set(clear_square), ray->dd), a),
               r8_le(r8_mul(r8_set(clear_slope), v8_max_abs(d)), r8_abs(d.z)));
    if (m8_bits(steep) != 255)
        return span8_cylinder(c, ray);
    const double r = c->radius;
    const struct real8 along = r8_add(r8_mul(d.x, o.x), r8_mul(d.y, o.y));
    if (!(bits & ~quick_missed(r8_add(r8_mul(o.x, o.x), r8_mul(o.y, o.y)), along, a, r)))
        return quick_nothing();
    const struct real8 s = r8_div(along, a);
    const struct real8 x = r8_sub(o.x, r8_mul(s, d.x)), y = r8_sub(o.y, r8_mul(s, d.y));
    const struct real8 rest = r8_sub(r8_set(r * r), r8_add(r8_mul(x, x), r8_mul(y, y)));
    struct span8 v = {.met = r8_lt(zero, rest),
                      .clear = r8_le(r8_set(clear_square * r * r), rest)};
    if (!(m8_bits(v.met) & bits))
        return quick_nothing();
    const struct real8 reach = r8_sqrt(r8_div(rest, a));
    const struct real8 inv = r8_div(r8_set(1), d.z);
    const struct real8 p = r8_mul(r8_sub(zero, o.z), inv);
    const struct real8 q = r8_mul(r8_sub(length, o.z), inv);
    v.in = r8_max(r8_min(p, q), r8_sub(r8_neg(s), reach));
    v.out = r8_min(r8_max(q, p), r8_add(r8_neg(s), reach));
    v.met = m8_and(v.met, m8_and(r8_le(v.in, v.out), r8_lt(r8_set(-INFINITY), v.in)));
    return v;
}

// ---- products -----------------------------------------------------------------------------

struct quick {
    struct real8 t_min, t_max;
    struct real8 first, last; // of the solids' stretch
    struct real8 from, to;    // the stretch on which a complement matters
    struct real8 a, b;        // A and B
    struct mask8 doubt;
};

enum { QUICK_HOLLOWS = 2 }; // solids of a product that lines may be inside but for a span

struct quick_hollow {
    struct span8 span;
    const struct product_part *part;
};

// The spans that matter, those of solids first.
struct quick_spans {
    struct real8 in[PRODUCT_LEAVES + QUICK_HOLLOWS], out[PRODUCT_LEAVES + QUICK_HOLLOWS];
    const struct product_part *part[PRODUCT_LEAVES + QUICK_HOLLOWS];
    struct quick_hollow
        hollow[QUICK_HOLLOWS]; // what is missing of solids, like complements
    uint32_t count, solids, hollows;
};

LANES_INLINE struct real8 quick_bound(const struct quick *q, double times, struct real8 t)
{
    return r8_mul(r8_set(times), r8_add(q->a, r8_mul(q->b, r8_abs(t))));
}

// How much the bounds must allow for in a space: that of the ray. `more` is what the
// rounding of the way there adds to coordinates and to speed.
LANES_INLINE void quick_space(struct quick *q, const struct accel_product *x,
                              uint32_t space, const struct ray8 *ray, struct real8 more,
                              struct real8 more_speed)
{
    const struct real8 size = r8_add(ray->o_max, r8_set(x->extent[space]));
    const struct real8 unit = r8_mul(r8_set(SPAN_CLEAR), ray->per_length);
    q->a = r8_max(r8_mul(unit, r8_add(size, more)), q->a);
    q->b = r8_max(r8_mul(unit, r8_add(v8_max_abs(ray->d), more_speed)), q->b);
    q->doubt = m8_or(q->doubt, r8_lt(r8_set(x->least), r8_mul(r8_set(GAMMA(17)), size)));
    q->doubt = m8_or(q->doubt, r8_lt(r8_set(0x1p-10), q->b));
}

// The space of a leaf with a transform. moved_error of trace/sweep.c adds at most dt times
// GAMMA(32) / GAMMA(8) stretch (o + 2 offset + |t| speed) / o_max, o and speed those of the
// ray in the world and o_max in the leaf's space; dt is in proportion to o_max + extent
// there, which is at most 65 o_max where the lane is not in doubt.
LANES_INLINE void quick_moved(struct quick *q, const struct accel_product *x,
                              uint32_t space, const struct leaf *l,
                              const struct ray8 *ray, const struct ray8 *own)
{
    enum { ROOM = 64 };
    const double share = (1 + ROOM) * 4.01 * l->stretch; // GAMMA(32) < 4.01 GAMMA(8)
    const struct real8 size =
        r8_add(ray->o_max, r8_set(2 * vec3_max_abs(l->transform->offset)));
    q->doubt = m8_or(q->doubt,
                     r8_lt(r8_mul(r8_set(ROOM), own->o_max), r8_set(x->extent[space])));
    quick_space(q, x, space, own, r8_mul(r8_set(share), size),
                r8_mul(r8_set(share), v8_max_abs(ray->d)));
}

LANES_INLINE void quick_begin(struct quick *q, struct real8 t_min, struct real8 t_max)
{
    q->t_min = t_min;
    q->t_max = t_max;
    q->first = r8_set(-INFINITY);
    q->last = r8_set(INFINITY);
    q->a = q->b = r8_set(0);
    q->doubt = m8_of(0);
}

// Where the errors of a span are known: those that the bound does not hold are not clear.
LANES_INLINE struct mask8 quick_clear(const struct quick *q, const struct span8 *x)
{
    return m8_and(r8_le(x->in_e, quick_bound(q, 1, x->in)),
                  r8_le(x->out_e, quick_bound(q, 1, x->out)));
}

// The span is one that matters, where it is met; elsewhere it is from `none` to -none.
LANES_INLINE void quick_keep(struct quick *q, struct quick_spans *v,
                             const struct product_part *part, struct mask8 met,
                             const struct span8 *x, double none)
{
    v->in[v->count] = r8_select(met, x->in, r8_set(none));
    v->out[v->count] = r8_select(met, x->out, r8_set(-none));
    v->part[v->count++] = part;
    q->doubt = m8_or(q->doubt, m8_without(met, x->clear));
}

// As product_add, of a leaf that is no complement.
LANES_INLINE unsigned quick_solid(struct quick *q, struct quick_spans *v,
                                  const struct product_part *part, const struct span8 *x)
{
    const bool bounded = part->kind != PACKET_PLANE;
    if (!bounded)
        q->doubt = m8_or(q->doubt, m8_without(m8_of(255), x->met));
    quick_keep(q, v, part, x->met, x, bounded ? INFINITY : -INFINITY);
    q->first = r8_max(v->in[v->count - 1], q->first);
    q->last = r8_min(v->out[v->count - 1], q->last);
    return m8_bits(r8_le(q->first, q->last));
}

// The solids are known: returns the lanes whose stretch in them lies ahead and begins before
// t, that of their nearest hit.
LANES_INLINE unsigned quick_solids_end(struct quick *q, struct quick_spans *v,
                                       struct real8 t)
{
    const struct real8 start = r8_max(q->t_min, q->first);
    const struct real8 margin = quick_bound(q, 5, r8_max(r8_abs(start), r8_abs(q->last)));
    v->solids = v->count;
    q->from = r8_sub(start, margin);
    q->to = r8_add(q->last, margin);
    return m8_bits(m8_and(r8_le(q->t_min, q->to), r8_le(q->from, r8_min(t, q->t_max))));
}

// As product_add, of a complement, if it matters to any of `lanes`.
LANES_INLINE void quick_complement(struct quick *q, struct quick_spans *v,
                                   const struct product_part *part, unsigned lanes,
                                   const struct span8 *x)
{
    if (part->kind == PACKET_PLANE)
        q->doubt = m8_or(q->doubt, m8_without(m8_of(255), x->met));
    const struct mask8 met =
        m8_and(x->met, m8_and(r8_le(x->in, q->to), r8_le(q->from, x->out)));
    if (m8_bits(met) & lanes)
        quick_keep(q, v, part, met, x, INFINITY);
}

// Lanes where t_min may lie within the bounds of a crossing that another touches
// (product_parts). With E = A + B |t_min| such two are within 3.02 E of t_min, and of
// complements that were left out, E = A + B |t_min| from `from`, only where the stretch
// begins late.
LANES_INLINE struct mask8 quick_begins(const struct quick *q, const struct quick_spans *v)
{
    const struct real8 near = quick_bound(q, 4, q->t_min);
    struct mask8 twice = m8_of(0), once = m8_of(0);
    for (uint32_t i = 0; i < v->count; i++) {
        const struct mask8 in = r8_le(r8_abs(r8_sub(v->in[i], q->t_min)), near);
        const struct mask8 out = r8_le(r8_abs(r8_sub(v->out[i], q->t_min)), near);
        const struct mask8 either = m8_or(in, out);
        twice = m8_or(twice, m8_or(m8_and(in, out), m8_and(either, once)));
        once = m8_or(once, either);
    }
    const struct mask8 late =
        r8_lt(r8_add(q->t_min, quick_bound(q, 1, q->t_min)), q->first);
    return m8_or(twice, m8_and(once, late));
}

// As product_advance. still: t is t_min yet.
LANES_INLINE void quick_advance(const struct quick *q, const struct quick_spans *v,
                                unsigned lanes, struct real8 *t, struct mask8 *still)
{
    for (unsigned moved = lanes; moved;) {
        moved = 0;
        for (uint32_t i = v->solids; i < v->count; i++) {
            const struct mask8 begun = m8_and(r8_eq(v->in[i], *t), *still);
            const struct mask8 m =
                m8_and(m8_or(r8_lt(v->in[i], *t), begun), r8_lt(*t, v->out[i]));
            const unsigned bits = m8_bits(m) & lanes;
            if (!bits)
                continue;
            moved |= bits;
            *t = r8_select(m, v->out[i], *t);
            *still = m8_without(*still, m);
        }
        moved &= m8_bits(r8_lt(*t, q->last));
    }
}

// Which crossing is at t: the only one that lies close. More than one: doubt.
LANES_INLINE struct mask8 quick_which(const struct quick *q, const struct quick_spans *v,
                                      struct real8 t, struct real8 *at)
{
    const struct real8 touching = quick_bound(q, 3, t);
    struct mask8 twice = r8_le(r8_abs(r8_sub(q->t_max, t)), touching), once = m8_of(0);
    for (uint32_t i = 0; i < v->count; i++) {
        const struct mask8 in = r8_le(r8_abs(r8_sub(v->in[i], t)), touching);
        const struct mask8 out = r8_le(r8_abs(r8_sub(v->out[i], t)), touching);
        const struct mask8 either = m8_or(in, out);
        twice = m8_or(twice, m8_or(m8_and(in, out), m8_and(either, once)));
        once = m8_or(once, either);
        *at = r8_select(either, r8_set(v->part[i]->at), *at);
    }
    return twice;
}

// As product_first; at: of either crossing of the leaf 2 i.
LANES_INLINE unsigned quick_first(const struct quick *q, const struct quick_spans *v,
                                  unsigned lanes, struct real8 *t, struct real8 *at,
                                  unsigned *doubt)
{
    *doubt = lanes & m8_bits(q->doubt);
    struct mask8 still = r8_le(q->first, q->t_min);
    *t = r8_max(q->t_min, q->first);
    *at = r8_set(0);
    if (v->count > v->solids)
        quick_advance(q, v, lanes, t, &still);
    const struct mask8 found = r8_lt(*t, q->last);
    const unsigned hit = lanes & m8_bits(found);
    if (lanes & ~hit) { // product_first: 2.5 times the sum of all bounds
        const struct real8 far = r8_max(r8_abs(q->first), r8_abs(q->last));
        *doubt |=
            lanes & ~hit &
            m8_bits(r8_le(r8_sub(q->last, q->first), quick_bound(q, 6. * v->count, far)));
    }
    if (!hit)
        return 0;
    if (m8_bits(still) & hit) {
        struct real8 end = q->last;
        for (uint32_t i = v->solids; i < v->count; i++)
            end = r8_select(r8_lt(q->t_min, v->in[i]), r8_min(v->in[i], end), end);
        *t = r8_select(still, end, *t);
    }
    *doubt |= hit & m8_bits(quick_which(q, v, *t, at));
    return hit & ~*doubt;
}

#endif
