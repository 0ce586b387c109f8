#include "test.h"

#include <stdlib.h>

#include "math/isa.h"
#include "trace/area.h"
#include "trace/lamp.h"
#include "trace/packet.h"
#include "trace/shade_kernel.h"

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

// ---- area lights ---------------------------------------------------------------------------

static double spread(uint32_t *h) { return hash_unit(*h = hash_mix(*h, 7)) * 4 - 2; }

static struct vec3 spread3(uint32_t *h)
{
    const double x = spread(h), y = spread(h);
    return vec3(x, y, spread(h));
}

enum { PLACES = 29 };

// Rays in lanes from places to every point of the lamp's grid are those of one place each.
static void check_rays(const struct shade_kernels *k, const struct light *light)
{
    struct lamp lamp;
    uint32_t h = 1, count = 0;
    struct area_places *at = calloc(1, sizeof *at);
    struct area_ray ray[BATCH_SIZE];
    struct ray_batch *out = ray_batch_new(BATCH_SIZE);
    struct interaction from[PLACES];
    lamp_init(&lamp, light, 3);
    for (uint32_t i = 0; i < PLACES; i++) {
        from[i] =
            (struct interaction){.p = spread3(&h), .error = fabs(spread(&h)) * 1e-9};
        from[i].ng = vec3_normalize(spread3(&h));
        const struct lamp_grid grid = lamp_grid_of(&lamp, from[i].p);
        const struct vec3 v[4] = {from[i].p, from[i].ng, grid.axis1, grid.axis2};
        double(*const to[4])[BATCH_SIZE] = {at->p, at->ng, at->axis1, at->axis2};
        for (int a = 0; a < 4; a++) {
            to[a][0][i] = v[a].x;
            to[a][1][i] = v[a].y;
            to[a][2][i] = v[a].z;
        }
        at->error[i] = from[i].error;
        at->hash[i] = hash_mix(i + 5, lamp.index);
    }
    for (uint32_t point = 0; point < (uint32_t)(light->size1 * light->size2); point++)
        for (uint32_t i = 0; i < PLACES && count < BATCH_SIZE; i++)
            ray[count++] = (struct area_ray){i, point, 0};
    k->toward(&lamp, at, ray, count, out);
    for (uint32_t i = 0; i < count; i++) {
        const struct interaction *x = &from[ray[i].place];
        const struct lamp_grid grid = lamp_grid_of(&lamp, x->p);
        struct lamp_view view;
        const struct vec3 to =
            area_point(&lamp, &grid, ray[i].place + 5, (int)ray[i].point / light->size2,
                       (int)ray[i].point % light->size2);
        lamp_direction(&lamp, to, x->p, &view);
        const struct vec3 o = trace_offset(x, view.l);
        assert_true(out->d[0][i] == view.l.x && out->d[1][i] == view.l.y &&
                    out->d[2][i] == view.l.z);
        assert_true(out->o[0][i] == o.x && out->o[1][i] == o.y && out->o[2][i] == o.z);
        assert_true(out->t_max[i] == view.distance);
    }
    ray_batch_free(out);
    free(at);
}

static void rays_to_grids_in_lanes_are_those_of_one_place(void **state)
{
    (void)state;
    enum {
        JITTER = 1,
        CIRCULAR = 2,
        ORIENT = 4,
        PARALLEL = 8,
        CYLINDER = 16,
        KINDS = 32
    };
    static const int size[][2] = {{5, 4}, {1, 7}, {3, 1}, {1, 1}, {6, 6}};
    for (int kind = 0; kind < KINDS; kind++) {
        for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
            struct light l = at_two_three();
            l.area = true;
            l.axis1 = vec3(1.5, 0.1, 0);
            l.axis2 = vec3(0, 1.25, 0.3);
            l.size1 = size[i][0];
            l.size2 = size[i][1];
            l.jitter = kind & JITTER;
            l.circular = kind & CIRCULAR;
            l.orient = kind & ORIENT;
            l.parallel = kind & PARALLEL;
            if (kind & CYLINDER)
                l.kind = LIGHT_CYLINDER;
            check_rays(&shade_kernels_base, &l);
            check_rays(ISA_NAMED(packet_kernels_choose()->name, shade_kernels), &l);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fade_doubles_near_and_is_one_at_the_distance),
        cmocka_unit_test(spot_falls_smoothly_in_the_cosine),
        cmocka_unit_test(cylinder_depends_on_the_axis_distance),
        cmocka_unit_test(parallel_light_has_a_signed_distance),
        cmocka_unit_test(grid_spans_the_axes),
        cmocka_unit_test(rays_to_grids_in_lanes_are_those_of_one_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
