#include "scene/shapes/frame.h"

// Duff et al., Building an Orthonormal Basis, Revisited (JCGT 2017): the sign keeps
// the denominator away from zero.
struct frame frame_around(struct vec3 origin, struct vec3 axis)
{
    const struct vec3 n = vec3_normalize(axis);
    const double sign = copysign(1, n.z);
    const double a = -1 / (sign + n.z);
    const double b = n.x * n.y * a;
    return (struct frame){
        .origin = origin,
        .e1 = vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        .e2 = vec3(b, sign + n.y * n.y * a, -n.y),
        .e3 = n,
    };
}

void frame_transform(struct frame *f, const struct transform *t)
{
    f->origin = transform_point(t, f->origin);
    f->e1 = vec3_normalize(transform_vector(t, f->e1));
    f->e2 = vec3_normalize(transform_vector(t, f->e2));
    f->e3 = vec3_normalize(transform_vector(t, f->e3));
}
