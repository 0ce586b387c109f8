#ifndef SCENE_SHAPES_SLABS_H
#define SCENE_SHAPES_SLABS_H

#include <math.h>
#include <stdbool.h>

#include "math/aabb.h"
#include "math/gamma.h"

// A ray against the boxes of a shape's own tree. Boxes are widened by the rounding of the
// tests inside them, which work relative to the origin: a ray that touches a corner must
// not miss its box.
struct slabs {
    struct vec3 o, inv;
    double widen;
};

static inline struct slabs slabs_of(const struct aabb *all, const struct ray *r)
{
    const double size =
        vec3_max_abs(r->o) + vec3_max_abs(all->min) + vec3_max_abs(all->max);
    return (struct slabs){r->o, vec3(1 / r->d.x, 1 / r->d.y, 1 / r->d.z),
                          GAMMA(16) * size};
}

static inline bool slab_meet(double min, double max, double o, double inv, double widen,
                             double *t_min, double *t_max)
{
    min -= widen;
    max += widen;
    if (isinf(inv)) // along the faces: all or nothing
        return o >= min && o <= max;
    const double a = (min - o) * inv, b = (max - o) * inv;
    const double near = a < b ? a : b, far = a < b ? b : a;
    *t_min = near > *t_min ? near : *t_min;
    *t_max = far < *t_max ? far : *t_max;
    return *t_min <= *t_max ||
           *t_min - *t_max <= GAMMA(6) * (fabs(*t_min) + fabs(*t_max));
}

// Whether the ray is in the box somewhere between t_min and t_max; *t is where it enters.
static inline bool slabs_meet(const struct aabb *b, const struct slabs *r, double t_min,
                              double t_max, double *t)
{
    const bool met =
        slab_meet(b->min.x, b->max.x, r->o.x, r->inv.x, r->widen, &t_min, &t_max) &&
        slab_meet(b->min.y, b->max.y, r->o.y, r->inv.y, r->widen, &t_min, &t_max) &&
        slab_meet(b->min.z, b->max.z, r->o.z, r->inv.z, r->widen, &t_min, &t_max);
    *t = t_min;
    return met;
}

#endif
