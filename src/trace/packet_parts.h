#ifndef TRACE_PACKET_PARTS_H
#define TRACE_PACKET_PARTS_H

// Eight rays and a product, part by part (trace/packet_quick.h).
#include "trace/packet_csg.h"
#include "trace/packet_quick.h"

// The span of a cone or a quadric: its own bounds tell whether it is clear.
static struct span8 quick_other(const struct eight *e, const struct quick *q,
                                const struct product_part *part, const struct ray8 *ray,
                                const struct leaf *l)
{
    struct mask8 odd;
    struct span8 x = leaf_span(e, l, part->kind, ray, &odd);
    x.clear = m8_and(quick_clear(q, &x), m8_without(m8_of(255), odd));
    return x;
}

// The same of a quadric that is no complement: lines that are inside but for the stretch
// between their crossings are inside all the way, and that stretch is like a complement.
static struct span8 quick_quadric(const struct eight *e, const struct quick *q,
                                  struct quick_spans *v, const struct product_part *part,
                                  const struct ray8 *ray, const struct leaf *l)
{
    const struct quadric *s = part->shape;
    const struct cross8 c = cross8_quadric(s, ray);
    const struct real8 at_o = quadric8_value(s, v8_sub(ray->o, V8_SET(s->centre)));
    struct mask8 odd = m8_or(c.odd, m8_without(r8_le(at_o, r8_set(0)), c.met));
    struct mask8 hollow = m8_without(c.met, c.enters);
    struct span8 x = {.in = c.t[0], .out = c.t[1], .in_e = c.dt[0], .out_e = c.dt[1]};
    if (!l->transform->identity) {
        x.in_e = moved8(l, &e->ray, ray, x.in, x.in_e);
        x.out_e = moved8(l, &e->ray, ray, x.out, x.out_e);
    }
    x.clear = quick_clear(q, &x);
    if (m8_bits(hollow) && v->hollows < QUICK_HOLLOWS) {
        x.met = hollow;
        v->hollow[v->hollows++] = (struct quick_hollow){x, part};
    } else {
        odd = m8_or(odd, hollow);
        hollow = m8_of(0);
    }
    const struct mask8 all = m8_or(odd, hollow);
    x.in = r8_select(all, r8_set(-INFINITY), x.in);
    x.out = r8_select(all, r8_set(INFINITY), x.out);
    x.met = m8_or(c.met, odd);
    x.clear = m8_without(m8_or(x.clear, hollow), odd);
    return x;
}

// The span of a part, seen by the rays of its space.
LANES_INLINE struct span8 part_span(const struct eight *e, const struct quick *q,
                                    const struct product_part *part,
                                    const struct ray8 *ray, uint32_t first_leaf,
                                    unsigned bits)
{
    switch (part->kind) {
    case PACKET_SPHERE: return quick_sphere(part, ray, bits);
    case PACKET_BOX:
        return quick_box(part->shape, ray, ray == &e->ray ? &e->inverse : NULL);
    case PACKET_CYLINDER: return quick_cylinder(part->shape, ray, bits);
    case PACKET_PLANE: return span8_plane(part->shape, ray);
    default: return quick_other(e, q, part, ray, &e->p->w->leaf[first_leaf + part->leaf]);
    }
}

// The same of a solid.
LANES_INLINE struct span8 solid_span(const struct eight *e, const struct quick *q,
                                     struct quick_spans *v,
                                     const struct product_part *part,
                                     const struct ray8 *ray, uint32_t first_leaf,
                                     unsigned bits)
{
    if (part->kind != PACKET_QUADRIC)
        return part_span(e, q, part, ray, first_leaf, bits);
    return quick_quadric(e, q, v, part, ray, &e->p->w->leaf[first_leaf + part->leaf]);
}

// The spans of the solids and of what matters of their complements; returns the lanes that
// may meet the object.
LANES_INLINE unsigned quick_parts(const struct eight *e, const struct accel_product *x,
                                  uint32_t first_leaf, unsigned bits, struct quick *q,
                                  struct quick_spans *v, struct ray8 own[PRODUCT_SPACES])
{
    const struct product_part *part = x->part;
    uint32_t i = 0;
    for (; i < x->world_solids && bits; i++) {
        const struct span8 s = solid_span(e, q, v, &part[i], &e->ray, first_leaf, bits);
        bits &= quick_solid(q, v, &part[i], &s);
    }
    for (uint32_t k = 0; k < x->spaces && bits; k++) {
        const struct leaf *l = &e->p->w->leaf[first_leaf + x->space[k]];
        own[k] = local_ray(l->transform, &e->ray);
        quick_moved(q, x, k + 1, l, &e->ray, &own[k]);
    }
    for (; i < x->solids && bits; i++) {
        const struct ray8 *ray = part[i].space ? &own[part[i].space - 1] : &e->ray;
        const struct span8 s = solid_span(e, q, v, &part[i], ray, first_leaf, bits);
        bits &= quick_solid(q, v, &part[i], &s);
    }
    if (bits)
        bits &= quick_solids_end(q, v, r8_load(e->p->t));
    for (uint32_t k = 0; k < v->hollows && bits; k++)
        quick_complement(q, v, v->hollow[k].part, bits, &v->hollow[k].span);
    for (; i < x->count && bits; i++) {
        const struct ray8 *ray = part[i].space ? &own[part[i].space - 1] : &e->ray;
        const struct span8 s = part_span(e, q, &part[i], ray, first_leaf, bits);
        quick_complement(q, v, &part[i], bits, &s);
    }
    return bits;
}

// A merge has the boundaries of what lies outside of it, which is a product.
static unsigned product_exact(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct world_object *o = &p->w->object[object];
    const bool merge = p->w->accel->object_shape[object] == PACKET_MERGE;
    struct product x;
    product_begin(&x, e->t_min, e->t_max);
    bits = exact_leaves(e, &x, false, merge, o, bits);
    product_solids_end(&x);
    bits = exact_leaves(e, &x, true, merge, o, bits);
    if (!bits)
        return 0;
    struct real8 t, at;
    unsigned unsure;
    const unsigned found = product_first(&x, bits, &t, &at, &unsure);
    const unsigned won = take_leaves(e, found, t, at, object);
    if (!unsure)
        return won;
    return won | (o->node_count > CSG_NODES ? packet_try_object(p, unsure, object)
                                            : csg8(e, unsure, object));
}

static unsigned merge8(struct eight *e, unsigned bits, uint32_t object)
{
    if (!e->boxed)
        bits &= box_lanes(e, &e->p->w->object[object].bounds);
    if (!bits)
        return 0;
    e->p->s->stats.csg_tests++;
    return product_exact(e, bits, object);
}

static unsigned product(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct world_object *o = &p->w->object[object];
    const struct accel_product *x = &p->w->accel->product[object];
    if (!e->boxed)
        bits &= box_lanes(e, &o->bounds);
    if (!bits)
        return 0;
    p->s->stats.csg_tests++;
    if (!x->part)
        return product_exact(e, bits, object);
    struct quick q;
    struct quick_spans v; // not set to zero: it is large
    struct ray8 own[PRODUCT_SPACES];
    v.count = v.hollows = 0;
    quick_begin(&q, e->t_min, e->t_max);
    quick_space(&q, x, 0, &e->ray, r8_set(0), r8_set(0));
    bits = quick_parts(e, x, o->first_leaf, bits, &q, &v, own);
    if (!bits)
        return 0;
    q.doubt = m8_or(q.doubt, quick_begins(&q, &v));
    struct real8 t, at;
    unsigned doubt;
    const unsigned found = quick_first(&q, &v, bits, &t, &at, &doubt);
    const unsigned won = take_leaves(e, found, t, at, object);
    return doubt ? won | product_exact(e, doubt, object) : won;
}

#endif
