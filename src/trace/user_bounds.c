#include "trace/user_bounds.h"

#include "scene/object.h"
#include "scene/shape.h"

struct user_bound user_bound_of(const struct object *o, const struct transform *world,
                                bool exact)
{
    struct user_bound b = {.transform = transform_then(o->transform, world)};
    if (o->kind == OBJECT_SHAPE && !o->clip_count && !(o->flags & OBJECT_INVERSE)) {
        b.box = shape_placed_bounds(o->ops, o->shape, &b.transform);
        b.ops = exact ? o->ops : NULL;
        b.shape = o->shape;
    } else {
        b.box = aabb_pad(aabb_transform(object_bounds(o), world));
    }
    return b;
}

static bool holds_corners(const struct user_bound *b, const struct aabb *box)
{
    if (!(b->ops->flags & SHAPE_CONVEX))
        return false;
    for (int i = 0; i < 8; i++) {
        const struct vec3 p =
            vec3(i & 1 ? box->max.x : box->min.x, i & 2 ? box->max.y : box->min.y,
                 i & 4 ? box->max.z : box->min.z);
        if (!b->ops->inside(b->shape, transform_inverse_point(&b->transform, p)))
            return false;
    }
    return true;
}

bool user_bound_holds(const struct user_bound *b, const struct aabb *box)
{
    if (!aabb_is_finite(*box))
        return false;
    if (b->ops)
        return holds_corners(b, box);
    const struct aabb *c = &b->box;
    return box->min.x >= c->min.x && box->max.x <= c->max.x && box->min.y >= c->min.y &&
           box->max.y <= c->max.y && box->min.z >= c->min.z && box->max.z <= c->max.z;
}

bool user_bound_culls(const struct user_bound *b, const struct ray *ray,
                      struct boundary_list *list)
{
    if (!b->ops)
        return false;
    const struct ray r = {transform_inverse_point(&b->transform, ray->o),
                          transform_inverse_vector(&b->transform, ray->d), -INFINITY,
                          INFINITY};
    list->count = 0;
    list->first_only = false;
    b->ops->intersect(b->shape, &r, list);
    for (uint32_t i = 0; i < list->count; i++)
        if (list->at[i].t > 0)
            return false;
    return !b->ops->inside(b->shape, r.o);
}
