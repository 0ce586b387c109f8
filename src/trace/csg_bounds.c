// Boxes of CSG nodes (S-bounds).
#include "trace/csg_bounds.h"

#include <stdlib.h>

static struct aabb drawn_bounds(const struct leaf *l)
{
    struct aabb s = shape_surface_bounds(l->ops, l->shape);
    if (!l->drawn)
        return aabb_empty();
    return l->transform.identity || aabb_is_empty(s)
               ? s
               : aabb_pad(aabb_transform(s, &l->transform));
}

// Bottom up: where the node may be inside, and where it may have drawn surfaces
// (Cameron & Yap 1992). Children come after their parents in the array.

struct boxes {
    struct aabb inside, surface;
};

static void intersect_boxes(const struct csg_node *n, struct boxes *box,
                            struct boxes *out, struct aabb *suffix)
{
    out->inside = aabb_infinite();
    out->surface = aabb_empty();
    suffix[n->child_count] = aabb_infinite();
    for (uint32_t i = n->child_count; i-- > 0;)
        suffix[i] = aabb_meet(suffix[i + 1], box[n->first_child + i].inside);
    for (uint32_t i = 0; i < n->child_count; i++) {
        const struct boxes *c = &box[n->first_child + i];
        const struct aabb others = aabb_meet(out->inside, suffix[i + 1]);
        out->surface = aabb_join(out->surface, aabb_meet(c->surface, others));
        out->inside = aabb_meet(out->inside, c->inside);
    }
}

struct aabb csg_bound(struct csg_node *node, uint32_t root, uint32_t count,
                      const struct leaf *leaf)
{
    struct boxes *box = malloc((count + 1) * sizeof *box);
    struct aabb *suffix = malloc((count + 2) * sizeof *suffix);
    if (!box || !suffix)
        abort();
    for (uint32_t i = count; i-- > root;) {
        struct csg_node *n = &node[i];
        if (n->op == NODE_LEAF) {
            const struct leaf *l = &leaf[n->leaf];
            box[i].inside = l->inverted ? aabb_infinite()
                            : l->solid  ? l->bounds
                                        : aabb_empty();
            box[i].surface = drawn_bounds(l);
            n->base_inside = l->inverted;
        } else if (n->op == NODE_INTERSECTION) {
            intersect_boxes(n, box, &box[i], suffix);
        } else {
            box[i] = (struct boxes){aabb_empty(), aabb_empty()};
            for (uint32_t k = 0; k < n->child_count; k++) {
                box[i].inside = aabb_join(box[i].inside, box[n->first_child + k].inside);
                box[i].surface =
                    aabb_join(box[i].surface, box[n->first_child + k].surface);
            }
        }
        n->bounds = box[i].surface;
        if (n->op != NODE_LEAF) { // inside where no leaf's box holds the point
            n->base_inside = 0;
            for (uint32_t k = 0; k < n->child_count; k++) {
                const struct csg_node *c = &node[n->first_child + k];
                n->base_inside += node_is_inside(c, c->base_inside);
            }
        }
    }
    const struct aabb surface = box[root].surface;
    free(box);
    free(suffix);
    return surface;
}
