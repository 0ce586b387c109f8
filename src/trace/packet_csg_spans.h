#ifndef TRACE_PACKET_CSG_SPANS_H
#define TRACE_PACKET_CSG_SPANS_H

// Eight rays and CSG (packet_csg.h): the lines' spans in a leaf, and what they say of nodes.
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

#endif
