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
#include "math/isa.h"
#include "scene/shapes/superellipsoid.h"
#include "trace/packet_carve.h"

enum {
    CSG_SPANS = 64, // of all leaves
    LEAF_SPANS = 4  // of a shape whose crossings are made ray by ray
};

struct csg8 {
    struct eight *e;
    const struct world_object *o;
    const struct csg_node *node; // of the object, by index from its root
    struct real8 in[CSG_SPANS], out[CSG_SPANS];
    uint8_t in_drawn[CSG_SPANS], out_drawn[CSG_SPANS]; // lanes
    uint8_t leaf[CSG_SPANS];                           // from the object's first
    uint8_t first[CSG_LEAVES], count[CSG_LEAVES];      // the spans of a leaf
    uint8_t turned[CSG_LEAVES]; // lanes that are in the leaf outside of its spans
    // Of spans that are `kept`, in each lane: where scratch has the boundaries.
    uint32_t begins[CSG_SPANS][8], ends[CSG_SPANS][8];
    uint64_t kept;
    uint32_t spans;
    uint64_t live;              // nodes that may not be as they are far from all leaves
    struct real8 from, to;      // what begins or ends elsewhere is of no interest
    struct real8 margin;        // within which of the stretch something still may be
    struct real8 bounds;        // the sum of all error bounds
    struct real8 slack;         // no more than `margin`, else the lane is unsure
    struct real8 before, after; // the stretch within `slack` of the crossing at hand
    unsigned lanes, unsure;
    const struct transform *space; // of the rays in `own`; NULL: of none
    struct ray8 own;
    struct made_crossings made;
};

// ---- states ---------------------------------------------------------------------------------

// Lanes where the leaf may be inside, or outside, on the stretch at hand.
static unsigned csg8_leaf_may(const struct csg8 *v, uint32_t i, bool inside)
{
    const unsigned turned = v->turned[i];
    unsigned held = 0, clear = 0; // may be in a span; is in one all along
    for (uint32_t k = v->first[i]; k < (uint32_t)v->first[i] + v->count[i]; k++) {
        held |= m8_bits(m8_and(r8_le(v->in[k], v->after), r8_le(v->before, v->out[k])));
        clear |= m8_bits(m8_and(r8_lt(v->in[k], v->before), r8_lt(v->after, v->out[k])));
    }
    return inside ? (held & ~turned) | (~clear & turned)
                  : (~clear & ~turned) | (held & turned);
}

// The same of a node, by index from the root; of `lanes`.
static unsigned csg8_may(const struct csg8 *v, uint32_t n, bool inside, unsigned lanes)
{
    const struct csg_node *node = &v->node[n];
    if (!(v->live >> n & 1))
        return node_is_inside(node, node->base_inside) == inside ? lanes : 0;
    if (node->op == NODE_LEAF)
        return lanes & csg8_leaf_may(v, node->leaf - v->o->first_leaf, inside);
    const uint32_t first = node->first_child - v->o->root;
    const bool all = (node->op == NODE_INTERSECTION) == inside;
    unsigned left = lanes;
    for (uint32_t c = first; c < first + node->child_count && left; c++) {
        const unsigned may = csg8_may(v, c, inside, left);
        left = all ? may : left & ~may;
    }
    return all ? left : lanes & ~left;
}

// Lanes where a crossing of leaf i may be a surface.
static unsigned csg8_shows(const struct csg8 *v, uint32_t i, unsigned lanes)
{
    const uint32_t root = v->o->root;
    uint32_t n = v->e->p->w->leaf[v->o->first_leaf + i].node - root;
    while (n && lanes) {
        const uint32_t up = v->node[n].parent - root;
        const struct csg_node *node = &v->node[up];
        const uint32_t first = node->first_child - root;
        if (node->op != NODE_UNION)
            for (uint32_t c = first; c < first + node->child_count && lanes; c++)
                if (c != n)
                    lanes = csg8_may(v, c, node->op == NODE_INTERSECTION, lanes);
        n = up;
    }
    return lanes;
}

// ---- spans ----------------------------------------------------------------------------------

// The rays as a leaf's shape sees them; those of the last space are kept.
static const struct ray8 *csg8_ray(struct csg8 *v, const struct leaf *l)
{
    if (l->transform->identity)
        return &v->e->ray;
    if (l->transform != v->space)
        v->own = local_ray(l->transform, &v->e->ray);
    v->space = l->transform;
    return &v->own;
}

// Lanes that may be in the leaf's box where that matters.
static unsigned csg8_boxed(const struct csg8 *v, const struct leaf *l, unsigned lanes)
{
    if (!lanes || !aabb_is_finite(l->bounds))
        return lanes;
    return lanes & box_lanes_to(v->e, &l->bounds,
                                r8_add(v->to, r8_mul(r8_set(0x1p20), v->margin)));
}

static void csg8_begin_leaf(struct csg8 *v, uint32_t i)
{
    v->first[i] = (uint8_t)v->spans;
    v->count[i] = 0;
    v->turned[i] = v->e->p->w->leaf[v->o->first_leaf + i].inverted ? 255 : 0;
}

// Its state may be another than far from all leaves.
static void csg8_live(struct csg8 *v, uint32_t i)
{
    const uint32_t root = v->o->root;
    uint32_t n = v->e->p->w->leaf[v->o->first_leaf + i].node - root;
    for (; !(v->live >> n & 1); n = v->node[n].parent - root)
        v->live |= (uint64_t)1 << n;
}

static void csg8_turn(struct csg8 *v, uint32_t i, unsigned lanes)
{
    v->turned[i] ^= (uint8_t)lanes;
    if (lanes)
        csg8_live(v, i);
}

// A span of leaf i, the last begun.
static void csg8_span(struct csg8 *v, uint32_t i, const struct span8 *x,
                      unsigned in_drawn, unsigned out_drawn)
{
    const struct real8 error = r8_add(x->in_e, x->out_e);
    const struct mask8 behind = r8_lt(r8_add(x->out, error), v->from),
                       beyond = r8_lt(v->to, r8_sub(x->in, error)); // not if no number
    const struct mask8 met =
        m8_without(m8_and(x->met, m8_of(v->lanes)), m8_or(behind, beyond));
    if (!m8_bits(met))
        return;
    if (v->spans == CSG_SPANS) {
        v->unsure |= m8_bits(met);
        return;
    }
    const uint32_t k = v->spans++;
    v->count[i]++;
    v->leaf[k] = (uint8_t)i;
    v->in[k] = r8_select(met, x->in, r8_set(INFINITY));
    v->out[k] = r8_select(met, x->out, r8_set(-INFINITY));
    v->in_drawn[k] = (uint8_t)in_drawn;
    v->out_drawn[k] = (uint8_t)out_drawn;
    v->bounds = r8_add(v->bounds, r8_select(met, error, r8_set(0)));
    csg8_live(v, i);
}

// A convex shape.
static void csg8_convex(struct csg8 *v, uint32_t i, enum packet_shape shape,
                        const struct ray8 *ray)
{
    const struct leaf *l = &v->e->p->w->leaf[v->o->first_leaf + i];
    const unsigned drawn = l->drawn ? 255 : 0;
    struct mask8 odd;
    const struct span8 x = leaf_span(v->e, l, shape, ray, &odd);
    v->unsure |= v->lanes & m8_bits(odd);
    if (shape == PACKET_PLANE)
        v->unsure |= v->lanes & ~m8_bits(x.met); // beside it or all the way in it
    csg8_span(v, i, &x, drawn, drawn);
}

// A quadric: lines may be inside but for their span, or all the way.
static void csg8_quadric(struct csg8 *v, uint32_t i, const struct ray8 *ray)
{
    const struct leaf *l = &v->e->p->w->leaf[v->o->first_leaf + i];
    const struct quadric *s = l->shape;
    const unsigned drawn = l->drawn ? 255 : 0;
    const struct cross8 c = cross8_quadric(s, ray);
    struct span8 x = {.in = c.t[0], .out = c.t[1], .in_e = c.dt[0], .out_e = c.dt[1]};
    unsigned turned = m8_bits(c.met) & ~m8_bits(c.enters);
    x.met = c.met;
    if (!l->transform->identity) {
        x.in_e = moved8(l, &v->e->ray, ray, x.in, x.in_e);
        x.out_e = moved8(l, &v->e->ray, ray, x.out, x.out_e);
    }
    if (!l->bounded && (m8_bits(c.met) & v->lanes) != v->lanes) {
        const struct real8 at_o = quadric8_value(s, v8_sub(ray->o, V8_SET(s->centre)));
        turned |= m8_bits(r8_le(at_o, r8_set(0))) & ~m8_bits(c.met);
    }
    v->unsure |= v->lanes & m8_bits(c.odd);
    csg8_turn(v, i, turned);
    csg8_span(v, i, &x, drawn, drawn);
}

static void csg8_ring(struct csg8 *v, uint32_t i, const struct ray8 *ray)
{
    const struct leaf *l = &v->e->p->w->leaf[v->o->first_leaf + i];
    const unsigned drawn = l->drawn ? 255 : 0;
    struct cross8 c[2];
    c[1] = cross8_none();
    c[0] = cross8_tube(l->shape, ray, r8_set(0), &c[1]);
    v->unsure |= v->lanes & m8_bits(c[0].odd);
    for (int k = 0; k < 2 && m8_bits(c[k].met); k++) {
        const struct span8 x = {
            .in = c[k].t[0],
            .out = c[k].t[1],
            .in_e = torus_error(l, &v->e->ray, ray, c[k].t[0], c[k].dt[0]),
            .out_e = torus_error(l, &v->e->ray, ray, c[k].t[1], c[k].dt[1]),
            .met = c[k].met};
        csg8_span(v, i, &x, drawn, drawn);
    }
}

// The spans of one leaf's lanes, made ray by ray.
struct lane_spans {
    double in[LEAF_SPANS][8], out[LEAF_SPANS][8], in_e[LEAF_SPANS][8],
        out_e[LEAF_SPANS][8];
    uint32_t begins[LEAF_SPANS][8], ends[LEAF_SPANS][8];
    uint8_t met[LEAF_SPANS], in_drawn[LEAF_SPANS], out_drawn[LEAF_SPANS];
};

// The spans between the crossings of one lane, those in the list from `from` on; false: they
// do not take turns, or are many.
static bool lane_spans_add(struct lane_spans *x, int lane, bool inverted,
                           const struct boundary_list *list, uint32_t from)
{
    const uint8_t bit = (uint8_t)(1u << lane);
    uint32_t n = 0;
    bool within = false;
    for (uint32_t k = from; k < list->count; k++) {
        const struct boundary *b = &list->at[k];
        const bool enters = (b->crossing == CROSS_ENTER) != inverted;
        if (b->crossing == CROSS_TOUCH || (k > from && enters == within) ||
            n == LEAF_SPANS)
            return false;
        if (enters || k == from) {
            x->met[n] |= bit;
            x->begins[n][lane] = k;
            x->in[n][lane] = enters ? b->t : -INFINITY;
            x->in_e[n][lane] = enters ? b->dt : 0;
            x->in_drawn[n] |= b->drawn ? bit : 0;
            x->out[n][lane] = INFINITY;
            x->out_e[n][lane] = 0;
        }
        if (!enters) {
            x->ends[n][lane] = k;
            x->out[n][lane] = b->t;
            x->out_e[n][lane] = b->dt;
            x->out_drawn[n++] |= b->drawn ? bit : 0;
        }
        within = enters;
    }
    return true;
}

// Crossings that are found in lanes: those of a convex superellipsoid, and of shapes with a kernel
// for lines.
struct lane_ends {
    struct superellipsoid_ends ends;
    struct shape_lines lines;
    bool made; // the superellipsoid's
    unsigned met;
    unsigned told; // lanes whose `lines` are
};

static void lane_ends_find(struct lane_ends *x, struct csg8 *v, const struct leaf *l,
                           unsigned lanes)
{
    const struct eight *e = v->e;
    const bool some = lanes & (lanes - 1);
    x->told = 0;
    x->made = l->ops == &superellipsoid_ops && superellipsoid_is_convex(l->shape) && some;
    if (!x->made && !(l->ops->lines8 && some))
        return;
    struct shape_rays rays;
    const struct ray8 *ray = csg8_ray(v, l);
    v8_store(rays.o, ray->o);
    v8_store(rays.d, ray->d);
    r8_store(rays.t_min, e->t_min);
    r8_store(rays.t_max, e->t_max);
    if (x->made)
        x->met = OF_ISA(superellipsoid_ends8_)(l->shape, &rays, lanes, &x->ends);
    else
        x->told =
            l->ops->lines8(&OF_ISA(shape_kernels_), l->shape, &rays, lanes, &x->lines);
}

// leaf_crossings_in_csg of a lane.
static void lane_crossings(const struct lane_ends *x, const struct packet *p,
                           uint32_t leaf, const struct ray *ray, int lane)
{
    const uint32_t from = p->s->crossings.count;
    if (x->told >> lane & 1) {
        shape_lines_add(&x->lines, lane, &p->s->crossings);
        leaf_crossings_made(p->w, p->s, leaf, ray, from, NULL);
    } else if (!x->made) {
        leaf_crossings_in_csg(p->w, p->s, leaf, ray);
    } else if (x->met >> lane & 1) {
        const double slope[2] = {x->ends.slope[0][lane], x->ends.slope[1][lane]};
        superellipsoid_add_ends(&x->ends, lane, &p->s->crossings);
        leaf_crossings_made(p->w, p->s, leaf, ray, from, slope);
    }
}

// Any solid, in the lanes that meet its box.
static void csg8_other(struct csg8 *v, uint32_t i, unsigned lanes)
{
    struct packet *p = v->e->p;
    const uint32_t leaf = v->o->first_leaf + i;
    const struct leaf *l = &p->w->leaf[leaf];
    struct lane_spans x;
    struct lane_ends ends;
    lane_ends_find(&ends, v, l, lanes);
    v->made.lanes[i] = (uint8_t)lanes;
    for (int k = 0; k < LEAF_SPANS; k++)
        x.met[k] = x.in_drawn[k] = x.out_drawn[k] = 0;
    for (; lanes; lanes &= lanes - 1) {
        const int lane = __builtin_ctz(lanes);
        const struct ray ray = ray_of_lane(p, lane);
        const uint32_t from = p->s->crossings.count;
        lane_crossings(&ends, p, leaf, &ray, lane);
        v->made.from[i][lane] = from;
        v->made.to[i][lane] = p->s->crossings.count;
        p->s->stats.leaf_tests++;
        if (!lane_spans_add(&x, lane, l->inverted, &p->s->crossings, from))
            v->unsure |= 1u << lane;
        if (p->s->crossings.count == from && !l->bounded &&
            l->ops->inside(l->shape, transform_inverse_point(l->transform, ray.o)))
            csg8_turn(v, i, 1u << lane);
    }
    for (int k = 0; k < LEAF_SPANS && x.met[k]; k++) {
        const struct span8 s = {.in = r8_load(x.in[k]),
                                .out = r8_load(x.out[k]),
                                .in_e = r8_load(x.in_e[k]),
                                .out_e = r8_load(x.out_e[k]),
                                .met = m8_of(x.met[k])};
        const uint32_t at = v->spans;
        csg8_span(v, i, &s, x.in_drawn[k], x.out_drawn[k]);
        if (v->spans == at)
            continue;
        v->kept |= (uint64_t)1 << at;
        memcpy(v->begins[at], x.begins[k], sizeof x.begins[k]);
        memcpy(v->ends[at], x.ends[k], sizeof x.ends[k]);
    }
}

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

static unsigned csg8_first(struct csg8 *v, struct real8 *t, struct real8 *at)
{
    const struct eight *e = v->e;
    const struct world *w = e->p->w;
    const struct real8 limit = r8_load(e->p->t);
    unsigned found = 0;
    *t = e->t_max;
    *at = r8_set(0);
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
        aabb_is_finite(*b) ? fmax(vec3_max_abs(b->min), vec3_max_abs(b->max)) : 0;
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
    struct real8 t, at;
    unsigned found = v.spans && v.lanes ? csg8_first(&v, &t, &at) : 0;
    if (found)
        v.unsure |= found & csg8_near(&v, t, at);
    const unsigned won = csg8_take(&v, found & ~v.unsure, t, at, object);
    return v.unsure ? won | csg8_sweep(&v, object) : won;
}

#endif
