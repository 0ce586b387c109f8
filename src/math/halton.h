#ifndef MATH_HALTON_H
#define MATH_HALTON_H

#include <stdint.h>

// The fraction whose digits in this base are those of n, mirrored (van der Corput; points
// of two bases are Halton's, 1960). halton(0, base) is 0.
static inline double halton(uint32_t n, uint32_t base)
{
    double v = 0, part = 1.0 / base;
    for (; n > 0; n /= base) {
        v += part * (n % base);
        part /= base;
    }
    return v;
}

#endif
