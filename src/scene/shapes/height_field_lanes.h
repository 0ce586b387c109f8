#ifndef SCENE_SHAPES_HEIGHT_FIELD_LANES_H
#define SCENE_SHAPES_HEIGHT_FIELD_LANES_H

#include "scene/shape_kernels.h"

// As shape_kernels.height_field.
#define HEIGHT_CLOSEST8(isa)                                                             \
    unsigned height_closest8_##isa(const struct height_field *f,                         \
                                   const struct shape_rays *rays, unsigned lanes,        \
                                   bool any, struct shape_hits *out);
HEIGHT_CLOSEST8(base)
HEIGHT_CLOSEST8(avx2)
HEIGHT_CLOSEST8(avx512)
#undef HEIGHT_CLOSEST8

#endif
