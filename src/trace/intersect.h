#ifndef TRACE_INTERSECT_H
#define TRACE_INTERSECT_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"
#include "scene/boundary.h"
#include "trace/world.h"

// Which objects a ray may see: OBJECT_NO_* bits that hide an object from it.
struct ray_query {
    struct ray ray;
    unsigned hidden_by; // OBJECT_NO_IMAGE, OBJECT_NO_REFLECTION, OBJECT_NO_SHADOW, 0
};

struct hit {
    struct boundary b; // b.leaf says which leaf; b.t == INFINITY: a miss
};

// Scratch memory of one thread: boundary lists, stacks. Not shared.
struct trace_scratch;
struct trace_scratch *trace_scratch_new(const struct world *w);
void trace_scratch_free(struct trace_scratch *s);

// Counters of a thread, added up for --stats.
struct trace_stats {
    uint64_t rays, shadow_rays, node_visits, leaf_tests, csg_tests;
    uint64_t evaluations; // of functions, to find surfaces
};
const struct trace_stats *trace_scratch_stats(struct trace_scratch *s);

// Rays in structure-of-arrays form, for packets. Capacity is a multiple of 8;
// entries past count are ignored. All arrays 64-byte aligned.
struct ray_batch {
    uint32_t count, capacity;
    double *o[3], *d[3], *t_min, *t_max;
    unsigned *hidden_by;
};
struct ray_batch *ray_batch_new(uint32_t capacity);
void ray_batch_free(struct ray_batch *b);

// Hits in structure-of-arrays form: the members of a boundary that is drawn, `part` as a
// number. Of misses only t is set. Arrays as those of ray_batch.
struct hit_batch {
    double *t, *dt, *part, *u, *v;
    uint32_t *leaf;
    uint8_t *crossing;
};
static inline struct ray ray_batch_at(const struct ray_batch *b, uint32_t i)
{
    return (struct ray){{b->o[0][i], b->o[1][i], b->o[2][i]},
                        {b->d[0][i], b->d[1][i], b->d[2][i]},
                        b->t_min[i],
                        b->t_max[i]};
}
// The same from its origin on without an end.
static inline struct ray ray_batch_line(const struct ray_batch *b, uint32_t i)
{
    struct ray r = ray_batch_at(b, i);
    r.t_min = 0;
    r.t_max = INFINITY;
    return r;
}

struct hit_batch *hit_batch_new(uint32_t capacity);
void hit_batch_free(struct hit_batch *b);
struct hit hit_batch_at(const struct hit_batch *b, uint32_t i);
// Sets all that hit_batch_at gives.
static inline void hit_batch_put(const struct hit_batch *b, uint32_t i,
                                 const struct boundary *x)
{
    b->t[i] = x->t;
    b->dt[i] = x->dt;
    b->part[i] = x->part;
    b->u[i] = x->u;
    b->v[i] = x->v;
    b->leaf[i] = x->leaf;
    b->crossing[i] = x->crossing;
}
// The nearest drawn boundary with t_min < t < t_max of each ray. Same bits for
// every ISA and for one ray at a time.
void trace_closest(const struct world *w, struct trace_scratch *s,
                   const struct ray_batch *rays, const struct hit_batch *out);
struct hit trace_closest_1(const struct world *w, struct trace_scratch *s,
                           const struct ray_query *q);

// out[i]: some OPAQUE surface lies on t_min < t < t_max of ray i. Surfaces that let
// light through are not seen; where world->has_transparent, the caller walks them
// with trace_closest_1.
void trace_occluded(const struct world *w, struct trace_scratch *s,
                    const struct ray_batch *rays, uint8_t *out);
bool trace_occluded_1(const struct world *w, struct trace_scratch *s,
                      const struct ray_query *q);
// As trace_occluded, by those of the first 64 objects alone that are `some` (bits): where
// it is known that no other one can lie on the rays.
void trace_occluded_by(const struct world *w, struct trace_scratch *s,
                       const struct ray_batch *rays, uint64_t some, uint8_t *out);

// Every top-level object (world_object index) that contains p; returns the count.
uint32_t trace_containing(const struct world *w, struct vec3 p, uint32_t *object,
                          uint32_t max);
// Those whose boxes meet the box, which is finite, at most `max`.
uint32_t trace_boxes_meet(const struct world *w, struct aabb box, uint32_t *object,
                          uint32_t max);
// Whether p is inside the world object.
bool world_object_inside(const struct world *w, uint32_t object, struct vec3 p);

// The surface point of a hit in world space. `error` bounds the distance from p to
// the true surface; a secondary ray starts at p moved by `error` along the
// geometric normal to its own side (trace_offset), so that no absolute epsilon is
// needed.
struct interaction {
    struct vec3 p;
    double error;
    struct vec3 ng, ns; // unit; inverted leaves already turned; not faced to the ray
    struct vec2 uv;
    const struct leaf *leaf;
    const struct surface *surface;
    struct boundary b; // of surfaces whose parts have textures
};
void trace_interaction(const struct world *w, const struct ray *ray,
                       const struct hit *hit, struct interaction *out);
// The origin for a ray that leaves the surface in direction d.
static inline struct vec3 trace_offset(const struct interaction *i, struct vec3 d)
{
    const double side = vec3_dot(d, i->ng) < 0 ? -1 : 1;
    return vec3_mad(i->p, 2 * side * i->error, i->ng);
}

#endif
