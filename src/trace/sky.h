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

// What lies between the camera side and a point at distance s of the ray: adds the
// light of fogs, media and rainbows to the sum, and filters what the path brings from there
// on (spec/lighting.md 9.2, 9.3, 10). group: the light group of what lies there, or 0.
void air_apply(struct tracer *t, struct path *path, double s, uint32_t group);
// The factor by which fogs and media that fill the scene filter light along a way.
struct rgb air_filter(struct tracer *t, struct vec3 o, struct vec3 d, double s);

#endif
