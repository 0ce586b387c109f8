#ifndef SCENE_SHAPES_POLY_LANES_H
#define SCENE_SHAPES_POLY_LANES_H

#include "scene/shape_kernels.h"

// As shape_kernels.poly.
#define POLY_CLOSEST8(isa)                                                               \
    unsigned poly_closest8_##isa(const struct poly *s, const struct shape_rays *rays,    \
                                 unsigned lanes, bool any, struct shape_hits *out);
POLY_CLOSEST8(base)
POLY_CLOSEST8(avx2)
POLY_CLOSEST8(avx512)
#undef POLY_CLOSEST8

// As shape_kernels.poly_lines.
#define POLY_LINES8(isa)                                                                 \
    unsigned poly_lines8_##isa(const struct poly *s, const struct shape_rays *rays,      \
                               unsigned lanes, struct shape_lines *out);
POLY_LINES8(base)
POLY_LINES8(avx2)
POLY_LINES8(avx512)
#undef POLY_LINES8

#endif
