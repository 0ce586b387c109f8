#ifndef TRACE_PACKET_PRODUCT_H
#define TRACE_PACKET_PRODUCT_H

// CSG for eight rays: an intersection of convex leaves and of complements of convex leaves.
// The rays' spans in the leaves give the first surface without sorting: the last entry into
// the leaves, moved out of every complement it lies in, or, from within, the first exit.
//
// That is what the sweep (trace/sweep.c) finds wherever each batch that decides holds one
// crossing: no other crossing's error bounds touch those of the one found, nor those of one
// whose bounds hold t_min, which could part a batch. Where nothing is found, the sweep might
// still see a leaf so thin that it begins and ends in one batch; the sum of all bounds
// excludes that. The lanes where this does not hold are left to the sweep.
#include "trace/accel.h"
#include "trace/packet_shapes.h"

struct product_leaf {
    struct real8 in, out, in_e, out_e;
    struct real8 in_at, out_at; // as in_at and out_at of product
};

struct product {
    struct product_leaf leaf[PRODUCT_LEAVES];
    uint32_t count, solids; // the first are no complements
    struct real8 t_min, t_max;
    // The span of the leaves that are no complements, and where it begins and ends:
    // 2 i for the entry of leaf i, 2 i + 1 for its exit, -1 for t_min.
    struct real8 in, out, in_e, out_e, in_at, out_at;
    struct real8 bounds; // the sum of all error bounds
    struct mask8 begins; // a crossing's bounds hold t_min
    struct mask8 unsure; // lanes for the sweep
};

// Leaves are not set to zero: most products have few of them.
LANES_INLINE void product_begin(struct product *p, struct real8 t_min, struct real8 t_max)
{
    p->count = p->solids = 0;
    p->t_min = t_min;
    p->t_max = t_max;
    p->in = r8_set(-INFINITY);
    p->out = r8_set(INFINITY);
    p->in_e = p->out_e = p->bounds = r8_set(0);
    p->in_at = p->out_at = r8_set(-1);
    p->begins = p->unsure = m8_of(0);
}

// The span of leaf i joins, those of complements last; returns the lanes that can still
// meet the object.
LANES_INLINE unsigned product_add(struct product *p, uint32_t i, bool complement,
                                  bool bounded, const struct span8 *x)
{
    struct product_leaf *l = &p->leaf[p->count++];
    l->in_at = r8_set(2 * i);
    l->out_at = r8_set(2 * i + 1);
    const struct real8 none = r8_set(0);
    // A line that meets no boundary is outside, but of an unbounded leaf: see below.
    const double beyond = bounded || complement ? INFINITY : -INFINITY;
    l->in = r8_select(x->met, x->in, r8_set(beyond));
    l->out = r8_select(x->met, x->out, r8_set(-beyond));
    l->in_e = r8_select(x->met, x->in_e, none);
    l->out_e = r8_select(x->met, x->out_e, none);
    p->bounds = r8_add(p->bounds, r8_add(l->in_e, l->out_e));
    p->begins =
        m8_or(p->begins, m8_or(r8_le(r8_abs(r8_sub(l->in, p->t_min)), l->in_e),
                               r8_le(r8_abs(r8_sub(l->out, p->t_min)), l->out_e)));
    if (!bounded) // a line that does not meet it may lie inside all the way
        p->unsure = m8_or(p->unsure, m8_without(m8_of(255), x->met));
    if (complement)
        return 255;
    const struct mask8 later = r8_lt(p->in, l->in), sooner = r8_lt(l->out, p->out);
    p->in = r8_select(later, l->in, p->in);
    p->in_e = r8_select(later, l->in_e, p->in_e);
    p->in_at = r8_select(later, l->in_at, p->in_at);
    p->out = r8_select(sooner, l->out, p->out);
    p->out_e = r8_select(sooner, l->out_e, p->out_e);
    p->out_at = r8_select(sooner, l->out_at, p->out_at);
    return m8_bits(r8_le(p->in, p->out));
}

LANES_INLINE void product_solids_end(struct product *p) { p->solids = p->count; }

// Lanes where the bounds of another crossing than `at` touch those of one at t.
LANES_INLINE struct mask8 product_near(const struct product *p, struct real8 t,
                                       struct real8 e, struct real8 at)
{
    struct mask8 near = m8_of(0);
    for (uint32_t i = 0; i < p->count; i++) {
        const struct product_leaf *l = &p->leaf[i];
        const struct mask8 in = r8_le(r8_abs(r8_sub(l->in, t)), r8_add(l->in_e, e));
        const struct mask8 out = r8_le(r8_abs(r8_sub(l->out, t)), r8_add(l->out_e, e));
        near = m8_or(near, m8_without(in, r8_eq(at, l->in_at)));
        near = m8_or(near, m8_without(out, r8_eq(at, l->out_at)));
    }
    return near;
}

// Lanes where the rays begin within the bounds of the crossing at t, and those of another
// touch these.
LANES_INLINE struct mask8 product_parts(const struct product *p, struct real8 t,
                                        struct real8 e, struct real8 at)
{
    return m8_and(r8_le(r8_abs(r8_sub(t, p->t_min)), e), product_near(p, t, e, at));
}

// Of the lanes of p->begins.
static struct mask8 product_begins(const struct product *p)
{
    struct mask8 m = m8_of(0);
    for (uint32_t i = 0; i < p->count; i++) {
        const struct product_leaf *l = &p->leaf[i];
        m = m8_or(m, m8_or(product_parts(p, l->in, l->in_e, l->in_at),
                           product_parts(p, l->out, l->out_e, l->out_at)));
    }
    return m;
}

// Moves t out of the complements; lanes that begin inside stay at t_min. What is entered at
// t_min itself is entered before, as a ray that goes on from its last hit has it.
LANES_INLINE void product_advance(const struct product *p, unsigned lanes,
                                  struct real8 *t, struct real8 *e, struct real8 *at)
{
    for (unsigned moved = lanes; moved;) {
        moved = 0;
        for (uint32_t i = p->solids; i < p->count; i++) {
            const struct product_leaf *l = &p->leaf[i];
            const struct mask8 first = m8_and(r8_eq(l->in, *t), r8_lt(*at, r8_set(0)));
            const struct mask8 m =
                m8_and(m8_or(r8_lt(l->in, *t), first), r8_lt(*t, l->out));
            const unsigned bits = m8_bits(m) & lanes;
            if (!bits)
                continue;
            moved |= bits;
            *t = r8_select(m, l->out, *t);
            *e = r8_select(m, l->out_e, *e);
            *at = r8_select(m, l->out_at, *at);
        }
        moved &= m8_bits(r8_lt(*t, p->out));
    }
}

// The first surface of `lanes` in t, and which crossing it is in at; the lanes that have
// one and those for which the sweep must tell.
LANES_INLINE unsigned product_first(const struct product *p, unsigned lanes,
                                    struct real8 *t, struct real8 *at, unsigned *unsure)
{
    lanes &= m8_bits(r8_le(p->in, p->out)); // else empty, whatever the errors
    *unsure = lanes & m8_bits(p->unsure);
    if (lanes & m8_bits(p->begins))
        *unsure |= lanes & m8_bits(product_begins(p));
    const struct mask8 ahead = r8_lt(p->t_min, p->in);
    *t = r8_select(ahead, p->in, p->t_min);
    *at = r8_select(ahead, p->in_at, r8_set(-1));
    struct real8 e = r8_select(ahead, p->in_e, r8_set(0));
    product_advance(p, lanes, t, &e, at);
    const struct mask8 found = r8_lt(*t, p->out);
    const struct mask8 within = m8_and(found, r8_lt(*at, r8_set(0)));
    const unsigned hit = lanes & m8_bits(found);
    // Nothing: is the span so short that it may be one batch?
    *unsure |= lanes & ~hit &
               m8_bits(r8_le(r8_sub(p->out, p->in), r8_mul(r8_set(2.5), p->bounds)));
    if (!hit)
        return 0;
    if (m8_bits(within) & hit) {
        struct real8 end = p->out, end_e = p->out_e, end_at = p->out_at;
        for (uint32_t i = p->solids; i < p->count; i++) {
            const struct product_leaf *l = &p->leaf[i];
            const struct mask8 m = m8_and(r8_lt(p->t_min, l->in), r8_lt(l->in, end));
            end = r8_select(m, l->in, end);
            end_e = r8_select(m, l->in_e, end_e);
            end_at = r8_select(m, l->in_at, end_at);
        }
        *t = r8_select(within, end, *t);
        e = r8_select(within, end_e, e);
        *at = r8_select(within, end_at, *at);
    }
    const struct mask8 last = r8_le(r8_abs(r8_sub(p->t_max, *t)), e);
    *unsure |= hit & m8_bits(m8_or(last, product_near(p, *t, e, *at)));
    return hit & ~*unsure;
}

#endif
