#include "tess/solid.h"

#include "base/arena.h"
#include "scene/scene.h"
#include "trace/intersect.h"
#include "trace/scratch.h"
#include "trace/world.h"

void tess_solid_open(struct tess_solid *s, struct arena *a, const struct object *object)
{
    static const struct pigment black;
    static const struct texture_layer layer = {.pigment = &black,
                                               .finish = &finish_default};
    static const struct texture plain = {.layer = &layer, .layer_count = 1};
    struct scene *scene = arena_new_struct(a, struct scene);
    const struct object **only = arena_new_array(a, const struct object *, 1);
    only[0] = object;
    scene->object = only;
    scene->object_count = 1;
    scene->default_texture.texture = &plain;
    scene->default_texture.transform = &transform_identity;
    *s = (struct tess_solid){.object = object, .bounds = object_bounds(object)};
    s->world = world_build(a, scene);
    if (s->world)
        s->scratch = trace_scratch_new(s->world);
}

void tess_solid_close(struct tess_solid *s)
{
    if (s->scratch)
        trace_scratch_free(s->scratch);
    s->scratch = NULL;
    boundary_list_free(&s->crossings);
}

bool tess_solid_inside(const struct tess_solid *s, struct vec3 p)
{
    return object_inside(s->object, p);
}

bool tess_solid_first(const struct tess_solid *s, struct vec3 from, struct vec3 to,
                      struct tess_crossing *out)
{
    const struct vec3 way = vec3_sub(to, from);
    const struct ray_query q = {
        .ray = {.o = from, .d = vec3_normalize(way), .t_max = vec3_length(way)}};
    const struct hit hit = trace_closest_1(s->world, s->scratch, &q);
    if (!(hit.b.t < q.ray.t_max))
        return false;
    struct interaction i;
    trace_interaction(s->world, &q.ray, &hit, &i);
    *out = (struct tess_crossing){i.p, i.ng, hit.b.leaf, hit.b.part};
    return vec3_dot(i.ng, q.ray.d) < 0;
}

bool tess_solid_project(struct tess_solid *s, const struct tess_crossing *on,
                        struct vec3 p, struct tess_crossing *out)
{
    const struct ray ray = {p, on->n, -INFINITY, INFINITY};
    struct boundary_list *list = &s->crossings;
    list->count = 0;
    leaf_crossings(s->world, on->leaf, &ray, list);
    const struct boundary *near = NULL;
    for (uint32_t i = 0; i < list->count; i++) {
        const struct boundary *b = &list->at[i];
        if (b->drawn && b->part == on->part && (!near || fabs(b->t) < fabs(near->t)))
            near = b;
    }
    if (!near)
        return false;
    struct interaction i;
    const struct hit hit = {*near};
    trace_interaction(s->world, &ray, &hit, &i);
    *out = (struct tess_crossing){i.p, i.ng, on->leaf, on->part};
    return true;
}

// The surface drawn may lie elsewhere than the boundary of what is inside: clips cut
// without a surface. Halving finds the boundary to the last bits of the segment.
static struct vec3 halve(const struct tess_solid *s, struct vec3 out, struct vec3 in)
{
    enum { STEPS = 48 };
    for (int i = 0; i < STEPS; i++) {
        const struct vec3 mid = vec3_scale(0.5, vec3_add(out, in));
        if (tess_solid_inside(s, mid))
            in = mid;
        else
            out = mid;
    }
    return vec3_scale(0.5, vec3_add(out, in));
}

struct tess_crossing tess_solid_crossing(const struct tess_solid *s, struct vec3 outside,
                                         struct vec3 inside)
{
    struct tess_crossing c;
    if (tess_solid_first(s, outside, inside, &c))
        return c;
    return (struct tess_crossing){halve(s, outside, inside), {0, 0, 0}, 0, 0};
}
