#ifndef SCENE_SHAPES_SUPERELLIPSOID_H
#define SCENE_SHAPES_SUPERELLIPSOID_H

#include "scene/shape_kernels.h"

struct superellipsoid {
    double p, q; // 2/e and 2/n
    double e, n;
};

// As shape_kernels.superellipsoid.
#define SUPERELLIPSOID_CLOSEST8(isa)                                                     \
    unsigned superellipsoid_closest8_##isa(                                              \
        const struct superellipsoid *s, const struct shape_rays *rays, unsigned lanes,   \
        bool any, struct shape_hits *out);
SUPERELLIPSOID_CLOSEST8(base)
SUPERELLIPSOID_CLOSEST8(avx2)
SUPERELLIPSOID_CLOSEST8(avx512)
#undef SUPERELLIPSOID_CLOSEST8

// As shape_kernels.superellipsoid_samples.
#define SUPERELLIPSOID_SAMPLES8(isa)                                                     \
    void superellipsoid_samples8_##isa(const struct superellipsoid *s, struct vec3 o,    \
                                       struct vec3 u, const double t[8], double f[8],    \
                                       double slope[8]);
SUPERELLIPSOID_SAMPLES8(base)
SUPERELLIPSOID_SAMPLES8(avx2)
SUPERELLIPSOID_SAMPLES8(avx512)
#undef SUPERELLIPSOID_SAMPLES8

#endif
