#ifndef TESS_CONTOUR_H
#define TESS_CONTOUR_H

#include "tess/mesh.h"
#include "tess/solid.h"

struct contour_settings {
    int resolution; // cells along the longest side of the object's bounds, 2 to 512
    bool sharp;     // reconstruct edges and corners
};

// The boundary of a solid with finite bounds as a closed, oriented 2-manifold whose
// vertices lie on the surface. Whatever is thinner than a cell may be lost.
void contour_solid(struct tess_solid *s, const struct contour_settings *settings,
                   struct tess_mesh *out);

// ---- between the parts ---------------------------------------------------------------
struct contour {
    struct tess_solid *solid;
    struct tess_mesh *mesh;
    struct vec3 origin;
    double step; // side of a cell
    int cells[3];
    bool sharp;
    uint8_t *inside;                // of the corners, x fastest
    struct tess_crossing *crossing; // of the vertices on grid edges, by vertex
    uint32_t crossing_count, crossing_capacity;
    uint8_t *feature; // of vertices: it stands for an edge or a corner
    uint32_t feature_capacity;
};

// The vertex for a loop of crossings of the cell whose lowest corner is `low`; tells
// whether it is a feature.
struct vec3 contour_centre(const struct contour *c, struct vec3 low,
                           const uint32_t *vertex, int count, bool *feature);
// Turns the edges between neighbouring features so that they run along the feature.
void contour_turn_edges(struct contour *c);

#endif
