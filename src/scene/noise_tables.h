#ifndef SCENE_NOISE_TABLES_H
#define SCENE_NOISE_TABLES_H

#include <stdint.h>

// Tables that gen_noise_tables computes while lambert is built (spec/textures 1).
enum {
    NOISE_HASH_SIZE = 8192,
    NOISE_VALUE_COUNT = 267,
    NOISE_ROW_COUNT = NOISE_VALUE_COUNT - 3,
    NOISE_FAN_COUNT = NOISE_VALUE_COUNT - 8,
    NOISE_GRADIENT_PERIOD = 2048,
    NOISE_GRADIENT_COUNT = 2 * NOISE_GRADIENT_PERIOD + 2,
    NOISE_RANDOM_COUNT = 32768,
    NOISE_WAVE_COUNT = 64, // waves past these are computed when they are needed
};

extern const uint16_t noise_hash_table[NOISE_HASH_SIZE];
extern const double noise_value_table[NOISE_VALUE_COUNT];
// The same modulo 256, times 4: places in noise_row_table in doubles.
extern const uint16_t noise_corner_table[NOISE_HASH_SIZE];
// Four values from each place on, the first of them halved.
extern const double noise_row_table[NOISE_ROW_COUNT][4];
// The values at each place, four and eight further, and 0: what the three components of a
// vector have of the same kind side by side; at the place of a row and the three after it.
extern const double noise_fan_table[NOISE_FAN_COUNT][4];
extern const uint16_t noise_permutation[NOISE_GRADIENT_COUNT];
extern const double noise_gradient[NOISE_GRADIENT_COUNT][3];
extern const uint32_t noise_random_table[NOISE_RANDOM_COUNT]; // times 2^-32
extern const double noise_wave_table[NOISE_WAVE_COUNT][4];    // source x y z, frequency

#define NOISE_WAVE_SEED 3734115329u // 2^32 - 560851967
#define NOISE_WAVE_STEP 0.000030518509476

// Linear congruential generator of spec 1.1: one step, then bits 16..30.
static inline unsigned noise_draw(uint32_t *state)
{
    *state = *state * 1812433253u + 12345u;
    return *state >> 16 & 0x7fff;
}

#endif
