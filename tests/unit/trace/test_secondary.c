// Rays that go on: mirrors, glass; and that the picture does not depend on threads.
#include "test.h"

#include "base/arena.h"
#include "scene/shapes/plane.h"
#include "setup.h"

static const struct rgbft clay = {0.8f, 0.6f, 0.4f, 0, 0};
static const struct rgbft clear = {1, 1, 1, 0, 1};

static void mirror(struct setup *s)
{
    setup_open(s);
    setup_wall_camera(s, 1);
    setup_background(s, 0.3f, 0.6f, 0.9f);
    s->finish.diffuse = 0;
}

// normal z or -z, rotate x*60
static struct vec3 tilted(double sign) { return vec3(0, -sign * sqrt(0.75), sign * 0.5); }

static void mirror_between_two_colours(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = rgb(0.1f, 0.2f, 0.3f);
    s.finish.reflection_max = rgb(0.9f, 0.8f, 0.7f);
    s.finish.reflection_falloff = 3;
    setup_add_plane(&s, tilted(1), clay);
    CHECK(s, 1, 1, {0, 0, 0.06, 0.165, 0.31501});
}

static void mirror_fresnel(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = rgb_even(0.1f);
    s.finish.reflection_max = rgb_even(0.9f);
    s.finish.fresnel = true;
    s.interior.ior = 1.5f;
    setup_add_plane(&s, tilted(-1), clay);
    CHECK(s, 1, 1, {0, 0, 0.05141, 0.10282, 0.15421});
}

static void mirror_exponent(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = s.finish.reflection_max = rgb_even(0.8f);
    s.finish.reflection_exponent = 2;
    setup_add_plane(&s, tilted(1), clay);
    CHECK(s, 1, 1, {0, 0, 0.07201, 0.288, 0.64801});
}

static void mirror_conserves_energy(void **state)
{
    (void)state;
    struct setup s;
    mirror(&s);
    s.finish.reflection_min = s.finish.reflection_max = rgb(0.2f, 0.4f, 0.6f);
    s.finish.conserve_energy = true;
    setup_add_plane(&s, tilted(1), (struct rgbft){0.8f, 0.6f, 0.4f, 0.5f, 0.3f});
    CHECK(s, 1, 1, {0, 0, 0.228, 0.456, 0.72});
}

static void facing_mirrors(struct setup *s)
{
    setup_open(s);
    setup_wall_camera(s, 1);
    s->scene.camera.location = vec3(0, 0, -1);
    s->finish.diffuse = 0;
    s->finish.emission = rgb_even(0.1f);
    s->finish.reflection_min = s->finish.reflection_max = rgb_even(0.8f);
    setup_add_plane(s, vec3(0, 0, 1), (struct rgbft){1, 1, 1, 0, 0});
    struct plane *p = arena_new_struct(s->arena, struct plane);
    *p = (struct plane){vec3(0, 0, 1), vec3(0, 0, -2)};
    setup_add(s, &plane_ops, p,
              setup_texture(s, (struct rgbft){1, 1, 1, 0, 0}, &s->finish));
}

static void trace_level_counts_surfaces(void **state)
{
    (void)state;
    struct setup s;
    facing_mirrors(&s);
    s.scene.settings.max_trace_level = 4;
    CHECK(s, 1, 1, {0, 0, 0.2952, 0.2952, 0.2952});
}

static void light_rays_end(void **state)
{
    (void)state;
    struct setup s;
    facing_mirrors(&s);
    s.scene.settings.max_trace_level = 50;
    s.scene.settings.adc_bailout = 0.3f;
    CHECK(s, 1, 1, {0, 0, 0.36893, 0.36893, 0.36893});
}

static void glass(struct setup *s)
{
    setup_open(s);
    setup_glass_camera(s);
    setup_add_sky(s);
    s->finish.diffuse = 0;
}

static void refraction(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.5f;
    setup_add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {1, 1, 0.58981, 0.41019, 0.93645}, {2, 1, 0.50001, 0.41776, 0.94705},
          {2, 2, 0.50001, 0.50001, 0.95454}, {2, 3, 0.50001, 0.58224, 0.94705});
}

static void total_reflection(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    const double a = -42 * 3.14159265358979323846 / 180;
    s.scene.camera.direction = vec3(0, -sin(a), cos(a));
    s.scene.camera.up = vec3(0, 0.6 * cos(a), 0.6 * sin(a));
    s.scene.camera.right = vec3(0.001, 0, 0);
    s.scene.camera.location = vec3(0, 4 * sin(a), -4 * cos(a));
    s.interior.ior = 1.5f;
    s.finish.reflection_min = s.finish.reflection_max = rgb_even(0.3f);
    setup_add_plane(&s, vec3(0, 0, 1), (struct rgbft){0.9f, 0.6f, 0.3f, 0.5f, 0.1f});
    CHECK(s, 1, 5, {0, 0, 0.50001, 0.87459, 0.24251}, {0, 1, 0.50001, 0.84224, 0.20086},
          {0, 3, 0.42499, 0.58557, 0.22078}, {0, 4, 0.42499, 0.54524, 0.23452});
}

static void glass_with_fresnel(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.5f;
    s.finish.reflection_max = rgb_even(1);
    s.finish.fresnel = true;
    setup_add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {1, 1, 0.62698, 0.45843, 0.95225}, {2, 1, 0.54052, 0.46401, 0.95644},
          {2, 2, 0.54, 0.54, 0.95817});
}

static void nested_glass(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.2f;
    setup_add_sphere(&s, vec3(0, 0, 0), 1, clear);
    s.interior.ior = 1.5f;
    setup_add_sphere(&s, vec3(0.1, 0, 0), 0.5, clear);
    CHECK(s, 7, 7, {2, 2, 0.68962, 0.36208, 0.8894}, {3, 3, 0.53697, 0.50001, 0.95305},
          {4, 4, 0.42963, 0.61126, 0.93507});
}

static void fading_glass(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.fade_distance = 0.5;
    s.interior.fade_power = 1;
    s.interior.fade_color = rgb(0.8f, 0.3f, 0.1f);
    setup_add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {2, 1, 0.42141, 0.2453, 0.27877}, {2, 2, 0.42001, 0.22001, 0.26728});
}

static void dispersion(void **state)
{
    (void)state;
    struct setup s;
    glass(&s);
    s.interior.ior = 1.5f;
    s.interior.dispersion = 1.2f;
    setup_add_sphere(&s, vec3(0, 0, 0), 1, clear);
    CHECK(s, 5, 5, {2, 1, 0.49689, 0.42153, 0.94137}, {2, 2, 0.49689, 0.50001, 0.95091},
          {2, 3, 0.49689, 0.57847, 0.94137});
}

// The same bits whatever the number of threads and the size of tiles.
static void one_picture(void **state)
{
    (void)state;
    struct image first = {0};
    for (int turn = 0; turn < 4; turn++) {
        static const int tile[] = {32, 16, 64, 32};
        struct setup s;
        glass(&s);
        s.interior.ior = 1.5f;
        s.finish.reflection_max = rgb_even(1);
        s.finish.fresnel = true;
        s.finish.diffuse = 0.5f;
        s.light.area = s.light.jitter = true;
        s.light.axis1 = vec3(1, 0, 0);
        s.light.axis2 = vec3(0, 1, 0);
        s.light.size1 = s.light.size2 = 3;
        setup_add_light(&s);
        setup_add_sphere(&s, vec3(0, 0, 0), 1, (struct rgbft){0.9f, 0.8f, 0.7f, 0, 0.7f});
        setup_add_sphere(&s, vec3(0.4, 0.3, -1), 0.4,
                         (struct rgbft){0.7f, 0.8f, 1, 0.8f, 0});
        s.settings.threads = turn ? 3 : 1;
        s.settings.tile_size = tile[turn];
        struct image out = setup_shoot(&s, 80, 60);
        if (turn) {
            assert_memory_equal(out.pixel, first.pixel, 80 * 60 * 4 * sizeof(float));
            image_free(&out);
        } else {
            first = out;
        }
        arena_free(s.arena);
    }
    image_free(&first);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(mirror_between_two_colours),
        cmocka_unit_test(mirror_fresnel),
        cmocka_unit_test(mirror_exponent),
        cmocka_unit_test(mirror_conserves_energy),
        cmocka_unit_test(trace_level_counts_surfaces),
        cmocka_unit_test(light_rays_end),
        cmocka_unit_test(refraction),
        cmocka_unit_test(total_reflection),
        cmocka_unit_test(glass_with_fresnel),
        cmocka_unit_test(nested_glass),
        cmocka_unit_test(fading_glass),
        cmocka_unit_test(dispersion),
        cmocka_unit_test(one_picture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
