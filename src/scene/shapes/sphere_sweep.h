#ifndef SCENE_SHAPES_SPHERE_SWEEP_H
#define SCENE_SHAPES_SPHERE_SWEEP_H

#include "scene/shape_kernels.h"

enum sweep_spline { SPLINE_LINEAR, SPLINE_B, SPLINE_CUBIC };

struct sweep_ball {
    struct vec3 c;
    double r;
};

// Ascending powers of u; the ball `around` holds the segment.
struct sweep_segment {
    struct vec3 c[4];
    double r[4];
    int degree;
    struct sweep_ball around;
    bool empty; // a curve: all radii are zero
};

struct sweep {
    enum sweep_spline spline;
    struct sweep_ball *ball; // as written
    long count;
    struct sweep_segment *segment;
    uint32_t segments;
    struct aabb bounds;
};

// A segment whose `around` a ray meets, from this t of the ray on.
struct sweep_near {
    uint32_t segment;
    double from;
};

// The first crossing with t_min < t <= t_max of the ray among `count` segments, which are all
// that reach into that range and become sorted. False: there is none; *odd is set where there
// are too many to tell.
bool sweep_first(const struct sweep *s, const struct ray *ray, struct sweep_near *near,
                 uint32_t count, struct boundary *out, bool *odd);

// As shape_ops.closest8. Lanes that are `odd` are for the one line's crossings.
#define SWEEP_CLOSEST8(isa)                                                              \
    unsigned sweep_closest8_##isa(const struct sweep *s, const struct shape_rays *rays,  \
                                  unsigned lanes, struct shape_hits *out,                \
                                  unsigned *odd);
SWEEP_CLOSEST8(base)
SWEEP_CLOSEST8(avx2)
SWEEP_CLOSEST8(avx512)
#undef SWEEP_CLOSEST8

#endif
