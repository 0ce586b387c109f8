#ifndef IRRADIANCE_STORE_H
#define IRRADIANCE_STORE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"

// Irradiance samples and an index of where each may be used (spec/lighting.md 12.5, after
// Ward, Rubinstein and Clear 1988). All lengths are the world's.

struct cache_sample {
    struct vec3 p, n; // n unit
    struct vec3 to;   // unit, towards the nearest surface seen
    double radius;    // harmonic mean of the distances, clamped
    double nearest;   // distance of that nearest surface
    struct rgb light; // mean of what was seen
    float quality;    // 0 to 1
    uint32_t depth;   // of recursion
    double reach;     // it is filed for points within this distance
};

struct cache_cell {
    int32_t place[3]; // of the cell, in its own size
    int16_t size;     // power of two
    uint16_t depth;
    uint32_t first; // link
    uint32_t state; // 0: free
};

// A sample in a cell, with what most often tells that it says nothing.
struct cache_link {
    struct vec3 p;
    double radius;
    uint32_t sample, next;
};

enum { STORE_DEPTHS = 21, STORE_END = UINT32_MAX };

struct store {
    struct cache_sample *sample;
    uint32_t count, capacity;
    struct cache_link *link;
    uint32_t link_count, link_capacity;
    struct cache_cell *cell; // hashed, open addressing; capacity a power of two
    uint32_t cell_count, cell_capacity;
    int16_t size_low[STORE_DEPTHS], size_high[STORE_DEPTHS]; // low > high: empty
};

void store_init(struct store *s);
void store_free(struct store *s);
// Files the sample; points a little farther than its reach may find it too.
void store_add(struct store *s, const struct cache_sample *sample);

// What is asked for, and the weighted mean that answers it.
struct cache_point {
    struct vec3 p, n; // n unit
    double error_bound;
    uint32_t depth;
    bool smooth; // weights that fall off as a spline: in the picture itself
};
struct cache_mean {
    double weight, light[3]; // sums
};
void store_mean(const struct store *s, const struct cache_point *at,
                struct cache_mean *mean);
// Weight of one sample; 0: it says nothing here.
double cache_weight(const struct cache_sample *s, const struct cache_point *at);

#endif
