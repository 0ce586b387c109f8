// Whole solutions with exact answers, and the light of the picture at single points.
#include "test.h"

#include <stdlib.h>

#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "scenes.h"
#include "trace/tracer.h"

static const double pi = 3.14159265358979323846;

// ---- solutions ---------------------------------------------------------------------------
static bool bright(const struct element *e) { return e->emission.r > .5f; }
static bool dim(const struct element *e)
{
    return e->emission.r < .5f && e->reflectance.r > 0;
}

struct solution_case {
    const char *name, *scene;
    double bright, dim; // B of what emits and of what does not; 0: not asked
    double off;         // allowed, relative
};

static const struct solution_case solutions[] = {
    // Any closed scene: E / (1 - rho).
    {"S1",
     "camera { location <.05, -.15, .75> look_at 0 }\n"
     "difference { box { -2, 2 } box { -1, 1 M(.5, 1) } M(.5, 1) }"
     "difference { sphere { <.1, 0, -.3>, .5 } cylinder { -z, z, .2 } M(.5, 1) }",
     2, 0, .03},
    // A tenth of a sphere's inside emits.
    {"S3",
     "camera { location .1 look_at .5*z }\n"
     "difference { box { -2, 2 } sphere { .5*z, .5 texture { gradient z texture_map {"
     " [.9 pigment { rgb 1 } finish { ambient 0 diffuse .7 }]"
     " [.9 pigment { rgb 1 } finish { ambient 0 diffuse .7 emission 1 }] } } }"
     " M(0, 0) }",
     1.2333333333, 0.2333333333, .02},
    // A bowl, open at the top.
    {"S9",
     "camera { location z look_at 0 }\n"
     "difference { sphere { 0, 1.1 M(0, 0) } sphere { 0, 1 M(.5, 1) }"
     " plane { -z, 0 M(0, 0) } }",
     4.0 / 3, 0, .01},
};

static void solutions_s1_s3_s9(void **state)
{
    (void)state;
    static const char *const solvers[] = {"gauss-seidel", "stochastic"};
    for (size_t i = 0; i < sizeof solutions / sizeof solutions[0]; i++) {
        const struct solution_case *c = &solutions[i];
        for (int k = 0; k < 2; k++) {
            char text[1024];
            snprintf(text, sizeof text, HEAD "%s", c->scene);
            struct radiosity_options o = with(in_full() ? 600 : 100, solvers[k]);
            o.solver.tolerance = k ? .02 : 1e-4;
            struct scene_run s = scene_solve(text, &o);
            const struct mean b = mean_of(&s, bright), d = mean_of(&s, dim);
            print_message("%s %s: %.5f %.5f (%u patches)\n", c->name, solvers[k], b.b,
                          d.b, s.r->report.elements);
            assert_near(b.b / c->bright, 1, c->off);
            if (c->dim > 0)
                assert_near(d.b / c->dim, 1, 2 * c->off);
            scene_free(&s);
        }
    }
}

// T25: inside a sphere any patch sees of any part what the part is of the sphere.
static void sphere_t25(void **state)
{
    (void)state;
    struct scene_run s =
        scene_load(HEAD "camera { location .1 look_at z }\n"
                        "difference { box { -2, 2 } sphere { 0, 1 M(.5, 0) } M(0, 0) }");
    struct patch_settings settings = radiosity_defaults.patches;
    settings.count = 200;
    struct patches *p = patches_build(s.job, &settings);
    static const char *const methods[] = {"analytic", "sobol"};
    float *row = calloc(p->element_count, sizeof *row);
    double upper = 0, all = 0;
    for (uint32_t j = 0; j < p->element_count; j++) {
        all += p->element[j].area;
        upper += p->element[j].centre.z > 0 ? p->element[j].area : 0;
    }
    assert_near(all / (4 * pi), 1, 1e-6);
    for (int k = 0; k < 2; k++) {
        struct form_factor_settings f = form_factor_defaults;
        double worst = 0;
        f.method = methods[k];
        struct factor_state *state_of = factor_state_new(&p->enclosure, &f);
        for (uint32_t i = 0; i < p->element_count; i += 7) {
            double sum = 0;
            factor_row(state_of, i, row);
            for (uint32_t j = 0; j < p->element_count; j++)
                sum += p->element[j].centre.z > 0 ? (double)row[j] : 0;
            worst = fmax(worst, fabs(sum - upper / all));
        }
        print_message("T25 %s: off by %.4f at worst\n", methods[k], worst);
        assert_true(worst < (k ? .008 : .03));
        factor_state_free(state_of);
    }
    free(row);
    patches_free(p);
    scene_free(&s);
}

// F19: of rays from all over a closed cube none escapes, however large or far it is.
static void nothing_escapes_f19(void **state)
{
    (void)state;
    static const double scales[] = {1e-3, 1, 1e6};
    const uint32_t batches = in_full() ? 10000 : 100;
    for (int k = 0; k < 3; k++) {
        char text[512];
        snprintf(text, sizeof text,
                 HEAD "camera { location <.51, .52, .53>*%g look_at 0 }\n"
                      "difference { box { -%g, 2*%g } box { 0, %g M(.5, 0) } M(0, 0) }",
                 scales[k], scales[k], scales[k], scales[k]);
        struct scene_run s = scene_load(text);
        struct patch_settings settings = radiosity_defaults.patches;
        settings.count = 96;
        struct patches *p = patches_build(s.job, &settings);
        const struct enclosure *e = &p->enclosure;
        void *of_thread = e->thread_begin(e->user);
        struct ray_batch *rays = ray_batch_new(1024);
        uint32_t met[1024], escaped = 0;
        for (uint32_t b = 0; b < batches; b++) {
            rays->count = 0;
            for (uint32_t i = 0; i < 1024; i++) {
                struct element_point from;
                double x[4];
                random_point(b * 1024 + i, 5, x);
                assert_true(e->point(of_thread, i % e->count, x[0], x[1], &from));
                ray_put(rays, &from, cosine_direction(from.normal, x[2], x[3]), INFINITY);
            }
            e->closest(of_thread, rays, met);
            for (uint32_t i = 0; i < 1024; i++)
                escaped += met[i] == ELEMENT_NONE;
        }
        print_message("F19 scale %g: %u of %u escaped\n", scales[k], escaped,
                      batches * 1024);
        assert_int_equal(escaped, 0);
        ray_batch_free(rays);
        e->thread_end(of_thread);
        patches_free(p);
        scene_free(&s);
    }
}

// ---- light at a point --------------------------------------------------------------------
struct eye {
    struct tracer *t;
    struct indirect light;
};

// Irradiance where a ray meets the scene, in units of a radiosity.
static double light_at(const struct eye *eye, struct vec3 o, struct vec3 d, uint32_t hash)
{
    const struct ray_query q = {{o, d, 0, INFINITY}, 0};
    const struct hit hit = trace_closest_1(eye->t->job->world, eye->t->scratch, &q);
    struct interaction at;
    assert_true(hit.b.t < INFINITY);
    trace_interaction(eye->t->job->world, &q.ray, &hit, &at);
    return (double)eye->light
        .irradiance(eye->light.data, eye->t, &q.ray, &hit, &at, at.ng, hash)
        .g;
}

// On the black floor z = 0 at x, over many draws.
static double floor_light(const struct eye *eye, double x)
{
    enum { DRAWS = 256 };
    double sum = 0;
    for (uint32_t k = 0; k < DRAWS; k++)
        sum += light_at(eye, vec3(x, 0, .01), vec3(0, 0, -1), k * 7919) / DRAWS;
    return sum;
}

struct direct_case {
    const char *name, *scene;
    double x[6], h[6]; // irradiance / pi of a light of radiance 1
    int count;
    double off; // allowed, absolute
};

#define FLOOR                                                                            \
    "camera { location <5, -5, 3> look_at 0 sky z }\n"                                   \
    "mesh { triangle { <-99, -99, 0>, <99, -99, 0>, <0, 199, 0> } M(0, 0) }\n"
#define LAMP3                                                                            \
    "mesh { triangle { <-1, -1, 2>, <1, -1, 2>, <1, 1, 2> }"                             \
    " triangle { <-1, -1, 2>, <1, 1, 2>, <-1, 1, 2> } M(0, 1) }\n"
static const struct direct_case directs[] = {
    {"D1",
     FLOOR "disc { 2*z, z, 1 M(0, 1) }",
     {0, 1.5},
     {0.628318530717958648 / 3.14159265358979324,
      0.321335102751701072 / 3.14159265358979324},
     2,
     1e-3},
    {"D2",
     FLOOR "sphere { 3*z, .5 M(0, 1) }",
     {0},
     {0.0872664625997164788 / 3.14159265358979324},
     1,
     3e-4},
    // T21 with d = 2 r, at 80, 90 and 110 degrees.
    {"D2 80",
     FLOOR "sphere { 2*z, 1 rotate 80*y M(0, 1) }",
     {0},
     {0.0546958164455372532},
     1,
     1e-3},
    {"D2 90",
     FLOOR "sphere { 2*z, 1 rotate 90*y M(0, 1) }",
     {0},
     {0.0288344428112186543},
     1,
     1e-3},
    {"D2 110",
     FLOOR "sphere { 2*z, 1 rotate 110*y M(0, 1) }",
     {0},
     {0.00214956751760780101},
     1,
     4e-4},
    {"D3",
     FLOOR LAMP3,
     {0, 3},
     {0.752274688454107481 / 3.14159265358979324,
      0.104637075190907152 / 3.14159265358979324},
     2,
     1e-6},
    {"D4",
     FLOOR LAMP3 "mesh { triangle { <0, -999, 1>, <999, 0, 1>, <0, 999, 1> } M(0, 0) }",
     {-1, -.5, 0, .5, .9, 1},
     {0.566645112049507263 / 3.14159265358979324,
      0.584056157484374742 / 3.14159265358979324,
      0.376137344227053741 / 3.14159265358979324,
      0.116412809115846359 / 3.14159265358979324,
      0.0133615431992125321 / 3.14159265358979324, 0},
     6,
     1e-3},
};

static void direct_light_d1_to_d4(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof directs / sizeof directs[0]; i++) {
        const struct direct_case *c = &directs[i];
        char text[1024];
        snprintf(text, sizeof text, HEAD "%s", c->scene);
        struct radiosity_options o = with(600, "stochastic");
        o.solver.rays = 1000;
        struct scene_run s = scene_solve(text, &o);
        const struct eye eye = {tracer_new(s.job), radiosity_indirect(s.r)};
        for (int k = 0; k < c->count; k++) {
            const double h = floor_light(&eye, c->x[k]);
            const bool right = fabs(h - c->h[k]) <= c->off;
            print_message("%s%s at %g: %.6f of %.6f (%u emitters)\n",
                          right ? "" : "WRONG ", c->name, c->x[k], h, c->h[k],
                          s.r->emitter_count);
            wrong += !right;
        }
        tracer_free(eye.t);
        scene_free(&s);
    }
    assert_int_equal(wrong, 0);
}

// F13: where cells of different size meet nothing shows: in a furnace all points of all
// surfaces receive 1, those where a ball and a block cut cells included.
static void no_seams_f13(void **state)
{
    (void)state;
    const char *text =
        HEAD "camera { location <.05, -.15, .75> look_at 0 }\n"
             "difference { box { -2, 2 } box { -1, 1 M(.6, .4) } M(.5, .5) }"
             "difference { box { <-.3, -.4, -1>, .4 M(.3, .7) } sphere { .4, .5 M(.8, .2)"
             " } }";
    struct radiosity_options o = with(150, "gauss-seidel");
    o.solver.tolerance = 1e-5;
    o.emitters = EMITTERS_MESH;
    struct scene_run s = scene_solve(text, &o);
    const struct eye eye = {tracer_new(s.job), radiosity_indirect(s.r)};
    double least = INFINITY, most = -INFINITY;
    for (uint32_t k = 0; k < 4000; k++) {
        double x[4];
        random_point(k, 3, x);
        const struct vec3 up = vec3(0, 0, x[2] < .5 ? 1 : -1);
        const double h =
            light_at(&eye, vec3(.05, -.15, .75), cosine_direction(up, x[0], x[1]), k);
        least = fmin(least, h);
        most = fmax(most, h);
    }
    print_message("F13: %.6f to %.6f\n", least, most);
    assert_near(least, 1, 2e-3);
    assert_near(most, 1, 2e-3);
    tracer_free(eye.t);
    scene_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_s1_s3_s9),  cmocka_unit_test(sphere_t25),
        cmocka_unit_test(nothing_escapes_f19), cmocka_unit_test(direct_light_d1_to_d4),
        cmocka_unit_test(no_seams_f13),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
