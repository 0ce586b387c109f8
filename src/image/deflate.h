#ifndef IMAGE_DEFLATE_H
#define IMAGE_DEFLATE_H

// Zlib streams (RFC 1950) of pictures whose rows are differences: much of them is one byte
// again and again, and the rest is mostly noise. Made for speed.
#include <stddef.h>
#include <stdint.h>

// Allocated, or NULL: out of memory.
uint8_t *deflate_zlib(const uint8_t *data, size_t count, size_t *size);

#endif
