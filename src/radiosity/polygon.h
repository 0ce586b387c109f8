#ifndef RADIOSITY_POLYGON_H
#define RADIOSITY_POLYGON_H

#include "radiosity/enclosure.h"
#include "radiosity/sight_kernel.h"

// Form factor from a point with a normal to a polygon without anything between, from 0
// to 1: Lambert's sum over the edges (Baum, Rushmeier, Winget 1989, eq. 6) after the
// part below the horizon is cut off. 0 when the polygon turns its back. The corners go
// counter-clockwise about the polygon's normal; it need not be planar.
double lambert_polygon(struct vec3 p, struct vec3 n, const struct vec3 *corner,
                       uint32_t count);
// The same where sight_kernels.edges has found the terms of the sum and the heights of
// the corners.
double lambert_of_edges(struct vec3 p, struct vec3 n, const struct vec3 *corner,
                        uint32_t count, const double *term, const double *height);

// The part of a polygon of up to four corners that lies above the horizon of p, relative
// to it. Returns the number of its corners.
uint32_t polygon_risen(struct vec3 p, struct vec3 n, const struct vec3 *corner,
                       uint32_t count, struct vec3 out[HORIZON_CORNERS]);

enum { GAUSS_MAX = 8 };
// Nodes and weights of Gauss-Legendre quadrature on [0, 1], 1 <= k <= GAUSS_MAX.
struct gauss {
    double at[GAUSS_MAX], weight[GAUSS_MAX];
};
const struct gauss *gauss_rule(int k);

// The point of the polygon at (u, v) of the unit square, and the area of the polygon
// there for an area 1 of the square. Triangles are squares with one side shrunk to a
// corner.
struct vec3 polygon_point(const struct element *e, double u, double v, double *jacobian);
// The same point for (u, v) uniform in the square: uniform in the area of triangles and
// parallelograms.
struct vec3 polygon_uniform(const struct element *e, double u, double v);
double polygon_area(const struct element *e);
// Puts the corners of a quadrangle counter-clockwise about its normal.
void polygon_turn(struct element *e);
// Greatest distance of a corner from the centre.
double polygon_radius(const struct element *e);

// Fills in centre, normal, area and coverage from the corners.
void element_finish(struct element *e);

#endif
