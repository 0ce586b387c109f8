#ifndef SCENE_SHAPES_DISC_H
#define SCENE_SHAPES_DISC_H

#include "math/vec.h"

// The half space below the plane through centre; drawn where hole <= distance <= radius.
struct disc {
    struct vec3 centre, normal; // unit
    double radius, hole;
};

#endif
