#ifndef TRACE_PROJECTED_H
#define TRACE_PROJECTED_H

#include "math/vec.h"
#include "scene/object.h"

// The distance to the nearest surface of a tree that is not part of the world (an
// object that a light shines through); INFINITY: none. Slow: every leaf is tested.
double object_first_hit(const struct object *o, struct vec3 origin, struct vec3 d);

#endif
