#ifndef SCENE_SURFACE_EVAL_H
#define SCENE_SURFACE_EVAL_H

#include "scene/texture.h"

// Shared by pigment.c, normal.c and texture.c.

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

#endif
