#ifndef TRACE_PACKET_LANES_H
#define TRACE_PACKET_LANES_H

// Eight rays and an object whose shape takes eight rays itself (shape_ops.closest8).
#include "scene/shape_kernels.h"
#include "trace/carve.h"
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

static struct ray ray_of_lane(const struct packet *p, int lane)
{
    const struct ray_batch *r = p->rays;
    const uint32_t i = p->first + (uint32_t)lane;
    return (struct ray){vec3(r->o[0][i], r->o[1][i], r->o[2][i]),
                        vec3(r->d[0][i], r->d[1][i], r->d[2][i]), r->t_min[i],
                        r->t_max[i]};
}

// The same where simple solids cut something off the shape.
static unsigned carved8(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct world_object *o = &p->w->object[object];
    struct ray ray[8];
    struct carve_hits hits;
    double t[8] = {0};
    if (!e->boxed)
        bits &= box_lanes(e, &o->bounds);
    if (!bits)
        return 0;
    for (int i = 0; i < 8; i++)
        ray[i] = ray_of_lane(p, i);
    const unsigned met = carve(p->w, p->s, object, ray, p->t, bits, p->mode, &hits);
    for (unsigned m = met; m; m &= m - 1)
        t[__builtin_ctz(m)] = hits.b[__builtin_ctz(m)].t;
    const unsigned won = met ? take(e, met, r8_load(t), object, o->first_leaf) : 0;
    p->whole |= won;
    for (unsigned m = won; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        const struct boundary *b = &hits.b[i];
        p->leaf[i] = b->leaf;
        p->dt[i] = b->dt;
        p->u[i] = b->u;
        p->v[i] = b->v;
        p->part[i] = b->part;
        p->crossing[i] = b->crossing;
    }
    return hits.unsure ? won | packet_try_object(p, hits.unsure, object) : won;
}

#endif
