#ifndef TRACE_RAY_SHAFT_H
#define TRACE_RAY_SHAFT_H

// What may lie between a few places and a lamp (shaft culling: Haines and Wallace, "Shaft
// culling for efficient ray-cast radiosity", 1991).
#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#include "trace/world.h"

// All ways from the origins of some rays, of which `from` holds all, to the points of a box.
struct ray_shaft {
    const double *origin[3];
    uint32_t count; // of origins, a multiple of eight
    unsigned hidden_by;
    struct aabb from, to;
};

enum { RAY_SHAFT_OBJECTS = 4 };

// Boxes of shafts lie nearer than this: nothing overflows in single precision. Where a lamp or a
// place is farther off, or nowhere, there is no shaft.
static const double ray_shaft_far = 1e30;

static inline bool ray_shaft_reaches(const struct aabb *b)
{
    return fabs(b->min.x) < ray_shaft_far && fabs(b->min.y) < ray_shaft_far &&
           fabs(b->min.z) < ray_shaft_far && fabs(b->max.x) < ray_shaft_far &&
           fabs(b->max.y) < ray_shaft_far && fabs(b->max.z) < ray_shaft_far;
}
#define RAY_SHAFT_MANY UINT32_MAX

// The objects that rays along such ways may meet, and their number, or RAY_SHAFT_MANY. Of an object
// that is not among them no test of a ray, however it rounds, finds a hit.
typedef uint32_t ray_shaft_function(const struct world *w, const struct ray_shaft *s,
                                    uint32_t object[RAY_SHAFT_OBJECTS]);

#endif
