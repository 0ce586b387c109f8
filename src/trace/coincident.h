#ifndef TRACE_COINCIDENT_H
#define TRACE_COINCIDENT_H

// Faces of two objects in one place, one clear and one opaque: a block of glass on a table.
// Which of them a ray meets first is rounding, and behind the clear one it would start beyond
// the other. Here it meets the opaque one.
#include "trace/intersect.h"

// Says which objects that may concern (world_object.may_coincide): those with clear and flat
// faces whose boxes touch those of wholly opaque ones with flat faces. Curved faces in one
// place, and those of objects that are opaque in part, are not looked for.
void coincident_mark(struct world *w);
// Hits of clear faces of these objects become hits of the opaque ones that are no farther
// from them than the bounds on both errors.
void coincident_hits(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const struct hit_batch *hit);

#endif
