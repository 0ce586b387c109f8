#ifndef SCENE_SHAPES_PATCH_LANES_H
#define SCENE_SHAPES_PATCH_LANES_H

#include "scene/shape_kernels.h"

// As shape_kernels.patch.
#define PATCH_CLOSEST8(isa)                                                              \
    unsigned patch_closest8_##isa(const struct patch *p, const struct shape_rays *rays,  \
                                  unsigned lanes, bool any, struct shape_hits *out);
PATCH_CLOSEST8(base)
PATCH_CLOSEST8(avx2)
PATCH_CLOSEST8(avx512)
#undef PATCH_CLOSEST8

#endif
