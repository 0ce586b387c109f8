#ifndef TRACE_CSG_BOUNDS_H
#define TRACE_CSG_BOUNDS_H

#include "trace/world.h"

// Fills bounds and base_inside of the nodes root..count-1, one object's, children after
// their parents. Returns the box of everything drawn.
struct aabb csg_bound(struct csg_node *node, uint32_t root, uint32_t count,
                      const struct leaf *leaf);

#endif
