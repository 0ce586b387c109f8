// Light that lamps throw on surfaces, and fog on the way to them.
#include "test.h"

#include "base/arena.h"
#include "setup.h"

static const struct rgbft clay = {0.8f, 0.6f, 0.4f, 0, 0};
static const struct rgbft clear = {1, 1, 1, 0, 1};

static void wall(struct setup *s)
{
    setup_open(s);
    setup_wall_camera(s, 4);
    s->finish.diffuse = 0.7f;
}

static void diffuse(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    CHECK(s, 4, 4, {0, 0, 0.4056, 0.27378, 0.1014}, {3, 0, 0.52079, 0.35154, 0.13019},
          {1, 1, 0.41959, 0.28322, 0.10489}, {3, 3, 0.37076, 0.25026, 0.0927});
}

static void phong(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.finish.diffuse = 0.3f;
    s.finish.phong = 0.8f;
    s.finish.phong_size = 20;
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    CHECK(s, 4, 4, {0, 0, 0.1751, 0.11847, 0.04408}, {3, 0, 0.41051, 0.31923, 0.14946});
}

static void specular_and_irid(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.finish.diffuse = 0.6f;
    s.finish.specular = 0.3f;
    s.finish.irid = 0.4f;
    s.finish.irid_thickness = 0.3f;
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    CHECK(s, 4, 4, {0, 0, 0.40421, 0.41424, 0.16367}, {3, 0, 0.77879, 0.63876, 0.24016},
          {3, 3, 0.33069, 0.3563, 0.14301});
}

static void lit_from_behind(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.light.location = vec3(1, 2, 4);
    s.finish.diffuse = 0.6f;
    s.finish.diffuse_back = 0.3f;
    s.finish.specular = 0.9f;
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay)->flags |= OBJECT_NO_SHADOW;
    CHECK(s, 4, 4, {0, 0, 0.20238, 0.13661, 0.0506}, {3, 0, 0.23633, 0.15953, 0.05908});
}

static void transparent_and_lit(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    setup_background(&s, 0.3f, 0.6f, 0.9f);
    s.finish.ambient = rgb_even(0.1f);
    s.finish.specular = 0.5f;
    s.finish.roughness = 10;
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), (struct rgbft){0.8f, 0.6f, 0.4f, 0.3f, 0.2f});
    CHECK(s, 4, 4, {0, 0, 0.61296, 0.60923, 0.47778}, {3, 0, 0.85078, 0.81032, 0.5823});
}

static void shadow_of_a_filter(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    setup_add_sphere(&s, vec3(0.6, 1, -1.5), 0.8,
                     (struct rgbft){0.9f, 0.5f, 0.2f, 0.8f, 0})
        ->flags |= OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 1, 0.21752, 0.04532, 0.00269}, {2, 1, 0.23461, 0.04888, 0.0029},
          {0, 2, 0.18247, 0.03801, 0.00225}, {1, 2, 0.1977, 0.04118, 0.00244});
}

static void shadow_fades(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    s.interior.fade_power = 2;
    s.interior.fade_distance = 1;
    s.interior.fade_color = rgb(0.7f, 0.2f, 0.1f);
    setup_add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, clear)->flags |= OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 1, 0.33941, 0.13889, 0.04476}, {2, 1, 0.37197, 0.16042, 0.05271},
          {1, 2, 0.30016, 0.11127, 0.03444});
}

static void shadow_caustics(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    s.interior.caustics = 45 * 0.6f;
    setup_add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, clear)->flags |= OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 1, 0.42473, 0.2867, 0.10619}, {1, 2, 0.90046, 0.60781, 0.22512},
          {2, 2, 0.40665, 0.27449, 0.10166});
}

static void area_light(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.light.area = true;
    s.light.axis1 = vec3(1.5, 0, 0);
    s.light.axis2 = vec3(0, 1.5, 0);
    s.light.size1 = s.light.size2 = 5;
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    setup_add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, (struct rgbft){1, 1, 1, 0, 0})->flags |=
        OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {1, 0, 0.4172, 0.2816, 0.10429}, {2, 0, 0.48701, 0.32872, 0.12175},
          {0, 1, 0.24431, 0.1649, 0.06108}, {1, 1, 0, 0, 0});
}

static void area_illumination(void **state)
{
    (void)state;
    struct setup s;
    wall(&s);
    s.light.area = s.light.area_illumination = true;
    s.light.axis1 = vec3(1.5, 0, 0);
    s.light.axis2 = vec3(0, 1.5, 0);
    s.light.size1 = s.light.size2 = 3;
    s.light.fade_distance = 4;
    s.light.fade_power = 2;
    s.finish.specular = 0.5f;
    setup_add_light(&s);
    setup_add_plane(&s, vec3(0, 0, 1), clay);
    setup_add_sphere(&s, vec3(0.6, 1, -1.5), 0.8, (struct rgbft){1, 1, 1, 0, 0})->flags |=
        OBJECT_NO_IMAGE;
    CHECK(s, 4, 4, {0, 0, 0.36094, 0.26218, 0.11086}, {3, 0, 0.77504, 0.59222, 0.27051},
          {1, 1, 0, 0, 0});
}

static void foggy(struct setup *s, struct fog *fog)
{
    setup_open(s);
    s->scene.camera.location = vec3(0, 1, -10);
    s->scene.camera.direction = vec3(0, 0, 1.5);
    s->scene.camera.right = vec3(1, 0, 0);
    s->finish.diffuse = 0;
    s->finish.emission = rgb_even(1);
    static const struct fog *list[1];
    list[0] = fog;
    s->scene.fog = list;
    s->scene.fog_count = 1;
    setup_add_plane(s, vec3(0, 0, -1), clay);
}

static void fog_of_constant_density(void **state)
{
    (void)state;
    struct setup s;
    struct fog fog = {
        .type = FOG_CONSTANT, .distance = 12, .color = {0.3f, 0.4f, 0.9f, 0, 0}};
    foggy(&s, &fog);
    CHECK(s, 4, 4, {0, 0, 0.50658, 0.48263, 0.69342}, {1, 1, 0.51604, 0.48643, 0.68395});
}

static void ground_fog(void **state)
{
    (void)state;
    struct setup s;
    struct fog fog = {.type = FOG_GROUND,
                      .distance = 4,
                      .alt = 0.7,
                      .offset = -0.5,
                      .up = {0, 1, 0},
                      .color = {0.3f, 0.4f, 0.9f, 0, 0}};
    foggy(&s, &fog);
    CHECK(s, 4, 4, {0, 0, 0.71119, 0.56448, 0.48881}, {0, 3, 0.37458, 0.42983, 0.82542});
}

static void alpha_of_transparency(void **state)
{
    (void)state;
    struct setup s;
    setup_open(&s);
    setup_wall_camera(&s, 4);
    s.finish.diffuse = 0;
    s.finish.emission = rgb_even(1);
    s.settings.output_alpha = true;
    setup_add_plane(&s, vec3(0, 0, -1), (struct rgbft){0.5f, 0.25f, 0.8f, 0.4f, 0});
    struct image out = setup_shoot(&s, 1, 1);
    assert_near(image_at(&out, 0, 0)[0], 0.30001, 3e-4);
    assert_near(image_at(&out, 0, 0)[3], 0.84522, 3e-4);
    image_free(&out);
    arena_free(s.arena);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(diffuse),
        cmocka_unit_test(phong),
        cmocka_unit_test(specular_and_irid),
        cmocka_unit_test(lit_from_behind),
        cmocka_unit_test(transparent_and_lit),
        cmocka_unit_test(shadow_of_a_filter),
        cmocka_unit_test(shadow_fades),
        cmocka_unit_test(shadow_caustics),
        cmocka_unit_test(area_light),
        cmocka_unit_test(area_illumination),
        cmocka_unit_test(fog_of_constant_density),
        cmocka_unit_test(ground_fog),
        cmocka_unit_test(alpha_of_transparency),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
