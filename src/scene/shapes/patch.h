#ifndef SCENE_SHAPES_PATCH_H
#define SCENE_SHAPES_PATCH_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

#include "math/aabb.h"

struct arena;

// A bicubic Bezier patch as a tree of sub-patches (research 4.8). Control points [i][j]: i
// along u, j along v.
struct patch_half;
struct patch_leaf {
    struct vec3 p[4][4];
    double u[2], v[2]; // the part of the whole it is
    double size;       // largest coordinate
    struct vec3 middle, du, dv,
        n;                  // S at the middle, mean derivatives, their cross product
    struct vec3 n_dv, du_n; // n x dv, du x n
    // How far derivatives are from their means, in parts of du, dv and n: the largest
    // coefficient of either derivative, both added.
    double bend[3];
    double own[3][2];                  // its extent along n_dv, du_n, n, from the middle
    _Atomic(struct patch_half *) half; // made when a line needs them (patch_halves)
};

struct patch_node {
    struct aabb box;
    uint32_t other; // second child (the first follows); a leaf: 0
    uint32_t leaf;
};

// A leaf's halves, for lines that its own bend is too large for.
struct patch_half {
    struct aabb box;
    struct patch_leaf leaf;
};

// What a bicubic_patch begins with.
struct patch {
    struct vec3 p[4][4];
    double power[3][4][4]; // an axis: coefficients of powers of u - 1/2 and v - 1/2
    double size;           // largest sum of the terms' sizes
    struct patch_node *node;
    struct patch_leaf *leaf;
    uint32_t nodes, leaves;
    struct aabb bounds;
};

struct patch_hit {
    double t, dt, u, v;
};

void patch_build(struct patch *p, struct arena *arena);
// Two of them, the same whatever line comes first.
struct patch_half *patch_halves(struct patch_leaf *l);
void patch_derivatives(const struct patch *p, double u, double v, struct vec3 *at,
                       struct vec3 *du, struct vec3 *dv);

// The triangles that POV-Ray draws instead, with corner normals and (u, v): pieces of two
// triangles, halved until they are flat or 2^steps lie side by side.
struct mesh *patch_triangles(const struct patch *p, double flatness, double u_steps,
                             double v_steps, struct arena *arena);

// A ray with a frame across it.
struct patch_ray {
    struct vec3 o, d, e1, e2; // unit
    double length, size;
};
struct patch_ray patch_ray_of(const struct ray *ray);

// Where the line meets one leaf; returns how often.
enum { PATCH_HITS = 18 }; // a line meets a bicubic patch no more often
int patch_meet_leaf(const struct patch_leaf *leaf, const struct patch_ray *ray,
                    struct patch_hit hit[PATCH_HITS]);

// The cubic Bernstein polynomials at w, and their derivatives.
static inline void basis(double w, double b[4], double d[4])
{
    const double z = 1 - w;
    b[0] = z * z * z;
    b[1] = 3 * w * z * z;
    b[2] = 3 * w * w * z;
    b[3] = w * w * w;
    d[0] = -3 * z * z;
    d[1] = 3 * z * (z - 2 * w);
    d[2] = 3 * w * (2 * z - w);
    d[3] = 3 * w * w;
}

#endif
