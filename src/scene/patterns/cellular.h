#ifndef SCENE_PATTERNS_CELLULAR_H
#define SCENE_PATTERNS_CELLULAR_H

#include <stdlib.h>

#include "scene/pattern_math.h"

// The cells around one that can hold a near point: those whose offsets have at most
// one component of magnitude 2 (spec/textures 5.3).
static inline bool cellular_counts(int dx, int dy, int dz)
{
    return (abs(dx) == 2) + (abs(dy) == 2) + (abs(dz) == 2) <= 1;
}

enum { CELLULAR_REACH = 2 };

#endif
