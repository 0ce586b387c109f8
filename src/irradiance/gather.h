#ifndef IRRADIANCE_GATHER_H
#define IRRADIANCE_GATHER_H

#include "irradiance/cache.h"
#include "irradiance/store.h"
#include "trace/tracer.h"

struct arena;

struct irradiance_cache {
    struct arena *arena;
    const struct radiosity_settings *settings;
    struct vec3 eye;
    struct job scout;               // the camera's rays, before the picture
    struct job gather, gather_last; // of every depth but the last, and of that
    const volatile bool *cancel;    // when set, no further sample is taken; NULL: never
    uint32_t depths;
    bool has_importance; // some object is not seen by all rays
    struct store store;
    struct vec3 *direction; // about y, cosine-weighted
    uint32_t direction_count;
};

// A sample whose rays wait to be traced with those of others.
struct gather_waiting {
    struct vec3 p, n;
    double high; // the largest radius it may get
};

// What a thread keeps for one depth.
struct gather_level {
    struct gatherer *owner;
    uint32_t depth;
    struct tracer *tracer; // of rays that gather for this depth; made when first wanted
    uint32_t next;         // direction
    struct vec3 *to;       // directions of rays
    struct first_hit *first;
    float *quality; // of what each met, as the next depth tells
    struct gather_waiting *waiting;
    uint32_t waiting_count, waiting_most;
    struct store_memo asked;
};

struct gatherer {
    const struct irradiance_cache *cache;
    struct store
        *fresh; // where new samples go; NULL: nowhere, and all is as in the picture
    bool final; // the picture's rules for what is enough
    struct gather_level *level;
    // What the camera's points knew since the start, where nearest_count has a second number.
    double weight;
    uint32_t points;
};

// Of a thread that takes samples.
struct gatherer *gatherer_new(const struct irradiance_cache *c);
void gatherer_free(struct gatherer *g);
uint64_t gatherer_rays(const struct gatherer *g);
// Within which distance a sample may be of use.
double gather_reach(const struct irradiance_cache *c, const struct cache_sample *s);
// Whether a query before the picture would take a sample where this one lies.
bool gather_is_wanted(const struct irradiance_cache *c, const struct cache_sample *s);
// Whether nearest_count's second number says that where it was since the start enough is known.
bool gather_is_settled(const struct gatherer *g);
// Takes the samples that wait, as must be done before the rays that asked for them are gone.
void gatherer_flush(struct gatherer *g);
// A new store takes what is found, or what was known has grown; directions from here on.
void gatherer_start(struct gatherer *g, uint32_t direction);

// Rays of one sample at a depth.
uint32_t gather_count(const struct irradiance_cache *c, uint32_t depth);

// The functions of struct indirect; the state is a gather_level.
void *gather_begin(const void *cache);
void gather_end(void *state);
unsigned gather_known(const void *cache, void *state, const struct indirect_eight *q,
                      struct rgb out[8]);
// The same before the picture, of the camera's hits.
unsigned gather_settled(const void *cache, void *state, const struct indirect_eight *q);
struct rgb gather_irradiance(const void *cache, void *state, struct tracer *t,
                             const struct indirect_query *q);

#endif
