#ifndef SCENE_SHAPES_PLANE_H
#define SCENE_SHAPES_PLANE_H

#include "math/vec.h"

// The half space normal.(p - point) <= 0.
struct plane {
    struct vec3 normal; // unit
    struct vec3 point;  // on the plane
};

#endif
