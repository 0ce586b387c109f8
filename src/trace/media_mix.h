#ifndef TRACE_MEDIA_MIX_H
#define TRACE_MEDIA_MIX_H

#include "trace/media.h"

// Per unit of length: how much light is lost, given off, scattered.
struct media_point {
    struct vec3 extinction, emission, scattering;
};

// All media that fill a stretch together.
struct media_mix {
    const struct media *const *media;
    uint32_t count;
    const struct media *rules; // the one whose settings hold: most intervals
    double aa_threshold;       // the smallest of all
    bool even;                 // the same everywhere: `everywhere`
    bool scatters, emits;
    struct media_point everywhere;
};

// The densities of a medium, compiled.
struct media_tapes {
    const struct media *media;
    const struct pigment_tape *const *tape; // of each; NULL: nested too deeply
};

// The point o + t d, seen along d.
struct media_at {
    struct vec3 o, d;
    double t;
};

struct media_mix media_mix_of(const struct media *const *media, uint32_t count);
// Of the interiors of a list, for rays to the eye; lives to the next call.
struct media_mix media_mix_inside(struct tracer *t, const struct inside *list);
// Media that let all light through are left out, for shadows.
uint32_t media_opaque_only(const struct media *const *media, uint32_t count,
                           const struct media **out);
// At `count` points o + t[i] d.
void media_points(const struct job *job, const struct media_mix *mix,
                  const struct media_at *at, uint32_t count, struct media_point *out);
// The mean of the phase functions; cosine: between the ray and the way to the light.
double media_phase(const struct media_mix *mix, double cosine);

static inline struct vec3 vec3_of_rgb(struct rgb c)
{
    return vec3((double)c.r, (double)c.g, (double)c.b);
}

#endif
