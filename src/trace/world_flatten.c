// From an object's tree to nodes whose leaves may be inverted.

#include "base/arena.h"
#include "trace/world_build.h"

static enum node_op op_of(const struct object *o, bool inverted)
{
    switch (o->op) {
    case CSG_UNION: return inverted ? NODE_INTERSECTION : NODE_UNION;
    case CSG_MERGE: return inverted ? NODE_INTERSECTION : NODE_MERGE;
    default: return inverted ? NODE_MERGE : NODE_INTERSECTION;
    }
}

struct csg_node *world_build_node(struct build *b, uint32_t i)
{
    return (struct csg_node *)b->node.at + i;
}

static uint32_t add_children(struct build *b, uint32_t parent, enum node_op op,
                             uint32_t count)
{
    const uint32_t first = b->node.count;
    world_build_add(&b->node, count);
    struct csg_node *n = world_build_node(b, parent);
    n->op = op;
    n->first_child = first;
    n->child_count = count;
    for (uint32_t i = 0; i < count; i++)
        world_build_node(b, first + i)->parent = parent;
    return first;
}

static void later(struct build *b, const struct object *o, const struct context *c,
                  uint32_t node)
{
    struct pending *p = world_build_add(&b->pending, 1);
    *p = (struct pending){o, *c, node};
}

// A clipped node is the intersection of the node and its clips, which are not drawn.
// Clips hold for an inverted node too, as they are (spec/shapes.md 1.6).
static void flatten_clipped(struct build *b, const struct pending *p)
{
    const struct object *o = p->object;
    const uint32_t first = add_children(b, p->node, NODE_INTERSECTION, o->clip_count + 1);
    struct context clip = p->context;
    clip.inverted = clip.drawn = false;
    for (uint32_t i = o->clip_count; i-- > 0;)
        later(b, o->clip[i], &clip, first + 1 + i);
    struct object *bare = object_copy(b->arena, o);
    bare->clip_count = 0;
    later(b, bare, &p->context, first);
}

static void flatten_csg(struct build *b, const struct object *o, const struct context *in,
                        uint32_t node)
{
    uint32_t solid = 0;
    for (uint32_t i = 0; i < o->child_count; i++)
        solid += o->child[i]->kind != OBJECT_LIGHT;
    uint32_t at = add_children(b, node, op_of(o, in->inverted), solid) + solid;
    for (uint32_t i = o->child_count; i-- > 0;) { // the stack turns the order round again
        if (o->child[i]->kind == OBJECT_LIGHT)
            continue;
        struct context c = *in;
        if (o->op == CSG_DIFFERENCE && i > 0)
            c.inverted = !c.inverted;
        later(b, o->child[i], &c, --at);
    }
}

static void flatten(struct build *b, uint32_t root, const struct object *o,
                    const struct context *c)
{
    later(b, o, c, root);
    while (b->pending.count) {
        const struct pending p = ((struct pending *)b->pending.at)[--b->pending.count];
        if (p.object->clip_count) {
            flatten_clipped(b, &p);
            continue;
        }
        const struct context in = world_build_enter(b, p.object, &p.context);
        if (p.object->kind == OBJECT_CSG) {
            world_build_lights_below(b, p.object, &p.context);
            flatten_csg(b, p.object, &in, p.node);
        } else {
            const uint32_t leaf = world_build_leaf(b, p.object, &in);
            struct csg_node *n = world_build_node(b, p.node);
            n->op = NODE_LEAF;
            n->leaf = leaf;
            ((struct leaf *)b->leaf.at)[leaf].node = p.node;
        }
    }
}

const struct outer_clip *world_build_join_clips(struct build *b, const struct object *o,
                                                const struct context *c)
{
    const struct outer_clip *all = c->clips;
    for (uint32_t i = 0; i < o->clip_count; i++) {
        struct outer_clip *clip = arena_new_struct(b->arena, struct outer_clip);
        *clip = (struct outer_clip){o->clip[i], *c, all};
        clip->context.inverted = clip->context.drawn = false;
        clip->context.clips = NULL;
        all = clip;
    }
    return all;
}

// As flatten_clipped, of the clips of unions around the object.
void world_build_flatten(struct build *b, uint32_t root, const struct object *o,
                         const struct context *c)
{
    struct context bare = *c;
    uint32_t count = 0, first = root;
    bare.clips = NULL;
    for (const struct outer_clip *k = c->clips; k; k = k->next)
        count++;
    if (count)
        first = add_children(b, root, NODE_INTERSECTION, count + 1);
    for (const struct outer_clip *k = c->clips; k; k = k->next)
        later(b, k->object, &k->context, first + count--);
    flatten(b, first, o, &bare);
}

void world_build_mark_required(struct build *b, uint32_t root, uint32_t first_leaf)
{
    for (uint32_t i = first_leaf; i < b->leaf.count; i++) {
        struct leaf *l = (struct leaf *)b->leaf.at + i;
        uint32_t n = l->node;
        while (n != root && world_build_node(b, world_build_node(b, n)->parent)->op ==
                                NODE_INTERSECTION)
            n = world_build_node(b, n)->parent;
        l->required = n == root && l->solid && !l->inverted && l->bounded;
    }
}
