#ifndef TRACE_MEDIA_H
#define TRACE_MEDIA_H

#include "trace/tracer.h"

struct media;

// Participating media (spec/lighting.md 10): what a stretch of a ray collects and loses on
// its way through smoke, dust and fire. Colours are in double precision here, in x, y, z:
// sums of many small terms.

// A stretch of a ray from its origin on.
struct media_way {
    struct vec3 o, d; // d unit
    double s;         // length
    const struct inside *inside;
    uint32_t group; // light group of what lies at its end; 0: none
    uint32_t hash;  // seeds what is random along it
    uint32_t slot;  // of its ray
};

struct media_result {
    struct vec3 light; // that is added
    struct vec3 pass;  // of what comes from the far end
};

// Whether the ray is in a medium of an object (spec/lighting.md 10.2).
bool media_inside(const struct inside *list);
// Whether rays with these lists are in the same media.
bool media_same(const struct inside *a, const struct inside *b);
// Adds the light of the media of the interiors to the slot, and filters the path.
void media_apply(struct tracer *t, struct path *path, double s, uint32_t group);
// The same of the media that fill the scene.
void media_air_apply(struct tracer *t, struct path *path, double s, uint32_t group);
// The same for all rays of the wave; those that are in the same media are walked together
// (media_wave.c). How far media of interiors reach is known of those that hit something.
void media_wave(struct tracer *t);
void media_air_wave(struct tracer *t);
// What they let through of light on its way to a lamp.
struct rgb media_shadow(struct tracer *t, const struct inside *list, struct vec3 o,
                        struct vec3 d, double s);
// The same for several rays, which are walked together where they are in the same media.
struct media_dark {
    const struct inside *inside;
    struct vec3 o, d;
    double s;
    struct rgb pass; // filled
};
void media_shadows(struct tracer *t, struct media_dark *ray, uint32_t count);
struct rgb media_air_shadow(struct tracer *t, struct vec3 o, struct vec3 d, double s);
// Whether nothing but media that are the same everywhere fills the scene, and what it lets
// through of light on at most BATCH_SIZE ways of length s.
bool media_air_is_even(const struct tracer *t);
void media_air_even_shadows(struct tracer *t, const double *s, uint32_t count,
                            struct rgb *out);

// What a job works out for all rays.
void media_compile(struct job *job, struct arena *a);
void media_init(struct tracer *t);
void media_end(struct tracer *t);

#endif
