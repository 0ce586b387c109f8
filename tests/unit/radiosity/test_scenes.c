// Whole scenes with exact solutions, from the language to radiosities.
#include "test.h"

#include "scenes.h"

// Relative rms of b over elements against the truth t.
static double rms_of(const struct scene_run *s, bool (*which)(const struct element *),
                     double t)
{
    double off = 0, area = 0;
    for (uint32_t i = 0; i < s->r->patches->element_count; i++) {
        const struct element *e = &s->r->patches->element[i];
        if (which && !which(e))
            continue;
        const double d = s->r->solution.b[i][1] / t - 1;
        off += e->area * d * d;
        area += e->area;
    }
    return sqrt(off / area);
}

static bool flat_up(const struct element *e) { return e->normal.z > .999 && !e->curved; }
static bool curved(const struct element *e) { return e->curved; }

// ---- enclosures of spheres -------------------------------------------------------------
#define CAMERA_Z "camera { location <.03, .02, .1> look_at <.03, .02, 1> }\n"

static void caps(void **state)
{
    (void)state;
    static const char *const solvers[] = {"gauss-seidel", "stochastic", "hierarchical"};
    // S5 and S6: the part of a sphere above a plane, and the disc that closes it.
    static const struct {
        const char *text;
        double dome, base;
    } cases[] = {
        {HEAD CAMERA_Z
         "difference { box { -2, 2 } intersection { sphere { 0, 1 M(.8, 0) }"
         " box { <-2, -2, 0>, 2 M(.5, 1) } } M(.5, 0) }",
         1, 1.5},
        {HEAD CAMERA_Z
         "difference { box { -2, 2 } intersection { sphere { 0, 1 M(.6, 1) }"
         " box { <-2, -2, -.5>, 2 M(.4, 0) } } M(.5, 0) }",
         2.04081632653061224, 0.816326530612244898},
    };
    for (size_t i = 0; i < 2; i++) {
        for (size_t k = 0; k < 3; k++) {
            if (!in_full() && i != k)
                continue;
            struct radiosity_options o = with(i ? 160 : 150, solvers[k]);
            o.solver.tolerance = k == 1 ? .02 : 1e-4;
            o.closure = k == 2 ? CLOSURE_AUTO : CLOSURE_ENFORCE;
            struct scene_run s = scene_solve(cases[i].text, &o);
            const struct mean dome = mean_of(&s, curved), base = mean_of(&s, flat_up);
            print_message("S%zu %s: %.5f %.5f, areas %.5f %.5f, %u patches\n", i + 5,
                          solvers[k], dome.b, base.b, dome.area, base.area,
                          s.r->report.elements);
            const double off = k == 1 ? .01 : .005;
            assert_near(dome.b / cases[i].dome, 1, off);
            assert_near(base.b / cases[i].base, 1, off);
            // F14: elements cut by the edge have the area that exists.
            assert_near(dome.area / (i ? 3 * 3.14159265 : 2 * 3.14159265), 1, 5e-3);
            scene_free(&s);
        }
    }
}

static bool outer(const struct element *e) { return vec3_dot(e->normal, e->centre) < 0; }
static bool inner(const struct element *e) { return !outer(e); }

// Every patch of S6 to 2 %, which takes a hundred rays each to gather and thousands to
// be shot at.
static void every_patch(void **state)
{
    (void)state;
    struct radiosity_options o = with(300, "stochastic");
    o.solver.tolerance = .01;
    struct scene_run s = scene_solve(
        HEAD CAMERA_Z "difference { box { -2, 2 } intersection { sphere { 0, 1 M(.6, 1) }"
                      " box { <-2, -2, -.5>, 2 M(.4, 0) } } M(.5, 0) }",
        &o);
    const double dome = rms_of(&s, curved, 2.04081632653061224),
                 base = rms_of(&s, flat_up, .816326530612244898);
    print_message("S6: single patches off by %.4f and %.4f, says %.4f, %.0f rays each\n",
                  dome, base, s.r->report.error,
                  (double)s.r->report.rays / s.r->report.elements);
    assert_true(s.r->report.converged);
    assert_true(dome < .02 && base < .02);
    assert_true(s.r->report.rays < 1000 * s.r->report.elements);
    scene_free(&s);
}

static void concentric_s4(void **state)
{
    (void)state;
    const char *text =
        HEAD "camera { location 1.5*x look_at y }\n"
             "sphere { 0, 1 M(.3, 1) }\n"
             "difference { sphere { 0, 3 } sphere { 0, 2 M(.6, 0) } M(0, 0) }";
    struct radiosity_options o = with(120, "stochastic");
    o.solver.rays = 100000;
    struct scene_run s = scene_solve(text, &o);
    const struct mean a = mean_of(&s, inner), b = mean_of(&s, outer);
    print_message("S4: %.5f %.5f\n", a.b, b.b);
    assert_near(a.b, 1.08910891089108911, .003);
    assert_near(b.b, 0.29702970297029703, .003);
    // F21: patches have the sphere's area, not that of their corners, which is 2 % less.
    static const double pi = 3.14159265358979323846;
    print_message("F21: areas %.9f %.9f\n", a.area / (4 * pi), b.area / (16 * pi));
    assert_near(a.area / (4 * pi), 1, 1e-5);
    assert_near(b.area / (16 * pi), 1, 1e-5);
    scene_free(&s);
}

// ---- C4: discs ----------------------------------------------------------------------------
static double near_radius(const struct scene_run *s, bool up, double low, double high)
{
    const struct patches *p = s->r->patches;
    double sum = 0, area = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        const double r = hypot(e->centre.x, e->centre.y);
        if ((e->normal.z > 0) != up || r < low || r > high)
            continue;
        sum += e->area * s->r->solution.b[i][0];
        area += e->area;
    }
    return sum / area;
}

// The value at a squared radius, by a line through those of rings near it: a ring's
// chart is even in that.
static double at_square(const struct scene_run *s, bool up, double square)
{
    static const double window = .25;
    const struct patches *p = s->r->patches;
    double n = 0, x = 0, xx = 0, y = 0, xy = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct cell *c = &p->cell[p->element_cell[i] / 2];
        const double d = c->v + c->dv / 2 - square, b = s->r->solution.b[i][0];
        if ((p->element[i].normal.z > 0) != up || fabs(d) > window)
            continue;
        n++;
        x += d;
        xx += d * d;
        y += b;
        xy += d * b;
    }
    return (y * xx - x * xy) / (n * xx - x * x);
}

static void discs_c4(void **state)
{
    (void)state;
    const char *text = HEAD "camera { location <0, 0, .5> look_at z }\n"
                            "disc { 0, z, 1 M(.8, 1) } disc { z, z, 1 M(.8, 0) }";
    struct radiosity_options o = with(in_full() ? 2200 : 150, "gauss-seidel");
    o.solver.tolerance = 1e-5;
    struct scene_run s = scene_solve(text, &o);
    const double b1 = near_radius(&s, true, 0, 2), b2 = near_radius(&s, false, 0, 2);
    print_message("C4: %.6f %.6f (%u patches)\n", b1, b2, s.r->report.elements);
    assert_near((b1 - 1) / .1067181835151, 1, in_full() ? .003 : .02);
    assert_near(b2 / .33924340803155, 1, in_full() ? .001 : .01);
    // With rings enough, the truth's second and first disc at the centre and at half the radius.
    static const double by_radius[2][2] = {{.44594601089871, .1450335967953},
                                           {.38953619424714, .1239236057059}};
    for (int k = 0; k < 2 && in_full(); k++)
        for (int up = 0; up < 2; up++) {
            const double b = at_square(&s, up, .25 * k) - up;
            print_message("C4 at %g: %.5f of %.5f\n", .5 * k, b, by_radius[k][up]);
            assert_near(b / by_radius[k][up], 1, .02);
        }
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(caps),
        cmocka_unit_test(every_patch),
        cmocka_unit_test(concentric_s4),
        cmocka_unit_test(discs_c4),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
