#ifndef TRACE_PACKET_CSG_H
#define TRACE_PACKET_CSG_H

// Eight rays and CSG of any form: unions, merges, intersections in each other, clips.
//
// Each line has spans in each leaf. A crossing is a surface of the whole if, of every node
// above it, the other children are inside (an intersection) or outside (a merge) there; what
// the leaf itself does makes no difference. A child counts as either where it may be that
// within `slack` of the crossing, which is more than a batch of the sweep (trace/sweep.c) is
// long: all that the sweep takes for a surface passes. The first that passes is what the sweep
// finds, if no other crossing lies within `slack`: then what may be is, and its batch holds
// nothing else. The other lanes are left to the sweep.
#include "trace/packet_csg_spans.h"

// ---- leaves ---------------------------------------------------------------------------------

static bool csg8_is_convex(const struct csg8 *v, uint32_t i)
{
    return packet_is_product_shape(v->e->p->w->accel->leaf_shape[v->o->first_leaf + i]);
}

static void csg8_simple(struct csg8 *v, uint32_t i)
{
    const struct leaf *l = &v->e->p->w->leaf[v->o->first_leaf + i];
    const enum packet_shape shape = v->e->p->w->accel->leaf_shape[v->o->first_leaf + i];
    csg8_begin_leaf(v, i);
    if (!csg8_boxed(v, l, v->lanes))
        return;
    v->e->p->s->stats.leaf_tests++;
    const struct ray8 *ray = csg8_ray(v, l);
    if (shape == PACKET_QUADRIC)
        csg8_quadric(v, i, ray);
    else
        csg8_convex(v, i, shape, ray);
}

// Lanes that are inside the leaf somewhere, or may be.
static unsigned csg8_held(const struct csg8 *v, uint32_t i)
{
    unsigned held = v->turned[i];
    for (uint32_t k = v->first[i]; k < (uint32_t)v->first[i] + v->count[i]; k++)
        held |= m8_bits(r8_le(v->in[k], v->out[k]));
    return held;
}

// The same of a node, by index from the root.
static unsigned csg8_node_held(const struct csg8 *v, uint32_t n)
{
    const struct csg_node *node = &v->node[n];
    if (node->op == NODE_LEAF)
        return csg8_held(v, node->leaf - v->o->first_leaf);
    const uint32_t first = node->first_child - v->o->root;
    const bool all = node->op == NODE_INTERSECTION;
    unsigned held = all ? 255 : 0;
    for (uint32_t c = first; c < first + node->child_count; c++)
        held = all ? held & csg8_node_held(v, c) : held | csg8_node_held(v, c);
    return held;
}

// Lanes where a leaf makes a difference: no intersection above it is nowhere without it.
static unsigned csg8_matters(const struct csg8 *v, uint32_t i)
{
    const uint32_t root = v->o->root;
    uint32_t n = v->e->p->w->leaf[v->o->first_leaf + i].node - root;
    unsigned lanes = v->lanes;
    while (n && lanes) {
        const uint32_t up = v->node[n].parent - root;
        const uint32_t first = v->node[up].first_child - root;
        if (v->node[up].op == NODE_INTERSECTION)
            for (uint32_t c = first; c < first + v->node[up].child_count; c++)
                if (c != n)
                    lanes &= csg8_node_held(v, c);
        n = up;
    }
    return lanes;
}

static void csg8_dear(struct csg8 *v, uint32_t i)
{
    const struct leaf *l = &v->e->p->w->leaf[v->o->first_leaf + i];
    const bool ring = l->ops == &torus_ops && ((const struct torus *)l->shape)->major >
                                                  ((const struct torus *)l->shape)->minor;
    csg8_begin_leaf(v, i);
    const unsigned lanes = csg8_boxed(v, l, csg8_matters(v, i));
    if (!lanes)
        return;
    if (ring)
        csg8_ring(v, i, csg8_ray(v, l));
    else
        csg8_other(v, i, lanes);
}

// More than a batch is long: 2 would do, but for the rounding of the sum.
static struct real8 csg8_slack(const struct csg8 *v)
{
    return r8_mul(r8_set(2.5), v->bounds);
}

// Solids without which there is nothing: what lies outside of them is of no interest.
static void csg8_required(struct csg8 *v)
{
    for (uint32_t i = 0; i < v->o->leaf_count && v->lanes; i++) {
        if (!v->e->p->w->leaf[v->o->first_leaf + i].required || !csg8_is_convex(v, i))
            continue;
        csg8_simple(v, i);
        v->lanes &= csg8_held(v, i) | v->unsure;
        if (!v->count[i])
            continue;
        const uint32_t k = v->first[i];
        const struct mask8 known =
            m8_and(m8_of(v->lanes & ~v->unsure), r8_le(csg8_slack(v), v->margin));
        v->from = r8_select(known, r8_max(r8_sub(v->in[k], v->margin), v->from), v->from);
        v->to = r8_select(known, r8_min(r8_add(v->out[k], v->margin), v->to), v->to);
        v->lanes &= m8_bits(r8_le(v->from, v->to)) | v->unsure;
    }
}

static void csg8_others(struct csg8 *v)
{
    const struct world *w = v->e->p->w;
    for (uint32_t i = 0; i < v->o->leaf_count && v->lanes; i++)
        if (csg8_is_convex(v, i) && !w->leaf[v->o->first_leaf + i].required)
            csg8_simple(v, i);
    for (uint32_t i = 0; i < v->o->leaf_count; i++)
        if (!csg8_is_convex(v, i)) { // not known yet
            v->first[i] = v->count[i] = 0;
            v->turned[i] = 255;
        }
    for (int inverted = 0; inverted < 2; inverted++)
        for (uint32_t i = 0; i < v->o->leaf_count && v->lanes; i++) {
            const struct leaf *l = &w->leaf[v->o->first_leaf + i];
            if (csg8_is_convex(v, i) || l->inverted != inverted)
                continue;
            csg8_dear(v, i);
            if (l->required)
                v->lanes &= csg8_held(v, i) | v->unsure;
        }
}

// ---- the first surface ------------------------------------------------------------------------

// Lanes where another crossing than `at` lies close to t.
static unsigned csg8_near(const struct csg8 *v, struct real8 t, struct real8 at)
{
    struct mask8 near = m8_of(0);
    for (uint32_t k = 0; k < v->spans; k++) {
        const struct mask8 in = r8_le(r8_abs(r8_sub(v->in[k], t)), v->slack);
        const struct mask8 out = r8_le(r8_abs(r8_sub(v->out[k], t)), v->slack);
        near = m8_or(near, m8_without(in, r8_eq(at, r8_set(2. * k))));
        near = m8_or(near, m8_without(out, r8_eq(at, r8_set(2. * k + 1))));
    }
    return m8_bits(near);
}

// Before *t; *at says which it is.
static unsigned csg8_first(struct csg8 *v, struct real8 *t, struct real8 *at)
{
    const struct eight *e = v->e;
    const struct world *w = e->p->w;
    const struct real8 limit = r8_load(e->p->t);
    unsigned found = 0;
    for (uint32_t k = 0; k < v->spans; k++) {
        const struct leaf *l = &w->leaf[v->o->first_leaf + v->leaf[k]];
        if (e->p->mode == SWEEP_OPAQUE && !w->surface[l->surface].opaque)
            continue;
        for (int side = 0; side < 2; side++) {
            const struct real8 x = side ? v->out[k] : v->in[k];
            unsigned lanes = v->lanes & (side ? v->out_drawn[k] : v->in_drawn[k]);
            lanes &= m8_bits(
                m8_and(m8_and(r8_lt(e->t_min, x), r8_lt(x, *t)), r8_le(x, limit)));
            if (!lanes)
                continue;
            v->before = r8_sub(x, v->slack);
            v->after = r8_add(x, v->slack);
            lanes = csg8_shows(v, v->leaf[k], lanes);
            found |= lanes;
            *t = r8_select(m8_of(lanes), x, *t);
            *at = r8_select(m8_of(lanes), r8_set(2. * k + side), *at);
        }
    }
    return found;
}

// The lane's hit is the boundary at that place.
static void csg8_keep(struct packet *p, int lane, uint32_t at)
{
    const struct boundary b = boundary_as_shape_has_it(p->s, &p->s->crossings.at[at]);
    p->dt[lane] = b.dt;
    p->u[lane] = b.u;
    p->v[lane] = b.v;
    p->part[lane] = b.part;
    p->crossing[lane] = b.crossing;
    p->whole |= 1u << lane;
}

static unsigned csg8_take(const struct csg8 *v, unsigned found, struct real8 t,
                          struct real8 at, uint32_t object)
{
    struct packet *p = v->e->p;
    const uint32_t first_leaf = v->o->first_leaf;
    const unsigned won = found ? take(v->e, found, t, object, first_leaf) : 0;
    double which[8];
    if (won)
        r8_store(which, at);
    for (unsigned m = won; m; m &= m - 1) {
        const int lane = __builtin_ctz(m);
        const uint32_t i = (uint32_t)which[lane], k = i / 2;
        p->leaf[lane] = first_leaf + v->leaf[k];
        if (v->kept >> k & 1)
            csg8_keep(p, lane, i % 2 ? v->ends[k][lane] : v->begins[k][lane]);
    }
    return won;
}

// What is ahead, and nearer than all that is known. The margin only has to exceed errors.
static void csg8_stretch(struct csg8 *v)
{
    const struct eight *e = v->e;
    const struct aabb *b = &v->o->bounds;
    const double extent =
        aabb_is_finite(*b) ? larger(vec3_max_abs(b->min), vec3_max_abs(b->max)) : 0;
    v->margin = r8_mul(r8_mul(r8_set(0x1p-30), e->ray.per_length),
                       r8_add(e->ray.o_max, r8_set(extent)));
    v->from = r8_sub(e->t_min, v->margin);
    v->to = r8_add(r8_min(e->t_max, r8_load(e->p->t)), v->margin);
}

// Leaves the lanes that are unsure to the sweep, with what is known of their crossings.
static unsigned csg8_sweep(struct csg8 *v, uint32_t object)
{
    struct trace_scratch *s = v->e->p->s;
    unsigned won = 0;
    scratch_keep_crossings(s, &v->made);
    for (unsigned m = v->unsure; m; m &= m - 1) {
        v->made.lane = __builtin_ctz(m);
        won |= packet_try_object(v->e->p, m & -m, object);
    }
    s->made = NULL;
    return won;
}

static unsigned csg8(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    struct csg8 v; // not set to zero: it is large
    v.e = e;
    v.o = &p->w->object[object];
    if (!e->boxed)
        bits &= box_lanes(e, &v.o->bounds);
    if (!bits)
        return 0;
    p->s->stats.csg_tests++;
    v.node = p->w->node + v.o->root;
    v.spans = 0;
    v.live = v.kept = 0;
    v.space = NULL;
    v.made.first_leaf = v.o->first_leaf;
    memset(v.made.lanes, 0, sizeof v.made.lanes);
    p->s->crossings.count = p->s->own_count = 0;
    v.bounds = r8_set(0);
    v.lanes = bits;
    v.unsure = 0;
    csg8_stretch(&v);
    csg8_required(&v);
    csg8_others(&v);
    v.slack = csg8_slack(&v);
    v.unsure |= ~m8_bits(r8_le(v.slack, v.margin));
    v.unsure &= v.lanes;
    v.lanes &= ~v.unsure;
    struct real8 t = e->t_max, at = r8_set(0);
    unsigned found = v.spans && v.lanes ? csg8_first(&v, &t, &at) : 0;
    if (found)
        v.unsure |= found & csg8_near(&v, t, at);
    const unsigned won = csg8_take(&v, found & ~v.unsure, t, at, object);
    return v.unsure ? won | csg8_sweep(&v, object) : won;
}

#endif
