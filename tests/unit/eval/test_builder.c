#include "test.h"

#include "base/arena.h"
#include "eval/eval.h"
#include "scene/shapes/isosurface.h"
#include "scene/shapes/mesh.h"

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

static const struct mesh *only_mesh(const struct scene *s)
{
    assert_int_equal(s->object_count, 1);
    return s->object[0]->shape;
}

// However its triangles come: all of them, with what they have in common once.
static void meshes_keep_corners_once(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct scene s = {0};
    const char *text =
        "#declare T = texture { pigment { rgb x } }\n"
        "#macro Face(P) smooth_triangle { 0, y, x, y, P, y texture { T } } #end\n"
        "mesh { inside_vector y triangle { <0,0,0>, <1,0,0>, <0,1,0> },\n"
        "  triangle { <0,0,0>, <0,1,0>, <0,0,1> uv_vectors <0,0>, <1,0>, <1,1> }\n"
        "  #for (I, 1, 300) Face(z) #end triangle { x, y, z texture { pigment { rgb y } "
        "} }"
        "  pigment { rgb 1 } }";
    assert_int_equal(read_scene(a, text, &s), 0);
    const struct mesh *m = only_mesh(&s);
    assert_int_equal(m->face_count, 303);
    assert_int_equal(m->vertex_count, 4);
    assert_int_equal(m->normal_count, 1);
    assert_int_equal(m->uv_count, 3);
    assert_int_equal(m->texture_count, 2);
    assert_int_equal(m->face_normal[1][0], UINT32_MAX);
    assert_int_equal(m->face_normal[2][0], 0);
    assert_int_equal(m->face_normal[302][0], UINT32_MAX);
    assert_int_equal(m->face_texture[1][0], UINT32_MAX);
    assert_int_equal(m->face_texture[301][2], 0);
    assert_int_equal(m->face_texture[302][0], 1);
    assert_near(m->uv[m->face_uv[0][0]].u, 0, 0);
    assert_near(m->uv[m->face_uv[1][2]].v, 1, 0);
    assert_true(m->solid);
    const uint32_t *first = m->face[0], *last = m->face[302];
    assert_true(first[0] == 0 && first[1] == 1 && first[2] == 2);
    assert_true(last[0] == 1 && last[1] == 2 && last[2] == 3);
    arena_free(a);
}

static void a_wrong_triangle_is_one_error(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct scene s = {0};
    const char *first = "mesh { triangle { 0, \"a\", x } triangle { 0, \"b\", x } }";
    assert_int_equal(read_scene(a, first, &s), 1);
    const char *texture = "mesh { triangle { 0, x, y texture { pigment { A } } } }";
    assert_int_equal(read_scene(a, texture, &s), 1);
    const char *late =
        "mesh { triangle { 0, x, y } pigment { rgb 1 } triangle { 0, x, z } }";
    assert_int_equal(read_scene(a, late, &s), 1);
    arena_free(a);
}

static const struct iso_cell *cells_of(const struct scene *s, uint32_t i)
{
    return ((const struct isosurface *)s->object[i]->shape)->root;
}

// Written again (by a macro, say) it is the same to a ray; its clip or hints do not matter.
static void equal_isosurfaces_share_their_cells(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct scene s = {0};
    const char *text =
        "#declare f_noise3d = function { internal(76) }\n"
        "#declare F = function(x, y, z, R) { x*x + y*y + f_noise3d(z, x, y) - R }\n"
        "#declare F3 = function { pigment { granite } }\n"
        "#macro Iso(R) isosurface { function { F(x, y, z, R) } #end\n"
        "Iso(1) } Iso(1) accuracy 0.01 open translate x } Iso(2) } Iso(1) threshold 0.5 "
        "}\n"
        "Iso(1) contained_by { box { -1, 2 } } } Iso(1) max_gradient 3 } Iso(1) }\n"
        "isosurface { function { F3(x, y, z).red } } isosurface { function { F3(x, y, "
        "z).red } }\n"
        "isosurface { function { F3(x, y, z).green } }";
    assert_int_equal(read_scene(a, text, &s), 0);
    assert_int_equal(s.object_count, 10);
    const uint32_t same_as[] = {0, 0, 2, 3, 4, 5, 0, 7, 7, 9};
    for (uint32_t i = 0; i < 10; i++)
        for (uint32_t k = 0; k < 10; k++)
            assert_int_equal(cells_of(&s, i) == cells_of(&s, k),
                             same_as[i] == same_as[k]);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(modifiers_act_in_written_order),
        cmocka_unit_test(camera_items_combine_in_a_fixed_order),
        cmocka_unit_test(misplaced_items_are_errors),
        cmocka_unit_test(meshes_keep_corners_once),
        cmocka_unit_test(a_wrong_triangle_is_one_error),
        cmocka_unit_test(equal_isosurfaces_share_their_cells),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
