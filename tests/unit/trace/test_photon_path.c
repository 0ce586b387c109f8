// Photons of rays that are followed side by side: those of one ray after the other, in their order.
#include "../radiosity/scenes.h"
#include "test.h"
#include "trace/photon_path.h"

// Glass that mirrors, too, beside a mirror and what lets photons pass, in a medium.
#define OBJECTS                                                                          \
    "#version 3.7;"                                                                      \
    "global_settings { assumed_gamma 1 photons { spacing .1 media 10 } }"                \
    "sphere { <0, 1, 0>, .9 pigment { rgbf .9 } finish { reflection { .1, .5 } }"        \
    "  interior { ior 1.4 } photons { target refraction on reflection on } }"            \
    "box { <1, 0, -2>, <1.2, 2, 2> pigment { rgb .5 } finish { reflection .7 }"          \
    "  photons { reflection on } }"                                                      \
    "cylinder { <-1, 0, 0>, <-1, 2, 0>, .3 pigment { rgbt .6 } photons { pass_through "  \
    "} }"                                                                                \
    "plane { y, 0 pigment { rgb .8 } }"                                                  \
    "box { -9, 9 hollow pigment { rgbt 1 } interior { media { scattering { 1, .02 } } "  \
    "} }"

static struct photon_shot shot_at(const struct photon_gun *g, uint32_t i)
{
    const double a = .7 * i, r = .02 * i;
    const struct vec3 to = vec3(r * cos(a), 1 + r * sin(a), .3 * r);
    if (g->lamp->light->parallel)
        return (struct photon_shot){vec3_add(g->from, to), g->lamp->light->axis, i};
    return (struct photon_shot){g->from, vec3_normalize(vec3_sub(to, g->from)), i};
}

static void check_map(const struct photon_map *a, const struct photon_map *b)
{
    assert_int_equal(a->count, b->count);
    assert_true(a->count > 100);
    assert_memory_equal(a->photon, b->photon, a->count * sizeof *a->photon);
}

static void check_scene(const char *text)
{
    enum { SHOTS = 70 };
    struct scene_run s = scene_load(text);
    struct photon_flight *f = photon_flight_new(s.job);
    const struct lamp *lamp = &s.job->lamp[0];
    const struct photon_gun gun = {
        .lamp = lamp, .from = lamp->light->location, .spread = .01, .share = 1};
    struct photon_shot shot[SHOTS];
    struct photons one = {.gather = {{0}}}, all = {.gather = {{0}}};
    uint32_t met = 0;
    for (uint32_t i = 0; i < SHOTS; i++) {
        shot[i] = shot_at(&gun, i);
        met += photon_fly(f, &gun, &shot[i], 1, NULL, &one);
    }
    assert_int_equal(photon_fly(f, &gun, shot, SHOTS, NULL, &all), met);
    assert_in_range(met, SHOTS / 4, SHOTS - 1);
    check_map(&one.surface, &all.surface);
    check_map(&one.media, &all.media);
    assert_int_equal(photon_fly(f, &gun, shot, 0, NULL, &all), 0);
    photon_map_end(&one.surface);
    photon_map_end(&one.media);
    photon_map_end(&all.surface);
    photon_map_end(&all.media);
    photon_flight_free(f);
    scene_free(&s);
}

static void test_lamp(void **state)
{
    (void)state;
    check_scene(OBJECTS
                "light_source { <3, 6, -3>, 1 photons { refraction on reflection on } }");
}

static void test_parallel(void **state)
{
    (void)state;
    check_scene(OBJECTS "light_source { <-2, 4, -3>, 1 parallel point_at <0, 0, 0>"
                        " photons { refraction on reflection on } }");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_lamp),
                                       cmocka_unit_test(test_parallel)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
