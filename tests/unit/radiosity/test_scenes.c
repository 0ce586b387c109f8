// Whole scenes with exact solutions, from the language to radiosities.
#include "test.h"

#include "radiosity/sequence.h"
#include "scenes.h"
#include <stdlib.h>

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
static bool small_sphere(const struct element *e) { return e->centre.z > .5; }

// ---- S2: whatever is in a closed scene, B = 1 where E = 1 - rho ------------------------
// @: a texture of random reflectance.
static const char *const furnaces[] = {
    "difference { box { -2, 2 } box { -1, 1 @ } @ }",
    "difference { sphere { 0, 3 } sphere { 0, 2 @ } @ }",
    "difference { box { -2, 2 } box { -1, 1 @ } @ }"
    "sphere { <.2, .1, -.2>, .5 @ }",
    "difference { cylinder { -2*z, 2*z, 2 } cylinder { -z, z, 1 @ } @ }"
    "box { <-.3, -.2, -.5>, <.1, .3, .2> rotate 20*x @ }",
    "difference { box { -2, 2 } sphere { -.3*x, 1 @ } sphere { .5*x, .9 @ }"
    " @ }",
    "difference { box { -3, 3 } box { -1, 1 @ } @ }"
    "difference { sphere { <0, 0, -.3>, .6 @ } cylinder { -z, z, .2 @ }"
    " box { <0, 0, -.3>, 2 @ } }",
    "difference { box { -3, 3 } cone { -z, 1.2, z, .5 @ } @ }",
    "difference { box { -3, 3 } box { -1, 1 @ } @ }"
    "cone { <0, 0, -.9>, .5, <0, 0, .4>, 0 @ } disc { .6*z, z, .4 @ "
    "}",
    "difference { box { -3, 3 } box { -1, 1 @ } @ }"
    "intersection { box { -.4, .4 @ } sphere { 0, .5 @ } rotate 30 }",
    "difference { box { -3, 3 } box { -1, 1 @ } @ }"
    "merge { sphere { -.2*x, .3 @ } cylinder { -.5*y, .5*y, .2 @ } }"
    "triangle { <-.8, -.8, -.5>, <.8, -.8, -.5>, <0, .8, -.6> @ }",
};
static const char *const camera = "camera { location <.05, -.15, .75> look_at 0 }\n";

// A furnace whose every surface has a reflectance of its own, .05 to .95, in each channel.
static void furnace_text(char *text, size_t size, const char *furnace, uint32_t seed)
{
    size_t n = (size_t)snprintf(
        text, size,
        "#version 3.7; global_settings { assumed_gamma 1 }\n"
        "#macro M(C) texture { pigment { rgb C }"
        " finish { ambient 0 diffuse 1 emission (<1, 1, 1> - C) / C } } #end\n%s",
        camera);
    for (uint32_t k = 0; *furnace && n < size; furnace++) {
        double x[4];
        if (*furnace != '@') {
            text[n++] = *furnace;
            text[n < size ? n : size - 1] = '\0';
            continue;
        }
        random_point(k++, seed, x);
        n += (size_t)snprintf(text + n, size - n, "M(<%.4f, %.4f, %.4f>)",
                              .05 + .9 * x[0], .05 + .9 * x[1], .05 + .9 * x[2]);
    }
    assert_true(n < size);
}

struct range {
    double least, most, mean[3];
};

// Radiosities of all patches in all channels.
static struct range range_of(const struct scene_run *s)
{
    struct range x = {INFINITY, -INFINITY, {0, 0, 0}};
    const struct patches *p = s->r->patches;
    double area = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        area += p->element[i].area;
        for (int c = 0; c < 3; c++) {
            const double b = s->r->solution.b[i][c];
            x.least = fmin(x.least, b);
            x.most = fmax(x.most, b);
            x.mean[c] += p->element[i].area * b;
        }
    }
    for (int c = 0; c < 3; c++)
        x.mean[c] /= area;
    return x;
}

static void check_furnace(size_t i, uint32_t seed)
{
    char text[4096];
    furnace_text(text, sizeof text, furnaces[i], seed);
    struct radiosity_options o = with(in_full() ? 300 : 40, "gauss-seidel");
    o.solver.tolerance = 1e-5;
    struct scene_run s = scene_solve(text, &o);
    const struct range x = range_of(&s);
    print_message("furnace %zu, seed %u: %u patches, %.6f to %.6f, rows %.3f to %.3f\n",
                  i, seed, s.r->report.elements, x.least, x.most,
                  s.r->report.row_sum_least, s.r->report.row_sum_most);
    assert_true(s.r->report.closed);
    assert_near(x.least, 1, 1e-3);
    assert_near(x.most, 1, 1e-3);
    // Unscaled, by how much rows are off; the least is a sliver's, in full of one point
    // of its cell's 256.
    assert_true(s.r->report.row_sum_least > (in_full() ? 0 : .4));
    assert_true(s.r->report.row_sum_most < 1.3);
    scene_free(&s);
    o = with(40, "stochastic");
    o.solver.rays = 100000;
    s = scene_solve(text, &o);
    const struct range y = range_of(&s);
    for (int c = 0; c < 3; c++)
        assert_near(y.mean[c], 1, .02);
    // Weak elements have a ray now and then: right in the mean.
    assert_near(s.r->report.defect, 0, .02);
    scene_free(&s);
}

static void furnace(void **state)
{
    (void)state;
    const uint32_t seeds = in_full() ? 2 : 1;
    for (size_t i = 0; i < sizeof furnaces / sizeof furnaces[0]; i++)
        for (uint32_t seed = 1; seed <= seeds; seed++)
            if (in_full() || i % 3 == 0)
                check_furnace(i, seed);
}

// Shapes with a map of their own have its charts: torus, ellipsoid, lathe, sor, patch.
static void mapped_shapes(void **state)
{
    (void)state;
    static const struct {
        const char *solid;
        double area;
    } cases[] = {
        {"torus { .6, .2 M(.4, .6) rotate 30*x }", 4 * 9.8696044 * .6 * .2},
        {"quadric { <1, 4, 4>, 0, 0, -.36 M(.4, .6) }", 1.9330592},
        {"lathe { linear_spline 5, <.2, -.5>, <.6, 0>, <.2, .5>, <.1, 0>, <.2, -.5> "
         "M(.4, .6) }",
         0},
        {"sor { 5, <.3, -.7>, <.3, -.5>, <.5, 0>, <.2, .5>, <.2, .7> M(.4, .6) }", 0},
        {"bicubic_patch { type 1 flatness 0 u_steps 3 v_steps 3"
         " <-.6, -.6, 0>, <-.2, -.6, .3>, <.2, -.6, .3>, <.6, -.6, 0>"
         " <-.6, -.2, .3>, <-.2, -.2, .5>, <.2, -.2, .5>, <.6, -.2, .3>"
         " <-.6, .2, .3>, <-.2, .2, .5>, <.2, .2, .5>, <.6, .2, .3>"
         " <-.6, .6, 0>, <-.2, .6, .3>, <.2, .6, .3>, <.6, .6, 0> M(.4, .6) }",
         0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        char text[2048];
        snprintf(text, sizeof text,
                 HEAD
                 "camera { location <.85, -.8, .9> look_at 0 }\n"
                 "difference { box { -2, 2 } box { -1, 1 M(.7, .3) } M(.5, .5) } %s\n",
                 cases[i].solid);
        struct radiosity_options o = with(150, "stochastic");
        o.solver.rays = 40000;
        struct scene_run s = scene_solve(text, &o);
        const struct mean all = mean_of(&s, NULL), m = mean_of(&s, curved);
        uint32_t others = 0;
        for (uint32_t k = 0; k < s.r->patches->chart_count; k++)
            others += s.r->patches->chart[k].kind == CHART_PROJECTED;
        print_message("mapped %zu: %u patches, area %.4f, B %.4f, all %.4f\n", i,
                      s.r->report.elements, m.area, m.b, all.b);
        assert_int_equal(others, 0);
        if (cases[i].area > 0)
            assert_near(m.area / cases[i].area, 1, 2e-3);
        assert_true(m.area > .5);
        assert_near(m.b, 1, .02);
        assert_near(all.b, 1, .01);
        scene_free(&s);
    }
}

// Quadrics without end, cut by other solids: the drawn area, and B = 1 in the furnace.
static void cut_quadrics(void **state)
{
    (void)state;
    static const struct {
        const char *solid;
        double area; // of what is curved
    } cases[] = {
        {"quadric { <1, 1, 0>, 0, <0, 0, -1>, 0 M(.4, .6) } box { -2, <2, 2, 1> M(.8, "
         ".2) }",
         5.3304135},
        {"quadric { <1, 1, -1>, 0, 0, -.25 M(.4, .6) } box { <-2, -2, -.5>, <2, 2, .5> "
         "M(.8, .2) }",
         3.9938247},
        {"quadric { <1, 1, 0>, 0, 0, -1 M(.4, .6) rotate 30*x } box { <-3, -3, -.5>, "
         "<3, 3, .5> M(.8, .2) rotate 30*x }",
         6.2831853},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (!in_full() && i == 1)
            continue;
        char text[2048];
        snprintf(text, sizeof text,
                 HEAD "camera { location <.02, -.03, .3> look_at 0 }\n"
                      "difference { box { -5, 5 } intersection { %s } M(.5, .5) }\n",
                 cases[i].solid);
        struct radiosity_options o = with(30, "gauss-seidel");
        struct scene_run s = scene_solve(text, &o);
        const struct mean m = mean_of(&s, NULL), side = mean_of(&s, curved);
        print_message("quadric %zu: %u patches, area %.4f, %.4f to %.4f\n", i,
                      s.r->report.elements, side.area, m.least, m.most);
        assert_near(side.area / cases[i].area, 1, .015);
        assert_near(m.least, 1, 1e-3);
        assert_near(m.most, 1, 1e-3);
        scene_free(&s);
    }
}

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

// ---- failures of section 4 ------------------------------------------------------------------
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
        cmocka_unit_test(furnace),
        cmocka_unit_test(mapped_shapes),
        cmocka_unit_test(cut_quadrics),
        cmocka_unit_test(caps),
        cmocka_unit_test(every_patch),
        cmocka_unit_test(concentric_s4),
        cmocka_unit_test(discs_c4),
        cmocka_unit_test(small_over_large_t12),
        cmocka_unit_test(leaks_f9),
        cmocka_unit_test(contact_f10),
        cmocka_unit_test(enclosed_f15_f16),
        cmocka_unit_test(error_target),
        cmocka_unit_test(memory_is_predicted),
        cmocka_unit_test(cancelled),
    };
    if (getenv("LAMBERT_TEST")) // a pattern of names
        cmocka_set_test_filter(getenv("LAMBERT_TEST"));
    return cmocka_run_group_tests(tests, NULL, NULL);
}
