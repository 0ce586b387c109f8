#ifndef TRACE_PAINT_H
#define TRACE_PAINT_H

#include "scene/texture.h"
#include "trace/tracer.h"

// Hits that are shaded one by one (trace/shade.c) have their textures evaluated eight hits
// of a surface at a time before: the plain textures of maps, with their weights, and of
// each the colours and normals of its layers, with the bits and in the order of
// texture_walk and layer_eval.
struct painted {
    struct vec3 n;
    struct rgbft color;
    bool found; // as pigment_color returns
};

// One plain texture at a hit. Layers below opaque ones are not set.
struct paint_part {
    const struct texture *texture;
    double weight;
    const struct painted *layer;
};

struct paint_texture {
    const struct texture *texture;
    const struct pigment_tape *const *tape; // of a plain one's layers; NULL: one colour
    const struct paint_texture *entry;      // of a map
};

struct paint_surface {
    uint32_t number;                 // of its list of hits
    const struct paint_texture *top; // NULL: its hits are not painted
};

// The most at one hit.
enum { PAINT_LAYERS = 16, PAINT_PARTS = 8 };

void paint_compile(struct job *job, struct arena *a);
void paint_init(struct tracer *t);
void paint_end(struct tracer *t);
// Keeps the hit of ray k of the batch if its surface is painted.
bool paint_take(struct tracer *t, uint32_t k);
// Shades the hits that were kept.
void paint_shade(struct tracer *t);

#endif
