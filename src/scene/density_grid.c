#include "scene/density_grid.h"

#define HEADER 6 // three sizes of 16 bits

bool density_grid_init(struct density_grid *g, const uint8_t *data, size_t size)
{
    if (size < HEADER)
        return false;
    for (int i = 0; i < 3; i++)
        g->size[i] = (uint32_t)(data[2 * i] << 8 | data[2 * i + 1]);
    // Below 2^48, so that four times it cannot overflow.
    const uint64_t count = (uint64_t)g->size[0] * g->size[1] * g->size[2];
    g->sample = data + HEADER;
    for (int i = 0; i < 256; i++)
        g->level[i] = i / 255.0;
    for (g->width = 4; g->width; g->width /= 2)
        if (count && size - HEADER == count * g->width)
            return true;
    return false;
}
