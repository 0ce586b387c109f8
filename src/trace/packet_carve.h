#ifndef TRACE_PACKET_CARVE_H
#define TRACE_PACKET_CARVE_H

// Eight rays and a solid whose shape takes eight rays itself (shape_ops.closest8), intersected
// with simple ones or their complements: half spaces, boxes, what is cut off or clipped. The
// simple ones are met first; they leave stretches of each ray on which all of them are inside,
// and the solid's first crossing on such a stretch is all that has to be found of it. One that
// only clips is asked for points alone.
#include "trace/packet_lanes.h"

// Crossings no farther apart than this many of their errors, or this share of their t, are
// left to the sweep, which knows what coincides. Only more than the errors is needed.
static const double NEAR_ERRORS = 4, NEAR_SHARE = 0x1p-34;

struct cut8 {
    struct real8 t[2], margin[2]; // where it begins and ends; what is too near to that
    struct mask8 hollow;          // lanes that are to stay outside
    bool shown;                   // its boundaries end the search
};

struct carving {
    struct eight *e;
    const struct world_object *o;
    uint32_t solid;                // the leaf
    struct cut8 cut[CARVE_LEAVES]; // of the other leaves, by their place in the object
    uint32_t cuts[CARVE_LEAVES], count; // these places
    struct real8 limit;                 // hits are to lie before it
    struct real8 lo, hi, lo_at, hi_at;  // the stretch without what is hollow; lo is t_min
                                        // or beyond it
    struct real8 begin, end;            // the stretch at hand
    struct real8 begin_at, end_at;      // 2 i + k: t[k] of cut i; -1: t_min
    unsigned unsure;                    // lanes where crossings are too near each other
};

// What carving finds. Where `own` the boundary is the solid's and in `hits`, else leaf's.
struct carve_hits {
    struct shape_hits hits;
    double t[8];
    uint32_t leaf[8];
    unsigned own, unsure;
};

static struct ray ray_of_lane(const struct packet *p, int lane)
{
    const struct ray_batch *r = p->rays;
    const uint32_t i = p->first + (uint32_t)lane;
    return (struct ray){vec3(r->o[0][i], r->o[1][i], r->o[2][i]),
                        vec3(r->d[0][i], r->d[1][i], r->d[2][i]), r->t_min[i],
                        r->t_max[i]};
}

// ---- the simple solids ------------------------------------------------------------------------

static struct real8 margin_of(struct real8 t, struct real8 dt)
{
    return r8_add(r8_mul(r8_set(NEAR_ERRORS), dt), r8_mul(r8_set(NEAR_SHARE), r8_abs(t)));
}

// The lanes of `lanes`, which meet no boundary of the leaf, that are inside its shape.
static unsigned rays_inside(const struct eight *e, const struct leaf *l, unsigned lanes)
{
    unsigned in = 0;
    for (unsigned m = lanes; m; m &= m - 1) {
        const struct ray ray = ray_of_lane(e->p, __builtin_ctz(m));
        if (l->ops->inside(l->shape, transform_inverse_point(l->transform, ray.o)))
            in |= m & -m;
    }
    return in;
}

// The span in a leaf's shape; hollow: lanes that are outside on it and inside elsewhere.
// all: lanes that are inside all the way.
static struct span8 cut_span(const struct carving *c, const struct leaf *l,
                             enum packet_shape shape, unsigned bits, struct mask8 *odd,
                             struct mask8 *hollow, unsigned *all)
{
    struct eight *e = c->e;
    struct ray8 own;
    const struct ray8 *ray = leaf_ray(l, &e->ray, &own);
    struct span8 s;
    *hollow = m8_of(0);
    *all = 0;
    if (shape != PACKET_QUADRIC) {
        s = leaf_span(e, l, shape, ray, odd);
        if (shape == PACKET_PLANE)
            *all = rays_inside(e, l, bits & ~m8_bits(s.met));
        return s;
    }
    const struct cross8 x = cross8_quadric(l->shape, ray);
    const struct quadric *q = l->shape;
    const struct real8 at_o = quadric8_value(q, v8_sub(ray->o, V8_SET(q->centre)));
    s = span8_of(&x, x.met, m8_of(0));
    if (!l->transform->identity) {
        s.in_e = moved8(l, &e->ray, ray, s.in, s.in_e);
        s.out_e = moved8(l, &e->ray, ray, s.out, s.out_e);
    }
    *odd = x.odd;
    *hollow = m8_without(x.met, x.enters);
    *all = m8_bits(m8_without(r8_le(at_o, r8_set(0)), x.met));
    return s;
}

// Whether a leaf is cut out that no line comes near: its crossings are nowhere.
static bool cut_is_far(const struct carving *c, uint32_t place, unsigned bits)
{
    const struct eight *e = c->e;
    const struct leaf *l = &e->p->w->leaf[c->o->first_leaf + place];
    const struct aabb *b = &l->bounds;
    if (!l->inverted || !aabb_is_finite(*b))
        return false;
    const struct real8 size =
        r8_add(e->ray.o_max, r8_set(larger(vec3_max_abs(b->min), vec3_max_abs(b->max))));
    const struct real8 margin = r8_mul(r8_mul(r8_set(0x1p-30), e->ray.per_length), size);
    return !(bits &
             box_lanes_between(e, b, r8_sub(e->t_min, margin), r8_add(c->limit, margin)));
}

// Narrows the stretch to where the leaf is; returns the lanes where something is left.
static unsigned cut_add(struct carving *c, uint32_t place, unsigned bits, bool shown)
{
    const struct world *w = c->e->p->w;
    const uint32_t leaf = c->o->first_leaf + place;
    const struct leaf *l = &w->leaf[leaf];
    struct cut8 *cut = &c->cut[place];
    struct mask8 odd;
    unsigned all;
    const struct span8 s =
        cut_span(c, l, w->accel->leaf_shape[leaf], bits, &odd, &cut->hollow, &all);
    if (l->inverted) {
        cut->hollow = m8_without(s.met, cut->hollow);
        all = ~all;
    }
    c->cuts[c->count++] = place;
    c->unsure |= bits & m8_bits(odd);
    bits &= m8_bits(s.met) | all;
    cut->shown = shown;
    cut->t[0] = r8_select(s.met, s.in, r8_set(-INFINITY));
    cut->t[1] = r8_select(s.met, s.out, r8_set(INFINITY));
    for (int k = 0; k < 2; k++) {
        const struct mask8 finite = r8_lt(r8_abs(cut->t[k]), r8_set(INFINITY));
        const struct real8 margin = margin_of(cut->t[k], k ? s.out_e : s.in_e);
        cut->margin[k] = r8_select(finite, margin, r8_set(0));
        c->unsure |= bits & ~m8_bits(r8_lt(cut->margin[k], r8_set(INFINITY)));
    }
    const struct mask8 later = m8_without(r8_lt(c->lo, cut->t[0]), cut->hollow),
                       sooner = m8_without(r8_lt(cut->t[1], c->hi), cut->hollow);
    c->lo = r8_select(later, cut->t[0], c->lo);
    c->lo_at = r8_select(later, r8_set(2 * place), c->lo_at);
    c->hi = r8_select(sooner, cut->t[1], c->hi);
    c->hi_at = r8_select(sooner, r8_set(2 * place + 1), c->hi_at);
    return bits & m8_bits(m8_and(r8_le(c->lo, c->hi), r8_lt(c->lo, c->limit)));
}

// Lanes where two crossings of the simple solids that matter are too near each other.
static struct mask8 cuts_near(const struct carving *c)
{
    const struct real8 t_min = c->e->t_min;
    struct mask8 near = m8_of(0);
    for (uint32_t i = 0; i < 2 * c->count; i++) {
        const struct cut8 *a = &c->cut[c->cuts[i / 2]];
        const struct real8 t = a->t[i % 2], margin = a->margin[i % 2];
        const struct mask8 matters =
            m8_and(r8_lt(t_min, r8_add(t, margin)), r8_lt(r8_sub(t, margin), c->limit));
        for (uint32_t k = 0; k < i; k++) {
            const struct cut8 *b = &c->cut[c->cuts[k / 2]];
            const struct mask8 close =
                r8_le(r8_abs(r8_sub(t, b->t[k % 2])), r8_add(margin, b->margin[k % 2]));
            near = m8_or(near, m8_and(matters, close));
        }
    }
    return near;
}

// ---- stretches --------------------------------------------------------------------------------

// From c->begin on: out of what is hollow there, and to the end of that stretch; returns the
// lanes that have one.
static unsigned stretch_find(struct carving *c, unsigned lanes)
{
    for (unsigned moved = lanes; moved;) {
        moved = 0;
        for (uint32_t i = 0; i < c->count; i++) {
            const struct cut8 *cut = &c->cut[c->cuts[i]];
            const struct mask8 in =
                m8_and(cut->hollow,
                       m8_and(r8_le(cut->t[0], c->begin), r8_lt(c->begin, cut->t[1])));
            moved |= lanes & m8_bits(in);
            c->begin = r8_select(in, cut->t[1], c->begin);
            c->begin_at = r8_select(in, r8_set(2 * c->cuts[i] + 1), c->begin_at);
        }
    }
    c->end = c->hi;
    c->end_at = c->hi_at;
    for (uint32_t i = 0; i < c->count; i++) {
        const struct cut8 *cut = &c->cut[c->cuts[i]];
        const struct mask8 sooner = m8_and(
            cut->hollow, m8_and(r8_lt(c->begin, cut->t[0]), r8_lt(cut->t[0], c->end)));
        c->end = r8_select(sooner, cut->t[0], c->end);
        c->end_at = r8_select(sooner, r8_set(2 * c->cuts[i]), c->end_at);
    }
    return lanes & m8_bits(m8_and(r8_lt(c->begin, c->hi), r8_lt(c->begin, c->limit)));
}

// The margin of the crossing `at`, and whether it is shown.
static struct real8 end_margin(const struct carving *c, struct real8 at,
                               struct mask8 *shown)
{
    struct real8 margin = r8_set(0);
    *shown = m8_of(0);
    for (uint32_t i = 0; i < c->count; i++)
        for (uint32_t k = 0; k < 2; k++) {
            const struct cut8 *cut = &c->cut[c->cuts[i]];
            const struct mask8 here = r8_eq(at, r8_set(2 * c->cuts[i] + k));
            margin = r8_select(here, cut->margin[k], margin);
            if (cut->shown)
                *shown = m8_or(*shown, here);
        }
    return margin;
}

static struct mask8 too_near(const struct carving *c, struct real8 t, struct real8 dt)
{
    const struct real8 margin = margin_of(t, dt);
    struct mask8 near = m8_of(0);
    for (uint32_t i = 0; i < 2 * c->count; i++) {
        const struct cut8 *cut = &c->cut[c->cuts[i / 2]];
        near = m8_or(near, r8_le(r8_abs(r8_sub(t, cut->t[i % 2])),
                                 r8_add(cut->margin[i % 2], margin)));
    }
    return near;
}

// Of `lanes`: those that are inside the solid at t.
static unsigned inside_at(const struct carving *c, unsigned lanes, struct real8 t)
{
    const struct leaf *l = &c->e->p->w->leaf[c->solid];
    double at[8];
    unsigned in = 0;
    r8_store(at, t);
    for (unsigned m = l->solid ? lanes : 0; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        const struct ray ray = ray_of_lane(c->e->p, i);
        const struct vec3 p = transform_inverse_point(l->transform, ray_at(&ray, at[i]));
        if (l->ops->inside(l->shape, p) != l->inverted)
            in |= m & -m;
    }
    return in;
}

// The lanes that are in a box at t.
static unsigned in_box(const struct ray8 *ray, const struct aabb *b, struct real8 t)
{
    const struct vec8 p = v8_mad(ray->o, t, ray->d), min = V8_SET(b->min),
                      max = V8_SET(b->max);
    const struct mask8 x = m8_and(r8_le(min.x, p.x), r8_le(p.x, max.x)),
                       y = m8_and(r8_le(min.y, p.y), r8_le(p.y, max.y)),
                       z = m8_and(r8_le(min.z, p.z), r8_le(p.z, max.z));
    return m8_bits(m8_and(m8_and(x, y), z));
}

// The same on the stretch at hand, where no crossing of the solid was found: outside if both ends
// are out of its box; else as in the middle, since rounding may hide a crossing in a face of the
// box (that of an isosurface in its container's).
static unsigned inside_between(const struct carving *c, unsigned lanes)
{
    const struct real8 lo = c->begin, hi = r8_min(c->end, c->limit);
    const struct leaf *l = &c->e->p->w->leaf[c->solid];
    const struct ray8 *ray = &c->e->ray;
    unsigned out = 0;
    if (l->solid && l->bounded)
        out = lanes & ~(in_box(ray, &l->bounds, lo) | in_box(ray, &l->bounds, hi));
    if (out == lanes)
        return l->inverted ? out : 0;
    const struct real8 middle = r8_add(lo, r8_mul(r8_set(0.5), r8_sub(hi, lo))),
                       beyond = r8_add(lo, r8_max(r8_set(1), r8_abs(lo)));
    return (l->inverted ? out : 0) |
           inside_at(c, lanes & ~out,
                     r8_select(r8_lt(hi, r8_set(INFINITY)), middle, beyond));
}

// ---- the solid --------------------------------------------------------------------------------

// The solid's first crossings from lo to hi.
static unsigned solid_meets(const struct carving *c, unsigned lanes, struct real8 lo,
                            struct real8 hi, struct shape_hits *hits)
{
    struct packet *p = c->e->p;
    const struct leaf *l = &p->w->leaf[c->solid];
    struct ray8 own;
    const struct ray8 *ray = leaf_ray(l, &c->e->ray, &own);
    const unsigned met = leaf_closest8(p, l, ray, lo, hi, lanes, hits);
    return met & m8_bits(r8_lt(r8_load(hits->t), hi));
}

static void found_at(struct carve_hits *h, const struct carving *c, unsigned lanes,
                     struct real8 t, struct real8 at)
{
    double all[8], which[8];
    r8_store(all, t);
    r8_store(which, at);
    for (unsigned m = lanes; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        h->t[i] = all[i];
        h->leaf[i] = c->o->first_leaf + (uint32_t)which[i] / 2;
    }
}

static unsigned exits_of(const struct shape_hits *hits, unsigned lanes, bool inverted)
{
    unsigned exits = 0;
    for (unsigned m = lanes; m; m &= m - 1)
        if (crossing_of_leaf(hits->crossing[__builtin_ctz(m)], inverted) == CROSS_EXIT)
            exits |= m & -m;
    return exits;
}

static bool is_close(double p, double lo, double hi, double slack)
{
    return fabs(p - lo) <= slack || fabs(p - hi) <= slack;
}

// Of `lanes`: those that are at t beside the box of the solid's shape, in its space. There may be
// boundaries that are not drawn, such as the sides of a height field, and rays along them.
static unsigned beside_box(const struct carving *c, unsigned lanes, struct real8 t)
{
    const struct leaf *l = &c->e->p->w->leaf[c->solid];
    const struct aabb b = l->ops->bounds(l->shape);
    unsigned beside = 0;
    double at[8];
    r8_store(at, t);
    for (unsigned m = lanes; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        const struct ray ray = ray_of_lane(c->e->p, i);
        const struct vec3 o = transform_inverse_point(l->transform, ray.o);
        const struct vec3 p = transform_inverse_point(l->transform, ray_at(&ray, at[i]));
        const double slack = NEAR_SHARE * (vec3_max_abs(o) + vec3_max_abs(p));
        if (is_close(p.x, b.min.x, b.max.x, slack) ||
            is_close(p.y, b.min.y, b.max.y, slack) ||
            is_close(p.z, b.min.z, b.max.z, slack))
            beside |= m & -m;
    }
    return beside;
}

// Of `lanes`: those that meet an end of the stretch at t within the solid, which is not drawn.
static unsigned end_search(struct carving *c, unsigned lanes, struct real8 t,
                           struct real8 at, struct real8 margin, struct carve_hits *h)
{
    struct shape_hits hits;
    if (!lanes)
        return 0;
    const struct real8 far = r8_add(margin, margin), before = r8_sub(t, far),
                       after = r8_add(t, far);
    unsigned unsure = solid_meets(c, lanes, before, after, &hits);
    unsure |= beside_box(c, lanes & ~unsure, t);
    const unsigned met = inside_at(c, lanes & ~unsure, before);
    unsure |= met ^ inside_at(c, lanes & ~unsure, after); // a boundary that is not drawn
    h->unsure |= unsure;
    found_at(h, c, met & ~unsure, t, at);
    return met & ~unsure;
}

// One stretch of the lanes; returns those that meet the object there.
static unsigned stretch_search(struct carving *c, unsigned lanes, struct carve_hits *h)
{
    struct mask8 begins, ends;
    struct shape_hits hits;
    const struct real8 margin = end_margin(c, c->begin_at, &begins),
                       end = r8_add(c->end, end_margin(c, c->end_at, &ends));
    const unsigned opens = lanes & m8_bits(begins),
                   closes = lanes & m8_bits(m8_and(ends, r8_lt(c->end, c->limit)));
    if (!c->e->p->w->leaf[c->solid].drawn) {
        const unsigned met = end_search(c, opens, c->begin, c->begin_at, margin, h);
        return met | end_search(c, closes & ~(met | h->unsure), c->end, c->end_at,
                                r8_sub(end, c->end), h);
    }
    // So that what is too near the ends is found as well.
    const unsigned met =
        solid_meets(c, lanes, r8_max(c->e->t_min, r8_sub(c->begin, margin)),
                    r8_min(c->limit, end), &hits);
    const struct real8 t = r8_load(hits.t);
    h->unsure |= met ? met & m8_bits(too_near(c, t, r8_load(hits.dt))) : 0;
    const unsigned solid = met & ~h->unsure;
    unsigned hidden = 0; // the stretch begins inside the solid
    if (solid & opens && c->e->p->mode == SWEEP_CLOSEST)
        hidden = exits_of(&hits, solid & opens, c->e->p->w->leaf[c->solid].inverted);
    const unsigned within = lanes & ~met & (opens | closes)
                                ? inside_between(c, lanes & ~met & (opens | closes))
                                : 0;
    const unsigned first = hidden | (within & opens), own = solid & ~hidden;
    found_at(h, c, first, c->begin, c->begin_at);
    found_at(h, c, within & ~opens, c->end, c->end_at);
    for (unsigned m = own; m; m &= m - 1) {
        const struct boundary b = shape_hits_at(&hits, __builtin_ctz(m));
        shape_hits_put(&h->hits, __builtin_ctz(m), &b);
    }
    found_at(h, c, own, t, r8_set(2 * (c->solid - c->o->first_leaf)));
    h->own |= own;
    return own | first | within;
}

static unsigned stretches_search(struct carving *c, unsigned lanes, struct carve_hits *h)
{
    unsigned found = 0;
    c->begin = c->lo;
    c->begin_at = c->lo_at;
    while ((lanes = stretch_find(c, lanes))) {
        const unsigned here = stretch_search(c, lanes, h);
        found |= here;
        lanes &= ~(here | h->unsure) & m8_bits(r8_lt(c->end, c->hi));
        c->begin = c->end;
    }
    return found;
}

// Whether a leaf's boundaries end the search.
static bool ends_search(const struct packet *p, const struct leaf *l)
{
    return l->drawn && (p->mode == SWEEP_CLOSEST || p->w->surface[l->surface].opaque);
}

// As sweep_object, for the lanes of `bits`; limit: where each lane's nearest hit lies. The
// lanes of h->unsure are for the sweep.
static unsigned carve8(struct eight *e, unsigned bits, uint32_t object,
                       struct real8 limit, struct carve_hits *h)
{
    const struct packet *p = e->p;
    const struct world_object *o = &p->w->object[object];
    const uint8_t *shape = p->w->accel->leaf_shape + o->first_leaf;
    struct carving c; // not set to zero as a whole: it is large
    h->own = h->unsure = 0;
    c.e = e;
    c.o = o;
    c.solid = o->first_leaf;
    c.count = 0;
    c.unsure = 0;
    // An equal distance must still be seen: the object may have been declared earlier.
    c.limit = r8_min(e->t_max, r8_add(limit, r8_mul(r8_set(0x1p-52), limit)));
    c.lo = e->t_min;
    c.hi = r8_set(INFINITY);
    c.lo_at = c.hi_at = r8_set(-1);
    p->s->stats.csg_tests += (unsigned)__builtin_popcount(bits);
    for (uint32_t i = 0; i < o->leaf_count && bits; i++) {
        const struct leaf *l = &p->w->leaf[o->first_leaf + i];
        if (shape[i] == PACKET_LANES)
            c.solid = o->first_leaf + i;
        else if (!cut_is_far(&c, i, bits))
            bits = cut_add(&c, i, bits, ends_search(p, l));
    }
    if (!bits)
        return 0;
    h->unsure = bits & (c.unsure | m8_bits(cuts_near(&c)));
    const struct leaf *solid = &p->w->leaf[c.solid];
    if (solid->drawn && !ends_search(p, solid)) // what is clear may be followed by more
        h->unsure = bits;
    bits &= ~h->unsure;
    return bits ? stretches_search(&c, bits, h) : 0;
}

static unsigned carved8(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct world_object *o = &p->w->object[object];
    struct carve_hits h;
    if (!e->boxed)
        bits &= box_lanes(e, &o->bounds);
    if (!bits)
        return 0;
    const unsigned met = carve8(e, bits, object, r8_load(p->t), &h);
    const unsigned won = met ? take(e, met, r8_load(h.t), object, o->first_leaf) : 0;
    for (unsigned m = won; m; m &= m - 1)
        p->leaf[__builtin_ctz(m)] = h.leaf[__builtin_ctz(m)];
    keep_shape_hits(p, &h.hits, won & h.own);
    return h.unsure ? won | packet_try_object(p, h.unsure, object) : won;
}

#endif
