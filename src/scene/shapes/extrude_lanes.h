#ifndef SCENE_SHAPES_EXTRUDE_LANES_H
#define SCENE_SHAPES_EXTRUDE_LANES_H

#include "scene/shape_kernels.h"

struct transform;

// Outlines swept along an axis or towards the origin (extrude.h), and their union.
struct extrude_solid {
    const struct outline *outline;
    uint32_t count;
    double low, high;
    bool open, conic;
    int axis[3];                  // of the ray, that are (u, v, h)
    const struct transform *tilt; // its own space's, or NULL
};

// As shape_ops.closest8, with the part of outline i in bits 16 and up. Lanes that are `odd`
// are for the one line's crossings.
#define EXTRUDE_CLOSEST8(isa)                                                            \
    unsigned extrude_closest8_##isa(const struct extrude_solid *s,                       \
                                    const struct shape_rays *rays, unsigned lanes,       \
                                    struct shape_hits *out, unsigned *odd);
EXTRUDE_CLOSEST8(base)
EXTRUDE_CLOSEST8(avx2)
EXTRUDE_CLOSEST8(avx512)
#undef EXTRUDE_CLOSEST8

#endif
