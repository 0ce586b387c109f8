#ifndef TRACE_MEDIA_MIX_H
#define TRACE_MEDIA_MIX_H

#include "scene/effects.h"
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
    bool isotropic; // media_phase is 1
    struct media_point everywhere;
};

// The densities of a medium, compiled.
struct media_tapes {
    const struct media *media;
    const struct pigment_tape *const *tape; // of each; NULL: nested too deeply
};

// Eight points and along what they are seen.
struct media_places {
    _Alignas(64) double at[3][8], ray_d[3][8];
};
// What a media_point has, of eight.
struct media_eight {
    _Alignas(64) double extinction[3][8], emission[3][8], scattering[3][8];
};

struct media_mix media_mix_of(const struct media *const *media, uint32_t count);
// Of the interiors of a list, for rays to the eye; lives to the next call.
struct media_mix media_mix_inside(struct tracer *t, const struct inside *list);
// Media that let all light through are left out, for shadows.
uint32_t media_opaque_only(const struct media *const *media, uint32_t count,
                           const struct media **out);
static inline void media_place(struct media_places *to, uint32_t i, struct vec3 p,
                               struct vec3 d)
{
    to->at[0][i] = p.x, to->at[1][i] = p.y, to->at[2][i] = p.z;
    to->ray_d[0][i] = d.x, to->ray_d[1][i] = d.y, to->ray_d[2][i] = d.z;
}

// At `count` points, eight a block; lanes that are left over are filled in.
void media_points(const struct job *job, const struct media_mix *mix,
                  struct media_places *place, uint32_t count, struct media_eight *out);
// The mean of the phase functions; cosine: between the ray and the way to the light.
double media_phase(const struct media_mix *mix, double cosine);

static inline struct vec3 vec3_of_rgb(struct rgb c)
{
    return vec3((double)c.r, (double)c.g, (double)c.b);
}

static inline struct vec3 media_extinction(const struct media *m)
{
    return vec3_mad(vec3_of_rgb(m->absorption), (double)m->extinction,
                    vec3_of_rgb(m->scattering));
}

#endif
