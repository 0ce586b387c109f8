#ifndef TRACE_MEDIA_LIT_H
#define TRACE_MEDIA_LIT_H

#include "trace/media_mix.h"

// A lamp that lights a part of a stretch.
struct media_lamp {
    const struct lamp *lamp;
    double begin, end;
};

// A part of a stretch that is sampled by itself.
struct media_interval {
    double begin, length;
    bool lit;
    uint32_t walker; // whose it is, where several ways are walked together
};

// The lamps of a light group that reach the stretch; returns how many.
uint32_t media_lamps(const struct job *job, uint32_t group, struct vec3 o, struct vec3 d,
                     double s, struct media_lamp *out);
// How the stretch is divided (spec/lighting.md 10.3); in the arena.
struct media_interval *media_intervals(struct arena *a, const struct media_mix *mix,
                                       double s, const struct media_lamp *lamp,
                                       uint32_t lamp_count, uint32_t *count);

#endif
