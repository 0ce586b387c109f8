// Closed scenes in which B = 1 where E = 1 - rho, whatever is in them.
#include "test.h"

#include "radiosity/sequence.h"
#include "scenes.h"

static bool curved(const struct element *e) { return e->curved; }

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(furnace),
        cmocka_unit_test(mapped_shapes),
        cmocka_unit_test(cut_quadrics),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
