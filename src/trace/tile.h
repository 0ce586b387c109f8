#ifndef TRACE_TILE_H
#define TRACE_TILE_H

#include "image/image.h"
#include "trace/antialias.h"
#include "trace/lens.h"
#include "trace/tracer.h"

struct tile {
    int x0, y0, x1, y1; // half-open
};

// Worked out once for all tiles.
struct tile_tables {
    struct jitter_tables jitter;
    struct lens lens; // of a camera that has one
};

// Renders the pixels of a tile into the picture.
void tile_render(struct tracer *t, const struct tile_tables *tables,
                 const struct tile *tile, struct image *out);

#endif
