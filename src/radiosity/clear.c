// Objects that are clear all over have no light of their own and let all of others' through:
// patches do not see them.
#include <stdlib.h>

#include "radiosity/radiosity.h"
#include "scene/texture.h"
#include "trace/accel.h"

static bool color_is_clear(struct rgbft c)
{
    static const float rounding = 1e-6f; // of the sum
    return c.filter + c.transmit >= 1 - rounding;
}

static bool pigment_is_clear(const struct pigment *p)
{
    switch (p->kind) {
    case PIGMENT_SOLID: return color_is_clear(p->color);
    case PIGMENT_COLORS:
        for (uint32_t i = 0; i < p->colors->count; i++)
            if (!color_is_clear(p->colors->color[i]))
                return false;
        return true;
    case PIGMENT_MAP:
    case PIGMENT_AVERAGE:
    case PIGMENT_UV:
        for (uint32_t i = 0; i < p->map->count; i++)
            if (!pigment_is_clear(p->map->entry[i]))
                return false;
        return true;
    case PIGMENT_NONE:
    case PIGMENT_IMAGE: break;
    }
    return false;
}

static bool texture_is_clear(const struct texture *x)
{
    if (x->kind == TEXTURE_PLAIN) {
        for (uint32_t i = 0; i < x->layer_count; i++)
            if (!pigment_is_clear(x->layer[i].pigment))
                return false;
        return x->layer_count > 0;
    }
    for (uint32_t i = 0; i < x->map->count; i++)
        if (!texture_is_clear(x->map->entry[i]))
            return false;
    return true;
}

static bool object_is_clear(const struct world *w, const struct world_object *o)
{
    if (o->opaque || o->mixed)
        return false;
    for (uint32_t i = 0; i < o->leaf_count; i++) {
        const struct leaf *l = &w->leaf[o->first_leaf + i];
        const struct surface *s = &w->surface[l->surface];
        if (l->drawn && (s->parts || !texture_is_clear(s->texture) ||
                         (s->interior_texture && !texture_is_clear(s->interior_texture))))
            return false;
    }
    return true;
}

const struct job *clear_left_out(const struct job *job, struct clear_world **out)
{
    const struct world *w = job->world;
    uint32_t first = 0;
    *out = NULL;
    while (first < w->object_count && !object_is_clear(w, &w->object[first]))
        first++;
    if (first == w->object_count)
        return job;
    struct clear_world *c = calloc(1, sizeof *c);
    if (!c || !(c->accel = malloc(sizeof *c->accel)) ||
        !(c->object = malloc(w->object_count * sizeof *c->object)))
        abort();
    for (uint32_t i = 0; i < w->object_count; i++) {
        c->object[i] = w->object[i];
        if (object_is_clear(w, &w->object[i]))
            c->object[i].flags |= OBJECT_NO_RADIOSITY;
    }
    *c->accel = *w->accel;
    c->accel->flags |= OBJECT_NO_RADIOSITY;
    c->accel->lone_flags |= OBJECT_NO_RADIOSITY;
    c->world = *w;
    c->world.object = c->object;
    c->world.accel = c->accel;
    c->job = *job;
    c->job.world = &c->world;
    *out = c;
    return &c->job;
}

void clear_world_free(struct clear_world *c)
{
    if (!c)
        return;
    free(c->accel);
    free(c->object);
    free(c);
}
