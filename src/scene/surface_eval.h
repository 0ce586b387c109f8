#ifndef SCENE_SURFACE_EVAL_H
#define SCENE_SURFACE_EVAL_H

#include "scene/texture.h"

// Shared by pigment.c, normal.c, texture.c and surface_kernel.c.

static inline struct pattern_context pattern_context_of(const struct texture_point *at)
{
    return (struct pattern_context){.p_world = at->p_world,
                                    .normal = at->normal_seen,
                                    .ray_d = at->ray_d,
                                    .uv = at->uv};
}

static inline struct vec3 uv_point(const struct texture_point *at)
{
    return vec3(at->uv.u, at->uv.v, 0);
}

// Where a texture, pigment or normal of an object is evaluated.
static inline struct vec3 texture_place(const struct texture_point *at)
{
    return at->uv_mapping ? uv_point(at) : at->p;
}

// Differences of a normal's value are taken towards these, the corners of a tetrahedron,
// and count that much; a slope map makes another height of the value.
extern const struct vec3 normal_sides[4];
double normal_difference_scale(const struct normal *n);
double normal_slope_height(const struct slope_map *m, double v);

#endif
