#ifndef SCENE_SHAPES_ISOSURFACE_H
#define SCENE_SHAPES_ISOSURFACE_H

#include <stdatomic.h>

#include "scene/shapes/container.h"
#include "scene/tape.h"

// Private to isosurface*.c.

// The container is halved along each axis again and again where the surface may be. Cells
// are made when a ray first comes there; what they hold depends on their place alone, so
// that the picture does not depend on which ray, of which thread, came first.
enum cell_kind {
    CELL_OUTSIDE, // no surface in it, all outside
    CELL_INSIDE,
    CELL_LEAF,
    CELL_BRANCH,
};

struct iso_cell {
    float slope[3][2]; // bounds of the gradient (LEAF)
    float steepest;    // LEAF of an opaque function: the largest slope assumed
    uint8_t kind;
    _Atomic(struct iso_cell *) child; // eight, x lowest bit (BRANCH); NULL: not made yet
};

struct isosurface {
    const struct tape *f;
    double threshold, accuracy, max_gradient;
    double evaluate[3]; // evaluate[0] > 0: given
    long max_trace;
    bool open;
    struct container container;
    struct aabb bounds;
    struct iso_cell *root;
};

// The eight children, made now if they are not there. Counts evaluations.
struct iso_cell *iso_children(const struct isosurface *s, struct iso_cell *cell,
                              const struct aabb *box, int depth, uint32_t *evaluations);
struct iso_cell *iso_tree_new(struct arena *a);
struct aabb iso_child_box(const struct aabb *box, const struct vec3 *middle, int octant);

static inline double iso_value(const struct isosurface *s, struct vec3 p)
{
    double v;
    tape_run(s->f, (const double[]){p.x, p.y, p.z}, &v);
    return v - s->threshold;
}

// As shape_ops.intersect.
void iso_walk(const struct isosurface *s, const struct ray *ray,
              struct boundary_list *out);

// Faces of the container are parts 1 + the container's own.
enum { ISO_SURFACE = 0, ISO_CONTAINER = 1 };

#endif
