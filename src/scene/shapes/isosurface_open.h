#ifndef SCENE_SHAPES_ISOSURFACE_OPEN_H
#define SCENE_SHAPES_ISOSURFACE_OPEN_H

#include <stdbool.h>

// Whether an isosurface lacks faces where its container ends.
bool isosurface_is_open(const void *shape);

#endif
