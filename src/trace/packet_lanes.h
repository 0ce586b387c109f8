#ifndef TRACE_PACKET_LANES_H
#define TRACE_PACKET_LANES_H

// Eight rays and an object whose shape takes eight rays itself (shape_ops.closest8).
#include "math/lanes_vec.h"
#include "scene/shape_kernels.h"
#include "trace/packet_objects.h"

// The first crossings of a leaf, seen by the rays of its space, between t_min and t_max.
static unsigned leaf_closest8(struct packet *p, const struct leaf *l,
                              const struct ray8 *ray, struct real8 t_min,
                              struct real8 t_max, unsigned lanes, struct shape_hits *hits)
{
    struct shape_rays rays;
    v8_store(rays.o, ray->o);
    v8_store(rays.d, ray->d);
    r8_store(rays.t_min, t_min);
    r8_store(rays.t_max, t_max);
    hits->evaluations = 0;
    hits->cancel = p->s->crossings.cancel;
    hits->cut = false;
    p->s->stats.leaf_tests += (unsigned)__builtin_popcount(lanes);
    const unsigned met = l->ops->closest8(p->w->accel->kernels->shapes, l->shape, &rays,
                                          lanes, p->mode == SWEEP_OPAQUE, hits);
    p->s->crossings.evaluations += hits->evaluations;
    p->s->crossings.cut |= hits->cut;
    return met;
}

// Keeps the boundaries of the lanes that have won, in full.
static void keep_shape_hits(struct packet *p, const struct shape_hits *hits, unsigned won)
{
    p->whole |= won;
    for (unsigned m = won; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        p->dt[i] = hits->dt[i];
        p->u[i] = hits->u[i];
        p->v[i] = hits->v[i];
        p->part[i] = hits->part[i];
        p->crossing[i] =
            crossing_of_leaf(hits->crossing[i], p->w->leaf[p->leaf[i]].inverted);
    }
}

static unsigned lanes8(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const uint32_t leaf = p->w->object[object].first_leaf;
    const struct leaf *l = &p->w->leaf[leaf];
    struct ray8 own;
    const struct ray8 *ray = leaf_ray(l, &e->ray, &own);
    struct shape_hits hits;
    const unsigned met =
        leaf_closest8(p, l, ray, e->t_min, r8_min(e->t_max, r8_load(p->t)), bits, &hits);
    const unsigned won = met ? take(e, met, r8_load(hits.t), object, leaf) : 0;
    keep_shape_hits(p, &hits, won);
    return won;
}

#endif
