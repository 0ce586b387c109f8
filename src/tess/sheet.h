#ifndef TESS_SHEET_H
#define TESS_SHEET_H

#include "scene/object.h"
#include "tess/mesh.h"

// Whether an object is made of nothing but mesh, mesh2, triangle, smooth_triangle, disc,
// bicubic_patch, and unions of them without clips.
bool is_sheet(const struct object *o);

// Appends the surfaces of such an object: triangles with their corners shared as they are
// written, curves by cells of 1/resolution of the longest side of the object's box. A mesh
// with an inside is turned outward if it is closed.
void sheet_mesh(const struct object *o, int resolution, struct tess_mesh *out);

#endif
