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

// What is needed to follow photons.
struct photon_flight;
struct photon_flight *photon_flight_new(const struct job *job, struct photons *to);
void photon_flight_free(struct photon_flight *f);
// Follows a ray of the gun and all that comes of it. Whether it met the target.
bool photon_fly(struct photon_flight *f, const struct photon_gun *gun, struct vec3 o,
                struct vec3 d, uint32_t hash);

#endif
