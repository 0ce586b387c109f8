// Lights and the groups they shine on.
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "trace/world_build.h"

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

void world_build_light(struct build *b, const struct object *o, const struct context *c)
{
    struct light *l = arena_new_struct(b->arena, struct light);
    const struct transform t = transform_then(o->transform, &c->world);
    *l = *o->light;
    place_light(l, &t);
    if (l->projected_through)
        l->projected_through = placed(b, l->projected_through, &t);
    if (c->light_group == 0)
        *(const struct light **)world_build_add(&b->light, 1) = l;
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
        world_build_top(b, look, &plain);
    }
}

void world_build_lights_below(struct build *b, const struct object *o,
                              const struct context *c)
{
    if (o->kind == OBJECT_LIGHT) {
        world_build_light(b, o, c);
        return;
    }
    struct context inner = *c;
    inner.world = transform_then(o->transform, &c->world);
    for (uint32_t i = 0; o->kind == OBJECT_CSG && i < o->child_count; i++)
        if (o->child[i]->kind == OBJECT_LIGHT)
            world_build_light(b, o->child[i], &inner);
}

struct context world_build_group(struct build *b, const struct object *o,
                                 const struct context *c)
{
    struct context in = *c;
    if (!o->group_light)
        return in;
    struct light_group *g = world_build_add(&b->group, 1);
    *(uint32_t *)world_build_add(&b->group_parent, 1) = c->light_group;
    g->global_lights = o->group_global_lights;
    in.light_group = b->group.count;
    return in;
}

void world_build_join_groups(struct build *b)
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
