#include "api/probe.h"

#include "base/arena.h"
#include "scene/scene.h"
#include "trace/intersect.h"
#include "trace/world.h"

// A hit nearer than this part of the origin's size is the surface that the origin was
// computed to lie on: the roundings of a root and of a few steps in the language.
static const double own_surface = 1e-11;

struct target {
    const struct object *object;
    struct scene scene;
    struct world *world;
    struct trace_scratch *scratch;
};

struct probe {
    struct arena *arena;
    struct target **target; // open addressing by the object's address
    size_t count, capacity; // a power of 2
};

struct probe *probe_new(void)
{
    struct arena *a = arena_new(1 << 16);
    struct probe *p = arena_new_struct(a, struct probe);
    p->arena = a;
    p->capacity = 64;
    p->target = arena_new_array(a, struct target *, p->capacity);
    return p;
}

void probe_free(struct probe *p)
{
    for (size_t i = 0; i < p->capacity; i++)
        if (p->target[i])
            trace_scratch_free(p->target[i]->scratch);
    arena_free(p->arena);
}

// Where an object is in the table or belongs. Addresses decide nothing but the speed.
static struct target **find(const struct probe *p, const struct object *o)
{
    size_t i = (size_t)((uintptr_t)o / _Alignof(struct object) * 0x9E3779B1u);
    for (;; i++) {
        struct target **t = &p->target[i & (p->capacity - 1)];
        if (!*t || (*t)->object == o)
            return t;
    }
}

static void grow(struct probe *p)
{
    const struct probe old = *p;
    p->capacity *= 2;
    p->target = arena_new_array(p->arena, struct target *, p->capacity);
    for (size_t i = 0; i < old.capacity; i++)
        if (old.target[i])
            *find(p, old.target[i]->object) = old.target[i];
}

static struct target *compile(struct probe *p, const struct object *o)
{
    static const struct pigment black;
    static const struct texture_layer layer = {.pigment = &black,
                                               .finish = &finish_default};
    static const struct texture plain = {.layer = &layer, .layer_count = 1};
    struct target *t = arena_new_struct(p->arena, struct target);
    const struct object **only = arena_new_array(p->arena, const struct object *, 1);
    only[0] = o;
    t->object = o;
    t->scene.object = only;
    t->scene.object_count = 1;
    t->scene.default_texture.texture = &plain;
    t->scene.default_texture.transform = &transform_identity;
    t->world = world_build(p->arena, &t->scene);
    t->scratch = trace_scratch_new(t->world);
    return t;
}

bool probe_trace(void *user, const struct object *o, struct vec3 from, struct vec3 d,
                 struct vec3 *hit, struct vec3 *normal)
{
    struct probe *p = user;
    struct target **t = find(p, o);
    if (!*t) {
        if (2 * ++p->count > p->capacity) {
            grow(p);
            t = find(p, o);
        }
        *t = compile(p, o);
    }
    const struct world *w = (*t)->world;
    const struct ray_query q = {.ray = {.o = from,
                                        .d = d,
                                        .t_min = own_surface * vec3_max_abs(from),
                                        .t_max = INFINITY}};
    struct hit h = trace_closest_1(w, (*t)->scratch, &q);
    if (!(h.b.t < INFINITY))
        return false;
    struct interaction i;
    trace_interaction(w, &q.ray, &h, &i);
    *hit = i.p;
    *normal = i.ns;
    return true;
}
