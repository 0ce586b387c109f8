#include "world_fixture.h"

#include <stdlib.h>

#include "scene/shapes/box.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"

int setup(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    f->a = arena_new(1 << 16);
    f->scene.object = f->object;
    f->scene.default_texture =
        (struct attached_texture){&grey_texture, &transform_identity};
    *state = f;
    return 0;
}

int teardown(void **state)
{
    struct fixture *f = *state;
    trace_scratch_free(f->s);
    arena_free(f->a);
    free(f);
    return 0;
}

void add(struct fixture *f, const struct object *o)
{
    f->object[f->scene.object_count++] = o;
}

void finish(struct fixture *f)
{
    f->w = world_build(f->a, &f->scene);
    f->s = trace_scratch_new(f->w);
}

struct object *sphere_at(struct fixture *f, double x, double y, double z, double r)
{
    struct sphere *s = arena_new_struct(f->a, struct sphere);
    *s = (struct sphere){vec3(x, y, z), r, transform_identity.linear};
    return object_new_shape(f->a, &sphere_ops, s, (struct span){0});
}

struct object *box_of(struct fixture *f, struct vec3 min, struct vec3 max)
{
    struct box *b = arena_new_struct(f->a, struct box);
    *b = (struct box){min, max};
    return object_new_shape(f->a, &box_ops, b, (struct span){0});
}

struct object *unit_box(struct fixture *f)
{
    return box_of(f, vec3(-1, -1, -1), vec3(1, 1, 1));
}

struct object *half_space(struct fixture *f, struct vec3 normal, double d)
{
    struct plane *p = arena_new_struct(f->a, struct plane);
    *p = (struct plane){normal, vec3_scale(d, normal)};
    return object_new_shape(f->a, &plane_ops, p, (struct span){0});
}

struct object *csg(struct fixture *f, enum csg_op op, const struct object *x,
                   const struct object *y)
{
    const struct object **child = arena_new_array(f->a, const struct object *, 2);
    child[0] = x;
    child[1] = y;
    return object_new_csg(f->a, op, child, 2, (struct span){0});
}

struct object *moved(struct fixture *f, struct object *o, struct transform t)
{
    object_transform(f->a, o, &t);
    return o;
}

struct ray_query query(struct vec3 o, struct vec3 d)
{
    return (struct ray_query){.ray = {o, d, 0, INFINITY}};
}

double first_t(struct fixture *f, struct vec3 o, struct vec3 d)
{
    struct ray_query q = query(o, d);
    return trace_closest_1(f->w, f->s, &q).b.t;
}

struct vec3 first_normal(struct fixture *f, struct vec3 o, struct vec3 d)
{
    struct ray_query q = query(o, d);
    struct hit h = trace_closest_1(f->w, f->s, &q);
    struct interaction i;
    trace_interaction(f->w, &q.ray, &h, &i);
    return i.ng;
}

double random_unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return (double)(*s >> 11) * 0x1p-53;
}

double between(uint64_t *s, double lo, double hi)
{
    return lo + (hi - lo) * random_unit(s);
}
