// Whole solutions with exact answers, and the light of the picture at single points.
#include "test.h"

#include <stdlib.h>

#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "scenes.h"
#include "trace/tracer.h"
#include "truth.h"

static const double pi = 3.14159265358979323846;

// ---- solutions ---------------------------------------------------------------------------
static bool reflects(const struct element *e) { return e->reflectance.r > 0; }

struct solution_case {
    const char *name, *scene;
    double h;   // irradiance of all that reflects, in the mean
    double off; // allowed, relative
};

static const struct solution_case solutions[] = {
    // Any closed scene: B = E / (1 - rho).
    {"S1",
     "camera { location <.05, -.15, .75> look_at 0 }\n"
     "difference { box { -2, 2 } box { -1, 1 M(.5, 1) } M(.5, 1) }"
     "difference { sphere { <.1, 0, -.3>, .5 } cylinder { -z, z, .2 } M(.5, 1) }",
     2, 2e-3},
    // A tenth of a sphere's inside emits: H = f E / (1 - rho). The rim of the tenth runs
    // through patches, whose emission is the mean of 36 points.
    {"S3",
     "camera { location .1 look_at .5*z }\n"
     "difference { box { -2, 2 } sphere { .5*z, .5 texture { gradient z texture_map {"
     " [.9 pigment { rgb 1 } finish { ambient 0 diffuse .7 }]"
     " [.9 pigment { rgb 1 } finish { ambient 0 diffuse .7 emission 1 }] } } }"
     " M(0, 0) }",
     1.0 / 3, .05},
    // A bowl, open at the top: B = E / (1 - rho / 2).
    {"S9",
     "camera { location z look_at 0 }\n"
     "difference { sphere { 0, 1.1 M(0, 0) } sphere { 0, 1 M(.5, 1) }"
     " plane { -z, 0 M(0, 0) } }",
     2.0 / 3, .01},
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
            const struct mean m = mean_of(&s, reflects);
            print_message("%s %s: %.5f of %.5f (%u patches)\n", c->name, solvers[k], m.h,
                          c->h, s.r->report.elements);
            assert_near(m.h / c->h, 1, c->off);
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

// A lid that glows a hundredth below the ceiling: what it gives to points of one patch
// differs by all there is. Rays find that in few steps (drawing emitters took ten), and
// what stores all factors finds the same.
static void close_emitter(void **state)
{
    (void)state;
    static const char *const solvers[] = {"gauss-seidel", "stochastic"};
    double h[2];
    for (int k = 0; k < 2; k++) {
        struct radiosity_options o = with(300, solvers[k]);
        o.solver.tolerance = k ? .02 : 1e-4;
        o.solver.steps_max = k ? 6 : 0;
        struct scene_run s = scene_solve(
            HEAD
            "camera { location <0, 1, -1> look_at 0 }\n"
            "difference { box { -3, 4 } box { <-1.5, 0, -1.5>, <1.5, 3, 1.5> M(.7, 0) }"
            " M(.7, 0) } box { <-.45, 2.97, -.45>, <.45, 2.99, .45> M(.7, 15) }",
            &o);
        h[k] = mean_of(&s, NULL).h;
        print_message("a lid, %s: %.4f in %u steps\n", solvers[k], h[k],
                      s.r->solution.steps);
        assert_true(s.r->solution.converged);
        scene_free(&s);
    }
    assert_near(h[1] / h[0], 1, .02);
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
    void *state; // of the light
};

static struct eye eye_new(const struct scene_run *s)
{
    struct eye eye = {tracer_new(s->job), radiosity_indirect(s->r), NULL};
    eye.state = eye.light.begin(eye.light.data);
    return eye;
}

static void eye_free(const struct eye *eye)
{
    eye->light.end(eye->state);
    tracer_free(eye->t);
}

// Irradiance where a ray meets the scene, in units of a radiosity.
static double light_at(const struct eye *eye, struct vec3 o, struct vec3 d, uint32_t hash)
{
    const struct ray_query q = {{o, d, 0, INFINITY}, 0};
    const struct hit hit = trace_closest_1(eye->t->job->world, eye->t->scratch, &q);
    struct interaction at;
    assert_true(hit.b.t < INFINITY);
    trace_interaction(eye->t->job->world, &q.ray, &hit, &at);
    const struct vec3 side = vec3_dot(at.ng, d) > 0 ? vec3_neg(at.ng) : at.ng;
    const struct indirect_query query = {.ray = &q.ray,
                                         .hit = &hit,
                                         .at = &at,
                                         .n = side,
                                         .side = side,
                                         .weight = 1,
                                         .hash = hash,
                                         .level = 1};
    return (double)eye->light.irradiance(eye->light.data, eye->state, eye->t, &query).g;
}

// On the black floor z = 0 at x, over many draws.
static double floor_light(const struct eye *eye, double x)
{
    const uint32_t draws = in_full() ? 512 : 64;
    double sum = 0;
    for (uint32_t k = 0; k < draws; k++)
        sum += light_at(eye, vec3(x, 0, .01), vec3(0, 0, -1), k * 7919) / draws;
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
    "mesh { triangle { <-5, -4, 0>, <5, -4, 0>, <0, 8, 0> } M(0, 0) }\n"
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
    // T21 with d = 2 r, at 80, 90 and 110 degrees. Patches of which only a rim is above
    // the horizon may be missed.
    {"D2 80",
     FLOOR "sphere { 2*z, 1 rotate 80*y M(0, 1) }",
     {0},
     {0.0546958164455372532},
     1,
     2e-3},
    {"D2 90",
     FLOOR "sphere { 2*z, 1 rotate 90*y M(0, 1) }",
     {0},
     {0.0288344428112186543},
     1,
     2e-3},
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
    {"D3 corner",
     FLOOR "mesh { triangle { <0, 0, 2>, <2, 0, 2>, <2, 2, 2> }"
           " triangle { <0, 0, 2>, <2, 2, 2>, <0, 2, 2> } M(0, 1) }",
     {0},
     {0.435209875683551599 / 3.14159265358979324},
     1,
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
     4e-3},
};

static void direct_light_d1_to_d4(void **state)
{
    (void)state;
    int wrong = 0;
    for (size_t i = 0; i < sizeof directs / sizeof directs[0]; i++) {
        const struct direct_case *c = &directs[i];
        char text[1024];
        snprintf(text, sizeof text, HEAD "%s", c->scene);
        struct radiosity_options o = with(400, "stochastic");
        o.solver.rays = 1000;
        struct scene_run s = scene_solve(text, &o);
        const struct eye eye = eye_new(&s);
        for (int k = 0; k < c->count; k++) {
            const double h = floor_light(&eye, c->x[k]);
            const bool right = fabs(h - c->h[k]) <= c->off;
            print_message("%s%s at %g: %.6f of %.6f (%u emitters)\n",
                          right ? "" : "WRONG ", c->name, c->x[k], h, c->h[k],
                          s.r->emitter_count);
            wrong += !right;
        }
        eye_free(&eye);
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
    const struct eye eye = eye_new(&s);
    double least = INFINITY, most = -INFINITY;
    for (uint32_t k = 0; k < (in_full() ? 20000u : 2000u); k++) {
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
    eye_free(&eye);
    scene_free(&s);
}

static void benchmark_path(char path[1024], const char *name)
{
    const char *top = getenv("top_srcdir");
    snprintf(path, 1024, "%s/tests/perf/radiosity/%s", top ? top : "..", name);
}

// ---- the Cornell box ---------------------------------------------------------------------
// Area, and irradiance by surface for a light of radiosity 1 (particle tracing, 1e8 particles, 2e-4
// or better on the walls), in the order of the scene.
static const struct {
    const char *name;
    double area, h[3];
} cornell[16] = {
    {"light", 13650.0, {0.011394, 0.010454, 0.009008}},
    {"floor", 308231.0, {0.0090689, 0.0088400, 0.0078402}},
    {"ceiling", 297265.2, {0.0083087, 0.0073108, 0.0059764}},
    {"back", 303376.6, {0.0137741, 0.0132337, 0.0117231}},
    {"right", 306889.0, {0.0148453, 0.0143999, 0.0133418}},
    {"left", 306904.5, {0.0132363, 0.0121969, 0.0113562}},
    {"short top", 27633.0, {0.025696, 0.026194, 0.024555}},
    {"short side", 27562.4, {0.0013115, 0.0038147, 0.0014248}},
    {"short side", 27199.0, {0.0079103, 0.0101912, 0.0076353}},
    {"short side", 27344.2, {0.0088587, 0.0065057, 0.0062168}},
    {"short side", 27610.3, {0.0011324, 0.0007172, 0.0006599}},
    {"tall top", 27626.5, {0.059159, 0.056632, 0.055742}},
    {"tall side", 54589.8, {0.0064886, 0.0059277, 0.0053309}},
    {"tall side", 55220.5, {0.0073973, 0.0100371, 0.0071589}},
    {"tall side", 54688.5, {0.0082001, 0.0058322, 0.0052822}},
    {"tall side", 54905.1, {0.0071249, 0.0008553, 0.0008086}},
};
enum { CORNELL = 16, CORNELL_BLOCKS = 6, CORNELL_TALL = 11 };

// The surface of the table that an element belongs to; CORNELL: none. The blocks are
// hollow in the scene; their inner sides and the lamp's upper one are none of the table's.
static int cornell_surface(const struct patches *p, uint32_t i)
{
    static const struct vec3 middle[2] = {{185.5, 82.5, 168.5}, {368.5, 165, 351.25}};
    const struct element *e = &p->element[i];
    const uint32_t leaf = p->chart[p->cell[p->element_cell[i] / 2].chart].leaf;
    const int k = (int)p->job->world->leaf[leaf].object;
    const bool within =
        k >= CORNELL_BLOCKS &&
        vec3_dot(e->normal, vec3_sub(e->centre, middle[k >= CORNELL_TALL])) < 0;
    return within || (k == 0 && e->normal.y > 0) ? CORNELL : k;
}

// Every surface and channel within 1 %. Of a coarse mesh and few rays 3 %, but for the
// lamp and the sides of the blocks, which get little light.
static void cornell_box(void **state)
{
    (void)state;
    char path[1024];
    benchmark_path(path, "cornell.pov");
    struct scene_run s = scene_load_file(path);
    struct radiosity_options o = with(in_full() ? 150000 : 2000, "stochastic");
    o.solver.rays = in_full() ? 20000000 : 300000;
    scene_solve_loaded(&s, &o);
    double h[CORNELL + 1][3] = {{0}}, off = 0, all = 0;
    const struct patches *p = s.r->patches;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const int k = cornell_surface(p, i);
        for (int c = 0; c < 3; c++)
            h[k][c] += p->element[i].area * s.r->solution.h[i][c] / 20;
    }
    int wrong = 0;
    for (int k = 0; k < CORNELL; k++) {
        const bool side = k >= CORNELL_BLOCKS && strstr(cornell[k].name, "side");
        const double allowed = in_full() ? .01 : k == 0 || side ? 1 : .03;
        double most = 0;
        for (int c = 0; c < 3; c++) {
            const double d = h[k][c] / cornell[k].area - cornell[k].h[c];
            most = fmax(most, fabs(d / cornell[k].h[c]));
            off += cornell[k].area * d * d;
            all += cornell[k].area * cornell[k].h[c] * cornell[k].h[c];
        }
        print_message("%s%s: off by %.4f\n", most > allowed ? "WRONG " : "",
                      cornell[k].name, most);
        wrong += most > allowed;
    }
    print_message("Cornell box: off by %.4f (rms), %u patches\n", sqrt(off / all),
                  p->element_count);
    assert_int_equal(wrong, 0);
    assert_true(sqrt(off / all) < .01);
    scene_free(&s);
}

// ---- the estimate of an error target -----------------------------------------------------
// The true error is within a factor 3 of the estimate, and the estimate meets the target.
static void estimate_is_true(void **state)
{
    (void)state;
    static const struct {
        const char *scene, *truth;
        double error;
        bool quick;
    } cases[] = {
        {"cube.pov", "cube.truth.tsv", .1, true},
        {"cube.pov", "cube.truth.tsv", .03, false},
        {"csg.pov", NULL, .1, false},
        {"cornell.pov", "cornell.truth.tsv", .1, false},
        {"cornell.pov", "cornell.truth.tsv", .05, false},
        {"room.pov", "room.truth.tsv", .1, false},
    };
    int wrong = 0;
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
        if (!cases[k].quick && !in_full())
            continue;
        char path[1024];
        benchmark_path(path, cases[k].scene);
        struct scene_run s = scene_load_file(path);
        struct radiosity_options o = radiosity_defaults;
        o.error = cases[k].error;
        scene_solve_loaded(&s, &o);
        if (cases[k].truth) {
            benchmark_path(path, cases[k].truth);
            truth_read(path);
        }
        const double off =
            cases[k].truth ? truth_error(s.r, true, false) : furnace_error(s.r, false);
        const double estimate = s.r->report.error;
        const bool right =
            estimate <= o.error && off < 3 * estimate && estimate < 3 * off;
        print_message("%s%s: asked %g, estimated %.4f, off by %.4f, %u patches\n",
                      right ? "" : "WRONG ", cases[k].scene, o.error, estimate, off,
                      s.r->report.elements);
        wrong += !right;
        scene_free(&s);
    }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_s1_s3_s9),  cmocka_unit_test(sphere_t25),
        cmocka_unit_test(nothing_escapes_f19), cmocka_unit_test(direct_light_d1_to_d4),
        cmocka_unit_test(no_seams_f13),        cmocka_unit_test(cornell_box),
        cmocka_unit_test(estimate_is_true),    cmocka_unit_test(close_emitter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
