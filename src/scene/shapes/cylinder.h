#ifndef SCENE_SHAPES_CYLINDER_H
#define SCENE_SHAPES_CYLINDER_H

#include <stdbool.h>

#include "scene/shapes/frame.h"

// In the frame: x*x + y*y <= radius*radius, 0 <= z <= length.
struct cylinder {
    struct frame frame;    // origin: the first end; e3: towards the second
    double length, radius; // > 0
    bool open;
};

enum { CYLINDER_SIDE, CYLINDER_BASE, CYLINDER_TOP }; // boundary.part

#endif
