#ifndef SCENE_DENSITY_GRID_H
#define SCENE_DENSITY_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// The samples of a df3 file: unsigned, big-endian, x fastest, then y, then z.
struct density_grid {
    uint32_t size[3];
    uint32_t width; // bytes per sample: 1, 2 or 4
    const uint8_t *sample;
};

// Points into data, which must outlive it. False: the length does not fit the sizes.
bool density_grid_init(struct density_grid *g, const uint8_t *data, size_t size);
// 0 to 1; the indices must be inside.
double density_grid_at(const struct density_grid *g, uint32_t x, uint32_t y, uint32_t z);

#endif
