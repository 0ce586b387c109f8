#include "tess/parts.h"

#include "base/arena.h"
#include "tess/sheet.h"

static bool is_solid_part(const struct object *o)
{
    return object_is_solid(o) && aabb_is_finite(object_bounds(o));
}

static bool comes_apart(const struct object *o)
{
    return o->kind == OBJECT_CSG && o->op == CSG_UNION && !o->clip_count &&
           !(o->flags & OBJECT_INVERSE) && !is_sheet(o) && !is_solid_part(o);
}

static uint32_t count_parts(const struct object *o)
{
    if (!comes_apart(o))
        return 1;
    uint32_t n = 0;
    for (uint32_t i = 0; i < o->child_count; i++)
        n += count_parts(o->child[i]);
    return n;
}

struct part_list {
    const struct object **at;
    uint32_t count;
};

static void collect(struct arena *a, const struct object *o,
                    const struct transform *outer, struct part_list *solids,
                    struct part_list *sheets, struct tess_parts *out)
{
    if (o->kind == OBJECT_LIGHT)
        return;
    if (comes_apart(o)) {
        const struct transform t = transform_then(o->transform, outer);
        for (uint32_t i = 0; i < o->child_count; i++)
            collect(a, o->child[i], &t, solids, sheets, out);
        return;
    }
    struct part_list *list = is_sheet(o) ? sheets : is_solid_part(o) ? solids : NULL;
    if (!list) {
        out->other = out->other ? out->other : o;
        return;
    }
    struct object *moved = object_copy(a, o);
    object_transform(a, moved, outer);
    list->at[list->count++] = moved;
}

static const struct object *together(struct arena *a, const struct part_list *list,
                                     struct span where)
{
    return list->count == 0 ? NULL
           : list->count == 1
               ? list->at[0]
               : object_new_csg(a, CSG_UNION, list->at, list->count, where);
}

void tess_parts_of(struct arena *a, const struct object *o, struct tess_parts *out)
{
    *out = (struct tess_parts){0};
    if (!comes_apart(o)) {
        if (is_sheet(o))
            out->sheet = o;
        else if (is_solid_part(o))
            out->solid = o;
        else
            out->other = o;
        return;
    }
    const uint32_t n = count_parts(o);
    struct part_list solids = {arena_new_array(a, const struct object *, n + 1), 0};
    struct part_list sheets = {arena_new_array(a, const struct object *, n + 1), 0};
    collect(a, o, &transform_identity, &solids, &sheets, out);
    out->solid = together(a, &solids, o->where);
    out->sheet = together(a, &sheets, o->where);
}
