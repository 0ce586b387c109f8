#ifndef SCENE_SHAPES_TRIANGLE_H
#define SCENE_SHAPES_TRIANGLE_H

#include <stdbool.h>

#include "math/vec.h"

struct triangle {
    struct vec3 p[3], n[3];
    struct vec3 face; // unit
    bool smooth, degenerate;
};

// A ray prepared for watertight triangle tests (Woop, Benthin & Wald 2013): sheared so
// that it runs along the axis of its largest direction component. Edge functions of a
// shared edge are then the exact negatives of each other, and with closed edges no ray
// slips between two triangles.
struct triangle_ray {
    struct vec3 o;
    int kx, ky, kz;
    double sx, sy, sz;
};

struct triangle_hit {
    double t, dt;
    double u, v; // barycentric weights of the second and third corner
};

struct triangle_ray triangle_ray_of(const struct ray *r);
bool triangle_meet(const struct triangle_ray *r, const struct vec3 p[3],
                   struct triangle_hit *hit);

// Whether a triangle that triangle_meet hit counts for parity: of all triangles around
// a common edge or corner the ray goes through, those on the side to which the ray, moved
// a hair, would go. A closed mesh is then crossed an even number of times.
bool triangle_owns(const struct triangle_ray *r, const struct vec3 p[3]);

// Vertex order (p2 - p0) x (p1 - p0), unit, as the scene language has it; zero when the
// triangle has no area.
struct vec3 triangle_normal(const struct vec3 p[3]);

#endif
