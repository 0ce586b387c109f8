#ifndef SCENE_SHAPES_PARAMETRIC_H
#define SCENE_SHAPES_PARAMETRIC_H

#include <stdatomic.h>

#include "scene/shapes/container.h"
#include "scene/tape.h"

// Private to parametric*.c.

// A rectangle of (u, v) with bounds of the surface over it. Children are made when a ray
// first comes there, eight at a time; what they hold depends on their place alone.
struct uv_cell {
    double u[2], v[2];
    double middle[3];     // the point of the middle
    float box[3][2];      // of the surface
    float slope[2][3][2]; // bounds of d(x, y, z) by u, by v
    bool leaf, flat;      // flat: the slopes hardly turn
    _Atomic(struct uv_cell *) child;
};

struct parametric {
    const struct tape *f[3];
    struct vec2 low, high; // of (u, v)
    double accuracy, max_gradient;
    struct container container;
    struct aabb bounds;
    bool opaque; // one of the functions has no bounds
    struct uv_cell *root;
};

struct uv_cell *uv_tree_new(struct arena *a, const struct parametric *p);
struct uv_cell *uv_children(const struct parametric *p, struct uv_cell *cell, int depth);
// The point, and if wanted its derivatives by u and v.
struct vec3 uv_point(const struct parametric *p, double u, double v, struct vec3 *by_u,
                     struct vec3 *by_v);

#endif
