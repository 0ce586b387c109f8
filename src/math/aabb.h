#ifndef MATH_AABB_H
#define MATH_AABB_H

#include <stdbool.h>

#include "math/transform.h"
#include "math/vec.h"

// Closed box; min > max on any axis means empty. Infinite shapes have infinite
// bounds on the axes on which they are infinite.
struct aabb {
    struct vec3 min, max;
};

struct aabb aabb_empty(void);
struct aabb aabb_infinite(void);
struct aabb aabb_join(struct aabb a, struct aabb b);
struct aabb aabb_meet(struct aabb a, struct aabb b);
struct aabb aabb_add(struct aabb a, struct vec3 p);
// Around the centre moved by t, `half` the extents along the axes after it; grown by what
// their rounding (a few operations) may be off.
struct aabb aabb_around(struct vec3 centre, const double half[3],
                        const struct transform *t);
struct aabb aabb_transform(struct aabb a, const struct transform *t);
bool aabb_is_empty(struct aabb a);
bool aabb_is_finite(struct aabb a);
bool aabb_overlap(struct aabb a, struct aabb b);
// Grown by a few roundings of its own coordinates, so that a box computed in
// floating point still holds what it bounds.
struct aabb aabb_pad(struct aabb a);

#endif
