#include "scene/object.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"

static struct object *object_new(struct arena *a, enum object_kind kind,
                                 struct span where)
{
    struct object *o = arena_new_struct(a, struct object);
    o->kind = kind;
    o->where = where;
    o->transform = &transform_identity;
    o->texture.transform = &transform_identity;
    o->interior_texture.transform = &transform_identity;
    return o;
}

struct object *object_new_shape(struct arena *a, const struct shape_ops *ops,
                                const void *shape, struct span where)
{
    struct object *o = object_new(a, OBJECT_SHAPE, where);
    o->ops = ops;
    o->shape = shape;
    o->leaves = 1;
    return o;
}

struct object *object_new_csg(struct arena *a, enum csg_op op,
                              const struct object *const *child, uint32_t count,
                              struct span where)
{
    struct object *o = object_new(a, OBJECT_CSG, where);
    o->op = op;
    o->child = child;
    o->child_count = count;
    for (uint32_t i = 0; i < count; i++)
        object_hold(o, child[i]);
    return o;
}

struct object *object_copy(struct arena *a, const struct object *o)
{
    struct object *copy = arena_new_struct(a, struct object);
    *copy = *o;
    return copy;
}

const struct transform *transform_join(struct arena *a, const struct transform *first,
                                       const struct transform *second)
{
    if (second->identity)
        return first;
    struct transform *both = arena_new_struct(a, struct transform);
    *both = transform_then(first, second);
    return both;
}

static void move_attached(struct arena *a, struct attached_texture *x,
                          const struct transform *t)
{
    if (x->texture)
        x->transform = transform_join(a, x->transform, t);
}

static const struct object *const *move_all(struct arena *a,
                                            const struct object *const *list,
                                            uint32_t count, const struct transform *t)
{
    const struct object **moved = arena_alloc(a, count * sizeof *moved);
    for (uint32_t i = 0; i < count; i++) {
        struct object *o = object_copy(a, list[i]);
        object_transform(a, o, t);
        moved[i] = o;
    }
    return moved;
}

void object_transform(struct arena *a, struct object *o, const struct transform *t)
{
    if (t->identity)
        return;
    o->transform = transform_join(a, o->transform, t);
    if (!(o->flags & OBJECT_UV_MAPPING)) { // uv coordinates stay with the surface
        move_attached(a, &o->texture, t);
        move_attached(a, &o->interior_texture, t);
    }
    if (o->clip_count)
        o->clip = move_all(a, o->clip, o->clip_count, t);
    if (o->bound_count)
        o->bound = move_all(a, o->bound, o->bound_count, t);
}

// ---- bounds, inside, solidity -----------------------------------------------
// These follow the tree. A chain of two thousand nested differences must not use two
// thousand stack frames, so the first child is followed by a loop and only the others
// by recursion.

struct frame_list {
    const struct object **at;
    uint32_t count, capacity;
};

static void push(struct frame_list *l, const struct object *o)
{
    l->at = must_grow(l->at, l->count, &l->capacity, sizeof *l->at);
    l->at[l->count++] = o;
}

static bool is_inverse(const struct object *o)
{
    return (o->flags & OBJECT_INVERSE) != 0;
}

// The node and its first children down to a leaf.
static struct frame_list first_chain(const struct object *o)
{
    struct frame_list l = {0};
    push(&l, o);
    while (o->kind == OBJECT_CSG && o->child_count) {
        o = o->child[0];
        push(&l, o);
    }
    return l;
}

// The bounds of a node whose first child has bounds `b`, in the node's outer space.
static struct aabb bounds_above(const struct object *o, struct aabb b)
{
    for (uint32_t i = 1; i < o->child_count; i++) {
        if (o->op == CSG_DIFFERENCE)
            break; // what is taken away does not make it larger
        struct aabb other = object_bounds(o->child[i]);
        if (o->child[i]->kind == OBJECT_LIGHT)
            continue;
        b = o->op == CSG_INTERSECTION ? aabb_meet(b, other) : aabb_join(b, other);
    }
    return b;
}

static struct aabb outside(const struct object *o, struct aabb b)
{
    if (is_inverse(o))
        b = aabb_infinite();
    if (!o->transform->identity && !aabb_is_empty(b))
        b = aabb_transform(b, o->transform);
    for (uint32_t i = 0; i < o->clip_count; i++)
        b = aabb_meet(b, object_bounds(o->clip[i]));
    return b;
}

struct aabb object_bounds(const struct object *o)
{
    struct frame_list chain = first_chain(o);
    struct aabb b = aabb_empty();
    for (size_t i = chain.count; i-- > 0;) {
        const struct object *n = chain.at[i];
        if (n->kind == OBJECT_SHAPE)
            b = n->ops->bounds(n->shape);
        else if (n->kind == OBJECT_CSG)
            b = bounds_above(n, b);
        b = outside(n, b);
    }
    free(chain.at);
    return b;
}

bool object_inside(const struct object *o, struct vec3 p)
{
    for (uint32_t i = 0; i < o->clip_count; i++)
        if (!object_inside(o->clip[i], p))
            return false;
    if (!o->transform->identity)
        p = transform_inverse_point(o->transform, p);
    bool in = false;
    if (o->kind == OBJECT_SHAPE) {
        in = shape_is_solid(o->ops, o->shape) && o->ops->inside(o->shape, p);
    } else if (o->kind == OBJECT_CSG) {
        const bool all = o->op == CSG_INTERSECTION || o->op == CSG_DIFFERENCE;
        in = all && o->child_count > 0;
        for (uint32_t i = o->child_count; i-- > 0;) {
            if (o->child[i]->kind == OBJECT_LIGHT)
                continue;
            bool child = object_inside(o->child[i], p);
            if (o->op == CSG_DIFFERENCE && i > 0)
                child = !child;
            if (child != all) {
                in = child;
                break;
            }
        }
    }
    return in != is_inverse(o);
}

bool object_is_solid(const struct object *o)
{
    if (o->kind == OBJECT_SHAPE)
        return shape_is_solid(o->ops, o->shape);
    if (o->kind == OBJECT_LIGHT)
        return false;
    for (uint32_t i = 0; i < o->child_count; i++)
        if (o->child[i]->kind != OBJECT_LIGHT && !object_is_solid(o->child[i]))
            return false;
    return true;
}
