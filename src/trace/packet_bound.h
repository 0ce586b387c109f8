#ifndef TRACE_PACKET_BOUND_H
#define TRACE_PACKET_BOUND_H

// Eight rays and what bounded_by culls.
#include "math/lanes_vec.h"
#include "trace/packet_objects.h"
#include "trace/user_bounds.h"

static struct vec3 lane_of(struct vec8 v, int lane)
{
    double at[3][8];
    v8_store(at, v);
    return vec3(at[0][lane], at[1][lane], at[2][lane]);
}

// A sphere or a box: rays keep what they meet ahead or begin in.
static unsigned within_convex(const struct eight *e, unsigned bits,
                              const struct user_bound *b)
{
    struct ray8 own;
    const struct ray8 *ray = &e->ray;
    if (!b->transform.identity) {
        own = local_ray(&b->transform, ray);
        ray = &own;
    }
    const struct span8 x =
        b->ops == &box_ops ? span8_box(b->shape, ray) : span8_sphere(b->shape, ray);
    unsigned kept = bits & m8_bits(m8_and(x.met, r8_lt(r8_set(0), x.out)));
    for (unsigned m = bits & ~kept; m; m &= m - 1)
        if (b->ops->inside(b->shape, lane_of(ray->o, __builtin_ctz(m))))
            kept |= m & -m;
    return kept;
}

// The lanes of `bits` whose rays no bound culls, as culled() of trace/intersect.c.
static unsigned within_bounds(const struct eight *e, unsigned bits,
                              const struct world_object *o)
{
    for (uint32_t i = 0; i < o->bound_count && bits; i++) {
        const struct user_bound *b = &o->bound[i];
        bits &= box_lanes_to(e, &b->box, e->t_max);
        if (b->ops == &box_ops || b->ops == &sphere_ops) {
            bits = bits ? within_convex(e, bits, b) : 0;
            continue;
        }
        for (unsigned m = b->ops ? bits : 0; m; m &= m - 1) {
            const int lane = __builtin_ctz(m);
            const struct ray ray = {lane_of(e->ray.o, lane), lane_of(e->ray.d, lane), 0,
                                    0};
            if (user_bound_culls(b, &ray, &e->p->s->crossings))
                bits &= ~(m & -m);
        }
    }
    return bits;
}

#endif
