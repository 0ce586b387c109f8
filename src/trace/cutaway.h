#ifndef TRACE_CUTAWAY_H
#define TRACE_CUTAWAY_H

#include "math/transform.h"
#include "scene/object.h"

// An attached texture in the world.
struct placed_texture {
    const struct texture *texture; // NULL: none
    struct transform transform;
};

// cutaway_textures: a cutter without a texture shows those of the parts that it cuts
// (spec/shapes 3.6).
struct cutaway {
    const struct object *object;   // the outermost node above the cutter
    struct transform world;        // from the space outside it
    struct placed_texture texture; // what it inherits; NULL: none
};

// Calls `see` with each texture that counts at a point (world space), its place in the
// world and its weight; the weights sum to 1, or nothing is called.
typedef void cutaway_function(void *user, const struct texture *x,
                              const struct transform *place, double weight);
void cutaway_textures(const struct cutaway *c, struct vec3 p, cutaway_function *see,
                      void *user);

#endif
