#ifndef SCENE_SHAPES_ISOSURFACE_LANES_H
#define SCENE_SHAPES_ISOSURFACE_LANES_H

#include "scene/shape_kernels.h"

// As shape_kernels.isosurface.
#define ISO_CLOSEST8(isa)                                                                \
    unsigned iso_closest8_##isa(const struct isosurface *s,                              \
                                const struct shape_rays *rays, unsigned lanes, bool any, \
                                struct shape_hits *out);
ISO_CLOSEST8(base)
ISO_CLOSEST8(avx2)
ISO_CLOSEST8(avx512)
#undef ISO_CLOSEST8

#endif
