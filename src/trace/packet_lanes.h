#ifndef TRACE_PACKET_LANES_H
#define TRACE_PACKET_LANES_H

// Eight rays and an object whose shape takes eight rays itself (shape_ops.closest8).
#include "scene/shape_kernels.h"
#include "trace/packet_objects.h"

static unsigned lanes8(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const uint32_t leaf = p->w->object[object].first_leaf;
    const struct leaf *l = &p->w->leaf[leaf];
    struct ray8 own;
    const struct ray8 *ray = leaf_ray(l, &e->ray, &own);
    struct shape_rays rays;
    struct shape_hits hits;
    r8_store(rays.o[0], ray->o.x);
    r8_store(rays.o[1], ray->o.y);
    r8_store(rays.o[2], ray->o.z);
    r8_store(rays.d[0], ray->d.x);
    r8_store(rays.d[1], ray->d.y);
    r8_store(rays.d[2], ray->d.z);
    r8_store(rays.t_min, e->t_min);
    r8_store(rays.t_max, r8_min(e->t_max, r8_load(p->t)));
    hits.evaluations = 0;
    hits.cancel = p->s->crossings.cancel;
    hits.cut = false;
    p->s->stats.leaf_tests += (unsigned)__builtin_popcount(bits);
    const unsigned met = l->ops->closest8(p->w->accel->kernels->shapes, l->shape, &rays,
                                          bits, p->mode == SWEEP_OPAQUE, &hits);
    p->s->crossings.evaluations += hits.evaluations;
    p->s->crossings.cut |= hits.cut;
    const unsigned won = met ? take(e, met, r8_load(hits.t), object, leaf) : 0;
    p->whole |= won;
    for (unsigned m = won; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        p->dt[i] = hits.dt[i];
        p->u[i] = hits.u[i];
        p->v[i] = hits.v[i];
        p->part[i] = hits.part[i];
        p->crossing[i] = crossing_of_leaf(hits.crossing[i], l->inverted);
    }
    return won;
}

#endif
