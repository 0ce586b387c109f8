#ifndef TRACE_AREA_H
#define TRACE_AREA_H

#include "trace/shade.h"

// Grid point (u, v) of an area light, jittered by the hash.
struct vec3 area_point(const struct lamp *lamp, const struct lamp_grid *grid,
                       uint32_t hash, int u, int v);
// How much of an area light reaches the request's place (spec/lighting.md 8.4).
struct rgb area_shadow(const struct shading *s, const struct lamp *lamp,
                       const struct shadow_request *r);
// The same for light that shines through an object (spec/lighting.md 8.5).
struct rgb projected_shadow(struct tracer *t, const struct lamp *lamp,
                            const struct shadow_request *r);

#endif
