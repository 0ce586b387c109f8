#ifndef RADIOSITY_SIGHT_KERNEL_H
#define RADIOSITY_SIGHT_KERNEL_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"

// What can come between: the boxes of a scene's objects, padded to eights.
enum { SHAFT_OBJECTS = 64 };
struct shaft_boxes {
    double low[3][SHAFT_OBJECTS], high[3][SHAFT_OBJECTS];
    uint64_t solid; // objects (bits) that hide anything
};

// The box of an element, and the objects (bits) that cannot hide anything from it
// within their hollow.
struct shaft {
    struct vec3 centre, half;
    uint64_t hollow;
};

// Points in whose hull an object lies, and up to as many planes above which (n . p > top)
// there is nothing of it. Both repeat what they have.
enum { HULL_CORNERS = 8 };
struct shaft_hull {
    double p[3][HULL_CORNERS], n[3][HULL_CORNERS], top[HULL_CORNERS];
};

// What of a flat polygon rises above the horizon of a point o with unit normal n: corners
// relative to o.
enum { HORIZON_CORNERS = 5 };
struct horizon_polygon {
    struct vec3 o, n, corner[HORIZON_CORNERS];
    uint32_t count;
};

// Two flat polygons that face each other, with their unit normals.
struct facing_polygons {
    struct vec3 corner[2][4], n[2];
    uint32_t count[2];
};

// The edges of polygons, one after the other, from a to b. The count is padded to eights.
struct polygon_edges {
    double *a[3], *b[3];
    uint32_t count;
};

// An emitter that is flat and whole: its points are o + u a + v b, of a triangle's chart
// o + sqrt(u) ((1 - v) a + v b), for u and v in the given ranges.
struct flat_emitter {
    struct vec3 o, a, b, n;
    double u, du, v, dv;
    bool triangle;
};

// Points of emitters that one looks at from o, with unit normal n.
enum { EMITTER_RAYS = 16 };
struct emitter_aims {
    struct vec3 o, n;
    const struct flat_emitter *of[EMITTER_RAYS];
    double u[EMITTER_RAYS], v[EMITTER_RAYS]; // in its square
    double d[3][EMITTER_RAYS];               // found: the way there
    double kernel[EMITTER_RAYS];             // and point_kernel() of both ends
};

// What is compiled once per instruction set, as trace/packet.h.
struct sight_kernels {
    const char *name;
    // Which of `some` objects may come between two boxes; the hollows are not asked.
    uint64_t (*between)(const struct shaft_boxes *boxes, const struct shaft *a,
                        const struct shaft *b, uint64_t some);
    // Whether a plane is known that parts an object from all ways to a polygon: the
    // horizon, one through an edge of the polygon, or a face of the object's hull.
    bool (*apart)(const struct shaft_hull *h, const struct horizon_polygon *to);
    // The same for all ways from one polygon to another: by the plane of either, one through
    // an edge of either and a corner of the other, or a face of the hull.
    bool (*beside)(const struct shaft_hull *h, const struct facing_polygons *x);
    // Of each edge what it adds to the sum of lambert_polygon(), and how high a is above
    // the horizon of n.
    void (*edges)(const struct polygon_edges *e, struct vec3 o, struct vec3 n,
                  double *term, double *height);
    void (*aim)(struct emitter_aims *x);
};

extern const struct sight_kernels sight_kernels_base, sight_kernels_avx2,
    sight_kernels_avx512;

#endif
