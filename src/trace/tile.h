#ifndef TRACE_TILE_H
#define TRACE_TILE_H

#include "image/image.h"
#include "trace/antialias.h"
#include "trace/tracer.h"

struct tile {
    int x0, y0, x1, y1; // half-open
};

// Renders the pixels of a tile into the picture.
void tile_render(struct tracer *t, const struct jitter_tables *jitter,
                 const struct tile *tile, struct image *out);

#endif
