#ifndef IRRADIANCE_STORE_KERNEL_H
#define IRRADIANCE_STORE_KERNEL_H

#include "irradiance/store.h"

// The spec's own constants (spec/lighting.md 12.5).
static const double cache_same_place = 1e-6, cache_behind = -0.05,
                    cache_least_weight = 0.001;

// What looking samples up compiles once per instruction set, as trace/packet.h.
struct store_kernels {
    const char *name;
    // Adds what `count` samples say, the last of `filed` first; false: that is enough.
    bool (*mean)(const struct cache_sample *sample, const uint32_t *filed, uint32_t count,
                 const struct cache_point *at, struct cache_mean *mean);
    // The same for those of eight points that are `lanes`; returns those that have not enough.
    unsigned (*means)(const struct cache_sample *sample, const uint32_t *filed,
                      uint32_t count, const struct cache_points *at, unsigned lanes,
                      struct cache_means *mean);
};

extern const struct store_kernels store_kernels_base, store_kernels_avx2,
    store_kernels_avx512;

#endif
