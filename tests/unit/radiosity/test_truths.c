// Form factors of whole scenes with closed forms: from the language by the charts, the
// exact CSG and the shadow rays to sums over elements.
#include "test.h"

#include <stdlib.h>

#include "scenes.h"

// The senders have reflectance .25, the receivers .5, what only hides .75; M(.25, 0) and
// so on tell them apart.
#define SENDER(e)   ((e)->reflectance.r < .3f)
#define RECEIVER(e) ((e)->reflectance.r > .4f && (e)->reflectance.r < .6f)
#define A_          " M(.25, 0) "
#define B_          " M(.5, 0) "
#define C_          " M(.75, 0) "

// A square from x = y = LOW to HIGH at z = HEIGHT, without its texture and brace.
#define SQUARE(low, high, height)                                                        \
    "mesh { triangle { <" low ", " low ", " height ">, <" high ", " low ", " height      \
    ">, <" high ", " high ", " height "> } triangle { <" low ", " low ", " height        \
    ">, <" high ", " high ", " height ">, <" low ", " high ", " height "> }"

struct factor_case {
    const char *name, *scene;
    struct vec3 from, to; // sides of the senders and receivers that count; 0: all
    double f;             // from senders to receivers
    double area;          // of the senders, also where nothing sees them
    double analytic;      // allowed relative error at `patches` elements; 0: not asked
    double patches;
};

#define CAMERA(p) "camera { location " p " look_at 0 }\n"
#define UP                                                                               \
    {                                                                                    \
        0, 0, 1                                                                          \
    }
#define DOWN                                                                             \
    {                                                                                    \
        0, 0, -1                                                                         \
    }
#define ANY                                                                              \
    {                                                                                    \
        0, 0, 0                                                                          \
    }
#define PI 3.14159265358979323846
// A disc of radius .002 stands for a point: 1e-6 off.
#define POINT(p, n) "disc { " p ", " n ", .002" A_ "}"
#define POINT_AREA  (PI * 4e-6)

static const char hidden_by_mesh[] = CAMERA("<3, 0, .5>") SQUARE("0", "1", "0") A_
    "} " SQUARE(".25", ".75", ".5") C_ "} " SQUARE("0", "1", "1") B_ "}";
static const struct factor_case cases[] = {
    {"T3 closed cube",
     CAMERA("<.5, .5, .2>") "difference { box { -1, 2 } box { 0, 1" A_ "} M(.75, 0) }",
     ANY, ANY, 1, 6, 0.0004, 38},
    {"T9 discs", CAMERA("<3, 0, .5>") "disc { 0, z, 1" A_ "} disc { z, z, 1" B_ "}", UP,
     ANY, 0.381966011250105152, PI, 0.012, 160},
    {"T10 discs 1, 2 at 1.5",
     CAMERA("<3, 0, .5>") "disc { 0, z, 1" A_ "} disc { 1.5*z, z, 2" B_ "}", UP, ANY,
     0.601653344388043880, PI, 0.012, 160},
    {"T10 discs 1, .5 at 3",
     CAMERA("<.1, 0, 1.5>") "disc { 0, z, 1" A_ "} disc { 3*z, z, .5" B_ "}", UP, ANY,
     0.0244485592242087456, PI, 0.012, 160},
    {"T10 discs 1, .5 at 3, seen from the side",
     CAMERA("<4, .2, 1.5>") "disc { 0, z, 1" A_ "} disc { 3*z, z, .5" B_ "}", UP, ANY,
     0.0244485592242087456, PI, 0.012, 600},
    {"T10 discs at .01",
     CAMERA("<.1, 0, .005>") "disc { 0, z, 1" A_ "} disc { .01*z, z, 1" B_ "}", UP, ANY,
     0.990049875000781, PI, 0.12, 160},
    {"T11 discs in a sphere, tilted",
     CAMERA("<3, 0, .1>") "disc { .25*z, z, sqrt(.1875)" A_
                          "} disc { -.15*z, z, sqrt(.2275) rotate 30*x" B_ "}",
     DOWN, ANY, 7.0 / 15, PI * .1875, 0.012, 160},
    {"T11 discs in a sphere, one side",
     CAMERA("<.1, 0, .2>") "disc { .25*z, z, sqrt(.1875)" A_
                           "} disc { .15*z, z, sqrt(.2275)" B_ "}",
     DOWN, ANY, 13.0 / 15, PI * .1875, 0.012, 160},
    {"T12 sphere to disc 1 at 2",
     CAMERA("<3, 0, .5>") "sphere { 0, .5" A_ "} disc { 2*z, z, 1" B_ "}", ANY, ANY,
     0.0527864045000420607, PI, 0.08, 160},
    {"T12 sphere to disc 2 at 1.5",
     CAMERA("<3, 0, .5>") "sphere { 0, .5" A_ "} disc { 1.5*z, z, 2" B_ "}", ANY, ANY, .2,
     PI, 0.08, 160},
    {"T13 sphere to a corner, 1 1 1",
     CAMERA("<3, 0, .5>") "sphere { 0, .3" A_ "} mesh { triangle { z, z + x, z + x + y }"
                          " triangle { z, z + x + y, z + y }" B_ "}",
     ANY, ANY, 0.0416666666666666667, 4 * PI * .09, 0.08, 160},
    {"T13 sphere to a corner, 2 1 1.5",
     CAMERA("<3, 0, .5>") "sphere { 0, .3" A_ "} mesh { triangle { 1.5*z, 1.5*z + 2*x, "
                          "<2, 1, 1.5> } triangle { 1.5*z, <2, 1, 1.5>, 1.5*z + y }" B_
                          "}",
     ANY, ANY, 0.0365889461394650649, 4 * PI * .09, 0.1, 160},
    {"T14 walls to a sphere",
     CAMERA("<.4, .4, .4>") "difference { box { -1, 1 } box { -.5, .5" A_
                            "} M(.75, 0) } sphere { 0, .25" B_ "}",
     ANY, ANY, 0.130899693899574718, 6, 0.012, 160},
    {"T15 spheres 1, 1, 4",
     CAMERA("<0, 3, .5>") "sphere { 0, 1" A_ "} sphere { 4*x, 1" B_ "}", ANY, ANY,
     0.0161562443698741815, 4 * PI, 0.1, 240},
    {"T15 spheres 1, 1, 2.5",
     CAMERA("<0, 3, .5>") "sphere { 0, 1" A_ "} sphere { 2.5*x, 1" B_ "}", ANY, ANY,
     0.0441189329067011556, 4 * PI, 0.08, 240},
    {"T15 spheres 1, 2, 6",
     CAMERA("<0, 3, .5>") "sphere { 0, 1" A_ "} sphere { 6*x, 2" B_ "}", ANY, ANY,
     0.0288299228082685010, 4 * PI, 0.14, 240},
    {"T19 point to disc, 0 from the axis",
     CAMERA("<3, 0, .5>") POINT("0", "z") "disc { z, z, 1" B_ "}", UP, ANY, .5,
     POINT_AREA, .04, 120},
    {"T19 point to disc, 1.5 from the axis",
     CAMERA("<3, 0, .5>") POINT("1.5*x", "z") "disc { z, z, 1" B_ "}", UP, ANY,
     0.12629534065817014755, POINT_AREA, 0.012, 120},
    {"T19 point to disc at 2, .5 from the axis",
     CAMERA("<3, 0, .5>") POINT(".5*x", "z") "disc { 2*z, z, 1" B_ "}", UP, ANY,
     0.184703687452767134, POINT_AREA, 0.012, 120},
    {"T20 point beside the axis of a disc",
     CAMERA("<.5, .1, -1>") POINT("<2, 0, -1>", "-x") "disc { 0, z, 1" B_ "}",
     {-1, 0, 0},
     ANY,
     0.0854101966249684545,
     POINT_AREA,
     0.012,
     300},
    {"T21 point to sphere, facing",
     CAMERA("<3, 3, .5>") POINT("0", "z") "sphere { 2*z, 1" B_ "}", UP, ANY, .25,
     POINT_AREA, 0.08, 240},
    {"T21 point to sphere, 80 degrees",
     CAMERA("<3, 3, .5>") POINT("0", "z") "sphere { 2*z, 1" B_ "rotate 80*x }", UP, ANY,
     0.0546958164455372532, POINT_AREA, 0.012, 240},
    {"T21 point to sphere, 90 degrees",
     CAMERA("<3, 3, .5>") POINT("0", "z") "sphere { 2*z, 1" B_ "rotate 90*x }", UP, ANY,
     0.0288344428112186543, POINT_AREA, 0.012, 240},
    {"T21 point to sphere, 110 degrees (F18)",
     CAMERA("<3, 3, .5>") POINT("0", "z") "sphere { 2*z, 1" B_ "rotate 110*x }", UP, ANY,
     0.00214956751760780101, POINT_AREA, .03, 240},
    {"T21 point to sphere at 3, 30 degrees",
     CAMERA("<3, 3, .5>") POINT("0", "z") "sphere { 3*z, 1" B_ "rotate 30*x }", UP, ANY,
     0.0962250448649376274, POINT_AREA, 0.012, 240},
    {"T24 outer to inner sphere",
     CAMERA("1.5*x") "difference { sphere { 0, 3 } sphere { 0, 2" A_
                     "} M(.75, 0) } sphere { 0, 1" B_ "}",
     ANY, ANY, .25, 16 * PI, 0.08, 240},
    {"T26 base to base",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } cylinder { -z, z, 1" A_
                            "} M(.75, 0) }",
     UP, DOWN, 0.171572875253809902, PI, .03, 160},
    {"T26 base to side",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } intersection { cylinder { -2*z, "
                            "2*z, 1" B_ "} box { <-2, -2, -1>, <2, 2, 1>" A_
                            "} } M(.75, 0) }",
     UP, ANY, 0.828427124746190098, PI, 0.012, 160},
    {"T26 side to bases",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } intersection { cylinder { -2*z, "
                            "2*z, 1" A_ "} box { <-2, -2, -1>, <2, 2, 1>" B_
                            "} } M(.75, 0) }",
     ANY, ANY, 2 * 0.207106781186547524, 4 * PI, 0.012, 160},
    {"T26 side to itself",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } intersection { cylinder { -2*z, "
                            "2*z, 1" A_ "} box { <-2, -2, -1>, <2, 2, 1>" C_
                            "} } M(.75, 0) }",
     ANY, ANY, 0.585786437626904951, 4 * PI, 0.012, 160},
    {"T28 base to dome",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } intersection { sphere { 0, 1" B_
                            "} box { <-2, -2, 0>, 2" A_ "} } M(.75, 0) }",
     ANY, ANY, 1, PI, 0.012, 160},
    {"T28 dome to base",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } intersection { sphere { 0, 1" A_
                            "} box { <-2, -2, 0>, 2" B_ "} } M(.75, 0) }",
     ANY, ANY, .5, 2 * PI, 0.012, 160},
    {"T28 dome to itself",
     CAMERA("<.1, .2, .3>") "difference { box { -3, 3 } intersection { sphere { 0, 1" A_
                            "} box { <-2, -2, 0>, 2" C_ "} } M(.75, 0) }",
     ANY, ANY, .5, 2 * PI, 0.012, 160},
    // The receiver is long enough for what lies beyond it to be 5e-4.
    {"T30 cylinders side by side",
     CAMERA("<1.5, 3, .5>") "cylinder { -.25*y, .25*y, 1 open" A_
                            "} cylinder { <3, -100, 0>, <3, 100, 0>, 1 open" B_ "}",
     ANY, ANY, 0.110695969631672511, PI, 0, 160},
    // Flat and in one direction: nothing that lies between has any thickness.
    {"O1 a quarter hidden by a mesh",
     CAMERA("<3, 0, .5>") SQUARE("0", "1", "0") A_ "} " SQUARE("0", ".5", ".5") C_
     "} " SQUARE("0", "1", "1") B_ "}",
     UP, ANY, 0.149868671773790537, 1, 0.012, 320},
    {"O2 its middle hidden by a mesh", hidden_by_mesh, UP, ANY, 0.0995062945989847863, 1,
     0.012, 160},
    {"O3 the same lower down",
     CAMERA("<3, 0, .5>") SQUARE("0", "1", "0") A_ "} " SQUARE(".25", ".75", ".25") C_
     "} " SQUARE("0", "1", "1") B_ "}",
     UP, ANY, 0.115620602132415, 1, 0.012, 320},
    {"O4 a disc between discs",
     CAMERA("<3, 0, .5>") "disc { 0, z, .5" A_ "} disc { z, z, .5" C_
                          "} disc { 2*z, z, 1.5" B_ "}",
     UP, ANY, 0.179316484072672770, PI / 4, 0.012, 320},
    {"O5 a disc before a point",
     CAMERA("<3, 0, .5>") POINT("0", "z") "disc { z, z, .25" C_ "} disc { 2*z, z, 1" B_
                                          "}",
     UP, ANY, 0.141176470588235294, POINT_AREA, 0.012, 320},
    {"O6 a sphere between discs",
     CAMERA("<3, 0, .5>") "disc { 0, z, .5" A_ "} sphere { 1.5*z, .5" C_
                          "} disc { 3*z, z, 4" B_ "}",
     UP, ANY, 0.535056180317043392, PI / 4, 0.012, 320},
    {"F12 1e-3 over 10 x 10",
     CAMERA("<3, 0, .5>") "mesh { triangle { <-.0005, -.0005, 1>, <.0005, -.0005, 1>, "
                          "<.0005, .0005, 1> } triangle { <-.0005, -.0005, 1>, <.0005, "
                          ".0005, 1>, <-.0005, .0005, 1> }" A_
                          "} box { <-5, -5, -1>, <5, 5, 0>" B_ "}",
     DOWN, ANY, 0.96833955697404, 1e-6, 0.0002, 120},
};

static bool on_side(const struct element *e, struct vec3 side)
{
    return vec3_dot(side, side) == 0 || vec3_dot(e->normal, side) > .5;
}

// F from the senders to the receivers, or among the senders where nothing is a receiver.
// rays: of all senders together.
static double factor_of(struct patches *p, const char *method,
                        const struct factor_case *c, double rays)
{
    struct form_factor_settings s = radiosity_defaults.factors;
    uint32_t senders = 0, receivers = 0;
    double sum = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        senders += SENDER(&p->element[i]) && on_side(&p->element[i], c->from);
        receivers += RECEIVER(&p->element[i]);
    }
    s.method = method;
    s.rays = (int)(rays / fmax(senders, 1)) + 1;
    struct factor_state *state = factor_state_new(&p->enclosure, &s);
    float *row = calloc(p->element_count + 1, sizeof *row);
    assert_non_null(row);
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        if (!SENDER(e) || !on_side(e, c->from))
            continue;
        factor_row(state, i, row);
        for (uint32_t j = 0; j < p->element_count; j++) {
            const struct element *o = &p->element[j];
            if ((receivers ? RECEIVER(o) : SENDER(o)) && on_side(o, c->to))
                sum += e->area * (double)row[j];
        }
    }
    free(row);
    factor_state_free(state);
    return sum / c->area;
}

static double area_of_senders(const struct patches *p, const struct factor_case *c)
{
    double area = 0;
    for (uint32_t i = 0; i < p->element_count; i++)
        if (SENDER(&p->element[i]) && on_side(&p->element[i], c->from))
            area += p->element[i].area;
    return area;
}

static bool check(const struct factor_case *c)
{
    const double rays = in_full() ? 1e6 : 2e4;
    char text[2048];
    snprintf(text, sizeof text, HEAD "%s", c->scene);
    struct scene_run s = scene_load(text);
    struct patch_settings settings = radiosity_defaults.patches;
    settings.count = in_full() ? 4 * c->patches : c->patches;
    struct patches *p = patches_build(s.job, &settings);
    assert_non_null(p);
    // Elements are no larger than what is there.
    const double area = area_of_senders(p, c) / c->area - 1;
    const double analytic = factor_of(p, "analytic", c, 0) / c->f - 1;
    const double sobol = factor_of(p, "sobol", c, rays) / c->f - 1;
    // What as many independent rays would be off by (Sobol's are better), and the rim
    // of cells that exist in part.
    const double allowed = sqrt((1 - c->f) / (c->f * rays)) + 1e-3;
    const bool right = (c->analytic <= 0 || fabs(analytic) <= c->analytic) &&
                       fabs(sobol) <= allowed && area < 1e-3;
    print_message("%s%s: analytic %+.2e, Sobol %+.2e (allowed %.2e), %u patches\n",
                  right ? "" : "WRONG ", c->name, analytic, sobol, allowed,
                  p->element_count);
    patches_free(p);
    scene_free(&s);
    return right;
}

static void form_factors(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        // What is flat and hides must not be taken for what only touches.
        if (in_full() || i % 5 == 0 || cases[i].scene == hidden_by_mesh)
            wrong += !check(&cases[i]);
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(form_factors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
