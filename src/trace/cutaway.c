// The textures of cut surfaces (spec/shapes 3.6).
#include "trace/cutaway.h"

struct visit {
    struct vec3 p;
    double share; // weight of one texture; 0: they are being counted
    uint32_t count;
    cutaway_function *see;
    void *user;
};

static struct placed_texture inherited(const struct object *o,
                                       const struct placed_texture *above,
                                       const struct transform *world)
{
    if (!o->texture.texture)
        return *above;
    return (struct placed_texture){o->texture.texture,
                                   transform_then(o->texture.transform, world)};
}

// The parts of o that hold the point; of a difference the first one alone is asked.
static void visit(struct visit *v, const struct object *o, const struct transform *world,
                  const struct placed_texture *above)
{
    const struct placed_texture own = inherited(o, above, world);
    if (o->kind != OBJECT_CSG) {
        if (!own.texture)
            return;
        v->count++;
        if (v->share > 0)
            v->see(v->user, own.texture, &own.transform, v->share);
        return;
    }
    const struct transform inner = transform_then(o->transform, world);
    const uint32_t count = o->op == CSG_DIFFERENCE && o->child_count ? 1 : o->child_count;
    for (uint32_t i = 0; i < count; i++) {
        const struct object *part = o->child[i];
        if (part->kind != OBJECT_LIGHT &&
            object_inside(part, transform_inverse_point(&inner, v->p)))
            visit(v, part, &inner, &own);
    }
}

void cutaway_textures(const struct cutaway *c, struct vec3 p, cutaway_function *see,
                      void *user)
{
    struct visit v = {.p = p, .see = see, .user = user};
    visit(&v, c->object, &c->world, &c->texture);
    if (!v.count)
        return;
    v.share = 1.0 / v.count;
    visit(&v, c->object, &c->world, &c->texture);
}
