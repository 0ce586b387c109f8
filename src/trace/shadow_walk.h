#ifndef TRACE_SHADOW_WALK_H
#define TRACE_SHADOW_WALK_H

#include "trace/tracer.h"

struct shadow_request;

// Shadow rays among transparent things: those that nothing opaque stops go from surface to
// surface, each of which lets a part of the light through.

// Shadow rays end this much before a lamp: half of the digits of a double. A surface that
// the lamp lies on (a ceiling) is met within the rounding of its place, which the cosine
// divides, and throws no shadow on its own side at cosines down to about 2^-26.
static const double before_lamp = 1 - 0x1p-26;

// BATCH_SIZE of them, to be freed.
struct shadow_walk *shadow_walks_new(void);
// What the textures of a surface let through of light from d. caustics: of its interior, or 0.
struct rgb surface_filter(struct tracer *t, const struct interaction *at, struct vec3 d,
                          double caustics);
// The light that passes, with opaque objects known not to be in the way. air: fog and the
// like dim it.
struct rgb shadow_walk_alone(struct tracer *t, const struct shadow_request *r, bool air);
// The same for the first `count` rays of a batch that nothing opaque stops, into its `pass`.
// air_end[i]: where the lamp is, for rays that the air dims, or 0; NULL: none are.
void shadow_walk_batch(struct tracer *t, struct shadow_batch *b, uint32_t count,
                       const double *air_end);

#endif
