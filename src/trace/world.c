#include "trace/world.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "trace/accel.h"
#include "trace/coincident.h"
#include "trace/csg_bounds.h"
#include "trace/world_build.h"

void *world_build_add(struct vector *v, uint32_t n)
{
    if (v->count + n > v->capacity) {
        uint32_t capacity = v->capacity ? v->capacity : 64;
        while (capacity < v->count + n)
            capacity *= 2;
        v->at = must_realloc(v->at, capacity, v->size);
        v->capacity = capacity;
    }
    char *p = (char *)v->at + v->count * v->size;
    memset(p, 0, n * v->size);
    v->count += n;
    return p;
}

static bool splits(const struct object *o)
{
    return o->kind == OBJECT_CSG && o->op == CSG_UNION &&
           !(o->flags & (OBJECT_NO_SPLIT | OBJECT_INVERSE));
}

// The bounds of the unions around an object and its own; POV-Ray takes no notice of those of
// shapes that it meets quickly, and only the boxes of some others.
static const struct user_bound *join_bounds(struct build *b, const struct object *o,
                                            const struct context *c, uint32_t *count)
{
    const unsigned flags = o->kind == OBJECT_SHAPE ? o->ops->flags : SHAPE_BOUND_SHAPE;
    const bool exact = (flags & SHAPE_BOUND_SHAPE) != 0;
    const uint32_t own = exact || (flags & SHAPE_BOUND_BOX) ? o->bound_count : 0;
    *count = c->bound_count + own;
    if (own == 0)
        return c->bound;
    struct user_bound *all = arena_new_array(b->arena, struct user_bound, *count);
    if (c->bound_count)
        memcpy(all, c->bound, c->bound_count * sizeof *all);
    for (uint32_t i = 0; i < own; i++)
        all[c->bound_count + i] = user_bound_of(o->bound[i], &c->world, exact);
    return all;
}

// Those that hold the whole object, as they should, cost nothing.
static void drop_bounds(struct build *b, struct world_object *w)
{
    if (w->bound_count == 0)
        return;
    struct user_bound *kept =
        arena_new_array(b->arena, struct user_bound, w->bound_count);
    uint32_t n = 0;
    for (uint32_t i = 0; i < w->bound_count; i++) {
        bool holds = true;
        for (uint32_t k = 0; k < w->leaf_count && holds; k++) {
            const struct leaf *l = (struct leaf *)b->leaf.at + w->first_leaf + k;
            const struct aabb box = aabb_meet(l->bounds, w->bounds);
            holds = aabb_is_empty(box) || user_bound_holds(&w->bound[i], &box);
        }
        if (!holds)
            kept[n++] = w->bound[i];
    }
    w->bound = kept;
    w->bound_count = n;
}

static void add_object(struct build *b, const struct object *o, const struct context *c)
{
    const uint32_t first_leaf = b->leaf.count;
    const uint32_t root = b->node.count;
    world_build_add(&b->node, 1);
    world_build_node(b, root)->parent = root;
    world_build_flatten(b, root, o, c);
    if (b->leaf.count == first_leaf) {
        b->node.count = root;
        return;
    }
    const struct aabb bounds = csg_bound(b->node.at, root, b->node.count, b->leaf.at);
    world_build_mark_required(b, root, first_leaf);
    struct world_object *w = world_build_add(&b->object, 1);
    w->bounds = bounds;
    w->first_leaf = first_leaf;
    w->leaf_count = b->leaf.count - first_leaf;
    w->root = root;
    w->is_csg = world_build_node(b, root)->op != NODE_LEAF;
    if (!w->is_csg)
        b->node.count = root;
    w->node_count = b->node.count - root;
    bool some = false;
    w->opaque = true;
    for (uint32_t i = first_leaf; i < b->leaf.count; i++) {
        const struct leaf *l = (struct leaf *)b->leaf.at + i;
        const bool opaque = ((struct surface *)b->surface.at)[l->surface].opaque;
        w->opaque &= opaque || !l->drawn;
        some |= opaque && l->drawn;
    }
    w->mixed = some && !w->opaque;
    w->flags = o->flags | c->flags;
    w->source = o;
    w->bound = join_bounds(b, o, c, &w->bound_count);
    drop_bounds(b, w);
}

void world_build_top(struct build *b, const struct object *o, const struct context *c)
{
    const struct context here = world_build_group(b, o, c);
    if (o->kind == OBJECT_LIGHT) {
        world_build_light(b, o, &here);
    } else if (splits(o)) {
        struct context in = world_build_enter(b, o, &here);
        in.bound = join_bounds(b, o, &here, &in.bound_count);
        in.clips = world_build_join_clips(b, o, &here);
        for (uint32_t i = 0; i < o->child_count; i++)
            world_build_top(b, o->child[i], &in);
    } else {
        b->top = o;
        b->top_context = &here;
        b->cutaway = NULL;
        add_object(b, o, &here);
    }
}

static void *keep(struct arena *a, struct vector *v)
{
    void *p = arena_alloc_aligned(a, v->count * v->size + 1, 64);
    if (v->count)
        memcpy(p, v->at, v->count * v->size);
    free(v->at);
    return p;
}

// The world with some objects alone.
static const struct world *part_of(struct arena *a, const struct world *w,
                                   enum accel_part part)
{
    struct world *x = arena_new_struct(a, struct world);
    *x = *w;
    x->accel = accel_build_part(a, w, part);
    return x;
}

// Where nothing, or all, is opaque, the world itself is one of the two.
static void split(struct arena *a, struct world *w)
{
    uint32_t opaque = 0;
    for (uint32_t i = 0; i < w->object_count; i++)
        opaque += w->object[i].opaque;
    w->dark = w;
    if (!w->has_transparent)
        return;
    w->clear = opaque ? part_of(a, w, ACCEL_CLEAR) : w;
    w->dark = part_of(a, w, ACCEL_OPAQUE);
}

struct world *world_build(struct arena *a, const struct scene *scene)
{
    struct build b = {.arena = a, .scene = scene};
    b.leaf.size = sizeof(struct leaf);
    b.node.size = sizeof(struct csg_node);
    b.object.size = sizeof(struct world_object);
    b.surface.size = sizeof(struct surface);
    b.light.size = sizeof(struct light *);
    b.group.size = sizeof(struct light_group);
    b.group_parent.size = sizeof(uint32_t);
    b.pending.size = sizeof(struct pending);
    const struct context top = {.world = transform_identity, .drawn = true};
    for (uint32_t i = 0, past = 0; i < scene->object_count; i++) {
        while (past < scene->past_default_count && scene->past_default[past]->until <= i)
            past++;
        b.default_texture = past < scene->past_default_count
                                ? &scene->past_default[past]->texture
                                : &scene->default_texture;
        world_build_top(&b, scene->object[i], &top);
    }
    world_build_join_groups(&b);

    struct world *w = arena_new_struct(a, struct world);
    w->arena = a;
    w->scene = scene;
    w->leaf_count = b.leaf.count;
    w->node_count = b.node.count;
    w->object_count = b.object.count;
    w->surface_count = b.surface.count;
    w->light_count = b.light.count;
    w->light_group_count = b.group.count;
    w->has_transparent = b.has_transparent;
    w->leaf = keep(a, &b.leaf);
    w->node = keep(a, &b.node);
    w->object = keep(a, &b.object);
    w->surface = keep(a, &b.surface);
    w->light = keep(a, &b.light);
    w->light_group = keep(a, &b.group);
    free(b.pending.at);
    w->bounds = aabb_empty();
    for (uint32_t i = 0; i < w->object_count; i++)
        if (aabb_is_finite(w->object[i].bounds))
            w->bounds = aabb_join(w->bounds, w->object[i].bounds);
    w->accel = accel_build(a, w);
    split(a, w);
    coincident_mark(w);
    return w;
}
