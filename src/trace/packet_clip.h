#ifndef TRACE_PACKET_CLIP_H
#define TRACE_PACKET_CLIP_H

// Eight rays and one object that is clipped by convex solids: what they leave of each line is
// one stretch, and the object's first boundary on it is seen. Where a boundary's error bounds
// touch an end of the stretch, the lane is left to the sweep.
#include "trace/packet_objects.h"

struct clip8 {
    struct real8 in, out;
    struct real8 error; // the most that an end of any of the solids may be off
    unsigned unsure;
};

// The stretches; the lanes where there is one.
static unsigned clip_spans(const struct eight *e, const struct world_object *o,
                           unsigned bits, struct clip8 *c)
{
    const struct world *w = e->p->w;
    const struct real8 none = r8_set(0);
    *c = (struct clip8){r8_set(-INFINITY), r8_set(INFINITY), none, 0};
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count && bits; i++) {
        const struct leaf *l = &w->leaf[i];
        if (l->drawn)
            continue;
        const enum packet_shape shape = w->accel->leaf_shape[i];
        struct mask8 odd;
        struct ray8 own;
        const struct span8 s = leaf_span(e, l, shape, leaf_ray(l, &e->ray, &own), &odd);
        c->unsure |= m8_bits(odd);
        if (shape == PACKET_PLANE) // beside it or all the way in it
            c->unsure |= ~m8_bits(s.met);
        else
            bits &= m8_bits(s.met);
        c->in = r8_select(s.met, r8_max(c->in, s.in), c->in);
        c->out = r8_select(s.met, r8_min(c->out, s.out), c->out);
        c->error = r8_select(s.met, r8_max(c->error, r8_max(s.in_e, s.out_e)), c->error);
        bits &= m8_bits(r8_le(c->in, c->out));
    }
    return bits & m8_bits(r8_le(r8_sub(c->in, c->error), r8_load(e->p->t)));
}

// Lanes where a crossing at t may lie at an end of the stretch.
LANES_INLINE struct mask8 at_clip(const struct clip8 *c, struct real8 t, struct real8 dt)
{
    const struct real8 e = r8_add(dt, c->error);
    return m8_or(r8_le(r8_abs(r8_sub(t, c->in)), e), r8_le(r8_abs(r8_sub(t, c->out)), e));
}

// What the sweep takes the bounds of a leaf's crossings for, or more.
LANES_INLINE struct real8 swept_error(const struct eight *e, const struct leaf *l,
                                      struct real8 t, struct real8 dt)
{
    if (l->transform->identity)
        return dt;
    const struct ray8 own = local_ray(l->transform, &e->ray);
    return moved8(l, &e->ray, &own, t, dt);
}

static uint32_t drawn_leaf(const struct world *w, const struct world_object *o)
{
    uint32_t i = o->first_leaf;
    while (!w->leaf[i].drawn)
        i++;
    return i;
}

// One leaf is drawn; e has the stretch for its ends.
static unsigned clipped_leaf(struct eight *e, unsigned bits, uint32_t object,
                             const struct clip8 *c, unsigned *unsure)
{
    const struct world *w = e->p->w;
    const uint32_t leaf = drawn_leaf(w, &w->object[object]);
    const struct leaf *l = &w->leaf[leaf];
    struct ray8 own;
    const struct cross8 x = leaf_cross(e, leaf, leaf_ray(l, &e->ray, &own));
    const struct real8 dt[2] = {swept_error(e, l, x.t[0], x.dt[0]),
                                swept_error(e, l, x.t[1], x.dt[1])};
    const struct mask8 two = m8_or(r8_lt(x.t[0], x.t[1]), m8_and(x.drawn[0], x.drawn[1])),
                       close = r8_le(r8_sub(x.t[1], x.t[0]), r8_add(dt[0], dt[1])),
                       ends = m8_or(at_clip(c, x.t[0], dt[0]), at_clip(c, x.t[1], dt[1]));
    *unsure |=
        bits & m8_bits(m8_or(x.odd, m8_and(x.met, m8_or(ends, m8_and(two, close)))));
    const struct mask8 first = m8_and(x.drawn[0], r8_lt(e->t_min, x.t[0]));
    const unsigned met =
        bits & ~*unsure & m8_bits(m8_and(x.met, m8_or(first, x.drawn[1])));
    const unsigned won =
        met ? take(e, met, r8_select(first, x.t[0], x.t[1]), object, leaf) : 0;
    if (won && e->p->mode == SWEEP_CLOSEST)
        keep(e->p, &x, first, won, lanes_if(l->inverted));
    return won;
}

// All drawn leaves make a product.
static unsigned clipped_product(struct eight *e, unsigned bits, uint32_t object,
                                const struct clip8 *c, unsigned *unsure)
{
    const struct world_object *o = &e->p->w->object[object];
    struct product x;
    product_begin(&x, e->t_min, e->t_max);
    bits = exact_leaves(e, &x, false, false, o, bits);
    product_solids_end(&x);
    bits = exact_leaves(e, &x, true, false, o, bits);
    if (!bits)
        return 0;
    struct mask8 ends = m8_of(0);
    for (uint32_t i = 0; i < x.count; i++) {
        const struct product_leaf *l = &x.leaf[i];
        ends =
            m8_or(ends, m8_or(at_clip(c, l->in, l->in_e), at_clip(c, l->out, l->out_e)));
    }
    struct real8 t, at;
    unsigned doubt;
    *unsure |= bits & m8_bits(ends);
    const unsigned found = product_first(&x, bits & ~*unsure, &t, &at, &doubt);
    *unsure |= doubt;
    return take_leaves(e, found, t, at, object);
}

static unsigned clipped(struct eight *e, unsigned bits, uint32_t object, bool product)
{
    struct packet *p = e->p;
    const struct world_object *o = &p->w->object[object];
    struct clip8 c;
    if (!e->boxed)
        bits &= box_lanes(e, &o->bounds);
    bits = bits ? clip_spans(e, o, bits, &c) : 0;
    if (!bits)
        return 0;
    p->s->stats.csg_tests++;
    const struct real8 t_min = e->t_min, t_max = e->t_max;
    unsigned unsure = bits & c.unsure;
    e->t_min = r8_max(t_min, c.in);
    e->t_max = r8_min(t_max, c.out);
    const unsigned won = product ? clipped_product(e, bits, object, &c, &unsure)
                                 : clipped_leaf(e, bits, object, &c, &unsure);
    e->t_min = t_min;
    e->t_max = t_max;
    return unsure ? won | packet_try_object(p, unsure, object) : won;
}

#endif
