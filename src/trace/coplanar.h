#ifndef TRACE_COPLANAR_H
#define TRACE_COPLANAR_H

// Faces of two opaque objects that lie in one plane, look the same way (sheets: either way)
// and overlap: of boxes, planes, discs, triangles, and the ends of cylinders and cones.
#include "trace/world.h"

// Sets leaf.coplanar of their leaves, and the world's pairs; whether there are any. Faces of
// one surface, which look alike, count only beside a third that does not.
bool coplanar_mark(struct world *w);

#endif
