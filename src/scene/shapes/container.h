#ifndef SCENE_SHAPES_CONTAINER_H
#define SCENE_SHAPES_CONTAINER_H

#include "scene/shape.h"
#include "scene/shapes/box.h"
#include "scene/shapes/sphere.h"

struct args;

// contained_by { box { A, B } } or { sphere { C, r } }: where an isosurface or a
// parametric surface is looked for.
struct container {
    const struct shape_ops *ops; // box_ops or sphere_ops
    union {
        struct box box;
        struct sphere sphere;
    } shape;
};

struct container container_default(void); // box { -1, 1 }
// If the next item is contained_by, reads it; false: it is not.
bool container_read(struct args *a, struct container *c);
struct aabb container_bounds(const struct container *c);
void container_print(const struct container *c, FILE *out); // with contained_by

// If the next item is `word` and a number, reads it. A value that is not positive gives
// a warning and the default.
bool container_hint(struct args *a, const char *word, double preset, double *out);

#endif
