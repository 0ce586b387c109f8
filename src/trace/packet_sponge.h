#ifndef TRACE_PACKET_SPONGE_H
#define TRACE_PACKET_SPONGE_H

// A solid less many spheres, for eight rays: as trace/stab.c. Where that leaves a ray to the
// sweep, or a crossing is less clear than it has to be there, this leaves the lane to the
// one-ray form.
#include "trace/packet_objects.h"

struct sponge {
    const struct accel_large *large;
    uint32_t first_leaf;
    struct real8 in, out;  // the crossing reached; where the solid ends
    struct real8 in_e, at; // its error; which it is, as in take_leaves, -1: t_min
    struct span8 solid[STAB_SOLIDS];
    unsigned unsure;
};

// Lanes for which another crossing cannot be told from the one reached.
LANES_INLINE struct mask8 unclear8(const struct sponge *v, struct real8 t, struct real8 e,
                                   double at)
{
    const struct mask8 near = r8_le(r8_abs(r8_sub(t, v->in)), r8_add(e, v->in_e));
    return m8_without(near, r8_eq(v->at, r8_set(at)));
}

// The spans of the solids; returns the lanes that have an object before them.
static unsigned sponge_solids(struct eight *e, struct sponge *v, unsigned bits)
{
    const struct world *w = e->p->w;
    v->in = r8_set(-INFINITY);
    v->out = r8_set(INFINITY);
    v->in_e = r8_set(0);
    v->at = r8_set(-1);
    for (uint32_t i = 0; i < v->large->required_count; i++) {
        const uint32_t leaf = v->large->required[i];
        struct mask8 odd;
        struct ray8 own;
        const struct leaf *l = &w->leaf[leaf];
        const struct span8 x =
            leaf_span(e, l, w->accel->leaf_shape[leaf], leaf_ray(l, &e->ray, &own), &odd);
        v->solid[i] = x;
        v->unsure |= bits & m8_bits(odd);
        bits &= m8_bits(m8_and(x.met, r8_lt(e->t_min, r8_add(x.out, x.out_e))));
        const struct mask8 later = r8_lt(v->in, x.in);
        v->in = r8_select(later, x.in, v->in);
        v->in_e = r8_select(later, x.in_e, v->in_e);
        v->at = r8_select(later, r8_set(2. * (leaf - v->first_leaf)), v->at);
        v->out = r8_min(x.out, v->out);
    }
    bits &= m8_bits(m8_and(r8_le(v->in, v->out), r8_le(v->in, r8_load(e->p->t))));
    v->unsure |= bits & m8_bits(r8_le(v->out, e->t_min));
    const struct mask8 within = r8_le(v->in, e->t_min);
    v->in = r8_select(within, e->t_min, v->in);
    v->in_e = r8_select(within, r8_set(0), v->in_e);
    v->at = r8_select(within, r8_set(-1), v->at);
    return bits & ~v->unsure;
}

struct sponge_box {
    float lo[3], hi[3];
};

enum { SPONGE_APART = 16 }; // points further apart than this share of the tree part ways

// The box around the points reached by `bits`, grown as in stab.c; false: it is so large
// that the lanes had better look around one by one.
LANES_INLINE bool sponge_look(const struct eight *e, const struct sponge *v,
                              unsigned bits, struct sponge_box *box)
{
    const struct bvh8 *tree = &v->large->leaves;
    const double extent =
        larger(vec3_max_abs(tree->bounds.min), vec3_max_abs(tree->bounds.max));
    const struct real8 reach =
        r8_add(r8_mul(r8_set(0x1p-20), r8_add(e->ray.o_max, r8_set(extent))),
               r8_mul(r8_add(v->in_e, v->in_e), v8_max_abs(e->ray.d)));
    const struct vec8 p = v8_sub(v8_mad(e->ray.o, v->in, e->ray.d), V8_SET(tree->origin));
    const struct mask8 m = m8_of(bits);
    const struct real8 none = r8_set(INFINITY);
    double size = 0, whole = 0;
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct real8 c = a == 0 ? p.x : a == 1 ? p.y : p.z;
        float lo[8], hi[8], other;
        r8_store_floats(lo, r8_select(m, r8_sub(c, reach), none));
        r8_store_floats(hi, r8_select(m, r8_add(c, reach), r8_neg(none)));
        f8_range(f8_load(lo), &box->lo[a], &other);
        f8_range(f8_load(hi), &other, &box->hi[a]);
        const double side =
            vec3_axis(tree->bounds.max, a) - vec3_axis(tree->bounds.min, a);
        const double length = (double)box->hi[a] - box->lo[a];
        size = length > size ? length : size;
        whole = side > whole ? side : whole;
    }
    return size * SPONGE_APART < whole;
}

// Where lanes move to, and those that cannot be told.
struct sponge_move {
    struct real8 in, e, at;
    struct mask8 unclear;
};

// Items of the tree that may be near the points reached.
static void sponge_items(struct eight *e, const struct sponge *v, unsigned bits,
                         uint32_t first, uint32_t count, struct sponge_move *next)
{
    const struct bvh8 *tree = &v->large->leaves;
    for (uint32_t i = first; i < first + count; i++) {
        const struct accel_ball *b = &v->large->ball[i];
        const struct sphere ball = {.centre = b->centre, .radius = b->radius};
        if (!(ball.radius > 0))
            continue;
        e->p->s->stats.leaf_tests++;
        const struct span8 x = span8_sphere(&ball, &e->ray);
        if (!(m8_bits(x.met) & bits))
            continue;
        const double at = 2. * (tree->item[i] - v->first_leaf);
        const struct mask8 unclear =
            m8_or(unclear8(v, x.in, x.in_e, at), unclear8(v, x.out, x.out_e, at + 1));
        next->unclear = m8_or(next->unclear, m8_and(x.met, unclear));
        const struct mask8 in =
            m8_and(m8_and(x.met, r8_lt(x.in, v->in)), r8_lt(next->in, x.out));
        next->in = r8_select(in, x.out, next->in);
        next->e = r8_select(in, x.out_e, next->e);
        next->at = r8_select(in, r8_set(at + 1), next->at);
    }
}

// The children of a node that touch the box.
LANES_INLINE unsigned sponge_touched(const struct bvh8_node *n,
                                     const struct sponge_box *box)
{
    unsigned bits = 255;
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++)
        bits &= f8_le(f8_set(box->lo[a]), f8_load(n->box[3 + a])) &
                f8_le(f8_load(n->box[a]), f8_set(box->hi[a]));
    return bits;
}

// Looks at the spheres near the points reached: lanes in one move to its end. Returns the
// lanes that moved.
static unsigned sponge_round(struct eight *e, struct sponge *v, unsigned bits,
                             const struct sponge_box *box)
{
    const struct bvh8 *tree = &v->large->leaves;
    struct sponge_move next = {v->in, v->in_e, v->at, m8_of(0)};
    for (uint32_t i = 0; i < v->large->required_count; i++) {
        const struct span8 *x = &v->solid[i];
        const double at = 2. * (v->large->required[i] - v->first_leaf);
        next.unclear = m8_or(next.unclear, unclear8(v, x->in, x->in_e, at));
        next.unclear = m8_or(next.unclear, unclear8(v, x->out, x->out_e, at + 1));
    }
    int32_t stack[BVH8_STACK];
    uint32_t depth = tree->node != NULL;
    stack[0] = 0;
    while (depth) {
        const int32_t child = stack[--depth];
        if (child < 0) {
            sponge_items(e, v, bits, bvh8_leaf_first(child), bvh8_leaf_count(child),
                         &next);
            continue;
        }
        const struct bvh8_node *n = &tree->node[child];
        e->p->s->stats.node_visits++;
        for (unsigned some = sponge_touched(n, box); some; some &= some - 1)
            stack[depth++] = n->child[__builtin_ctz(some)];
    }
    v->unsure |= bits & m8_bits(next.unclear);
    const struct mask8 moved = m8_and(r8_lt(v->in, next.in), m8_of(bits & ~v->unsure));
    v->in = r8_select(moved, next.in, v->in);
    v->in_e = r8_select(moved, next.e, v->in_e);
    v->at = r8_select(moved, next.at, v->at);
    return m8_bits(moved);
}

static unsigned sponge(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct world *w = p->w;
    const struct world_object *o = &w->object[object];
    struct sponge v; // what is not set here, sponge_solids sets
    v.large = accel_large(w->accel, o, object);
    v.first_leaf = o->first_leaf;
    v.unsure = 0;
    bits &= box_lanes(e, &o->bounds);
    if (!bits)
        return 0;
    p->s->stats.csg_tests++;
    bits = sponge_solids(e, &v, bits);
    for (unsigned moving = bits; moving;) {
        struct sponge_box box;
        if (!sponge_look(e, &v, moving, &box)) {
            v.unsure |= moving;
            break;
        }
        moving = sponge_round(e, &v, moving, &box);
        const unsigned gone =
            moving & ~m8_bits(m8_and(r8_le(v.in, r8_load(p->t)), r8_le(v.in, v.out)));
        moving &= ~gone;
        bits &= ~gone;
    }
    bits &= ~v.unsure;
    v.unsure |= bits & m8_bits(m8_or(r8_lt(v.at, r8_set(0)),
                                     r8_le(r8_abs(r8_sub(v.in, e->t_max)), v.in_e)));
    const unsigned won = take_leaves(e, bits & ~v.unsure, v.in, v.at, object);
    return v.unsure ? won | packet_try_object(p, v.unsure, object) : won;
}

#endif
