// Intersections whose parts stand each in a space of its own: up to PRODUCT_SPACES of these
// packets test quickly, and what they find has the bits of the sweep.
#include "test.h"

#include "packet_maker.h"

#include "base/arena.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/sphere.h"
#include "trace/accel.h"

enum { PARTS_MOST = PRODUCT_SPACES + 2 };

// A ball with holes, each turned and stretched in its own way.
static struct object *turned_parts(struct maker *m, uint32_t parts)
{
    const struct object **child = arena_new_array(m->a, const struct object *, parts + 1);
    const struct sphere ball = {{0, 0, 0}, 1, transform_identity.linear};
    child[0] = of(m, &sphere_ops, &ball);
    for (uint32_t i = 1; i <= parts; i++) {
        const struct vec3 c = somewhere(m, .9);
        const double r = between(m, .1, .4);
        const struct box b = {vec3_sub(c, vec3(r, r, r)), vec3_add(c, vec3(r, r, r))};
        const struct cylinder z = {
            .frame = frame_around(c, vec3(0, .5, 1)), .length = 2 * r, .radius = r};
        struct object *o = i % 2 ? of(m, &box_ops, &b) : of(m, &cylinder_ops, &z);
        struct transform t = transform_rotate(somewhere(m, 90));
        object_transform(m->a, o, &t);
        t = transform_scale(vec3(1, 1 + .1 * i, 1));
        object_transform(m->a, o, &t);
        child[i] = o;
    }
    return object_new_csg(m->a, CSG_DIFFERENCE, child, parts + 1, (struct span){0});
}

static void parts_with_spaces_of_their_own(void **state)
{
    (void)state;
    for (uint64_t seed = 300; seed < 303; seed++) {
        struct maker m = {.a = arena_new(1 << 16), .random = seed};
        for (uint32_t parts = 1; parts <= PARTS_MOST; parts++)
            add_within(&m, turned_parts(&m, parts), seed == 300 ? 1 : 4);
        check_made(&m);
    }
}

// The ball stands in the space of the world.
static void quick_tests_take_so_many(void **state)
{
    (void)state;
    struct maker m = {.a = arena_new(1 << 16), .random = 310};
    for (uint32_t parts = 1; parts <= PARTS_MOST; parts++)
        m.object[m.count++] = turned_parts(&m, parts);
    struct scene scene = {.object = m.object, .object_count = m.count};
    scene.default_texture = (struct attached_texture){&grey_texture, &transform_identity};
    const struct world *w = world_build(m.a, &scene);
    for (uint32_t i = 0; i < w->object_count; i++) {
        const uint32_t parts = i + 1;
        assert_int_equal(w->accel->object_shape[i], PACKET_PRODUCT);
        const struct accel_product *p = &w->accel->product[i];
        if (parts > PRODUCT_SPACES)
            assert_null(p->part);
        else
            assert_int_equal(p->spaces, parts);
    }
    arena_free(m.a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_with_spaces_of_their_own),
        cmocka_unit_test(quick_tests_take_so_many),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
