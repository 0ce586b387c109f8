// What the nodes of an object hand down, and the leaves that it ends in.
#include <string.h>

#include "base/arena.h"
#include "scene/shapes/mesh.h"
#include "trace/world_build.h"

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

// What is written for a union holds for its parts beside what they say themselves, and wins
// over it. What photons pass as if nothing were there is no target.
static const struct photon_target *photons_of(struct build *b,
                                              const struct photon_target *own,
                                              const struct photon_target *whole)
{
    if (!own || (!whole && !(own->target && own->pass_through)))
        return own ? own : whole;
    struct photon_target *both = arena_new_struct(b->arena, struct photon_target);
    *both = *own;
    if (whole) {
        if (whole->target)
            both->spacing = whole->spacing;
        if (whole->refraction)
            both->refraction = whole->refraction;
        if (whole->reflection)
            both->reflection = whole->reflection;
        both->target |= whole->target;
        both->pass_through |= whole->pass_through;
        both->collect &= whole->collect;
    }
    both->target = both->target && !both->pass_through;
    return both;
}

struct context world_build_enter(struct build *b, const struct object *o,
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
    in.photons = photons_of(b, o->photons, c->photons);
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
        attach(b->default_texture, &c->texture, &transform_identity);
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
    const struct texture *whole = mesh_whole_texture(o->ops, o->shape);
    s.parts = o->ops->texture && o->ops->texture(o->shape, 0);
    if (!c->texture.texture && c->flags & OBJECT_CUTAWAY) {
        s.parts = true;
        s.cutaway = cutaway_of(b);
    } else if (whole) { // as if it were the object's, in the shape's own space
        s.parts = false;
        s.texture = whole;
        s.texture_transform = c->world;
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
    *(struct surface *)world_build_add(&b->surface, 1) = s;
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

uint32_t world_build_leaf(struct build *b, const struct object *o,
                          const struct context *c)
{
    const uint32_t index = b->leaf.count;
    const uint32_t surface = add_surface(b, o, c);
    struct leaf *l = world_build_add(&b->leaf, 1);
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
