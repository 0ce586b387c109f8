#ifndef SCENE_SHAPES_HEIGHT_FIELD_H
#define SCENE_SHAPES_HEIGHT_FIELD_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"
#include "scene/boundary.h"

#define HEIGHT_UNIT 65536. // value of height 1

// Samples at x = i/(width - 1) and z = j/(height - 1): at[j * width + i].
struct heights {
    int width, height;
    float *at;
};

// Lowest and highest value of blocks of 2^level by 2^level cells.
struct height_level {
    int width, height;
    float (*range)[2];
};

enum { HEIGHT_LEVELS = 32, HEIGHT_LANE_LEVELS = 16 }; // the latter: that lanes take

struct height_field {
    struct heights h;
    struct height_level level[HEIGHT_LEVELS]; // from 1 on
    int top;
    // All levels' ranges lie in one array, for lanes: where a level begins, its width.
    float (*ranges)[2];
    double level_from[HEIGHT_LEVELS], level_width[HEIGHT_LEVELS];
    double low, high, water; // in the shape's space
    double (
        *normal)[3]; // of `smooth`, at the samples; NULL: too many, made when asked for
    bool smooth, under_water;
};

// A line over the field: x and z in cells, y in the shape's space, t from the point
// nearest to the field's middle.
struct height_walk {
    const struct height_field *field;
    double o[3], d[3];
    double shift, length, error, cells;
    bool started, in, sides; // the state is known; which it is; report where it begins
    int ends[2];             // the axis of the sides where the stretch begins and ends
    struct boundary_list *out;
};

#endif
