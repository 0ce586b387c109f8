// Scenes at which methods of radiosity fail: leaks, contact, what few rays reach.
#include "test.h"

#include "scenes.h"

static bool small_sphere(const struct element *e) { return e->centre.z > .5; }

// What few rays reach takes part: T12, a small sphere over a large disc, seen from afar.
static void small_over_large_t12(void **state)
{
    (void)state;
    const char *text = HEAD "camera { location <0, -30, 20> look_at 0 }\n"
                            "disc { 0, z, 10 M(.5, 1) } sphere { z, .02 M(.5, 0) }";
    struct radiosity_options o = with(150, "gauss-seidel");
    struct scene_run s = scene_solve(text, &o);
    const struct mean m = mean_of(&s, small_sphere);
    print_message("T12: %.5f, area %.6f\n", m.h, m.area);
    assert_near(m.area / (4 * 3.14159265 * .0004), 1, 1e-3);
    assert_near(m.h / .450248, 1, .02);
    scene_free(&s);
}

static bool dark_room(const struct element *e) { return e->centre.x > .06; }
static bool lit_room(const struct element *e) { return e->centre.x < -.06; }

static void leaks_f9(void **state)
{
    (void)state;
    // One floor under two rooms, a wall between; light in one of them.
    const char *text =
        HEAD "camera { location <-.5, 0, .5> look_at <-.5, 1, .5> }\n"
             "difference { box { <-2, -2, -1>, 2 } box { <-1, -.5, 0>, <1, .5, 1> }"
             " M(.7, 0) }\n"
             "box { <-.05, -.6, -.1>, <.05, .6, 1.1> M(.7, 0) }\n"
             "disc { <-.5, 0, .9>, -z, .2 M(0, 1) }\n"
             "light_source { <.5, 0, .5> 0 }";
    static const char *const solvers[] = {"gauss-seidel", "stochastic"};
    for (int k = 0; k < 2; k++) {
        struct radiosity_options o = with(150, solvers[k]);
        o.closure = CLOSURE_REPORT;
        o.solver.tolerance = .05;
        struct scene_run s = scene_solve(text, &o);
        const struct mean dark = mean_of(&s, dark_room), lit = mean_of(&s, lit_room);
        print_message("F9 %s: %.3g, %.3g\n", solvers[k], dark.most, lit.b);
        assert_true(dark.area > 3 && lit.area > 3);
        assert_true(dark.most <= 1e-6 * lit.b);
        scene_free(&s);
    }
}

static bool under_box(const struct element *e)
{
    return e->normal.z > .9 && fabs(e->centre.z) < .01 && fabs(e->centre.x) < .19 &&
           fabs(e->centre.y) < .19;
}
static bool beside_box(const struct element *e)
{
    return e->normal.z > .9 && fabs(e->centre.z) < .01 && e->centre.x > .22 &&
           e->centre.x < .5 && fabs(e->centre.y) < .2;
}

static void contact_f10(void **state)
{
    (void)state;
    const char *text =
        HEAD "camera { location <0, -.9, .5> look_at 0 }\n"
             "difference { box { -2, 2 } box { <-1, -1, 0>, 1 } M(.5, 0) }\n"
             "box { <-.2, -.2, 0>, <.2, .2, .4> M(.5, 0) }\n"
             "disc { <0, 0, .999>, -z, .6 M(0, 1) }";
    struct radiosity_options o = with(300, "stochastic");
    o.solver.tolerance = .05;
    struct scene_run s = scene_solve(text, &o);
    // Under the box there is no floor that light reaches; beside it all of it.
    assert_true(isnan(mean_of(&s, under_box).b));
    const struct mean beside = mean_of(&s, beside_box);
    print_message("F10: beside %.4f, area %.4f\n", beside.b, beside.area);
    assert_true(beside.b > .1);
    scene_free(&s);
}

static bool outside_box(const struct element *e)
{
    return vec3_max_abs(e->centre) > 1.05 && vec3_max_abs(e->centre) < 1.5;
}

static void enclosed_f15_f16(void **state)
{
    (void)state;
    // A light in a hollow box in a room, the camera in the room; and the same as an
    // inverted box.
    static const char *const boxes[] = {
        "difference { box { -1.1, 1.1 } box { -1, 1 } M(.5, 0) }",
        "intersection { box { -1.1, 1.1 } box { -1, 1 inverse } M(.5, 0) }"};
    for (int k = 0; k < 2; k++) {
        char text[1024];
        snprintf(text, sizeof text,
                 HEAD "camera { location <2, 0, 0> look_at 0 }\n"
                      "light_source { <.9, .9, .9> 0 }\n"
                      "sphere { 0, .3 M(0, 1) } %s\n"
                      "difference { box { -4, 4 } box { -3, 3 } M(.5, 0) }",
                 boxes[k]);
        struct radiosity_options o = with(300, "stochastic");
        o.solver.rays = 60000;
        struct scene_run s = scene_solve(text, &o);
        const struct mean out = mean_of(&s, outside_box);
        // H inside: emitted power over the absorbing area (S11).
        double in_h = 0, in_area = 0;
        for (uint32_t i = 0; i < s.r->patches->element_count; i++) {
            const struct element *e = &s.r->patches->element[i];
            if (vec3_max_abs(e->centre) > 1.02 || vec3_length(e->centre) < .5)
                continue;
            in_h += e->area * s.r->solution.h[i][0];
            in_area += e->area;
        }
        print_message("F15 %d: outside %.3g, absorbed %.5f of %.5f\n", k, out.most,
                      in_h * .5, 4 * 3.14159265 * .09);
        assert_true(out.area > 25 && out.most == 0);
        assert_near(in_area, 24, .2);
        // The black sphere absorbs what comes back to it.
        assert_true(in_h * .5 < 4 * 3.14159265 * .09 &&
                    in_h * .5 > .9 * 4 * 3.14159265 * .09);
        scene_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_over_large_t12),
        cmocka_unit_test(leaks_f9),
        cmocka_unit_test(contact_f10),
        cmocka_unit_test(enclosed_f15_f16),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
