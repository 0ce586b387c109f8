#ifndef TRACE_PACKET_RING_H
#define TRACE_PACKET_RING_H

// Eight rays and one ring torus, or its complement, in an intersection with convex solids and
// complements of them, drawn ones or clips. The others leave stretches of each line, as in
// packet_product.h; on each of them the line's next way through the tube tells what is seen.
// Lanes where the bounds of two crossings that matter touch are left to the sweep.
#include "trace/packet_objects.h"

struct ring {
    struct eight *e;
    const struct world_object *o;
    uint32_t torus; // the leaf
    struct product others;
    struct ray8 own; // of the torus's space
    const struct ray8 *ray;
    // Of each lane, the stretch: where it begins and ends, in what, and how surely.
    struct real8 at, from, from_e, end_at, to, to_e;
    unsigned unsure;
};

static uint32_t ring_leaf(const struct world *w, const struct world_object *o)
{
    uint32_t i = o->first_leaf;
    while (w->accel->leaf_shape[i] != PACKET_TORUS)
        i++;
    return i;
}

// The others' spans; the lanes in which they can all hold.
static unsigned ring_others(struct ring *r, bool complements, unsigned bits)
{
    const struct world *w = r->e->p->w;
    for (uint32_t i = 0; i < r->o->leaf_count && bits; i++) {
        const uint32_t leaf = r->o->first_leaf + i;
        const struct leaf *l = &w->leaf[leaf];
        if (leaf == r->torus || l->inverted != complements)
            continue;
        const enum packet_shape shape = w->accel->leaf_shape[leaf];
        struct mask8 odd;
        struct ray8 own;
        const struct span8 s =
            leaf_span(r->e, l, shape, leaf_ray(l, &r->e->ray, &own), &odd);
        r->others.unsure = m8_or(r->others.unsure, odd);
        bits &= product_add(&r->others, i, complements, shape != PACKET_PLANE, &s);
    }
    return bits;
}

// Lanes where the crossing `at` is of a drawn leaf.
static struct mask8 ring_drawn(const struct ring *r, struct real8 at)
{
    const struct world *w = r->e->p->w;
    struct mask8 drawn = m8_of(0);
    for (uint32_t i = 0; i < r->others.count; i++) {
        const struct product_leaf *l = &r->others.leaf[i];
        double which[8];
        r8_store(which, l->in_at);
        if (w->leaf[r->o->first_leaf + (uint32_t)which[0] / 2].drawn)
            drawn = m8_or(drawn, m8_or(r8_eq(at, l->in_at), r8_eq(at, l->out_at)));
    }
    return drawn;
}

// The lanes' stretches that begin at `from` or behind it; the lanes that have one.
static unsigned ring_stretch(struct ring *r, unsigned bits)
{
    const struct product *p = &r->others;
    product_advance(p, bits, &r->from, &r->from_e, &r->at);
    r->to = p->out;
    r->to_e = p->out_e;
    r->end_at = p->out_at;
    for (uint32_t i = p->solids; i < p->count; i++) {
        const struct product_leaf *l = &p->leaf[i];
        const struct mask8 m = m8_and(r8_lt(r->from, l->in), r8_lt(l->in, r->to));
        r->to = r8_select(m, l->in, r->to);
        r->to_e = r8_select(m, l->in_e, r->to_e);
        r->end_at = r8_select(m, l->in_at, r->end_at);
    }
    const struct real8 limit = r8_min(r->e->t_max, r8_load(r->e->p->t));
    return bits & m8_bits(m8_and(r8_lt(r->from, p->out), r8_le(r->from, limit)));
}

// What is seen on the stretches of the lanes; those that won, *settled: those that need look
// no further.
static unsigned ring_look(struct ring *r, unsigned bits, uint32_t object,
                          unsigned *settled)
{
    struct eight *e = r->e;
    const struct leaf *l = &e->p->w->leaf[r->torus];
    const struct cross8 x = cross8_torus(l->shape, r->ray, r->from);
    const struct real8 dt[2] = {torus_error(l, &e->ray, r->ray, x.t[0], x.dt[0]),
                                torus_error(l, &e->ray, r->ray, x.t[1], x.dt[1])};
    const struct real8 none = r8_set(-1);
    struct mask8 touches = r8_le(r8_sub(x.t[1], x.t[0]), r8_add(dt[0], dt[1]));
    for (int i = 0; i < 2; i++)
        touches = m8_or(touches, product_near(&r->others, x.t[i], dt[i], none));
    const struct mask8 tube = m8_and(x.met, r8_lt(r->from, x.t[1]));
    const struct mask8 within = m8_and(tube, r8_le(x.t[0], r->from));
    const struct mask8 inside =
        l->inverted ? m8_without(m8_of(255), within) : within; // at `from`
    const struct real8 next = r8_select(within, x.t[1], x.t[0]);
    const struct mask8 crosses = m8_and(tube, r8_lt(next, r->to));
    const struct mask8 begins =
        m8_and(m8_and(inside, r8_le(r8_set(0), r->at)), ring_drawn(r, r->at));
    const struct mask8 ends =
        m8_without(m8_and(inside, ring_drawn(r, r->end_at)), crosses);
    const struct mask8 begun = m8_and(
        r8_le(r8_set(0), r->at), product_near(&r->others, r->from, r->from_e, r->at));
    // One of two that coincide may be drawn, whichever begins or ends the stretch.
    const struct mask8 ended = m8_and(
        m8_without(inside, crosses), product_near(&r->others, r->to, r->to_e, r->end_at));
    const struct mask8 near = m8_or(ended, m8_and(begun, m8_or(inside, crosses)));
    r->unsure |=
        bits & (m8_bits(x.odd) | m8_bits(m8_and(x.met, touches)) | m8_bits(near));
    bits &= ~r->unsure;
    const unsigned own = bits & m8_bits(m8_without(crosses, begins));
    const unsigned other = bits & m8_bits(m8_or(begins, ends)) & ~own;
    *settled = own | other | r->unsure;
    unsigned won = own ? take(e, own, next, object, r->torus) : 0;
    if (won && e->p->mode == SWEEP_CLOSEST)
        keep(e->p, &x, m8_without(m8_of(255), within), won, lanes_if(l->inverted));
    return won | take_leaves(e, other, r8_select(begins, r->from, r->to),
                             r8_select(begins, r->at, r->end_at), object);
}

static unsigned ring_product(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    struct ring r;
    r.e = e;
    r.o = &p->w->object[object];
    r.torus = ring_leaf(p->w, r.o);
    r.unsure = 0;
    if (!e->boxed)
        bits &= box_lanes(e, &r.o->bounds);
    product_begin(&r.others, e->t_min, e->t_max);
    bits = ring_others(&r, false, bits);
    product_solids_end(&r.others);
    bits = ring_others(&r, true, bits);
    if (!bits)
        return 0;
    p->s->stats.csg_tests++;
    const struct product *x = &r.others;
    const struct leaf *l = &p->w->leaf[r.torus];
    r.ray = leaf_ray(l, &e->ray, &r.own);
    r.unsure = bits & (m8_bits(x->unsure) | m8_bits(x->begins));
    const struct mask8 ahead = r8_lt(e->t_min, x->in);
    r.from = r8_select(ahead, x->in, e->t_min);
    r.from_e = r8_select(ahead, x->in_e, r8_set(0));
    r.at = r8_select(ahead, x->in_at, r8_set(-1));
    unsigned won = 0, hit = 0, settled;
    for (unsigned on = bits & ~r.unsure; (on = ring_stretch(&r, on)) != 0;) {
        won |= ring_look(&r, on, object, &settled);
        hit |= on & settled;
        on &= ~settled & m8_bits(r8_lt(r.to, x->out));
        r.from = r.to; // a complement begins
        r.at = r8_set(-1);
    }
    r.unsure |= bits & ~hit &
                m8_bits(r8_le(r8_sub(x->out, x->in), r8_mul(r8_set(2.5), x->bounds)));
    return r.unsure ? won | packet_try_object(p, r.unsure, object) : won;
}

#endif
