#ifndef PATTERNS_TILING_H
#define PATTERNS_TILING_H

#include "scene/pattern_math.h"

// What the tilings share (spec/textures 6). A tile is mirrored and turned into a small
// part of itself; its joints have the value 1.

#define ROOT3      1.73205080756887729353
#define HALF_ROOT3 0.86602540378443864676
#define ROOT2      1.41421356237309504880

struct place {
    double x, z;
};

static inline double max3(double a, double b, double c) { return fmax(fmax(a, b), c); }
static inline double min3(double a, double b, double c) { return fmin(fmin(a, b), c); }

// Distance to the rim of a unit square, and of two of them in a row.
static inline double tile_square(struct place p)
{
    return fmax(2 * fabs(p.x - 0.5), 2 * fabs(p.z - 0.5));
}
static inline double tile_rectangle(struct place p, int upright)
{
    if (upright)
        return fmax(2 * fabs(p.x - 0.5), 2 * (fmax(fabs(p.z), 0.5) - 0.5));
    return fmax(2 * (fmax(fabs(p.x), 0.5) - 0.5), 2 * fabs(p.z - 0.5));
}
static inline double tile_triangle(struct place p)
{
    return fmax(1 - 2 * ROOT3 * p.z, 1 - ROOT3 * (ROOT3 * p.x - p.z));
}
// The half of a half triangle; 1 when it was turned, 2 when it was on the very rim.
static inline int tile_half(struct place *p)
{
    if (p->x != 0) {
        if (!(p->z / p->x > ROOT3))
            return 0;
        *p = (struct place){0.5 - p->x, HALF_ROOT3 - p->z};
        return 1;
    }
    *p = (struct place){0.5, HALF_ROOT3 - p->z};
    return 2;
}
// A rhombus of two triangles.
double tile_lozenge(struct place p);

// One function per tiling of more than a few steps.
double tile_penrose(int n, struct place p); // 25, 26, 27
double tile_mixed(int n, struct place p);   // 16, 17, 19..24

#endif
