#ifndef TESS_SHEET_H
#define TESS_SHEET_H

#include "scene/object.h"
#include "tess/mesh.h"

// The triangles of an object that is made of triangles alone (mesh, mesh2, triangle,
// smooth_triangle, and unions of them without clips), corners shared as they are written.
// False: it is something else. A mesh with an inside is turned outward if it is closed.
bool sheet_mesh(const struct object *o, struct tess_mesh *out);

#endif
