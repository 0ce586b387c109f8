#ifndef TRACE_AREA_H
#define TRACE_AREA_H

#include "trace/shade.h"

// Grid point (u, v) of an area light, jittered by the hash.
struct vec3 area_point(const struct lamp *lamp, const struct lamp_grid *grid,
                       uint32_t hash, int u, int v);
// A place that an area light may shine on.
struct area_request {
    const struct lamp *lamp;
    struct shadow_request shadow; // to the middle of the lamp
    struct interaction at;        // its p, error and ng: where rays to the others begin
    uint32_t hash;
};

// How much of the light reaches the place (spec/lighting.md 8.4).
struct rgb area_shadow(struct tracer *t, const struct area_request *r);
// The same later, together with other places: then the request's value is added to its slot.
void area_add(struct tracer *t, const struct area_request *r);
// Answers what waits.
void area_flush(struct tracer *t);
void area_init(struct tracer *t);
void area_end(struct tracer *t);
// How much reaches a place of light that shines through an object (spec/lighting.md 8.5).
struct rgb projected_shadow(struct tracer *t, const struct lamp *lamp,
                            const struct shadow_request *r);

#endif
