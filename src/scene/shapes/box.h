#ifndef SCENE_SHAPES_BOX_H
#define SCENE_SHAPES_BOX_H

#include "math/vec.h"

struct box {
    struct vec3 min, max; // min <= max; equal is allowed: a flat box
};

#endif
