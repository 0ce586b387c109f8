#ifndef SCENE_SHAPES_MESH_READ_H
#define SCENE_SHAPES_MESH_READ_H

#include "scene/args.h"
#include "scene/shapes/mesh.h"

// What mesh { } and mesh2 { } have in common when they are read.

// Exporters write <0, 0, 0> where faces around a vertex cancel out. As in POV-Ray that is x;
// how many there were is said once.
struct vec3 mesh_read_normal(struct vec3 n, uint32_t *zero_normals);
bool mesh_read_inside_vector(struct mesh *m, struct args *args);
// When all faces are there; false, and reported, when there are none.
bool mesh_read_finish(struct mesh *m, struct args *args);

#define MESH_OPS(word)                                                                   \
    const struct shape_ops word##_ops = {                                                \
        .keyword = #word,                                                                \
        .size = sizeof(struct mesh),                                                     \
        .flags = SHAPE_BOUNDED | SHAPE_HIERARCHY | SHAPE_UV | SHAPE_FLAT,                \
        .build = build_##word,                                                           \
        .bounds = mesh_bounds,                                                           \
        .is_solid = mesh_is_solid,                                                       \
        .inside = mesh_inside,                                                           \
        .intersect = mesh_intersect,                                                     \
        .closest = mesh_closest,                                                         \
        .surface = mesh_surface,                                                         \
        .texture = mesh_texture,                                                         \
        .textures_at = mesh_textures_at,                                                 \
        .print = mesh_print,                                                             \
    }

#endif
