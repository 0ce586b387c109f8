#ifndef SCENE_SHAPES_MESH_H
#define SCENE_SHAPES_MESH_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "math/bvh8.h"
#include "scene/shape.h"

struct arena;
struct args;

// Triangles that share corners, and a box tree over them. Corners are indices, so a mesh
// is a few dozen bytes a triangle; declared meshes are shared by all their uses.
struct mesh {
    struct vec3 *vertex;
    struct vec3 *normal; // unit
    struct vec2 *uv;
    uint32_t (*face)[3];
    uint32_t (*face_normal)[3];  // NULL, or face_normal[f][0] == UINT32_MAX: flat
    uint32_t (*face_uv)[3];      // NULL: none
    uint32_t (*face_texture)[3]; // NULL, or of each corner; UINT32_MAX: the object's
    const struct texture **texture;
    uint32_t texture_count;
    const struct texture
        *whole; // that of all faces; NULL: they have not one and the same
    uint32_t vertex_count, normal_count, uv_count, face_count;
    uint32_t zero_normals; // that were read and replaced
    bool solid;            // inside_vector was given
    struct vec3 inside_vector;
    struct aabb bounds;
    struct bvh8 tree; // over the faces
};

static inline void mesh_corners(const struct mesh *m, uint32_t face, struct vec3 p[3])
{
    for (int i = 0; i < 3; i++)
        p[i] = m->vertex[m->face[face][i]];
}

// Builds the tree; faces without area are left out of it.
void mesh_finish(struct mesh *m, struct arena *a);

// A mesh { } while it is read, face by face; it is gone with the arena's memory.
struct mesh_soup;
struct mesh_soup *mesh_soup_new(struct arena *a);
// What stands in triangle { } or smooth_triangle { }. After an error, which is reported, it
// takes no more and there will be no mesh.
void mesh_soup_add(struct mesh_soup *s, struct args *block, bool smooth);
void mesh_soup_fail(struct mesh_soup *s);

// The uses of a mesh as a shape: what mesh_ops and mesh2_ops have in common.
struct aabb mesh_bounds(const void *shape);
bool mesh_is_solid(const void *shape);
bool mesh_inside(const void *shape, struct vec3 p);
void mesh_intersect(const void *shape, const struct ray *ray, struct boundary_list *out);
bool mesh_closest(const void *shape, const struct ray *ray, struct boundary *out);
void mesh_surface(const void *shape, const struct boundary *b, struct vec3 p,
                  struct surface_point *out);
// The texture of all faces; NULL: they have not one and the same. Any shape may be asked.
const struct texture *mesh_whole_texture(const struct shape_ops *ops, const void *shape);
const struct texture *mesh_texture(const void *shape, uint32_t i);
void mesh_textures_at(const void *shape, const struct boundary *b, struct vec3 p,
                      shape_texture_visit *visit, void *user);
void mesh_print(const void *shape, FILE *out);

#endif
