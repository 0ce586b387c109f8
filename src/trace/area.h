#ifndef TRACE_AREA_H
#define TRACE_AREA_H

#include "trace/shade.h"

// Grid point (u, v) of an area light, jittered by the hash.
struct vec3 area_point(const struct lamp *lamp, const struct lamp_grid *grid,
                       uint32_t hash, int u, int v);
// What seeds the points by which area_illumination lights, as others than those that
// shadows are looked for from.
static inline uint32_t area_lit_hash(uint32_t hash) { return hash ^ 0x5bd1e995u; }
// A place that an area light may shine on.
struct area_request {
    const struct lamp *lamp;
    struct vec3 p, ng; // as in interaction, as is error: where rays to the lamp begin
    double error;
    struct rgb value; // what is added to the slot of what comes of the lamp
    uint32_t slot, hash;
    uint8_t photons; // photons_instead
};

// How much of the light of one lamp reaches the places (spec/lighting.md 8.4).
void area_shadows(struct tracer *t, const struct area_request *const *r, uint32_t count,
                  struct rgb *out);
// The same later, together with other places: then the request's value is added to its slot.
void area_add(struct tracer *t, const struct area_request *r);
// Answers what waits.
void area_flush(struct tracer *t);
void area_init(struct tracer *t);
void area_end(struct tracer *t);

#endif
