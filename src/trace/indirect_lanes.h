#ifndef TRACE_INDIRECT_LANES_H
#define TRACE_INDIRECT_LANES_H

#include "trace/simple.h"

// Light by way of other surfaces for a group of eight hits, with the bits of shade_indirect.

// What asks on one side of a group's hits.
struct indirect_side {
    bool back;
    unsigned lanes;
    unsigned perturbed; // lanes where the group's n is not the surface's own
    struct rgb matt[8]; // what the lanes show of the light
    double n[3][8];     // of the first matt layer, towards the ray
};

// A lane whose matt part is not black.
static inline void indirect_side_add(struct indirect_side *s, int i, struct rgb matt,
                                     struct vec3 n)
{
    if (rgb_max(matt) <= 0)
        return;
    s->lanes |= 1u << i;
    s->matt[i] = matt;
    s->n[0][i] = n.x, s->n[1][i] = n.y, s->n[2][i] = n.z;
}
// Adds the light to the slots.
void indirect_side_light(struct tracer *t, const struct simple_group *g,
                         const struct indirect_side *side);
// The light in front of the hits of a group whose n is the surface's own, for a picture,
// where it is known and queries ask with that normal; returns those lanes.
unsigned indirect_known(struct tracer *t, const struct simple_group *g,
                        struct rgb light[8]);
// The hits whose light nobody looks at that ask with that normal and would be answered without a ray.
unsigned indirect_settled(struct tracer *t, const struct simple_group *g);
// What a hit asks, whose n is the surface's own, kept until it is the ray's turn.
struct indirect_kept {
    bool any;
    struct vec3 p, ng, ns; // as in interaction
    double error;
    struct rgb matt[2]; // in front and behind; black: nothing is asked
    struct vec3 n[2];
};
// Keeps it by ray.
void indirect_keep(const struct simple_group *g, const struct indirect_side *side,
                   struct indirect_kept *kept);
void indirect_ask_kept(struct tracer *t, uint32_t k, const struct indirect_kept *kept);
// The surface's own normal where ray k of the batch meets it, towards the ray.
struct vec3 bare_normal(const struct tracer *t, uint32_t k);
// Adds the light of one hit, that of ray k of the batch; n: of the layer, NULL: the surface's own.
void indirect_ask(struct tracer *t, uint32_t k, struct rgb matt, const struct vec3 *n,
                  bool back);

#endif
