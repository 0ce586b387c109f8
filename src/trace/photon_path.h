#ifndef TRACE_PHOTON_PATH_H
#define TRACE_PHOTON_PATH_H

#include "trace/photons.h"

// A lamp, or a point of an area light, that shoots at an object.
struct photon_gun {
    const struct lamp *lamp;
    uint32_t object; // of the world
    struct vec3 from;
    double spread; // how far rays are apart, at distance 1; parallel light: anywhere
    float share;   // of the lamp's light
};

struct photon_shot {
    struct vec3 o, d;
    uint32_t hash;
};

// What is needed to follow photons.
struct photon_flight;
struct photon_flight *photon_flight_new(const struct job *job);
void photon_flight_free(struct photon_flight *f);
// Follows rays of the gun and all that comes of them, and adds the photons that they leave to
// `to`: those of the first ray, then of the second ... How many met the target. *cancel, which
// may be NULL, ends it early.
uint32_t photon_fly(struct photon_flight *f, const struct photon_gun *gun,
                    const struct photon_shot *shot, uint32_t count,
                    const volatile bool *cancel, struct photons *to);

#endif
