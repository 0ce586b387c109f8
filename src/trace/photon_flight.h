#ifndef TRACE_PHOTON_FLIGHT_H
#define TRACE_PHOTON_FLIGHT_H

#include "trace/media_march.h"
#include "trace/photon_path.h"

// Between photon_path.c and photon_media.c.

// Where a photon is on its way: the ray it goes, and what it has behind it.
struct leg {
    struct path path;
    double length;    // from the lamp
    bool past_target; // met what it was shot at
    bool through;     // the last surface let it pass as if it were not there
    bool first;       // straight from the lamp
};

struct photon_flight {
    const struct job *job;
    struct photons *to;
    struct tracer *t;
    struct path_queue out; // what a surface sends on
    struct leg *leg;       // that wait, the next one last
    uint32_t leg_count, leg_capacity;
    const struct photon_gun *gun;
    const struct lamp *eye_lamp; // whose interiors are known
    struct vec3 eye;
    const struct inside *eye_inside;
    struct arena *eye_arena;
    bool met;
};

bool photon_is_parallel(const struct photon_gun *g);
// Leaves a photon of a leg at p, `way` behind its beginning; weight: of its energy.
void photon_leave(struct photon_flight *f, struct photon_map *m, const struct leg *leg,
                  struct vec3 p, double way, struct rgb weight);
// What a leg of length s leaves in media and loses there.
void photon_media_cross(struct photon_flight *f, struct leg *leg, double s);

#endif
