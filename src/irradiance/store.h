#ifndef IRRADIANCE_STORE_H
#define IRRADIANCE_STORE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"

// Irradiance samples and an index of where each may be used (spec/lighting.md 12.5, after
// Ward, Rubinstein and Clear 1988). All lengths are the world's.

struct cache_sample {
    union {
        struct {
            struct vec3 p;
            double radius;  // harmonic mean of the distances, clamped
            struct vec3 n;  // unit
            double nearest; // distance of the nearest surface seen
            struct vec3 to; // unit, towards it
            double quality; // 0 to 1
        };
        double row[12]; // the same, for the kernels
    };
    struct rgb light; // mean of what was seen
    uint32_t depth;   // of recursion
    double reach;     // it is filed for points within this distance
};

static const double cache_reach_most = 0x1p1000; // of a sample that can be filed

// The same in single precision, as much as tells of most samples that they say nothing.
struct cache_spot {
    float p[3], radius; // infinite where floats do not hold p
    float n[3], unused;
};

// Normals by the side of a cube they go through: two an axis, the positive one first.
enum { CACHE_SIDES = 6 };

// A cube of space, of a size that is a power of two, and the depth that it is for.
struct cache_place {
    int32_t at[3]; // in its own size
    int16_t size;
    uint16_t depth;
};

// What is filed for a place. Places of one size and depth may share it where their hashes
// are the same: it then lists samples that say nothing to the points of one of them.
struct cache_cell {
    uint32_t hash;
    int16_t size;
    uint16_t depth;
    uint32_t first, count; // of `filed`; 0: the cell is free
};

enum { STORE_DEPTHS = 21 };

struct store_kernels;

struct store {
    struct cache_sample *sample;
    struct cache_spot *spot; // of each sample
    uint32_t count, capacity, spot_capacity;
    // Samples, cell by cell, and in these side by side; before them, where each side's end.
    uint32_t *filed;
    uint32_t filed_count, filed_capacity;
    struct cache_cell *cell; // hashed, open addressing; capacity a power of two
    uint8_t *filter;         // bits: whether some cell has a hash that ends so
    uint32_t cell_count, cell_capacity;
    const struct store_kernels *kernels;
    int16_t size_low[STORE_DEPTHS], size_high[STORE_DEPTHS]; // low > high: empty
};

// isa: the name of an instruction set that the machine has (math/isa.h).
void store_init(struct store *s, const char *isa);
void store_free(struct store *s);
// Files the sample; points a little farther than its reach may find it too.
void store_add(struct store *s, const struct cache_sample *sample);

// What is asked for, and the weighted mean that answers it.
struct cache_point {
    struct vec3 p, n; // n unit
    double error_bound;
    uint32_t depth;
    bool smooth;   // weights that fall off as a spline: in the picture itself
    double enough; // a sum of weights past which no more is asked for
};
struct cache_mean {
    double weight, light[3]; // sums
};
void store_mean(const struct store *s, const struct cache_point *at,
                struct cache_mean *mean);

// The cells that a thread has asked last, one of a size: neighbours ask the same ones. All
// zero at first, and when the store is another one.
struct store_memo {
    struct cache_place place[16];
    const struct cache_cell *cell[16]; // NULL: none yet
    uint32_t cell_count;               // when they were asked
};
// The same of eight points at once; those that are not `lanes` are left alone.
struct cache_points {
    double p[3][8], n[3][8], error_bound[8];
    unsigned lanes;
    uint32_t depth;
    bool smooth;
    double enough; // of each, as in struct cache_point
};
struct cache_means {
    double weight[8], light[3][8];
};
// memo: of this store alone; NULL: none.
void store_means(const struct store *s, const struct cache_points *at,
                 struct store_memo *memo, struct cache_means *mean);
// Whether a sample at p with the normal n may say something there, if its radius is not larger.
bool cache_may_count(struct vec3 p, struct vec3 n, double radius,
                     const struct cache_point *at);
// Weight of one sample; 0: it says nothing here. This is the rule that the kernels follow.
double cache_weight(const struct cache_sample *s, const struct cache_point *at);

#endif
