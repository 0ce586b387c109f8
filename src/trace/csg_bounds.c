// Boxes of CSG nodes (S-bounds).
#include "trace/csg_bounds.h"

#include <stdlib.h>

static struct aabb drawn_bounds(const struct leaf *l)
{
    if (!l->drawn)
        return aabb_empty();
    if (!l->ops->surface_bounds)
        return l->bounds;
    const struct aabb s = shape_surface_bounds(l->ops, l->shape);
    return l->transform->identity || aabb_is_empty(s)
               ? s
               : aabb_pad(aabb_transform(s, l->transform));
}

// Bottom up: where the node may be inside, and where it may have drawn surfaces
// (Cameron & Yap 1992). Children come after their parents in the array.

struct boxes {
    struct aabb inside, surface;
};

static void intersect_boxes(const struct csg_node *n, const struct boxes *child,
                            struct boxes *out, struct aabb *suffix)
{
    out->inside = aabb_infinite();
    out->surface = aabb_empty();
    suffix[n->child_count] = aabb_infinite();
    for (uint32_t i = n->child_count; i-- > 0;)
        suffix[i] = aabb_meet(suffix[i + 1], child[i].inside);
    for (uint32_t i = 0; i < n->child_count; i++) {
        const struct boxes *c = &child[i];
        const struct aabb others = aabb_meet(out->inside, suffix[i + 1]);
        out->surface = aabb_join(out->surface, aabb_meet(c->surface, others));
        out->inside = aabb_meet(out->inside, c->inside);
    }
}

struct aabb csg_bound(struct csg_node *node, uint32_t root, uint32_t count,
                      const struct leaf *leaf)
{
    if (node[root].op == NODE_LEAF) {
        node[root].base_inside = leaf[node[root].leaf].inverted;
        return node[root].bounds = drawn_bounds(&leaf[node[root].leaf]);
    }
    struct boxes *box = malloc((count - root) * sizeof *box);
    struct aabb *suffix = malloc((count - root + 1) * sizeof *suffix);
    if (!box || !suffix)
        abort();
    for (uint32_t i = count; i-- > root;) {
        struct csg_node *n = &node[i];
        struct boxes *to = &box[i - root];
        const struct boxes *child = n->op == NODE_LEAF ? NULL : &box[n->first_child - root];
        if (n->op == NODE_LEAF) {
            const struct leaf *l = &leaf[n->leaf];
            to->inside = l->inverted ? aabb_infinite()
                         : l->solid  ? l->bounds
                                     : aabb_empty();
            to->surface = drawn_bounds(l);
            n->base_inside = l->inverted;
        } else if (n->op == NODE_INTERSECTION) {
            intersect_boxes(n, child, to, suffix);
        } else {
            *to = (struct boxes){aabb_empty(), aabb_empty()};
            for (uint32_t k = 0; k < n->child_count; k++) {
                to->inside = aabb_join(to->inside, child[k].inside);
                to->surface = aabb_join(to->surface, child[k].surface);
            }
        }
        n->bounds = to->surface;
        if (n->op != NODE_LEAF) { // inside where no leaf's box holds the point
            n->base_inside = 0;
            for (uint32_t k = 0; k < n->child_count; k++) {
                const struct csg_node *c = &node[n->first_child + k];
                n->base_inside += node_is_inside(c, c->base_inside);
            }
        }
    }
    const struct aabb surface = box[0].surface;
    free(box);
    free(suffix);
    return surface;
}
