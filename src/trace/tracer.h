#ifndef TRACE_TRACER_H
#define TRACE_TRACER_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"
#include "trace/intersect.h"
#include "trace/job.h"
#include "trace/scratch.h"

struct arena;
struct simple_group;
struct hit_run;
struct shadow_list;
struct paint_scratch;

// The interiors a ray is inside, the last entered first; never changed once made, so
// that rays share tails.
struct inside {
    const struct interior *interior;
    const struct inside *outer;
    bool hollow; // this one and all outer ones
};

// The list that was pushed to last, and what came of it: most rays enter what their
// neighbours have entered.
struct inside_pushed {
    const struct inside *list;
    const struct interior *interior;
    const struct inside *pushed;
};

static inline bool inside_hollow(const struct inside *i) { return !i || i->hollow; }

enum path_flags {
    PATH_REFLECTED = 1 << 0, // a mirror lies on the way from the camera
    PATH_CONTINUED = 1 << 1, // went straight on: its hit is not a new level
    PATH_SHORT = 1 << 2,     // sees no farther than the job's `reach`
    PATH_OF_ONE_WAY = PATH_CONTINUED | PATH_SHORT // what the next ray does not inherit
};

enum { BATCH_SIZE = 1024 };
// Of arrays that are walked side by side: rows that are a power of two apart share the same few
// places of the cache.
enum { BATCH_ROW = BATCH_SIZE + 16 };

// A ray on its way, and what its colour counts for. A picture's sample is a sum over
// such rays: colours are linear in `through`.
struct path {
    struct vec3 o, d; // d unit
    const struct inside *inside;
    struct rgb through;
    float through_t;  // how much of what passes is seen as transparency
    float weight;     // for adc_bailout: an upper bound as the language defines it
    float wavelength; // nm; 0: white
    uint32_t sample;  // index into tracer sums
    uint32_t hash;    // of the way here; the only source of randomness
    uint16_t level;
    uint16_t parent; // place in its batch of the ray it comes from
    uint8_t flags;
    uint8_t key; // path_key_within; 0: none
};

// The ray has met a surface.
static inline void path_meets(struct path *p)
{
    p->level += !(p->flags & PATH_CONTINUED);
    p->flags &= (uint8_t)~PATH_OF_ONE_WAY;
}

// Rays inside the object that they start from, for the most part, stay together by that
// object better than by their directions.
enum { PATH_KEYS_WITHIN = 16, PATH_KEYS = 48 };
static inline uint8_t path_key_within(uint32_t surface)
{
    return (uint8_t)(PATH_KEYS_WITHIN + surface % (PATH_KEYS - PATH_KEYS_WITHIN));
}

// Rays that leave in similar directions side by side, so that packets stay together.
enum { PATH_KEYS_DIRECTION = 16 };
static inline unsigned path_key_direction(const struct path *p)
{
    return (unsigned)(p->d.x < 0) | (unsigned)(p->d.y < 0) << 1 |
           (unsigned)(p->d.z < 0) << 2 | (unsigned)(p->flags & PATH_REFLECTED) << 3;
}

// Rays that wait. `order` says in which order they count: that of their parents.
struct path_queue {
    struct path *at;
    uint32_t *order;
    uint32_t count, capacity;
};

struct sample_sum {
    struct rgb light;
    float t;
};

// A shadow test that waits for a full batch.
struct shadow_request {
    struct vec3 o, d;
    double t_max;
    struct rgb value; // added when nothing is in the way
    const struct inside *inside;
    uint32_t slot, lamp;
    uint8_t photons; // photons_instead
};

// A mirrored ray whose colour is raised to a power: it is traced as a sample of its
// own and then added.
struct power_request {
    struct path path;
    struct rgb factor;
    float exponent;
    uint32_t sample;
};

// The rays that are traced together: at most BATCH_SIZE of a generation. Each has a slot,
// its place in the order of the generation; the rays themselves may stand in another
// order. Light is collected by slot and then added to the samples slot by slot: the sum
// does not depend on the order in which the hits of a batch are shaded.
struct wavefront {
    uint32_t count;
    const struct path *path; // with order, of each slot; NULL: straight from the camera
    const uint32_t *order;
    const struct vec2 *position; // of each slot, straight from the camera
    struct path_queue *next;
    uint16_t slot[BATCH_SIZE]; // of each ray
    // By slot: light that came unhindered, light that passed a shadow test, transparency.
    _Alignas(64) float own[3][BATCH_ROW];
    float lit[3][BATCH_ROW], t[BATCH_ROW];
    float through[3][BATCH_ROW];
    // Those of a path, by slot where there are paths.
    float through_t[BATCH_ROW];
    uint32_t sample[BATCH_ROW];
};

// Shadow rays to one lamp after the other; what each adds to which slot.
struct shadow_batch {
    struct ray_batch *rays;
    _Alignas(64) float value[3][BATCH_ROW];
    uint16_t slot[BATCH_SIZE];
    uint8_t occluded[BATCH_SIZE];
    uint8_t photons[BATCH_SIZE]; // photons_instead
    uint8_t air[BATCH_SIZE];     // air_counts, of rays of simple surfaces
    struct rgb *pass;            // what transparent things and fog let through; NULL: all
};

// What a ray from elsewhere than the camera met first.
struct first_hit {
    double distance; // INFINITY: nothing
    uint32_t leaf;
};

// What one thread needs to trace.
struct tracer {
    const struct job *job;
    struct trace_scratch *scratch;
    struct arena *arena; // interiors of the current tile
    struct ray_batch *rays;
    struct hit_batch *hit;
    struct wavefront wave;
    uint32_t slot;                    // of the ray that is shaded alone
    struct shadow_batch simple, rest; // of simple surfaces and of all others
    struct shadow_request *shadow;    // what waits for `rest`
    uint32_t shadow_count;
    uint32_t *shadow_order, *lamp_begin;
    struct shadow_batch near; // of few rays, or those to area lights
    struct area_queue *area;  // trace/area.h; NULL: no area lights
    struct shadow_walk *walk; // shadow rays among transparent things
    struct ray_batch *walk_rays;
    struct hit_batch *walk_hit;
    struct shadow_list *list;   // trace/shadow_list.h; NULL: not for this scene
    struct simple_group *group; // BATCH_SIZE / 8 of them
    uint16_t *class_head, *class_tail, *class_ray; // trace/simple.c
    struct hit_run *run;
    uint32_t run_count;
    uint32_t *class_seen, class_count;
    struct paint_scratch *paint; // trace/paint.h; NULL: nothing is painted
    struct sample_sum *sum;
    uint32_t sum_count, sum_capacity;
    struct power_request *power;
    uint32_t power_count, power_capacity;
    struct photon_near *near_photons; // trace/photons.h; NULL: there are none
    struct media_scratch *media;      // trace/media.h; NULL: the scene has none
    struct ray_batch *wall_rays;      // trace/subsurface.h; NULL: the scene has none
    struct hit_batch *wall_hit;
    struct wave_frame *frame;
    struct path_queue camera_queue;
    struct inside_pushed last_push;
    bool *settled;           // by ray of the batch (trace/scout.h); NULL: none ever is
    void *indirect;          // what light by way of others keeps for this tracer
    struct first_hit *first; // by sample, of rays of level first_level; NULL: not wanted
    uint16_t first_level;
    struct arena *camera_arena;
    const struct inside *camera_inside; // of a camera with one eye
    const struct inside **eye_inside;   // by slot, of one without whose rays are made
                                        // eight at a time; else NULL
    uint64_t samples;
};

// A ray from the camera. `position`, in pixels, seeds what is random along it.
struct tracer_ray {
    struct ray ray;
    struct vec2 position;
    bool exists;   // false: the camera sees nothing there
    uint8_t flags; // path_flags
};

// Asked now and then by what may take long. Once true, whatever is found is worth nothing and
// nobody looks at it, so that it need not be found.
static inline bool tracer_gives_up(struct tracer *t)
{
    return boundary_list_gives_up(&t->scratch->crossings);
}

struct tracer *tracer_new(const struct job *job);
void tracer_free(struct tracer *t);

// Stores red, green, blue and transparency of each ray. Same bits however the rays
// are grouped.
void tracer_rays(struct tracer *t, const struct tracer_ray *ray, uint32_t count,
                 float (*out)[4]);
// The same for sub-pixel positions of a camera without a lens.
void tracer_samples(struct tracer *t, const struct vec2 *position, uint32_t count,
                    float (*out)[4]);

// Room for rays that come from elsewhere than the camera, all of the same level, behind those
// that wait. Their samples are their places from 0.
struct path *tracer_paths_room(struct tracer *t, uint32_t count);
// Traces what waits; the samples stand until the next call. first, if not NULL, gets what each meets
// first.
const struct sample_sum *tracer_paths(struct tracer *t, struct first_hit *first);

// The same for at most BATCH_SIZE where a sample is one ray (a camera without meshes), where
// they stand until the next call. on_lens: where each goes through the camera's lens, in scene
// units off its centre; NULL: it has none.
const struct sample_sum *tracer_batch(struct tracer *t, const struct vec2 *position,
                                      const struct vec2 *on_lens, uint32_t count);

// ---- between the parts of the tracer ------------------------------------
// Adds what a hit sends towards the camera; rays that go on are appended to the wave's
// next. The slot is the tracer's.
void shade_hit(struct tracer *t, const struct path *path, const struct hit *hit);

// The ray of a slot of the wave, and the interiors it is inside.
struct path wave_path(const struct tracer *t, uint32_t slot);
const struct inside *wave_inside(const struct tracer *t, uint32_t slot);
uint32_t wave_hash(const struct tracer *t, uint32_t slot); // wave_path's

struct path *path_queue_add(struct path_queue *q);
// Room for `count` more.
void path_queue_reserve(struct path_queue *q, uint32_t count);
// Appends a ray unless its level or weight says that it counts nothing.
static inline bool path_counts(const struct job *job, int level, float weight)
{
    return level < job->max_level && weight >= job->adc_bailout;
}
void path_emit(struct tracer *t, const struct path *path);
void power_emit(struct tracer *t, const struct path *path, struct rgb factor,
                float exponent);

// Whether fog and media that fill the scene dim the light of a lamp.
bool air_counts(const struct job *job, uint32_t lamp);
void shadow_init(struct tracer *t);
void shadow_end(struct tracer *t);
void shadow_add(struct tracer *t, const struct shadow_request *r);
// Traces what waits.
void shadow_flush(struct tracer *t);
// Traces the first `count` shadow rays of simple surfaces.
void shadow_flush_simple(struct tracer *t, uint32_t count);
// What passes of light that runs along the request's ray.
struct rgb shadow_factor(struct tracer *t, const struct shadow_request *r);
// The same of the rays to one lamp that stand in `near`.
void shadow_factors_near(struct tracer *t, uint32_t lamp, uint32_t count,
                         struct rgb *out);
// The same for at most BATCH_SIZE requests.
void shadow_factors(struct tracer *t, const struct shadow_request *r, uint32_t count,
                    struct rgb *out);

// Adds to the slot of the tracer.
static inline void tracer_add(struct tracer *t, struct rgb c)
{
    t->wave.own[0][t->slot] += c.r;
    t->wave.own[1][t->slot] += c.g;
    t->wave.own[2][t->slot] += c.b;
}

// Adds light of lamps to a slot.
static inline void tracer_lit(struct tracer *t, uint32_t slot, struct rgb c)
{
    t->wave.lit[0][slot] += c.r;
    t->wave.lit[1][slot] += c.g;
    t->wave.lit[2][slot] += c.b;
}

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
