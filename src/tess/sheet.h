#ifndef TESS_SHEET_H
#define TESS_SHEET_H

#include "scene/object.h"
#include "tess/mesh.h"

// The open surfaces of an object that is made of nothing else (mesh, mesh2, triangle,
// smooth_triangle, disc, bicubic_patch, and unions of them without clips): triangles with
// their corners shared as they are written, curves by cells of 1/resolution of the longest
// side of the object's box. False: it is something else. A mesh with an inside is turned
// outward if it is closed.
bool sheet_mesh(const struct object *o, int resolution, struct tess_mesh *out);

#endif
