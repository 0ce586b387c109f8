#ifndef TESS_MESH_H
#define TESS_MESH_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"

// A triangle mesh by indices. Outward is (b - a) x (c - a).
struct tess_mesh {
    struct vec3 *vertex;
    uint32_t (*triangle)[3];
    uint32_t vertex_count, vertex_capacity, triangle_count, triangle_capacity;
};

void tess_mesh_free(struct tess_mesh *m);
uint32_t tess_mesh_add_vertex(struct tess_mesh *m, struct vec3 p); // its index
void tess_mesh_add_triangle(struct tess_mesh *m, uint32_t a, uint32_t b, uint32_t c);

// What a mesh is as a surface.
struct tess_report {
    bool closed;         // every edge has a triangle on each side
    bool oriented;       // ... that runs along it the other way
    bool manifold;       // both, and the triangles around each vertex are one fan
    long euler;          // vertices in use - edges + triangles; 2 - 2 genus a component
    double area, volume; // volume by the divergence theorem; needs a closed mesh
};
struct tess_report tess_mesh_report(const struct tess_mesh *m);

#endif
