#ifndef TRACE_LENS_H
#define TRACE_LENS_H

#include "math/vec.h"
#include "scene/camera.h"
#include "trace/antialias.h"

struct arena;

// Focal blur (spec/lighting.md 1.4): where samples lie on the lens, and when a pixel
// has enough of them.
struct lens {
    int count;
    struct vec2 *point; // in a unit square around 0
    double shake;       // how far jitter moves a point
    double *threshold;  // [k]: the variance of the mean at which k samples are enough
    // Where in a pixel samples lie, off its middle: 16 by 16 cells.
    struct vec2 spread[256];
};

void lens_init(struct lens *lens, struct arena *a, const struct camera *c,
               const struct jitter_tables *jitter);
// The batch after `done` samples: how many to take next; 0: all are taken.
int lens_batch(const struct lens *lens, int done);
// Sample s of a pixel: its place in the picture and on the lens (scene units).
void lens_sample(const struct lens *lens, const struct jitter_tables *jitter,
                 const struct camera *c, int px, int py, int s, struct vec2 *place,
                 struct vec2 *on_lens);

#endif
