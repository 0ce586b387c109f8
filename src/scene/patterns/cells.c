// cells: a random value for each unit cube

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return noise_random(noise_cell_hash(floor(at.x + PATTERN_EDGE),
                                        floor(at.y + PATTERN_EDGE),
                                        floor(at.z + PATTERN_EDGE)));
}

const struct pattern_ops cells_pattern_ops = {
    .keyword = "cells", .frequency = 1, .value = value};
