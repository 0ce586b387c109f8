#ifndef TRACE_PHOTON_FLIGHT_H
#define TRACE_PHOTON_FLIGHT_H

#include "trace/media_march.h"
#include "trace/photon_path.h"

// Between photon_path.c and photon_media.c.

// Where a photon is on its way: the ray it goes, and what it has behind it.
struct leg {
    struct path path;
    double length;    // from the lamp
    uint32_t shot;    // that it comes from
    uint32_t place;   // its leg_place
    bool past_target; // met what it was shot at
    bool through;     // the last surface let it pass as if it were not there
    bool first;       // straight from the lamp
};

// What a leg has left, and the legs that go on from its end: ranges of left.surface, left.media
// and place. Rays are followed side by side, but their photons count as if one ray were
// followed to its end after the other, and one way from a surface after the other.
struct leg_place {
    uint32_t surface[2], media[2], next[2];
};

struct photon_flight {
    const struct job *job;
    struct photons left; // in the order in which it was
    struct tracer *t;
    struct path_queue out; // what a surface sends on
    struct leg *leg;       // that wait, the next ones last
    uint32_t leg_count, leg_capacity;
    struct leg *flying; // BATCH_SIZE that are followed now
    struct leg_place *place;
    uint32_t place_count, place_capacity;
    uint32_t *turn; // places whose photons are to be counted, the next one last
    const struct photon_gun *gun;
    const struct lamp *eye_lamp; // whose interiors are known
    struct vec3 eye;
    const struct inside *eye_inside;
    struct arena *eye_arena;
    bool *met; // by shot: it met the target
};

bool photon_is_parallel(const struct photon_gun *g);
// Leaves a photon of a leg at p, `way` behind its beginning; weight: of its energy.
void photon_leave(struct photon_flight *f, struct photon_map *m, const struct leg *leg,
                  struct vec3 p, double way, struct rgb weight);
// What a leg of length s leaves in media and loses there.
void photon_media_cross(struct photon_flight *f, struct leg *leg, double s);

#endif
