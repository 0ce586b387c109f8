#ifndef IRRADIANCE_CACHE_H
#define IRRADIANCE_CACHE_H

#include "base/watch.h"
#include "trace/render.h"

// POV-Ray's radiosity { }: irradiance at some points of the picture, gathered by rays, and
// interpolated between them (spec/lighting.md 12). The samples are taken before the
// picture, in passes over squares of fixed size that do not see each other's new samples;
// a square where enough is known (nearest_count's second number) is left to the last pass:
// what is stored does not depend on threads. The picture then only looks them up; where
// none is near, it gathers without storing.

struct irradiance_cache;
struct cache_sample;

struct irradiance_report {
    uint32_t samples, passes;
    uint64_t rays;
    double seconds;
};

// Without samples. World and cancel (NULL: never) outlive the cache.
struct irradiance_cache *irradiance_cache_new(const struct world *w,
                                              const struct render_settings *settings,
                                              const volatile bool *cancel);
// Takes the samples that a picture with these settings needs beside those that are there.
// False after a cancel.
bool irradiance_cache_fill(struct irradiance_cache *c,
                           const struct render_settings *settings, struct watch *watch,
                           struct irradiance_report *report);
// What a file keeps of samples: all but their reach, which follows from the settings.
const struct cache_sample *irradiance_cache_samples(const struct irradiance_cache *c,
                                                    uint32_t *count);
// Adds such a sample; false: it is none.
bool irradiance_cache_add(struct irradiance_cache *c, const struct cache_sample *sample);
void irradiance_cache_free(struct irradiance_cache *c);
// What the tracer of the picture asks.
struct indirect irradiance_cache_indirect(const struct irradiance_cache *c);

#endif
