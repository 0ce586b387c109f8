#ifndef TRACE_PAINT_H
#define TRACE_PAINT_H

#include "scene/texture.h"
#include "trace/tracer.h"

// Layers of hits that are shaded one by one (trace/shade.c), evaluated eight hits of a
// surface at a time before: their colours and normals, with the bits of layer_eval. What
// is not known is evaluated there.
struct painted {
    struct vec3 n;
    struct rgbft color;
    bool known;
};

struct paint_surface {
    uint32_t number;      // of its list of hits
    uint32_t layer_count; // 0: its hits are not painted
    const struct pigment_tape *const *tape; // per layer; NULL: one colour
};

enum { PAINT_LAYERS = 8 };

void paint_compile(struct job *job, struct arena *a);
void paint_init(struct tracer *t);
void paint_end(struct tracer *t);
// Keeps the hit of ray k of the batch if its surface is painted.
bool paint_take(struct tracer *t, uint32_t k);
// Shades the hits that were kept.
void paint_shade(struct tracer *t);

#endif
