#include "trace/inside.h"

#include "base/arena.h"
#include "math/elementary.h"

static const struct inside *inside_push(struct arena *a, const struct inside *list,
                                        const struct interior *interior)
{
    struct inside *n = arena_new_struct(a, struct inside);
    *n = (struct inside){interior, list, interior->hollow && inside_hollow(list)};
    return n;
}

const struct inside *inside_enter(struct tracer *t, const struct inside *list,
                                  const struct interior *interior)
{
    struct inside_pushed *last = &t->last_push;
    if (!last->pushed || last->list != list || last->interior != interior)
        *last =
            (struct inside_pushed){list, interior, inside_push(t->arena, list, interior)};
    return last->pushed;
}

const struct inside *inside_remove(struct arena *a, const struct inside *list,
                                   const struct interior *interior)
{
    if (!list)
        return NULL;
    if (list->interior == interior)
        return list->outer;
    return inside_push(a, inside_remove(a, list->outer, interior), list->interior);
}

const struct inside *inside_at(struct arena *a, const struct world *w, struct vec3 p)
{
    enum { FEW = 32 };
    uint32_t few[FEW], *object = few;
    uint32_t count = trace_containing(w, p, object, FEW);
    if (count >= FEW) {
        object = arena_new_array(a, uint32_t, w->object_count);
        count = trace_containing(w, p, object, w->object_count);
    }
    const struct inside *list = NULL;
    for (uint32_t i = 0; i < count; i++) {
        const struct leaf *leaf = &w->leaf[w->object[object[i]].first_leaf];
        list = inside_push(a, list, w->surface[leaf->surface].interior);
    }
    return list;
}

struct objects_around objects_around(const struct world *w, struct aabb box)
{
    struct objects_around out;
    enum { MOST = sizeof out.object / sizeof *out.object };
    out.count = trace_boxes_meet(w, box, out.object, MOST);
    out.many = out.count == MOST;
    return out;
}

const struct inside *inside_among(struct arena *a, const struct world *w,
                                  const struct objects_around *few, struct vec3 p)
{
    bool any = few->many;
    for (uint32_t i = 0; i < few->count && !any; i++)
        any = world_object_inside(w, few->object[i], p);
    return any ? inside_at(a, w, p) : NULL;
}

static float fade_channel(double loss, float color)
{
    return (float)(color + (1 - (double)color) / loss);
}

struct rgb interior_fade(const struct interior *i, double s)
{
    if (interior_fades_exponentially(i)) {
        double e[3];
        interior_fade_exponents(i, s, e, 1);
        return rgb((float)det_exp_single(e[0]), (float)det_exp_single(e[1]),
                   (float)det_exp_single(e[2]));
    }
    const double loss = 1 + det_pow_single(s / i->fade_distance, i->fade_power);
    return rgb(fade_channel(loss, i->fade_color.r), fade_channel(loss, i->fade_color.g),
               fade_channel(loss, i->fade_color.b));
}
