#ifndef TRACE_TILE_H
#define TRACE_TILE_H

#include "image/image.h"
#include "trace/antialias.h"
#include "trace/lens.h"
#include "trace/tracer.h"

struct tile_place {
    uint16_t x, y; // from the tile's corner
};

// Worked out once for all tiles.
struct tile_tables {
    struct jitter_tables jitter;
    struct antialias_seams seams; // of method 1
    struct lens lens;             // of a camera that has one
    struct tile_place *place;     // the pixels of a whole tile in Morton order
    uint16_t *by_row;             // of each BATCH_SIZE of them, the order of their rows
    uint32_t place_count;
};

void tile_tables_init(struct tile_tables *t, struct arena *a, const struct job *job);

// Renders the pixels of a tile into the picture.
void tile_render(struct tracer *t, const struct tile_tables *tables,
                 const struct render_tile *tile, struct image *out);

#endif
