#ifndef IRRADIANCE_STORE_KERNEL_H
#define IRRADIANCE_STORE_KERNEL_H

#include <math.h>

#include "irradiance/store.h"
#include "math/larger.h"

// The spec's own constants (spec/lighting.md 12.5).
static const double cache_same_place = 1e-6, cache_behind = -0.05,
                    cache_least_weight = 0.001;

static const double cache_not_unit = 0.005; // for normals of lengths of up to 1.001

// The side of the cube that a normal goes through.
static inline int cache_side(struct vec3 n)
{
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    if (x >= y && x >= z)
        return n.x < 0;
    return y >= z ? 2 + (n.y < 0) : 4 + (n.z < 0);
}

// The sides that normals go through which may count where the normal is n: the chord between
// two of them is shorter than bound / sqrt(2) (cache_may_count), and planes at 45 degrees
// part the sides.
static inline unsigned cache_sides(struct vec3 n, double bound)
{
    const double x = fabs(n.x), y = fabs(n.y), z = fabs(n.z);
    const double room = sqrt(bound * bound + cache_not_unit);
    const double yz = larger(y, z) - room, xz = larger(x, z) - room,
                 xy = larger(x, y) - room;
    return (unsigned)(n.x >= yz) | (unsigned)(-n.x >= yz) << 1 |
           (unsigned)(n.y >= xz) << 2 | (unsigned)(-n.y >= xz) << 3 |
           (unsigned)(n.z >= xy) << 4 | (unsigned)(-n.z >= xy) << 5;
}

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

// Where the samples of each side end, counted from the cell's first.
static inline uint32_t *cell_ends(const struct store *s, const struct cache_cell *c)
{
    return s->filed + c->first - CACHE_SIDES;
}

// Bits of the filter: so many for each cell of the capacity that most places without a cell
// are told by them.
enum { FILTER_BITS = 8 };

static inline uint32_t filter_bit(const struct store *s, uint32_t hash)
{
    return hash & (FILTER_BITS * s->cell_capacity - 1);
}

// False: no cell has that hash.
static inline bool filter_passes(const struct store *s, uint32_t hash)
{
    const uint32_t bit = filter_bit(s, hash);
    return s->filter[bit / 8] >> bit % 8 & 1;
}

// What looking samples up compiles once per instruction set, as trace/packet.h.
struct store_kernels {
    const char *name;
    // Hashes of the cell at a place and of those of twice, four times... the size around it,
    // `count` in all; returns which of them the filter lets pass.
    unsigned (*hashes)(const struct store *s, const int32_t place[3], int size,
                       uint32_t depth, uint32_t count, uint32_t hash[STORE_SIZES]);
    // Adds what the samples of some cells say, the last side and its last sample first;
    // false: that is enough.
    bool (*mean)(const struct store *s, const struct cache_cell *const *cell,
                 uint32_t count, const struct cache_point *at, struct cache_mean *mean);
    // The same of one cell for those of eight points that are `lanes`; returns those that
    // have not enough.
    unsigned (*means)(const struct store *s, const struct cache_cell *cell,
                      const struct cache_points *at, unsigned lanes,
                      struct cache_means *mean);
};

extern const struct store_kernels store_kernels_base, store_kernels_avx2,
    store_kernels_avx512;

#endif
