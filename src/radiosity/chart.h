#ifndef RADIOSITY_CHART_H
#define RADIOSITY_CHART_H

#include <stdbool.h>
#include <stdint.h>

#include "trace/world.h"

struct tess_map;

// A piece of a leaf's surface as the image of the unit square, in shape space. All but
// CHART_MAPPED and CHART_PROJECTED keep ratios of areas.
enum chart_kind {
    CHART_FLAT,      // o + u a + v b
    CHART_TRIANGLE,  // corners o, o + a, o + b
    CHART_RING,      // a circle or ring in the frame, u round, v outwards
    CHART_SPHERE,    // u round, v from pole to pole
    CHART_CONE,      // the side of a cylinder or cone, u round, v along
    CHART_MAPPED,    // a piece of the shape's map (tess/maps)
    CHART_PROJECTED, // any shape: where lines along an axis cross it
};

struct chart {
    enum chart_kind kind;
    uint32_t leaf;
    uint32_t part; // boundary.part it belongs to; mapped: piece; projected: crossing
    const struct tess_map *map; // mapped
    struct vec3 o, a, b, n;     // frame; n: outwards where it is constant
    double r0, r1, length;
    int axis;             // projected
    double area, side[2]; // in the world; lengths along u and v
    uint32_t nu, nv;      // cells
    uint32_t first_cell;  // row by row, v upwards
    bool wrap, curved;
};

// The point at (u, v) and the outward normal of the bare shape, in the world. False:
// nothing is there.
bool chart_point(const struct chart *c, const struct leaf *l, double u, double v,
                 struct vec3 *p, struct vec3 *n);
// Where a point of the surface, on boundary b, lies in its chart.
void chart_locate(const struct chart *c, const struct leaf *l, const struct boundary *b,
                  struct vec3 p, double *u, double *v);
// World area for an area 1 of the square, near (u, v); h: a step in u and v that is small
// for the chart.
double chart_density(const struct chart *c, const struct leaf *l, double u, double v,
                     double hu, double hv);

// The charts of a leaf; infinite ones end at `limit`. Returns how many; out may be NULL.
uint32_t leaf_charts(const struct world *w, uint32_t leaf, const struct aabb *limit,
                     struct chart *out);
// Which of them a boundary lies on; count: none.
uint32_t leaf_chart_of(const struct world *w, const struct chart *chart, uint32_t count,
                       const struct boundary *b, struct vec3 p);

#endif
