#ifndef SCENE_SHAPES_QUADRIC_H
#define SCENE_SHAPES_QUADRIC_H

#include "math/aabb.h"
#include "math/vec.h"

// With q = p - centre: xx q.x^2 + yy q.y^2 + zz q.z^2 + xy q.x q.y + xz q.x q.z +
// yz q.y q.z + linear.q + constant <= 0. Central quadrics have linear == 0, and the
// largest coefficient is between 1 and 2.
struct quadric {
    struct vec3 centre;
    double xx, yy, zz, xy, xz, yz;
    struct vec3 linear;
    double constant;
};

// A box of what is inside the quadric and the box, which may have no end, larger by the share
// `slack` of the numbers it comes from; the box itself where terms are mixed.
struct aabb quadric_bounds_within(const struct quadric *s, struct aabb box, double slack);

#endif
