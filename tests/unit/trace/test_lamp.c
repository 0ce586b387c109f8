#include "test.h"

#include "trace/lamp.h"

static const double degree = 3.14159265358979323846 / 180;

static struct light at_two_three(void)
{
    struct light l = light_default;
    l.location = vec3(2, 3, -4);
    l.color = rgb(1, 1, 1);
    l.point_at = vec3(-0.5, 0.2, 0);
    l.axis = vec3_normalize(vec3_sub(l.point_at, l.location));
    return l;
}

// The factor at p.
static double factor(const struct light *l, struct vec3 p)
{
    struct lamp lamp;
    struct lamp_view v;
    lamp_init(&lamp, l, 0);
    return lamp_view(&lamp, l->location, p, &v) ? (double)v.color.r : 0;
}

static void fade_doubles_near_and_is_one_at_the_distance(void **state)
{
    (void)state;
    struct light l = at_two_three();
    l.fade_distance = 5;
    l.fade_power = 2;
    assert_near(factor(&l, vec3(2, 3, 1)), 1, 1e-6);
    assert_near(factor(&l, vec3(2, 3, -4 + 1e-9)), 2, 1e-6);
    assert_near(factor(&l, vec3(2, 3, 6)), 2.0 / 5, 1e-6);
}

static void spot_falls_smoothly_in_the_cosine(void **state)
{
    (void)state;
    struct light l = at_two_three();
    l.kind = LIGHT_SPOT;
    l.location = vec3(0, 0, 0);
    l.axis = vec3(0, 0, 1);
    l.radius = 8;
    l.falloff = 20;
    assert_near(factor(&l, vec3(0, 0, 3)), 1, 1e-6);
    assert_near(factor(&l, vec3(0, 0, -3)), 0, 0);
    // Halfway between the two cosines the cubic gives one half.
    const double c = (cos(8 * degree) + cos(20 * degree)) / 2;
    assert_near(factor(&l, vec3(sqrt(1 - c * c), 0, c)), 0.5, 1e-6);
    assert_near(factor(&l, vec3(tan(21 * degree), 0, 1)), 0, 0);
}

static void cylinder_depends_on_the_axis_distance(void **state)
{
    (void)state;
    struct light l = at_two_three();
    l.kind = LIGHT_CYLINDER;
    l.location = vec3(0, 0, 0);
    l.axis = vec3(0, 0, 1);
    l.radius = 1;
    l.falloff = 2;
    l.tightness = 0.5;
    assert_near(factor(&l, vec3(0.5, 0, 9)), sqrt(0.75), 1e-6);
    assert_near(factor(&l, vec3(1.5, 0, 9)), sqrt(0.25) * 0.5, 1e-6);
    assert_near(factor(&l, vec3(2.5, 0, 9)), 0, 0);
    assert_near(factor(&l, vec3(0.5, 0, -1)), 0, 0);
}

static void parallel_light_has_a_signed_distance(void **state)
{
    (void)state;
    struct light l = at_two_three();
    l.parallel = true;
    struct lamp lamp;
    struct lamp_view v;
    lamp_init(&lamp, &l, 0);
    assert_true(lamp_view(&lamp, l.location, vec3_mad(l.location, 3, l.axis), &v));
    assert_near(v.distance, 3, 1e-12);
    assert_near(vec3_dot(v.l, l.axis), -1, 1e-12);
    assert_true(lamp_view(&lamp, l.location, vec3_mad(l.location, -3, l.axis), &v));
    assert_near(v.distance, -3, 1e-12);
}

static void grid_spans_the_axes(void **state)
{
    (void)state;
    struct light l = at_two_three();
    l.area = true;
    l.axis1 = vec3(2, 0, 0);
    l.axis2 = vec3(0, 4, 0);
    l.size1 = 5;
    l.size2 = 1;
    struct lamp lamp;
    lamp_init(&lamp, &l, 0);
    const struct lamp_grid grid = lamp_grid_of(&lamp, vec3(0, 0, 0));
    const struct vec3 a = lamp_grid_point(&lamp, &grid, 0, 0);
    const struct vec3 b = lamp_grid_point(&lamp, &grid, 4, 0);
    assert_near(a.x, 1, 0);
    assert_near(b.x, 3, 0);
    assert_near(b.y, 3, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fade_doubles_near_and_is_one_at_the_distance),
        cmocka_unit_test(spot_falls_smoothly_in_the_cosine),
        cmocka_unit_test(cylinder_depends_on_the_axis_distance),
        cmocka_unit_test(parallel_light_has_a_signed_distance),
        cmocka_unit_test(grid_spans_the_axes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
