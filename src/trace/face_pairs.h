#ifndef TRACE_FACE_PAIRS_H
#define TRACE_FACE_PAIRS_H

// Faces of two objects that lie in one place:
// - flat ones of opaque objects that look the same way (sheets: either way) and overlap: of
//   boxes, planes, discs, triangles, and the ends of cylinders and cones;
// - curved ones of opaque objects that look the same way, or of a clear and an opaque one: of
//   spheres, cylinders, cones, quadrics (whichever of these they are written as), tori, and
//   of one shape that was declared and used twice;
// - flat or curved ones of two clear objects, whichever way they look: these are in contact.
#include "trace/world.h"

// Sets leaf.paired of their leaves, and the world's pairs; whether there are any. Faces of
// one surface, which look alike, count only beside a third that does not.
bool face_pairs_mark(struct world *w);

#endif
