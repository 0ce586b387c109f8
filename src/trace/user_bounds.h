#ifndef TRACE_USER_BOUNDS_H
#define TRACE_USER_BOUNDS_H

#include <stdbool.h>

#include "math/aabb.h"
#include "math/transform.h"
#include "math/vec.h"

struct boundary_list;
struct object;
struct shape_ops;

// An object of bounded_by { }: a ray that neither meets it nor begins in it misses all that
// it bounds, also where that reaches beyond.
struct user_bound {
    struct aabb box;             // world
    const struct shape_ops *ops; // NULL: the box counts
    const void *shape;
    struct transform transform; // world from shape space
};

// exact: by its shape, if it is a single one. world: from the space that the bound is in.
struct user_bound user_bound_of(const struct object *o, const struct transform *world,
                                bool exact);
// Whether it surely culls no ray that meets the box.
bool user_bound_holds(const struct user_bound *b, const struct aabb *box);
// list: emptied and used.
bool user_bound_culls(const struct user_bound *b, const struct ray *ray,
                      struct boundary_list *list);

#endif
