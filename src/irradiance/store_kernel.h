#ifndef IRRADIANCE_STORE_KERNEL_H
#define IRRADIANCE_STORE_KERNEL_H

#include "irradiance/store.h"

// The spec's own constants (spec/lighting.md 12.5).
static const double cache_same_place = 1e-6, cache_behind = -0.05,
                    cache_least_weight = 0.001;

enum { STORE_SIZES = 16 }; // of cells whose hashes are made at once

static inline uint32_t cache_cell_hash(const int32_t place[3], int size, uint32_t depth)
{
    uint32_t h = (uint32_t)size * 0x9e3779b9u + depth;
    for (int k = 0; k < 3; k++) {
        h ^= (uint32_t)place[k];
        h *= 0x85ebca6bu;
        h ^= h >> 15;
    }
    return h * 0xc2b2ae35u;
}

// What looking samples up compiles once per instruction set, as trace/packet.h.
struct store_kernels {
    const char *name;
    // Hashes of the cell at a place and of those of twice, four times... the size around it.
    void (*hashes)(const int32_t place[3], int size, uint32_t depth,
                   uint32_t hash[STORE_SIZES]);
    // Adds what `count` samples say, the last of `filed` first; false: that is enough.
    bool (*mean)(const struct store *s, const uint32_t *filed, uint32_t count,
                 const struct cache_point *at, struct cache_mean *mean);
    // The same for those of eight points that are `lanes`; returns those that have not enough.
    unsigned (*means)(const struct store *s, const uint32_t *filed, uint32_t count,
                      const struct cache_points *at, unsigned lanes,
                      struct cache_means *mean);
};

extern const struct store_kernels store_kernels_base, store_kernels_avx2,
    store_kernels_avx512;

#endif
