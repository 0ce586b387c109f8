#ifndef SCENE_SHAPES_POLYGON_H
#define SCENE_SHAPES_POLYGON_H

#include "scene/shape_kernels.h"

struct polygon {
    struct vec3 *point; // as written, the last loop closed
    bool *last;         // the point ends its loop: no edge goes on from it
    uint32_t count;
    struct vec3 normal, origin;
    int u, v; // the axes of the projection in which points are counted
    bool drawn;
};

// As shape_ops.closest8.
#define POLYGON_CLOSEST8(isa)                                                            \
    unsigned polygon_closest8_##isa(const struct polygon *s,                             \
                                    const struct shape_rays *rays, unsigned lanes,       \
                                    struct shape_hits *out);
POLYGON_CLOSEST8(base)
POLYGON_CLOSEST8(avx2)
POLYGON_CLOSEST8(avx512)
#undef POLYGON_CLOSEST8

#endif
