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
    double inv[3];
    double near[3], far[3]; // the origin, moved for the faces on either side
    int first[3], last[3];  // which numbers of a box those faces are
};

static inline struct slabs slabs_of(const struct aabb *all, const struct ray *r)
{
    const double size =
        vec3_max_abs(r->o) + vec3_max_abs(all->min) + vec3_max_abs(all->max);
    const double widen = GAMMA(16) * size;
    struct slabs s;
    for (int i = 0; i < 3; i++) {
        const double o = vec3_axis(r->o, i);
        s.inv[i] = 1 / vec3_axis(r->d, i);
        const int back = signbit(s.inv[i]) ? 1 : 0;
        s.near[i] = back ? o - widen : o + widen;
        s.far[i] = back ? o + widen : o - widen;
        s.first[i] = back ? 3 + i : i;
        s.last[i] = back ? i : 3 + i;
    }
    return s;
}

// Whether the ray is in the box somewhere between t_min and t_max; *t is where it enters.
// Along a zero direction the faces lie at infinity, or at NaN for an origin just in one,
// which the comparisons let pass.
static inline bool slabs_meet(const struct aabb *box, const struct slabs *r, double t_min,
                              double t_max, double *t)
{
    const double b[6] = {box->min.x, box->min.y, box->min.z,
                         box->max.x, box->max.y, box->max.z};
    for (int i = 0; i < 3; i++) {
        const double near = (b[r->first[i]] - r->near[i]) * r->inv[i];
        const double far = (b[r->last[i]] - r->far[i]) * r->inv[i];
        t_min = near > t_min ? near : t_min;
        t_max = far < t_max ? far : t_max;
    }
    *t = t_min;
    return t_min <= t_max || t_min - t_max <= GAMMA(6) * (fabs(t_min) + fabs(t_max));
}

#endif
