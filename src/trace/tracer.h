#ifndef TRACE_TRACER_H
#define TRACE_TRACER_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"
#include "trace/intersect.h"
#include "trace/job.h"

struct arena;

// The interiors a ray is inside, the last entered first; never changed once made, so
// that rays share tails.
struct inside {
    const struct interior *interior;
    const struct inside *outer;
    bool hollow; // this one and all outer ones
};

static inline bool inside_hollow(const struct inside *i) { return !i || i->hollow; }

enum path_flags {
    PATH_REFLECTED = 1 << 0, // a mirror lies on the way from the camera
    PATH_CONTINUED = 1 << 1, // went straight on: its hit is not a new level
};

// A ray on its way, and what its colour counts for. A picture's sample is a sum over
// such rays: colours are linear in `through`.
struct path {
    struct vec3 o, d; // d unit
    const struct inside *inside;
    struct rgb through;
    float through_t;   // how much of what passes is seen as transparency
    float weight;      // for adc_bailout: an upper bound as the language defines it
    float wavelength;  // nm; 0: white
    uint32_t sample;   // index into tracer sums
    uint32_t hash;     // of the way here; the only source of randomness
    uint16_t level;
    uint8_t flags;
};

struct path_queue {
    struct path *at;
    uint32_t count, capacity;
};

// Light collected by one sample. Direct light that waits for shadow tests is summed
// apart: its order among itself is fixed, against the rest it is not.
struct sample_sum {
    struct rgb local, lit;
    float t;
};

// A shadow test that waits for a full batch.
struct shadow_request {
    struct vec3 o, d;
    double t_max;
    struct rgb value; // added when nothing is in the way
    const struct inside *inside;
    uint32_t sample, lamp;
};

// A mirrored ray whose colour is raised to a power: it is traced as a sample of its
// own and then added.
struct power_request {
    struct path path;
    struct rgb factor;
    float exponent;
    uint32_t sample;
};

enum { BATCH_SIZE = 1024 };

// What one thread needs to trace.
struct tracer {
    const struct job *job;
    struct trace_scratch *scratch;
    struct arena *arena; // interiors of the current tile
    struct ray_batch *rays, *shadow_rays;
    struct hit *hit;
    uint8_t *occluded;
    struct shadow_request *shadow;
    uint32_t shadow_count;
    uint32_t *shadow_order, *lamp_begin;
    struct sample_sum *sum;
    uint32_t sum_count, sum_capacity;
    struct power_request *power;
    uint32_t power_count, power_capacity;
    struct arena *camera_arena;
    const struct inside *camera_inside; // of a camera with one eye
    uint64_t samples;
};

// A ray from the camera. `position`, in pixels, seeds what is random along it.
struct tracer_ray {
    struct ray ray;
    struct vec2 position;
    bool exists; // false: the camera sees nothing there
};

struct tracer *tracer_new(const struct job *job);
void tracer_free(struct tracer *t);

// Stores red, green, blue and transparency of each ray. Same bits however the rays
// are grouped.
void tracer_rays(struct tracer *t, const struct tracer_ray *ray, uint32_t count,
                 float (*out)[4]);
// The same for sub-pixel positions of a camera without a lens.
void tracer_samples(struct tracer *t, const struct vec2 *position, uint32_t count,
                    float (*out)[4]);

// ---- between the parts of the tracer ------------------------------------
// Traces a queue to its end, adding to the sums.
void wave_run(struct tracer *t, struct path_queue *queue);
struct path *path_queue_add(struct path_queue *q);

// Adds what a hit sends towards the camera; rays that go on are appended to next.
void shade_hit(struct tracer *t, const struct path *path, const struct hit *hit,
               struct path_queue *next);
void shade_miss(struct tracer *t, const struct path *path);

// Appends a ray unless its level or weight says that it counts nothing.
void path_emit(struct tracer *t, struct path_queue *next, const struct path *path);
void power_emit(struct tracer *t, const struct path *path, struct rgb factor,
                float exponent);

void shadow_add(struct tracer *t, const struct shadow_request *r);
void shadow_flush(struct tracer *t);
// What passes of light that runs along the request's ray.
struct rgb shadow_factor(struct tracer *t, const struct shadow_request *r);
// The same with opaque objects known not to be in the way.
struct rgb shadow_filter(struct tracer *t, const struct shadow_request *r);

void tracer_add(struct tracer *t, uint32_t sample, struct rgb c);

static inline uint32_t hash_mix(uint32_t h, uint32_t v)
{
    // One round of a multiply-xorshift hash; every input bit reaches every output bit.
    h ^= v + 0x9e3779b9u + (h << 6) + (h >> 2);
    h *= 0x85ebca6bu;
    h ^= h >> 13;
    h *= 0xc2b2ae35u;
    return h ^ (h >> 16);
}
static inline double hash_unit(uint32_t h) { return h * (1.0 / 4294967296.0); }

#endif
