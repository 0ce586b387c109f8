#ifndef RADIOSITY_SEQUENCE_H
#define RADIOSITY_SEQUENCE_H

#include <stdint.h>

// Sample numbers in [0, 1) that depend on the arguments alone.

// Coordinates 0 to 3 of point `index` of Sobol's sequence, scrambled as Owen's (1995)
// nested permutations do (by the hash of Laine and Karras 2011). `seed` names the
// scrambling; every prefix of 2^k points stays well spread.
void sobol_point(uint32_t index, uint32_t seed, double out[4]);
// Pseudo-random numbers.
void random_point(uint32_t index, uint32_t seed, double out[4]);

uint32_t sequence_seed(uint32_t a, uint32_t b);

#endif
