#ifndef TRACE_COPLANAR_H
#define TRACE_COPLANAR_H

// Faces of two opaque objects that lie in one plane, look the same way (sheets: either way)
// and overlap: of boxes, planes, discs, triangles, and the ends of cylinders and cones.
#include "trace/world.h"

// Sets leaf.coplanar of their leaves; whether there are any. Faces of one surface, which look
// alike, are not looked for.
bool coplanar_mark(struct world *w);

#endif
