#ifndef SCENE_SHAPES_SPHERE_H
#define SCENE_SHAPES_SPHERE_H

#include "math/transform.h"
#include "math/vec.h"

struct sphere {
    struct vec3 centre;
    double radius;     // > 0
    struct mat3 to_uv; // turns a direction back into the sphere's own frame
};

#endif
