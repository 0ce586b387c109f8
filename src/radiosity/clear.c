// Objects that are clear all over have no light of their own and let all of others' through:
// patches do not see them.
#include <stdlib.h>

#include "base/memory.h"
#include "radiosity/radiosity.h"
#include "scene/texture.h"
#include "trace/accel.h"

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
    struct clear_world *c = must_calloc(1, sizeof *c);
    c->accel = must_malloc(1, sizeof *c->accel);
    c->object = must_malloc(w->object_count, sizeof *c->object);
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
