#ifndef SCENE_NOISE_H
#define SCENE_NOISE_H

#include <stdint.h>

#include "math/interval.h"
#include "math/vec.h"

// Lattice noise of the scene language (spec/textures 1, 2). Same bits everywhere.

// Below an integer by less than this, a negative coordinate belongs to the cell above.
#define NOISE_EDGE 1e-10
// 2^62. From here on a coordinate has no fraction and is near the end of the integers.
#define NOISE_FAR 4611686018427387904.0

enum noise_generator { NOISE_ORIGINAL = 1, NOISE_RANGE_CORRECTED = 2, NOISE_PERLIN = 3 };

// What noise_value and noise_turbulence make of a generator that is out of range: 1.
double noise_value(struct vec3 p, int generator);
struct vec3 noise_vector(struct vec3 p);
// Where generator 2 has the blend of the lattice: (blend + add) times scale.
#define NOISE_CORRECTED_ADD   1.05242
#define NOISE_CORRECTED_SCALE 0.48985582
// Where each has it, before it is cut to 0..1: blend times scale + add, but for roundings.
struct noise_range {
    double scale, add;
};
static inline struct noise_range noise_range_of(int generator)
{
    return generator == NOISE_PERLIN ? (struct noise_range){0.795, 0.4925}
           : generator == NOISE_RANGE_CORRECTED
               ? (struct noise_range){NOISE_CORRECTED_SCALE,
                                      NOISE_CORRECTED_ADD * NOISE_CORRECTED_SCALE}
               : (struct noise_range){1, 0.5};
}
// A few dozen roundings of numbers below four. Slopes also differ where coordinates within
// NOISE_EDGE below a whole number belong to the cell above, and where generator 3 adds 1e7 to
// them before they are split.
#define NOISE_VALUE_SLACK 1e-13
#define NOISE_SLOPE_SLACK 1e-6
// No partial derivative of noise_value is larger: found by going through all pairs of entries
// of the tables, as tests/unit/scene/test_noise_bounds.c does again.
static inline double noise_slope_max(int generator)
{
    return generator == NOISE_PERLIN            ? 3.5
           : generator == NOISE_RANGE_CORRECTED ? 3.44
                                                : 7.01;
}

// Bounds of noise_value and of its partial derivatives over a box, with these slacks for
// roundings; a box of more lattice cells, along an axis or in all, has the whole range.
enum { NOISE_BOUNDS_ACROSS = 3, NOISE_BOUNDS_CELLS = 8 };
void noise_bounds(const struct interval box[3], int generator, struct interval *v,
                  struct interval slope[3]);
double noise_turbulence(struct vec3 p, double lambda, double omega, int octaves,
                        int generator);
struct vec3 noise_dturbulence(struct vec3 p, double lambda, double omega, int octaves);

// Hash of a lattice cell (spec 1.2), 0..4095.
unsigned noise_hash(int64_t x, int64_t y, int64_t z);
// Entry of the random table (spec 1.5), in [0, 1); the index is taken modulo its size.
double noise_random(unsigned index);
// The random point of a cell (spec 1.5); x, y, z are whole numbers.
struct vec3 noise_cell_point(double x, double y, double z);
unsigned noise_cell_hash(double x, double y, double z);

// Source and frequency of wave i of `waves` and `ripples` (spec 1.6).
struct vec3 noise_wave_source(int i);
double noise_wave_frequency(int i);

#endif
