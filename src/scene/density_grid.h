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
    double level[256]; // of samples of one byte, 0 to 1
};

// Points into data, which must outlive it. False: the length does not fit the sizes.
bool density_grid_init(struct density_grid *g, const uint8_t *data, size_t size);
// A sample as it stands, 0 to density_grid_most; the indices must be inside.
static inline uint32_t density_grid_raw(const struct density_grid *g, size_t at)
{
    const uint8_t *b = g->sample + at * g->width;
    uint32_t v = b[0];
    for (uint32_t i = 1; i < g->width; i++)
        v = v << 8 | b[i];
    return v;
}
static inline double density_grid_most(const struct density_grid *g)
{
    return UINT32_MAX >> (32 - 8 * g->width);
}
// 0 to 1.
static inline double density_grid_sample(const struct density_grid *g, size_t at)
{
    return density_grid_raw(g, at) / density_grid_most(g);
}
// The number of a sample.
static inline size_t density_grid_place(const struct density_grid *g, uint32_t x,
                                        uint32_t y, uint32_t z)
{
    return ((size_t)z * g->size[1] + y) * g->size[0] + x;
}

#endif
