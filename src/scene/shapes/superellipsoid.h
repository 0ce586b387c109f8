#ifndef SCENE_SHAPES_SUPERELLIPSOID_H
#define SCENE_SHAPES_SUPERELLIPSOID_H

#include "scene/shape_kernels.h"

// Of a p-norm; p is 2^squares, or squares is -1.
struct exponent {
    double p;
    int squares;
};

struct superellipsoid {
    struct exponent p, q; // 2/e and 2/n
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

// Whether a line has at most two crossings.
bool superellipsoid_is_convex(const struct superellipsoid *s);

// Where eight lines enter such a one, k = 0, and leave it: as `intersect` has it, and |cosine| of
// the normal to the line there, times the length of d.
struct superellipsoid_ends {
    double t[2][8], dt[2][8], slope[2][8];
};
// Returns those of `lanes` that cross it.
#define SUPERELLIPSOID_ENDS8(isa)                                                        \
    unsigned superellipsoid_ends8_##isa(const struct superellipsoid *s,                  \
                                        const struct shape_rays *rays, unsigned lanes,   \
                                        struct superellipsoid_ends *out);
SUPERELLIPSOID_ENDS8(base)
SUPERELLIPSOID_ENDS8(avx2)
SUPERELLIPSOID_ENDS8(avx512)
#undef SUPERELLIPSOID_ENDS8
// Appends the two crossings of a lane.
void superellipsoid_add_ends(const struct superellipsoid_ends *e, int lane,
                             struct boundary_list *out);

// As shape_kernels.superellipsoid_samples.
#define SUPERELLIPSOID_SAMPLES8(isa)                                                     \
    void superellipsoid_samples8_##isa(const struct superellipsoid *s, struct vec3 o,    \
                                       struct vec3 u, const double t[8], double f[8],    \
                                       double slope[8]);
SUPERELLIPSOID_SAMPLES8(base)
SUPERELLIPSOID_SAMPLES8(avx2)
SUPERELLIPSOID_SAMPLES8(avx512)
#undef SUPERELLIPSOID_SAMPLES8

// Eight lines o + t u on which F crosses zero, once or more, between two places; t: where to
// begin, afterwards a root, near which F has that slope. Lanes that are not asked hold numbers.
struct superellipsoid_roots {
    double o[3][8], u[3][8], outside[8], inside[8], t[8], slope[8];
};

// As shape_kernels.superellipsoid_roots.
#define SUPERELLIPSOID_ROOTS8(isa)                                                       \
    void superellipsoid_roots8_##isa(const struct superellipsoid *s, unsigned lanes,     \
                                     struct superellipsoid_roots *r);
SUPERELLIPSOID_ROOTS8(base)
SUPERELLIPSOID_ROOTS8(avx2)
SUPERELLIPSOID_ROOTS8(avx512)
#undef SUPERELLIPSOID_ROOTS8

// As shape_kernels.superellipsoid_least.
#define SUPERELLIPSOID_LEAST8(isa)                                                       \
    void superellipsoid_least8_##isa(const struct superellipsoid *s, struct vec3 o,      \
                                     struct vec3 u, const double t[9], double f[8]);
SUPERELLIPSOID_LEAST8(base)
SUPERELLIPSOID_LEAST8(avx2)
SUPERELLIPSOID_LEAST8(avx512)
#undef SUPERELLIPSOID_LEAST8

#endif
