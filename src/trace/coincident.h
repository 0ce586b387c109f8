#ifndef TRACE_COINCIDENT_H
#define TRACE_COINCIDENT_H

// Faces of two objects in one place. Which of them a ray meets first is rounding; here
// it is a rule:
// - of a clear one and an opaque one (a block of glass on a table) the opaque one is met:
//   behind the clear one the ray would start beyond the other;
// - of two opaque ones (face_pairs.h) the one that comes first in the scene;
// - of two clear ones the first is met, too, and the ray crosses both (contact.h).
// The opaque parts of objects that are opaque in part, and curved faces of which a part alone
// coincides, are not looked for.
#include "trace/intersect.h"

// Says which objects that may concern (world_object.may_coincide): those with clear and flat
// faces whose boxes touch those of wholly opaque ones with flat faces, and those with
// paired leaves.
void coincident_mark(struct world *w);
// Hits of these objects become hits of the face that is to be seen, which are no farther from
// them than rounding.
void coincident_hits(const struct world *w, struct trace_scratch *s,
                     const struct ray_batch *rays, const struct hit_batch *hit);

// Most faces that one ray crosses in one place, beside the one that was hit.
enum { CONTACTS_MOST = 4 };
// The faces of other clear objects that lie in that of the hit of q, there.
uint32_t coincident_contacts(const struct world *w, struct trace_scratch *s,
                             const struct ray_query *q, const struct hit *hit,
                             struct hit other[CONTACTS_MOST]);

#endif
