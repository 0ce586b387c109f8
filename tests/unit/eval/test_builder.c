#include "test.h"

#include "base/arena.h"
#include "eval/eval.h"

static void ignore(void *user, const struct diag *d)
{
    (void)user;
    (void)d;
}

static unsigned read_scene(struct arena *a, const char *text, struct scene *scene)
{
    struct source_map map;
    struct diag_sink sink = {.emit = ignore};
    struct eval_options options = {.image_width = 4, .image_height = 3};
    source_map_init(&map, a);
    uint32_t file = source_add(&map, "a.scn", text, strlen(text), (struct span){0});
    eval_scene(a, &map, file, &sink, &options, scene);
    return sink.errors;
}

static void modifiers_act_in_written_order(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct scene s = {0};
    assert_int_equal(read_scene(a,
                                "#version 3.7; global_settings{assumed_gamma 1}\n"
                                "sphere{0,1 pigment{rgb 0.5} translate x scale 2\n"
                                "  texture{pigment{rgb <0,1,0>}} finish{phong 1}}",
                                &s),
                     0);
    assert_int_equal(s.object_count, 1);
    const struct object *o = s.object[0];
    assert_near(o->transform->offset.x, 2, 0);
    assert_int_equal(o->texture.texture->layer_count, 2);
    assert_near(o->texture.texture->layer[0].pigment->color.g, 0.5, 0);
    assert_near(o->texture.texture->layer[0].finish->phong, 0, 0);
    assert_near(o->texture.texture->layer[1].finish->phong, 1, 0);
    arena_free(a);
}

static void camera_items_combine_in_a_fixed_order(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct scene s = {0};
    assert_int_equal(
        read_scene(a,
                   "#version 3.7; global_settings{assumed_gamma 1}\n"
                   "camera{look_at <0,0,5> angle 90 location <0,0,-5> right 2*x}",
                   &s),
        0);
    assert_near(s.camera.direction.z, 1, 1e-15);
    assert_near(s.camera.right.x, 2, 1e-15);
    assert_near(s.camera.up.y, 1, 1e-15);
    arena_free(a);
}

static void misplaced_items_are_errors(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct scene s = {0};
    assert_int_equal(read_scene(a, "sphere{0,1 sturm}", &s), 1);
    assert_int_equal(read_scene(a, "sphere{0,1 pigment{rgb 1 phong 1}}", &s), 1);
    assert_int_equal(read_scene(a, "light_source{0 rgb 1 radius 3}", &s), 1);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modifiers_act_in_written_order),
        cmocka_unit_test(camera_items_combine_in_a_fixed_order),
        cmocka_unit_test(misplaced_items_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
