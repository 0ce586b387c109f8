#ifndef IRRADIANCE_CACHE_H
#define IRRADIANCE_CACHE_H

#include "base/watch.h"
#include "trace/render.h"

// POV-Ray's radiosity { }: irradiance at some points of the picture, gathered by rays, and
// interpolated between them (spec/lighting.md 12). The samples are taken before the
// picture, in passes over squares of fixed size that do not see each other's new samples:
// what is stored does not depend on threads. The picture then only looks them up; where
// none is near, it gathers without storing.

struct irradiance_cache;

struct irradiance_report {
    uint32_t samples, passes;
    uint64_t rays;
    double seconds;
};

// Takes the samples that a picture with these settings needs. The world outlives the
// cache. NULL after a cancel.
struct irradiance_cache *irradiance_cache_new(const struct world *w,
                                              const struct render_settings *settings,
                                              struct watch *watch,
                                              struct irradiance_report *report);
void irradiance_cache_free(struct irradiance_cache *c);
// What the tracer of the picture asks.
struct indirect irradiance_cache_indirect(const struct irradiance_cache *c);

#endif
