#ifndef SCENE_SHAPES_HEIGHT_FIELD_H
#define SCENE_SHAPES_HEIGHT_FIELD_H

#include <stdbool.h>
#include <stdint.h>

#include "scene/boundary.h"

// Samples at x = i/(width - 1) and z = j/(height - 1): at[j * width + i], 65536 for height 1.
struct heights {
    int width, height;
    float *at;
};

// Lowest and highest value of blocks of 2^level by 2^level cells.
struct height_level {
    int width, height;
    float (*range)[2];
};

enum { HEIGHT_LEVELS = 20 };

struct height_field {
    struct heights h;
    struct height_level level[HEIGHT_LEVELS]; // from 1 on
    int top;
    double low, high, water; // in the shape's space
    bool smooth, under_water;
};

// A line over the field: x and z in cells, y in the shape's space, t from the point
// nearest to the field's middle.
struct height_walk {
    const struct height_field *field;
    double o[3], d[3];
    double shift, length, error, cells;
    bool started, in, sides;     // the state is known; which it is; report where it begins
    bool first_only;             // stop at the first drawn crossing
    double t_min, t_max;
    struct boundary_list *out;
};

#endif
