#ifndef TESTS_MESHES_H
#define TESTS_MESHES_H

#include "radiosity/enclosure.h"

// Rectangles, their elements and what hides them, for tests without a scene.
struct mesh {
    struct enclosure e;
    struct element *element;
    struct element *blocker; // opaque, no elements
    uint32_t capacity, blockers;
};

struct mesh *mesh_new(void);
void mesh_free(struct mesh *m);
// The parallelogram at p with sides a and b, lit on the side of a x b, cut into
// nu x nv elements. Returns the first.
uint32_t mesh_add(struct mesh *m, struct vec3 p, struct vec3 a, struct vec3 b,
                  uint32_t nu, uint32_t nv);
void mesh_add_triangle(struct mesh *m, struct vec3 a, struct vec3 b, struct vec3 c);
void mesh_block(struct mesh *m, struct vec3 p, struct vec3 a, struct vec3 b);
// Lets rays meet elements and blockers: without this nothing is hidden.
void mesh_trace(struct mesh *m);
// The inside of the unit cube, walls of n x n: floor, ceiling (z), x, y.
struct mesh *mesh_cube(uint32_t n);

#endif
