#ifndef SCENE_SHAPES_OVUS_H
#define SCENE_SHAPES_OVUS_H

#include "scene/shape_kernels.h"

// (rho + h)^2 + (y - v)^2 = r^2, rho the distance from the axis.
struct ovus_part {
    double h, v, r;
};

enum { OVUS_BOTTOM, OVUS_ARC, OVUS_TOP, OVUS_PARTS };

struct ovus {
    double bottom, top; // as written
    struct ovus_part part[OVUS_PARTS];
    double joint[2]; // the heights between the parts
    struct {
        double y, r;
    } around; // a ball that holds the egg
};

// As shape_kernels.ovus.
#define OVUS_CLOSEST8(isa)                                                               \
    unsigned ovus_closest8_##isa(const struct ovus *s, const struct shape_rays *rays,    \
                                 unsigned lanes, struct shape_hits *out);
OVUS_CLOSEST8(base)
OVUS_CLOSEST8(avx2)
OVUS_CLOSEST8(avx512)
#undef OVUS_CLOSEST8

#endif
