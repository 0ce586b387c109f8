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

// The spans in the shapes that packets know; odd: lanes that user_bound_culls has to tell, all
// where they do not know the shape.
static struct span8 bound_span(const struct user_bound *b, const struct ray8 *ray,
                               struct mask8 *odd)
{
    *odd = m8_of(0);
    if (b->ops == &sphere_ops)
        return span8_sphere(b->shape, ray);
    if (b->ops == &box_ops)
        return span8_box(b->shape, ray);
    if (b->ops == &plane_ops)
        return span8_plane(b->shape, ray);
    if (b->ops == &quadric_ops)
        return span8_quadric(b->shape, ray, odd);
    *odd = m8_of(255);
    return (struct span8){.met = m8_of(0)};
}

// Rays keep what they meet ahead or begin in.
static unsigned within_shape(const struct eight *e, unsigned bits,
                             const struct user_bound *b)
{
    struct ray8 own;
    const struct ray8 *ray = &e->ray;
    if (!b->transform.identity) {
        own = local_ray(&b->transform, ray);
        ray = &own;
    }
    struct mask8 odd;
    const struct span8 x = bound_span(b, ray, &odd);
    // A half space is met where it ends, or else begins.
    const struct real8 last = b->ops == &plane_ops
                                  ? r8_select(r8_lt(x.out, r8_set(INFINITY)), x.out, x.in)
                                  : x.out;
    const unsigned ahead =
        bits & m8_bits(m8_without(m8_and(x.met, r8_lt(r8_set(0), last)), odd));
    unsigned kept = ahead;
    for (unsigned m = bits & ~ahead; m; m &= m - 1) {
        const int lane = __builtin_ctz(m);
        const struct ray r = {lane_of(e->ray.o, lane), lane_of(e->ray.d, lane), 0, 0};
        const bool culls =
            m8_bits(odd) >> lane & 1
                ? user_bound_culls(b, &r, &e->p->s->crossings)
                : !b->ops->inside(b->shape, transform_inverse_point(&b->transform, r.o));
        kept |= culls ? 0 : m & -m;
    }
    return kept;
}

// The lanes of `bits` whose rays no bound culls, as culled() of trace/intersect.c.
static unsigned within_bounds(const struct eight *e, unsigned bits,
                              const struct world_object *o)
{
    for (uint32_t i = 0; i < o->bound_count && bits; i++) {
        const struct user_bound *b = &o->bound[i];
        bits &= box_lanes_to(e, &b->box, e->t_max);
        if (b->ops && bits)
            bits = within_shape(e, bits, b);
    }
    return bits;
}

#endif
