#ifndef TRACE_SKY_H
#define TRACE_SKY_H

#include "trace/job.h"
#include "trace/tracer.h"

// What a ray that hits nothing sees in direction d: colour and transparency. `opaque`:
// a background never shows as alpha to this ray (spec/lighting.md 9.1).
struct rgb sky_color(const struct job *job, struct vec3 d, bool opaque, float *t);

// The same, bit by bit, in `count` directions, up to eight, where the job has sky_tape: where
// sky_compile found that all its pigments can be run so. d: unused lanes hold any direction.
void sky_compile(struct job *job, struct arena *a);
void sky_colors(const struct job *job, const double d[3][8], uint32_t count,
                const bool opaque[8], struct rgb out[8], float t[8]);

// How far a ray that hits nothing goes, as fog and rainbow see it (spec/lighting.md 0).
static const double air_far = 2e10;
// What lies between the beginnings of the wave's rays and what they hit: adds the light of
// fogs, media and rainbows, and filters what the rays bring from there on (spec/lighting.md
// 9.2, 9.3, 10). Fogs of eight rays at a time by the kernels' `fogs`; media of interiors are
// left to shade_painted by the general rule.
void air_wave(struct tracer *t);
// A rainbow as rays see it.
struct bow {
    const struct rainbow *rainbow;
    struct vec3 axis, right, up;
    double least, most; // cosines of the angles from the axis at which it may be seen
};
void bows_init(struct job *job, struct arena *a);
// The factor by which fogs and media that fill the scene filter light along a way.
struct rgb air_filter(struct tracer *t, struct vec3 o, struct vec3 d, double s);

#endif
