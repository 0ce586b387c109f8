#ifndef API_MESH_FILE_H
#define API_MESH_FILE_H

#include "image/codec.h"
#include "tess/mesh.h"

enum mesh_format { MESH_UNKNOWN, MESH_OBJ, MESH_STL, MESH_PLY };
enum mesh_format mesh_format_of(const char *path);

// The bytes of a file that holds the meshes, in order; name i is that of mesh i.
void mesh_encode(enum mesh_format format, const struct tess_mesh *mesh,
                 const char *const *name, uint32_t count, struct byte_buffer *out);

#endif
