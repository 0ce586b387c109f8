#ifndef MATH_LANES_BITS_H
#define MATH_LANES_BITS_H

// The bits of eight doubles as numbers. They go by way of arrays, which compilers keep in
// registers.
#include <stdint.h>
#include <string.h>

#include "math/lanes.h"

typedef double bits_real8 __attribute__((vector_size(64)));
typedef int64_t bits_int8 __attribute__((vector_size(64)));
typedef uint64_t bits_uint8 __attribute__((vector_size(64)));

#define BITS_BIG      0x1.8p52           // whole numbers appear in the last bits
#define BITS_BIG_BITS 0x4338000000000000 // its own bits

// 2^k for whole k, where that is normal.
LANES_INLINE struct real8 r8_power_of_two(struct real8 k)
{
    double v[8];
    bits_real8 whole;
    r8_store(v, k);
    memcpy(&whole, v, sizeof v);
    const bits_real8 power =
        (bits_real8)(((bits_int8)(whole + BITS_BIG) - BITS_BIG_BITS + 1023) << 52);
    memcpy(v, &power, sizeof v);
    return r8_load(v);
}

#endif
