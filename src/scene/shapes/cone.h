#ifndef SCENE_SHAPES_CONE_H
#define SCENE_SHAPES_CONE_H

#include <stdbool.h>

#include "scene/shapes/frame.h"

// In the frame: x*x + y*y <= (r0 + slope*z)^2, 0 <= z <= length.
struct cone {
    struct frame frame;           // origin: the first end; e3: towards the second
    double length, r0, r1, slope; // slope = (r1 - r0)/length
    bool open;
};

enum { CONE_SIDE, CONE_BASE, CONE_TOP }; // boundary.part

#endif
