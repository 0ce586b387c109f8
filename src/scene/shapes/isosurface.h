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
// The root of the cells, which isosurfaces share that differ in none of what decides them;
// *trees: those of the scene.
struct iso_cell *iso_tree_of(const struct isosurface *s, struct arena *a, void **trees);

static inline struct aabb iso_child_box(const struct aabb *box, const struct vec3 *m,
                                        int octant)
{
    struct aabb b = *box;
    *(octant & 1 ? &b.min.x : &b.max.x) = m->x;
    *(octant & 2 ? &b.min.y : &b.max.y) = m->y;
    *(octant & 4 ? &b.min.z : &b.max.z) = m->z;
    return b;
}

static inline double iso_value(const struct isosurface *s, struct vec3 p)
{
    double v;
    tape_run(s->f, (const double[]){p.x, p.y, p.z}, &v);
    return v - s->threshold;
}

// As shape_ops.intersect.
void iso_walk(const struct isosurface *s, const struct ray *ray,
              struct boundary_list *out);

enum {
    ISO_EVALUATIONS_MAX =
        20000, // of one ray: past this stretches are decided by their ends
    ISO_REFINE_MAX = 80,
    ISO_ERROR_TRIES = 6,
};
// A stretch this small a share of the chord, or of its t's rounding, is not cut.
#define ISO_SHORTEST 0x1p-40
// Where the function jumps or its slope has no bound nothing better is known.
#define ISO_SHORTEST_JUMP 0x1p-20
// An error bound this small a share of the chord is good enough.
#define ISO_ERROR_GOOD 0x1p-36

// Faces of the container are parts 1 + the container's own.
enum { ISO_SURFACE = 0, ISO_CONTAINER = 1 };

#endif
