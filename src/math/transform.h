#ifndef MATH_TRANSFORM_H
#define MATH_TRANSFORM_H

#include <stdbool.h>

#include "math/vec.h"

struct mat3 {
    double m[3][3]; // row vectors, as the scene language writes them: p' = p * M
};

// An affine map and its inverse: p' = p * linear + offset. The inverse is
// applied as (p' - offset) * inverse, so that a far-away object keeps its
// digits (research, 4.6). `identity` lets callers skip the work.
struct transform {
    struct mat3 linear, inverse;
    struct vec3 offset;
    bool identity;
};

extern const struct transform transform_identity;

struct transform transform_translate(struct vec3 by);
struct transform transform_scale(struct vec3 by);       // no component may be zero
struct transform transform_rotate(struct vec3 degrees); // about x, then y, then z
struct transform transform_rotate_axis(struct vec3 axis, double radians);
// Rows 0-2 linear, row 3 offset. False when singular.
bool transform_matrix(const double rows[4][3], struct transform *out);
struct transform transform_then(const struct transform *first,
                                const struct transform *second);
struct transform transform_invert(const struct transform *t);

// Whether the map keeps all angles (rotation, reflection, equal scaling), up to the
// rounding of a chain of rotations; then *scale is its factor, exactly 1 for a
// rotation.
bool transform_is_similarity(const struct transform *t, double *scale);
bool transform_is_diagonal(const struct transform *t); // translation and scaling only

struct vec3 transform_point(const struct transform *t, struct vec3 p);
struct vec3 transform_vector(const struct transform *t, struct vec3 v);
struct vec3 transform_normal(const struct transform *t, struct vec3 n); // not normalised
struct vec3 transform_inverse_point(const struct transform *t, struct vec3 p);
struct vec3 transform_inverse_vector(const struct transform *t, struct vec3 v);
struct vec3 transform_inverse_normal(const struct transform *t, struct vec3 n);
// The same ray in object space: t keeps its meaning, d is not normalised.
struct ray transform_inverse_ray(const struct transform *t, const struct ray *r);

#endif
