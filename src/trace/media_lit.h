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

// The lamps of a light group that reach the stretch; returns how many. missed: which certainly
// do not, by the bits of `lane`; NULL: not known.
uint32_t media_lamps(const struct job *job, const struct media_way *way,
                     const uint8_t *missed, uint8_t lane, struct media_lamp *out);
// The lamps that eight ways of a light group certainly miss, a bit a way.
void media_lamps_missed(const struct job *job, const struct media_way *way,
                        uint32_t count, uint8_t *missed);
// How the stretch is divided (spec/lighting.md 10.3); in the arena.
struct media_interval *media_intervals(struct arena *a, const struct media_mix *mix,
                                       double s, const struct media_lamp *lamp,
                                       uint32_t lamp_count, uint32_t *count);

#endif
