// A tree over the components of a blob, where they are many.
#include <math.h>

#include "base/arena.h"
#include "scene/shapes/blob.h"

// Up to so many are looked at one after the other.
enum { FEW = 24 };

struct aabb blob_component_box(const struct blob_component *c)
{
    const double size = fabs(c->r);
    const struct vec3 r = vec3(size, size, size);
    struct aabb one = {vec3_sub(c->c, r), vec3_add(c->c, r)};
    if (c->kind == PART_STRAIGHT || c->kind == PART_APEX) {
        const struct vec3 end = vec3_mad(c->c, c->length, c->axis);
        one = aabb_join(one, (struct aabb){vec3_sub(end, r), vec3_add(end, r)});
    }
    return aabb_transform(one, &c->transform);
}

void blob_make_tree(struct blob *b, struct arena *a)
{
    struct aabb all = aabb_empty();
    if (b->count <= FEW)
        return;
    struct aabb *box = arena_new_array(a, struct aabb, b->count);
    uint32_t *index = arena_new_array(a, uint32_t, b->count);
    for (uint32_t i = 0; i < b->count; i++) {
        box[i] = aabb_pad(blob_component_box(&b->at[i]));
        index[i] = i;
        all = aabb_join(all, box[i]);
    }
    if (aabb_is_finite(all))
        b->tree = bvh8_build(a, box, index, b->count, BVH8_CHEAP_ITEMS);
}

void blob_near_begin(struct blob_near *n, const struct blob *b, struct vec3 p)
{
    n->blob = b;
    n->next = 0;
    n->last = b->tree.node ? 0 : b->count;
    if (!b->tree.node)
        return;
    const struct vec3 q = vec3_sub(p, b->tree.origin);
    n->p[0] = (float)q.x;
    n->p[1] = (float)q.y;
    n->p[2] = (float)q.z;
    bvh8_walk_begin(&n->walk, &b->tree);
}

bool blob_near_in_tree(struct blob_near *n, uint32_t *i)
{
    const struct bvh8 *tree = &n->blob->tree;
    while (n->next == n->last) {
        uint32_t count;
        if (!bvh8_walk_point(&n->walk, tree, n->p, &n->next, &count))
            return false;
        n->last = n->next + count;
    }
    *i = tree->item[n->next++];
    return true;
}
