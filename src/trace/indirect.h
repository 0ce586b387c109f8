#ifndef TRACE_INDIRECT_H
#define TRACE_INDIRECT_H

#include <stdint.h>

#include "math/color.h"
#include "trace/intersect.h"

struct tracer;

// Light that reaches surfaces by way of others, worked out before the picture.
struct indirect {
    const void *data; // NULL: there is none
    // Irradiance at a hit on the side of n, unit, in units in which a matt white surface
    // shows it as its colour. May trace with the tracer's scratch.
    struct rgb (*irradiance)(const void *data, struct tracer *t, const struct ray *ray,
                             const struct hit *hit, const struct interaction *at,
                             struct vec3 n, uint32_t hash);
};

#endif
