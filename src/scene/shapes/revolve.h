#ifndef SCENE_SHAPES_REVOLVE_H
#define SCENE_SHAPES_REVOLVE_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "math/aabb.h"
#include "scene/boundary.h"
#include "scene/shape_kernels.h"

struct arena;

// A profile turned about the y axis: segments h(w), r^2(w) for 0 <= w <= 1. The solid is
// what lies under the profile by the even-odd rule along the radius; where the profile
// ends away from the axis a flat cap closes the solid, drawn only for sor without `open`.
//
// On a ray, points of height h have squared distance from the axis
// q s^2 + 2 m s + P over Dy^2, s = h - Oy, so a segment is met where one polynomial in w,
// the same function of (r^2, h) for all segments, changes its sign. Neighbours share
// their end points bit for bit, so crossings are even in number.
struct revolve_segment {
    double h[4], r2[8]; // ascending powers of w; the last is room
    int h_degree, r2_degree;
    double h_end[2], r2_end[2]; // at w = 0 and 1, shared with the neighbours
    double low, high, most2; // it lies between these heights, within this radius squared
    bool climbs;             // h rises or falls all the way
    // Bernstein coefficients of h, h^2 and r^2 to one degree, the largest of each's sizes.
    double hull[3][7], most[3];
    int degree;
};

// Neighbouring segments lie between these heights, within this radius squared.
enum { REVOLVE_BLOCK = 16 };
struct revolve_block {
    double low, high, most2;
};

// What a lathe and a sor begin with.
struct revolve {
    struct revolve_segment *segment;
    uint32_t count;
    struct revolve_block *block; // of REVOLVE_BLOCK segments each
    uint32_t blocks;
    bool closed; // the profile ends where it began: no caps
    bool caps_drawn;
    double h_min, h_max, r_max;
};

// boundary.part; v of a segment is its w.
enum { REVOLVE_FIRST_CAP, REVOLVE_LAST_CAP, REVOLVE_SEGMENT };

// Fills bounds and blocks from the segments.
void revolve_prepare(struct revolve *r, struct arena *a);
// Whether every boundary is drawn: there are no caps, or none that is not.
bool revolve_is_closed(const struct revolve *r);
struct aabb revolve_bounds(const struct revolve *r);
bool revolve_inside(const struct revolve *r, struct vec3 p);
void revolve_intersect(const struct revolve *r, const struct ray *ray,
                       struct boundary_list *out);
// Up to this slope a ray is nearly flat.
#define REVOLVE_NEARLY_FLAT 0x1p-14

// closest8 of a lathe and a sor.
unsigned revolve_closest8(const struct shape_kernels *k, const struct shape_ops *ops,
                          const void *shape, const struct shape_rays *rays,
                          unsigned lanes, bool any, struct shape_hits *out);
// Lanes that are `odd` are for the one line's crossings.
#define REVOLVE_CLOSEST8(isa)                                                            \
    unsigned revolve_closest8_##isa(const struct revolve *s,                             \
                                    const struct shape_rays *rays, unsigned lanes,       \
                                    bool any, struct shape_hits *out, unsigned *odd);
REVOLVE_CLOSEST8(base)
REVOLVE_CLOSEST8(avx2)
REVOLVE_CLOSEST8(avx512)
#undef REVOLVE_CLOSEST8

void revolve_surface(const struct revolve *r, const struct boundary *b, struct vec3 p,
                     struct surface_point *out);

#endif
