#include "trace/world.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "trace/accel.h"
#include "trace/csg_bounds.h"
#include "trace/cutaway.h"
#include "trace/user_bounds.h"

// What a node takes from the nodes above it, in world space.
struct context {
    struct transform world;        // from the space outside the node
    struct placed_texture texture; // inherited; NULL: none yet
    struct placed_texture interior_texture;
    struct interior *interior;
    const struct photon_target *photons;
    unsigned flags; // OR of the flags above
    bool inverted, drawn;
    bool interior_given; // false: the scene says nothing of an interior
    uint32_t light_group;
    float importance;
    const struct user_bound *bound; // of unions that were split
    uint32_t bound_count;
    const struct outer_clip *clips; // of those, too
};

// What clips a union that was split clips each of its children.
struct outer_clip {
    const struct object *object;
    struct context context;
    const struct outer_clip *next;
};

// A node waiting to be flattened into its slot. A stack rather than recursion: trees may
// be thousands of levels deep.
struct pending {
    const struct object *object;
    struct context context;
    uint32_t node;
};

struct vector {
    void *at;
    uint32_t count, capacity;
    size_t size;
};

static void *vector_add(struct vector *v, uint32_t n)
{
    if (v->count + n > v->capacity) {
        uint32_t capacity = v->capacity ? v->capacity : 64;
        while (capacity < v->count + n)
            capacity *= 2;
        v->at = realloc(v->at, capacity * v->size);
        if (!v->at)
            abort();
        v->capacity = capacity;
    }
    char *p = (char *)v->at + v->count * v->size;
    memset(p, 0, n * v->size);
    v->count += n;
    return p;
}

struct build {
    struct arena *arena;
    const struct scene *scene;
    struct vector leaf, node, object, surface, light, group, group_parent, pending;
    const struct transform *transform; // the last one stored
    const struct interior *plain[2];   // of opaque surfaces; [1]: hollow
    bool has_transparent;
    // The top-level object at hand, for cutaway_textures; made when one needs it.
    const struct object *top;
    const struct context *top_context;
    const struct cutaway *cutaway;
};

static void add_top(struct build *b, const struct object *o, const struct context *c);

// ---- lights -------------------------------------------------------------------

static void place_light(struct light *l, const struct transform *t)
{
    l->location = transform_point(t, l->location);
    l->point_at = transform_point(t, l->point_at);
    l->axis = vec3_normalize(transform_vector(t, l->axis));
    l->axis1 = transform_vector(t, l->axis1);
    l->axis2 = transform_vector(t, l->axis2);
}

static const struct object *placed(struct build *b, const struct object *o,
                                   const struct transform *t)
{
    struct object *copy = object_copy(b->arena, o);
    object_transform(b->arena, copy, t);
    return copy;
}

static void add_light(struct build *b, const struct object *o, const struct context *c)
{
    struct light *l = arena_new_struct(b->arena, struct light);
    const struct transform t = transform_then(o->transform, &c->world);
    *l = *o->light;
    place_light(l, &t);
    if (l->projected_through)
        l->projected_through = placed(b, l->projected_through, &t);
    if (c->light_group == 0)
        *(const struct light **)vector_add(&b->light, 1) = l;
    else {
        struct light_group *g = (struct light_group *)b->group.at + c->light_group - 1;
        const struct light **more = arena_alloc(b->arena, (g->count + 1) * sizeof *more);
        if (g->count)
            memcpy(more, g->light, g->count * sizeof *more);
        more[g->count++] = l;
        g->light = more;
    }
    if (l->looks_like) {
        struct object *look = object_copy(b->arena, placed(b, l->looks_like, &t));
        look->flags |= OBJECT_NO_SHADOW;
        struct context plain = {
            .world = transform_identity, .drawn = true, .light_group = c->light_group};
        add_top(b, look, &plain);
    }
}

// Lights below a node that is flattened whole, in written order.
static void add_lights_below(struct build *b, const struct object *o,
                             const struct context *c)
{
    if (o->kind == OBJECT_LIGHT) {
        add_light(b, o, c);
        return;
    }
    struct context inner = *c;
    inner.world = transform_then(o->transform, &c->world);
    for (uint32_t i = 0; o->kind == OBJECT_CSG && i < o->child_count; i++)
        if (o->child[i]->kind == OBJECT_LIGHT)
            add_light(b, o->child[i], &inner);
}

// ---- inheritance -----------------------------------------------------------------

static struct placed_texture attach(const struct attached_texture *own,
                                    const struct placed_texture *inherited,
                                    const struct transform *world)
{
    if (!own->texture)
        return *inherited;
    return (struct placed_texture){own->texture, transform_then(own->transform, world)};
}

static struct interior *new_interior(struct build *b, const struct interior *given,
                                     bool hollow)
{
    struct interior *i = arena_new_struct(b->arena, struct interior);
    if (given)
        *i = *given;
    else
        *i = (struct interior){
            .dispersion = 1, .dispersion_samples = 7, .old_refraction = 1};
    i->hollow = hollow;
    return i;
}

// The finish of an object's own plain texture, the top layer's, where it says what today an
// interior says (spec/lighting.md 5.1); NULL: there is none.
static const struct finish *old_finish(const struct object *o)
{
    const struct texture *x = o->texture.texture;
    if (!x || x->kind != TEXTURE_PLAIN || !x->layer_count)
        return NULL;
    const struct finish *f = x->layer[x->layer_count - 1].finish;
    return f->old_ior >= 0 || f->old_caustics >= 0 || f->old_refraction >= 0 ? f : NULL;
}

// Every object has an interior of its own, whose identity says which surfaces bound the
// same medium; children without one share their parent's (spec/lighting.md 4.1). That of a
// shape nothing is said of waits for its surface: see plain_interior. What an old finish says
// of a shared one holds for all that share it.
static struct interior *interior_of(struct build *b, const struct object *o,
                                    const struct context *c, bool hollow)
{
    const struct finish *f = old_finish(o);
    struct interior *i = c->interior;
    if (o->interior || (!i && (f || o->kind != OBJECT_SHAPE)))
        i = new_interior(
            b, o->interior ? interior_moved(b->arena, o->interior, &c->world) : NULL,
            hollow);
    if (f && f->old_ior >= 0)
        i->ior = f->old_ior;
    if (f && f->old_caustics >= 0)
        i->caustics = f->old_caustics;
    if (f && f->old_refraction >= 0)
        i->old_refraction = f->old_refraction;
    return i;
}

// No ray enters through an opaque surface, so nobody asks for the identity of an interior
// that has no properties: one serves all.
static const struct interior *plain_interior(struct build *b, const struct context *c,
                                             bool opaque)
{
    const bool hollow = (c->flags & OBJECT_HOLLOW) != 0;
    if (!opaque)
        return c->interior ? c->interior : new_interior(b, NULL, hollow);
    if (!b->plain[hollow])
        b->plain[hollow] = new_interior(b, NULL, hollow);
    return b->plain[hollow];
}

// The context inside node o, for its children or its shape.
static struct context enter(struct build *b, const struct object *o,
                            const struct context *c)
{
    struct context in = *c;
    in.texture = attach(&o->texture, &c->texture, &c->world);
    in.interior_texture = attach(&o->interior_texture, &c->interior_texture, &c->world);
    unsigned inherited = c->flags & ~(unsigned)(OBJECT_INVERSE | OBJECT_HOLLOW_SET |
                                                OBJECT_UV_MAPPING | OBJECT_NO_SPLIT);
    if (o->flags & OBJECT_HOLLOW_SET)
        inherited &= ~(unsigned)OBJECT_HOLLOW;
    // A texture mapped by uv stays so for the children that inherit it.
    if (!o->texture.texture)
        inherited |= c->flags & OBJECT_UV_MAPPING;
    in.flags = inherited | o->flags;
    if (o->importance > 0)
        in.importance = o->importance;
    in.interior = interior_of(b, o, c, (in.flags & OBJECT_HOLLOW) != 0);
    in.interior_given = o->interior || old_finish(o) || c->interior_given;
    in.inverted = c->inverted != ((o->flags & OBJECT_INVERSE) != 0);
    if (o->photons)
        in.photons = o->photons;
    in.world = transform_then(o->transform, &c->world);
    return in;
}

// ---- leaves ------------------------------------------------------------------------

static bool same_transform(const struct transform *a, const struct transform *b)
{
    return a->identity == b->identity &&
           (a->identity || (!memcmp(&a->linear, &b->linear, sizeof a->linear) &&
                            !memcmp(&a->offset, &b->offset, sizeof a->offset)));
}

static bool same_surface(const struct surface *a, const struct surface *b)
{
    return !a->parts && !b->parts && a->texture == b->texture &&
           a->interior_texture == b->interior_texture && a->interior == b->interior &&
           a->photons == b->photons && a->flags == b->flags &&
           a->light_group == b->light_group && a->importance == b->importance &&
           same_transform(&a->texture_transform, &b->texture_transform) &&
           same_transform(&a->interior_texture_transform, &b->interior_texture_transform);
}

static const struct cutaway *cutaway_of(struct build *b)
{
    if (!b->cutaway) {
        struct cutaway *c = arena_new_struct(b->arena, struct cutaway);
        *c = (struct cutaway){b->top, b->top_context->world, b->top_context->texture};
        b->cutaway = c;
    }
    return b->cutaway;
}

// Neighbours in the tree mostly share their surface; they are stored once.
static uint32_t add_surface(struct build *b, const struct object *o,
                            const struct context *c)
{
    const struct placed_texture unnamed =
        attach(&b->scene->default_texture, &c->texture, &transform_identity);
    const struct placed_texture *t = c->texture.texture ? &c->texture : &unnamed;
    struct surface s = {.texture = t->texture,
                        .texture_transform = t->transform,
                        .interior_texture = c->interior_texture.texture,
                        .interior_texture_transform = c->interior_texture.transform,
                        .interior = c->interior,
                        .photons = c->photons,
                        .flags = c->flags,
                        .light_group = c->light_group,
                        .importance = c->importance};
    if (!(s.importance > 0))
        s.importance = (float)b->scene->settings.radiosity_settings.importance;
    s.parts = o->ops->texture && o->ops->texture(o->shape, 0);
    if (!c->texture.texture && c->flags & OBJECT_CUTAWAY) {
        s.parts = true;
        s.cutaway = cutaway_of(b);
    }
    s.opaque = texture_is_opaque(s.texture) &&
               (!s.interior_texture || texture_is_opaque(s.interior_texture));
    s.wants_uv = (s.flags & OBJECT_UV_MAPPING) || texture_wants_uv(s.texture) ||
                 (s.interior_texture && texture_wants_uv(s.interior_texture));
    const struct texture *x;
    if (s.cutaway) { // any texture of the object may be seen
        s.opaque = false;
        s.wants_uv = true;
    }
    for (uint32_t i = 0; s.parts && !s.cutaway && (x = o->ops->texture(o->shape, i));
         i++) {
        s.opaque &= texture_is_opaque(x);
        s.wants_uv |= texture_wants_uv(x);
    }
    if (!c->interior_given)
        s.interior = plain_interior(b, c, s.opaque);
    const uint32_t count = b->surface.count;
    if (count && same_surface((struct surface *)b->surface.at + count - 1, &s))
        return count - 1;
    b->has_transparent |= !s.opaque;
    *(struct surface *)vector_add(&b->surface, 1) = s;
    return count;
}

// Neighbours mostly share their transform, too.
static const struct transform *shared_transform(struct build *b,
                                                const struct transform *t)
{
    if (!b->transform || !same_transform(b->transform, t)) {
        struct transform *copy = arena_new_struct(b->arena, struct transform);
        *copy = *t;
        b->transform = copy;
    }
    return b->transform;
}

// The largest factor by which a row vector's largest component can grow.
static double stretch_of(const struct mat3 *m)
{
    double most = 0;
    for (int j = 0; j < 3; j++)
        most = fmax(most, fabs(m->m[0][j]) + fabs(m->m[1][j]) + fabs(m->m[2][j]));
    return most;
}

static uint32_t add_leaf(struct build *b, const struct object *o, const struct context *c)
{
    const uint32_t index = b->leaf.count;
    const uint32_t surface = add_surface(b, o, c);
    struct leaf *l = vector_add(&b->leaf, 1);
    l->ops = o->ops;
    l->shape = o->shape;
    l->surface = surface;
    l->object = b->object.count;
    l->solid = shape_is_solid(o->ops, o->shape);
    l->bounded = shape_is_bounded(o->ops, o->shape);
    l->inverted = l->solid && c->inverted;
    l->drawn = c->drawn;
    l->transform = &transform_identity;
    bool moved = !c->world.identity;
    if (moved && o->ops->absorb) {
        void *copy = arena_alloc(b->arena, o->ops->size);
        memcpy(copy, o->shape, o->ops->size);
        if (o->ops->absorb(copy, &c->world)) {
            l->shape = copy;
            moved = false;
        }
    }
    if (moved)
        l->transform = shared_transform(b, &c->world);
    l->stretch = stretch_of(&l->transform->inverse);
    l->bounds = shape_placed_bounds(o->ops, l->shape, l->transform);
    return index;
}

// ---- expressions ---------------------------------------------------------------------

static enum node_op op_of(const struct object *o, bool inverted)
{
    switch (o->op) {
    case CSG_UNION: return inverted ? NODE_INTERSECTION : NODE_UNION;
    case CSG_MERGE: return inverted ? NODE_INTERSECTION : NODE_MERGE;
    default: return inverted ? NODE_MERGE : NODE_INTERSECTION;
    }
}

static struct csg_node *node_at(struct build *b, uint32_t i)
{
    return (struct csg_node *)b->node.at + i;
}

static uint32_t add_children(struct build *b, uint32_t parent, enum node_op op,
                             uint32_t count)
{
    const uint32_t first = b->node.count;
    vector_add(&b->node, count);
    struct csg_node *n = node_at(b, parent);
    n->op = op;
    n->first_child = first;
    n->child_count = count;
    for (uint32_t i = 0; i < count; i++)
        node_at(b, first + i)->parent = parent;
    return first;
}

static void later(struct build *b, const struct object *o, const struct context *c,
                  uint32_t node)
{
    struct pending *p = vector_add(&b->pending, 1);
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
        const struct context in = enter(b, p.object, &p.context);
        if (p.object->kind == OBJECT_CSG) {
            add_lights_below(b, p.object, &p.context);
            flatten_csg(b, p.object, &in, p.node);
        } else {
            const uint32_t leaf = add_leaf(b, p.object, &in);
            struct csg_node *n = node_at(b, p.node);
            n->op = NODE_LEAF;
            n->leaf = leaf;
            ((struct leaf *)b->leaf.at)[leaf].node = p.node;
        }
    }
}

// ---- top level ------------------------------------------------------------------------

static bool splits(const struct object *o)
{
    return o->kind == OBJECT_CSG && o->op == CSG_UNION &&
           !(o->flags & (OBJECT_NO_SPLIT | OBJECT_INVERSE));
}

// The clips of a union that is split, before those around it.
static const struct outer_clip *join_clips(struct build *b, const struct object *o,
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
static void flatten_top(struct build *b, uint32_t root, const struct object *o,
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

// Marks the leaves without which there is nothing of the object.
static void mark_required(struct build *b, uint32_t root, uint32_t first_leaf)
{
    for (uint32_t i = first_leaf; i < b->leaf.count; i++) {
        struct leaf *l = (struct leaf *)b->leaf.at + i;
        uint32_t n = l->node;
        while (n != root && node_at(b, node_at(b, n)->parent)->op == NODE_INTERSECTION)
            n = node_at(b, n)->parent;
        l->required = n == root && l->solid && !l->inverted && l->bounded;
    }
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
    vector_add(&b->node, 1);
    node_at(b, root)->parent = root;
    flatten_top(b, root, o, c);
    if (b->leaf.count == first_leaf) {
        b->node.count = root;
        return;
    }
    const struct aabb bounds = csg_bound(b->node.at, root, b->node.count, b->leaf.at);
    mark_required(b, root, first_leaf);
    struct world_object *w = vector_add(&b->object, 1);
    w->bounds = bounds;
    w->first_leaf = first_leaf;
    w->leaf_count = b->leaf.count - first_leaf;
    w->root = root;
    w->is_csg = node_at(b, root)->op != NODE_LEAF;
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

// A light group's lights are children of it and are added when they are met.
static struct context group_context(struct build *b, const struct object *o,
                                    const struct context *c)
{
    struct context in = *c;
    if (!o->group_light)
        return in;
    struct light_group *g = vector_add(&b->group, 1);
    *(uint32_t *)vector_add(&b->group_parent, 1) = c->light_group;
    g->global_lights = o->group_global_lights;
    in.light_group = b->group.count;
    return in;
}

// The lights of a group shine on the groups within it, too.
static void join_groups(struct build *b)
{
    struct light_group *all = b->group.at;
    for (uint32_t i = 0; i < b->group.count; i++) {
        const uint32_t parent = ((uint32_t *)b->group_parent.at)[i];
        if (!parent)
            continue;
        const struct light_group *p = &all[parent - 1];
        struct light_group *g = &all[i];
        const struct light **list =
            arena_new_array(b->arena, const struct light *, p->count + g->count + 1);
        for (uint32_t k = 0; k < p->count; k++)
            list[k] = p->light[k];
        for (uint32_t k = 0; k < g->count; k++)
            list[p->count + k] = g->light[k];
        g->light = list;
        g->count += p->count;
        g->global_lights = g->global_lights && p->global_lights;
    }
    free(b->group_parent.at);
}

static void add_top(struct build *b, const struct object *o, const struct context *c)
{
    const struct context here = group_context(b, o, c);
    if (o->kind == OBJECT_LIGHT) {
        add_light(b, o, &here);
    } else if (splits(o)) {
        struct context in = enter(b, o, &here);
        in.bound = join_bounds(b, o, &here, &in.bound_count);
        in.clips = join_clips(b, o, &here);
        for (uint32_t i = 0; i < o->child_count; i++)
            add_top(b, o->child[i], &in);
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
    for (uint32_t i = 0; i < scene->object_count; i++)
        add_top(&b, scene->object[i], &top);
    join_groups(&b);

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
    return w;
}
