#ifndef IMAGE_DITHER_H
#define IMAGE_DITHER_H

#include <stdint.h>

#include "image/image.h"

// Rounding to few levels without bands: by a matrix of thresholds (Bayer's), or by handing
// on the error of each sample to those that follow: to the next one (D1), half to the next
// and half to the one below (D2), or to four of them (Floyd and Steinberg, "An adaptive
// algorithm for spatial greyscale", 1976).
struct dither;
// For rows of `width` pixels of up to 3 channels, asked for from left to right and from the
// top. NULL: out of memory.
struct dither *dither_new(enum dither_method method, int width);
void dither_free(struct dither *d);
// The code of a sample worth v codes, 0 to max.
uint16_t dither_code(struct dither *d, int x, int y, int channel, double v, double max);

#endif
