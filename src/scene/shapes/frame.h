#ifndef SCENE_SHAPES_FRAME_H
#define SCENE_SHAPES_FRAME_H

#include "math/transform.h"

// The coordinate frame of a shape around an axis (cylinder, cone, disc).
struct frame {
    struct vec3 origin;
    struct vec3 e1, e2, e3; // orthonormal; e3 is the axis
};

struct frame frame_around(struct vec3 origin, struct vec3 axis);
// Moves the frame by an angle-keeping map.
void frame_transform(struct frame *f, const struct transform *t);

static inline struct vec3 frame_coordinates(const struct frame *f, struct vec3 v)
{
    return vec3(vec3_dot(f->e1, v), vec3_dot(f->e2, v), vec3_dot(f->e3, v));
}

static inline struct vec3 frame_vector(const struct frame *f, double x, double y,
                                       double z)
{
    return vec3(f->e1.x * x + f->e2.x * y + f->e3.x * z,
                f->e1.y * x + f->e2.y * y + f->e3.y * z,
                f->e1.z * x + f->e2.z * y + f->e3.z * z);
}

#endif
