#include "eval/build.h"

// union, merge, intersection, difference, light_group (spec/shapes 3).

static enum csg_op op_of(enum word w)
{
    switch (w) {
    case WORD_merge: return CSG_MERGE;
    case WORD_intersection: return CSG_INTERSECTION;
    case WORD_difference: return CSG_DIFFERENCE;
    default: return CSG_UNION;
    }
}

static bool is_patch(const struct object *o)
{
    return o->kind == OBJECT_SHAPE && !(o->ops->flags & SHAPE_SOLID) && !o->ops->is_solid;
}

static struct object *children(struct args *a, enum csg_op op, uint32_t least)
{
    struct pointer_list l = {0};
    bool was = true, cuts = op == CSG_INTERSECTION || op == CSG_DIFFERENCE;
    while (a->at) {
        struct span where = args_span(a);
        const struct object *o = args_object(a, &was);
        if (!was)
            break;
        if (!o)
            continue;
        if (cuts && is_patch(o))
            args_warning(a, where, "a patch has no inside and cuts nothing");
        pointer_list_add(a->b->arena, &l, o);
    }
    if (l.count < least && !a->failed)
        args_warning(a, args_span(a), "at least two objects are expected");
    const struct object **child =
        arena_new_array(a->b->arena, const struct object *, l.count);
    for (uint32_t i = 0; i < l.count; i++)
        child[i] = l.at[i];
    return object_new_csg(a->b->arena, op, child, l.count, a->owner->where);
}

struct object *build_csg(struct args *a, const struct ast *block)
{
    struct object *o = children(a, op_of((enum word)block->word), 2);
    build_modifiers(a, o);
    return o;
}

// Lights anywhere below, each as a light of its own.
static void collect_lights(const struct object *o, struct arena *arena,
                           struct pointer_list *l)
{
    if (o->kind == OBJECT_LIGHT)
        pointer_list_add(arena, l, o->light);
    for (uint32_t i = 0; i < o->child_count; i++)
        collect_lights(o->child[i], arena, l);
}

struct object *build_light_group(struct args *a)
{
    struct object *o = children(a, CSG_UNION, 1);
    struct pointer_list l = {0};
    struct transform t;
    collect_lights(o, a->b->arena, &l);
    const struct light **light =
        arena_new_array(a->b->arena, const struct light *, l.count + 1);
    for (uint32_t i = 0; i < l.count; i++)
        light[i] = l.at[i];
    o->group_light = light; // not NULL even without lights: it is a group
    o->group_light_count = l.count;
    while (a->at) {
        static const enum word known[] = {WORD_global_lights, WORD_photons,
                                          WORD_translate, WORD_rotate, WORD_scale};
        if (build_trans(a, &t))
            object_move(a->b, o, &t);
        else if (args_take(a, WORD_global_lights))
            o->group_global_lights = args_switch(a);
        else if (args_at_block(a) == WORD_photons)
            build_photons(a, o);
        else
            args_unknown(a, known, ARRAY_COUNT(known));
    }
    return o;
}
