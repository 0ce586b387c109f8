// What is asked of a solution: its error, its memory, to be stopped.
#include "test.h"

#include "radiosity/solver.h"
#include "scenes.h"

// ---- the error target ------------------------------------------------------------------------
#define CUBE                                                                             \
    HEAD "camera { location <.5, .5, .5> look_at <.5, .5, 0> }\n"                        \
         "difference { box { -1, 2 } box { <0, 0, -.3>, 1 } M(.5, 0) }\n"                \
         "box { <-.1, -.1, -.5>, <1.1, 1.1, 0> M(.5, 1) }"

static bool floor_of_cube(const struct element *e)
{
    return e->normal.z > .5 && e->centre.z < .1;
}
static bool ceiling_of_cube(const struct element *e) { return e->normal.z < -.5; }
static bool wall_of_cube(const struct element *e) { return fabs(e->normal.z) < .5; }

static void error_target(void **state)
{
    (void)state;
    static const double targets[] = {.1, .03, .01};
    for (int k = 0; k < (in_full() ? 3 : 1); k++) {
        struct radiosity_options o = radiosity_defaults;
        o.error = targets[k];
        struct scene_run s = scene_solve(CUBE, &o);
        const double f = mean_of(&s, floor_of_cube).b - 1,
                     c = mean_of(&s, ceiling_of_cube).b;
        const double w = mean_of(&s, wall_of_cube).b;
        const double df = f - .1043616, dc = c - .1712160, dw = w - .1811056;
        const double off =
            sqrt((df * df + dc * dc + 4 * dw * dw) /
                 (.1043616 * .1043616 + .171216 * .171216 + 4 * .1811056 * .1811056));
        print_message("%.4f %.4f %.4f ", f, c, w);
        print_message(
            "asked %.3f, estimated %.4f, walls off by %.4f; %u patches, %u levels\n",
            targets[k], s.r->report.error, off, s.r->report.elements, s.r->report.levels);
        assert_true(s.r->report.converged && s.r->report.error <= targets[k]);
        // Means of walls are better than single elements, of which the estimate speaks.
        assert_true(off <= targets[k]);
        assert_true(off < 3 * s.r->report.error);
        scene_free(&s);
    }
}

// ---- memory ----------------------------------------------------------------------------------
static void memory_is_predicted(void **state)
{
    (void)state;
    char error[512] = "";
    struct scene_run s = scene_load(CUBE);
    struct radiosity_options o = with(100, "elimination");
    o.memory = 1e5;
    assert_null(radiosity_new(s.job, &o, NULL, error, sizeof error));
    print_message("%s\n", error);
    assert_non_null(strstr(error, "'elimination' needs"));
    assert_non_null(strstr(error, "'stochastic'"));
    scene_free(&s);
}

// ---- cancelling --------------------------------------------------------------------------
struct waiting {
    double stop_at, told;
    bool cancel, rising;
    uint32_t calls;
};

static void hear(void *user, double share)
{
    struct waiting *w = user;
    w->rising = w->rising && share > w->told && share <= 1;
    w->told = share;
    w->calls++;
    w->cancel = w->cancel || share >= w->stop_at;
}

// Wherever a solution is stopped, nothing comes of it and nothing is left behind; not
// stopped, it tells how far it is up to the end.
static void cancelled(void **state)
{
    (void)state;
    static const double stops[] = {0, .3, 2};
    for (int k = 0; k < SOLVER_COUNT; k++) {
        for (size_t i = 0; i < sizeof stops / sizeof stops[0]; i++) {
            struct waiting w = {stops[i], 0, stops[i] == 0, true, 0};
            struct watch watch = {&w.cancel, hear, &w, 0, 1, 0};
            char error[512] = "";
            struct scene_run s = scene_load(CUBE);
            struct radiosity_options o = with(100, solver_name(k));
            o.watch = &watch;
            o.solver.tolerance = .05;
            s.r = radiosity_new(s.job, &o, NULL, error, sizeof error);
            assert_true(w.rising);
            if (stops[i] > 1) { // how often it tells is up to the clock
                assert_non_null(s.r);
                assert_near(w.told, 1, 1e-12);
                assert_true(w.calls > 0);
            } else {
                assert_null(s.r);
            }
            scene_free(&s);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(error_target),
        cmocka_unit_test(memory_is_predicted),
        cmocka_unit_test(cancelled),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
