#ifndef TESTS_STABILITY_LOADED_H
#define TESTS_STABILITY_LOADED_H

#include <stdbool.h>

#include "base/arena.h"
#include "eval/eval.h"
#include "image/image.h"
#include "trace/intersect.h"
#include "trace/render.h"

// A scene text ready to be traced.
struct loaded {
    struct arena *arena;
    struct scene scene;
    struct world *world;
    struct trace_scratch *scratch;
};

// Stops the test when the text has errors; diagnostics go to standard output. The text
// comes after a #version and a global_settings with assumed_gamma 1.
void load(struct loaded *l, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void unload(struct loaded *l);

// The nearest surface on the ray from o along d, which need not be a unit vector.
struct hit shoot(struct loaded *l, struct vec3 o, struct vec3 d, struct interaction *at);

enum { PICTURE_SIZE = 64 };
// A square RGB picture of the scene, linear.
struct image render_picture(const struct loaded *l, int threads, int tile_size);
// The largest difference of two pictures' channels in units of 1/255, each clipped to
// 0..1 and rounded as for a file.
int picture_difference(const struct image *a, const struct image *b);

// A font that this machine has; NULL: none.
const char *font_file(void);

#endif
