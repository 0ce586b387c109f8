#ifndef IMAGE_PACK_H
#define IMAGE_PACK_H

#include <stddef.h>
#include <stdint.h>

// The rows of a picture as a PNG file has them, packed fast.
struct pixel_rows {
    const uint8_t *data; // each row after a byte that tells its filter
    size_t row, pixel;   // bytes of a row without that one, and of a pixel
    size_t height;
};

// The zlib stream (RFC 1950) of the rows, to be freed; NULL: out of memory.
uint8_t *pack_pixels(const struct pixel_rows *rows, size_t *size);

#endif
