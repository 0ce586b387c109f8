#ifndef SCENE_SHAPES_JULIA_LANES_H
#define SCENE_SHAPES_JULIA_LANES_H

#include "scene/shape_kernels.h"

// As shape_kernels.julia.
#define JULIA_CLOSEST8(isa)                                                              \
    unsigned julia_closest8_##isa(const struct julia *j, const struct shape_rays *rays,  \
                                  unsigned lanes, bool any, struct shape_hits *out);
JULIA_CLOSEST8(base)
JULIA_CLOSEST8(avx2)
JULIA_CLOSEST8(avx512)
#undef JULIA_CLOSEST8

#endif
