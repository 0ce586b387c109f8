#ifndef TESS_MAP_MESH_H
#define TESS_MAP_MESH_H

#include "tess/map.h"
#include "tess/mesh.h"

// Appends a mapped surface, moved by t, as triangles between points of it that lie about
// `step` apart. Edges that come together are sewn: around, and where they shrink to a point.
void tess_map_mesh(const struct tess_map *map, const void *shape,
                   const struct transform *t, double step, struct tess_mesh *out);

#endif
