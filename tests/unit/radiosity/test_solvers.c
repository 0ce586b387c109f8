// Solvers against exact systems, furnaces and each other.
#include "test.h"

#include <stdlib.h>

#include "meshes.h"
#include "radiosity/polygon.h"
#include "radiosity/sequence.h"
#include "radiosity/solver.h"

static void paint(struct element *e, double rho, double emission)
{
    e->reflectance = rgb_even((float)rho);
    e->emission = rgb_even((float)emission);
}

struct solved {
    struct mesh *m;
    struct factors f;
    struct radiosity_solution s;
};

static struct solved solve(struct mesh *m, const struct form_factor_settings *ff,
                           const struct solver_settings *settings, bool balance)
{
    struct solved r = {.m = m};
    struct radiosity_system system = {.e = &m->e, .factors = ff};
    if (solver_needs_matrix(solver_find(settings->solver))) {
        assert_true(factors_compute(&r.f, &m->e, ff));
        if (balance)
            factors_balance(&r.f, &m->e, NULL);
        system.f = &r.f;
    }
    assert_true(radiosity_solve(&r.s, &system, settings));
    return r;
}

static void solved_free(struct solved *r)
{
    mesh_free(r->m);
    if (r->f.f)
        factors_free(&r->f);
    solution_free(&r->s);
}

// ---- one element a wall --------------------------------------------------------------
struct walls {
    const char *name;
    double rho[6], emission[6], b[6]; // floor, ceiling, x0, x1, y0, y1
};
#define ALL(r)                                                                           \
    {                                                                                    \
        r, r, r, r, r, r                                                                 \
    }
#define FLOOR                                                                            \
    {                                                                                    \
        1, 0, 0, 0, 0, 0                                                                 \
    }
#define FCW(f, c, w)                                                                     \
    {                                                                                    \
        f, c, w, w, w, w                                                                 \
    }
static const struct walls cubes[] = {
    {"P1", ALL(.5), FLOOR,
     FCW(1.09090909810769547, 0.181745826107788481, 0.181836268946129011)},
    {"P2", ALL(.8), FLOOR,
     FCW(1.55172415364491464, 0.689551070737637626, 0.689681193904361933)},
    {"P3", ALL(.9), FLOOR,
     FCW(2.37288137482575707, 1.52531055112453987, 1.52545201851242576)},
    {"P4", ALL(.99), FLOOR,
     FCW(17.3622704725972643, 16.5274251277216730, 16.5275760999202657)},
    {"P5",
     {.2, .8, .5, .5, .5, .5},
     FLOOR,
     FCW(1.04193385026176381, 0.288223478229557876, 0.190052182348888824)},
    {"P6", {0, 0, .5, .5, .5, .5}, FLOOR, FCW(1, 0, 0.142879476192825995)},
    {"P7",
     {.75, .75, .63, .14, .75, .75},
     {0, 0, 0, 0, 0, 1},
     {0.334459209071493379, 0.334459209071493379, 0.286967490816775806,
      0.0698446698230719781, 0.334335087398085141, 1.20399961913752047}},
};

static void walls(const char *solver, double tolerance)
{
    struct form_factor_settings ff = form_factor_defaults;
    struct solver_settings settings = solver_defaults;
    ff.points = 7;
    ff.tolerance = 1e-9;
    settings.solver = solver;
    settings.tolerance = tolerance / 2;
    for (size_t k = 0; k < sizeof cubes / sizeof cubes[0]; k++) {
        const struct walls *w = &cubes[k];
        struct mesh *m = mesh_cube(1);
        double most = 0;
        for (int i = 0; i < 6; i++) {
            paint(&m->element[i], w->rho[i], w->emission[i]);
            most = fmax(most, w->b[i]);
        }
        struct solved r = solve(m, &ff, &settings, false);
        print_message("%s %s: %u steps, error %.2g, defect %.2g\n", solver, w->name,
                      r.s.steps, r.s.error, r.s.defect);
        for (int i = 0; i < 6; i++)
            assert_near(r.s.b[i][1], w->b[i],
                        (tolerance + 2e-7 / (1 - w->rho[5])) * most);
        // Factors and reflectances are floats, 1 / (1 - rho) times worse in b. S11, whatever the solver.
        assert_true(fabs(r.s.defect) < tolerance + 1e-6);
        solved_free(&r);
    }
}

static void constant_walls(void **state)
{
    (void)state;
    walls("elimination", 0);
    walls("jacobi", 1e-5);
    walls("gauss-seidel", 1e-5);
    walls("shooting", 1e-3);
    walls("cg", 1e-5);
}

static void open_squares_p8(void **state)
{
    (void)state;
    const char *const names[] = {"elimination", "gauss-seidel", "shooting", "cg",
                                 "hierarchical"};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        struct mesh *m = mesh_new();
        mesh_add(m, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 1, 1);
        mesh_add(m, vec3(0, 0, 1), vec3(0, 1, 0), vec3(1, 0, 0), 1, 1);
        paint(&m->element[0], .5, 1);
        paint(&m->element[1], .5, 0);
        struct solver_settings settings = solver_defaults;
        settings.solver = names[k];
        settings.tolerance = 1e-6;
        struct solved r = solve(m, &form_factor_defaults, &settings, false);
        assert_near(r.s.b[0][0], 1.01008315227492456, 1e-5);
        assert_near(r.s.b[1][0], 0.100919880275017571, 1e-5);
        solved_free(&r);
    }
}

// F7: few sweeps up to reflectance .99.
static void slow_convergence(void **state)
{
    (void)state;
    static const double rho[] = {.5, .9, .99};
    for (int k = 0; k < 3; k++) {
        uint32_t steps[3];
        static const char *const names[] = {"gauss-seidel", "cg", "jacobi"};
        for (int s = 0; s < 3; s++) {
            struct mesh *m = mesh_cube(4);
            for (uint32_t i = 0; i < m->e.count; i++)
                paint(&m->element[i], rho[k], i < 16 ? 1 : 0);
            struct solver_settings settings = solver_defaults;
            settings.solver = names[s];
            settings.tolerance = 1e-3;
            struct solved r = solve(m, &form_factor_defaults, &settings, true);
            // The estimate may not flatter.
            assert_true(fabs(r.s.defect) < 2e-3);
            steps[s] = r.s.steps;
            solved_free(&r);
        }
        print_message("rho %.2f: Gauss-Seidel %u, CG %u, Jacobi %u\n", rho[k], steps[0],
                      steps[1], steps[2]);
        assert_true(steps[0] <= 10);
        assert_true(steps[1] <= 12);
        assert_true(k == 0 || steps[2] > 3 * steps[0]);
    }
}

static double rms_off(const struct solved *a, const struct solved *b)
{
    double off = 0, all = 0;
    for (uint32_t i = 0; i < a->s.count; i++) {
        for (int c = 0; c < 3; c++) {
            const double d = a->s.h[i][c] - b->s.h[i][c];
            off += a->m->element[i].area * d * d;
            all += a->m->element[i].area * b->s.h[i][c] * b->s.h[i][c];
        }
    }
    return sqrt(off / all);
}

static struct mesh *coloured_cube(uint32_t n)
{
    struct mesh *m = mesh_cube(n);
    for (uint32_t i = 0; i < m->e.count; i++) {
        double x[4];
        random_point(i, 7, x);
        m->element[i].reflectance =
            rgb((float)(.9 * x[0]), (float)(.9 * x[1]), (float)(.9 * x[2]));
        if (i < n)
            m->element[i].emission = rgb(1, .5f, .25f);
    }
    return m;
}

// All of them solve one system of many colours.
static void solvers_agree(void **state)
{
    (void)state;
    struct solver_settings settings = solver_defaults;
    settings.solver = "elimination";
    struct solved truth =
        solve(coloured_cube(4), &form_factor_defaults, &settings, false);
    static const double allowed[SOLVER_COUNT] = {
        [SOLVER_elimination] = 1e-9, [SOLVER_jacobi] = 2e-4, [SOLVER_gauss_seidel] = 2e-4,
        [SOLVER_shooting] = 1e-3,    [SOLVER_cg] = 1e-4,     [SOLVER_stochastic] = .02,
        [SOLVER_hierarchical] = .01};
    for (int k = 0; k < SOLVER_COUNT; k++) {
        settings = solver_defaults;
        settings.solver = solver_name(k);
        settings.tolerance = k == SOLVER_stochastic ? .01
                             : k == SOLVER_shooting ? 1e-3
                                                    : 1e-4;
        struct mesh *m = coloured_cube(4);
        mesh_trace(m);
        if (k != SOLVER_stochastic)
            m->e.occluded = NULL;
        struct solved r = solve(m, &form_factor_defaults, &settings, false);
        const double off = rms_off(&r, &truth);
        print_message("%s: off by %.2g, says %.2g; %u steps, %llu rays, %llu links\n",
                      settings.solver, off, r.s.error, r.s.steps,
                      (unsigned long long)r.s.rays, (unsigned long long)r.s.links);
        assert_true(r.s.converged);
        assert_true(off <= allowed[k]);
        if (k == SOLVER_stochastic) {
            assert_true(off < 3 * r.s.error && off > r.s.error / 3);
            assert_true(fabs(r.s.defect) < 5e-3);
        }
        double emitted = 0, emitted_truth = 0;
        for (uint32_t i = 0; i < r.s.count; i++) {
            emitted += r.s.h_emitted[i][0];
            emitted_truth += truth.s.h_emitted[i][0];
        }
        assert_near(emitted / emitted_truth, 1, .02);
        solved_free(&r);
    }
    solved_free(&truth);
}

// The overshooting of Feda and Purgathofer takes fewer shots and ends at the same place.
static void overshooting(void **state)
{
    (void)state;
    uint32_t steps[2];
    struct solved r[2];
    for (int k = 0; k < 2; k++) {
        struct solver_settings settings = solver_defaults;
        settings.solver = "shooting";
        settings.tolerance = 1e-3;
        settings.overshoot = k == 1;
        r[k] = solve(coloured_cube(4), &form_factor_defaults, &settings, false);
        steps[k] = r[k].s.steps;
    }
    print_message("%u shots, %u with overshooting\n", steps[0], steps[1]);
    assert_true(rms_off(&r[0], &r[1]) < 2e-3);
    assert_true(steps[1] < steps[0]);
    solved_free(&r[0]);
    solved_free(&r[1]);
}

// The same bits for any number of threads.
static void deterministic(void **state)
{
    (void)state;
    static const char *const names[] = {"stochastic", "hierarchical", "jacobi"};
    for (int k = 0; k < 3; k++) {
        struct solved r[2];
        for (int t = 0; t < 2; t++) {
            struct form_factor_settings ff = form_factor_defaults;
            struct solver_settings settings = solver_defaults;
            struct mesh *m = coloured_cube(4);
            mesh_trace(m);
            settings.solver = names[k];
            settings.tolerance = .05;
            settings.threads = ff.threads = t ? 4 : 1;
            r[t] = solve(m, &ff, &settings, false);
        }
        assert_memory_equal(r[0].s.b, r[1].s.b, r[0].s.count * sizeof *r[0].s.b);
        solved_free(&r[0]);
        solved_free(&r[1]);
    }
}

// F20: the mean of many stochastic solutions is the solution.
static void stochastic_is_unbiased(void **state)
{
    (void)state;
    enum { RUNS = 64, N = 2 };
    struct solver_settings settings = solver_defaults;
    settings.solver = "elimination";
    struct mesh *cube = mesh_cube(N);
    for (uint32_t i = 0; i < cube->e.count; i++)
        paint(&cube->element[i], .5, i < N * N ? 1 : 0);
    struct solved truth = solve(cube, &form_factor_defaults, &settings, false);
    double sum = 0, square = 0, ceiling = 0;
    for (uint32_t i = N * N; i < 2 * N * N; i++)
        ceiling += truth.s.b[i][0];
    for (uint32_t k = 0; k < RUNS; k++) {
        struct mesh *m = mesh_cube(N);
        mesh_trace(m);
        for (uint32_t i = 0; i < m->e.count; i++)
            paint(&m->element[i], .5, i < N * N ? 1 : 0);
        settings.solver = "stochastic";
        settings.rays = 1000;
        settings.seed = k;
        struct solved r = solve(m, &form_factor_defaults, &settings, false);
        double b = 0;
        for (uint32_t i = N * N; i < 2 * N * N; i++)
            b += r.s.b[i][0];
        sum += b / RUNS;
        square += b * b / RUNS;
        solved_free(&r);
    }
    const double sigma = sqrt((square - sum * sum) / (RUNS - 1));
    print_message("mean %.6f, truth %.6f, sigma %.2g\n", sum, ceiling, sigma);
    assert_true(fabs(sum - ceiling) < 3 * sigma + 1e-4 * ceiling);
    solved_free(&truth);
}

// C1: the piecewise constant solution's own error, level by level.
static void continuous_cube(void **state)
{
    (void)state;
    static const struct {
        uint32_t n;
        double floor, ceiling; // per cent of the reflected part
        double walls;          // at most
    } levels[] = {{1, -12.9, 6.2, .41},
                  {2, -5.1, 1.4, .41},
                  {4, -1.64, .36, .16},
                  {8, -.50, .092, .06}};
    for (size_t k = 0; k < sizeof levels / sizeof levels[0]; k++) {
        const uint32_t n = levels[k].n;
        struct mesh *m = mesh_cube(n);
        for (uint32_t i = 0; i < m->e.count; i++)
            paint(&m->element[i], .5, i < n * n ? 1 : 0);
        struct solver_settings settings = solver_defaults;
        settings.tolerance = 1e-6;
        struct form_factor_settings ff = form_factor_defaults;
        ff.tolerance = 1e-5;
        struct solved r = solve(m, &ff, &settings, true);
        double floor = 0, ceiling = 0, wall = 0;
        for (uint32_t i = 0; i < n * n; i++) {
            floor += (r.s.b[i][0] - 1) / (n * n);
            ceiling += r.s.b[n * n + i][0] / (n * n);
        }
        for (uint32_t i = 2 * n * n; i < m->e.count; i++)
            wall += r.s.b[i][0] / (4 * n * n);
        print_message("%u: floor %.3f %%, ceiling %.3f %%, walls %.3f %%\n", n,
                      100 * (floor / .1043616 - 1), 100 * (ceiling / .1712160 - 1),
                      100 * (wall / .1811056 - 1));
        assert_near(100 * (floor / .1043616 - 1), levels[k].floor,
                    .05 + .01 * fabs(levels[k].floor));
        assert_near(100 * (ceiling / .1712160 - 1), levels[k].ceiling,
                    .02 + .02 * fabs(levels[k].ceiling));
        assert_true(fabs(100 * (wall / .1811056 - 1)) < levels[k].walls);
        solved_free(&r);
    }
}

// P9: the closed cylinder of radius 1 and height 2 as three elements with given factors.
static void cylinder_p9(void **state)
{
    (void)state;
    static const double bb = 0.171572875253809902, bs = 0.828427124746190098,
                        sb = 0.207106781186547524, ss = 0.585786437626904951;
    float matrix[9] = {0,         (float)bb, (float)bs, (float)bb, 0,
                       (float)bs, (float)sb, (float)sb, (float)ss};
    static const double truth[3] = {1.09109765070223484, 0.170106224261506598,
                                    0.184699031259064639};
    for (int k = 0; k < SOLVER_COUNT; k++) {
        if (!solver_needs_matrix(k))
            continue;
        struct mesh *m = mesh_new();
        for (int i = 0; i < 3; i++)
            mesh_add(m, vec3(0, 0, i), vec3(1, 0, 0), vec3(0, 1, 0), 1, 1);
        for (int i = 0; i < 3; i++) {
            m->element[i].area = i < 2 ? 1 : 4;
            paint(&m->element[i], .5, i == 0);
        }
        const struct factors f = {.count = 3, .f = matrix, .symmetric = true};
        const struct radiosity_system system = {
            .e = &m->e, .f = &f, .factors = &form_factor_defaults};
        struct solver_settings settings = solver_defaults;
        struct radiosity_solution out;
        settings.solver = solver_name(k);
        settings.tolerance = 1e-6;
        assert_true(radiosity_solve(&out, &system, &settings));
        for (int i = 0; i < 3; i++)
            assert_near(out.b[i][1], truth[i], 2e-6);
        solution_free(&out);
        mesh_free(m);
    }
}

// F8: with the ambient term, shot by shot the total comes close to what the energy
// identity says, and the term vanishes; no shot leaves more unshot than there was.
static void ambient_f8(void **state)
{
    (void)state;
    static const double rho = .8;
    struct form_factor_settings ff = form_factor_defaults;
    const double truth = 1 / (1 - rho); // of the emitted power, in a closed scene
    struct mesh *m = mesh_cube(4);
    struct factors f;
    for (uint32_t i = 0; i < m->e.count; i++)
        paint(&m->element[i], rho, i < 16);
    assert_true(factors_compute(&f, &m->e, &ff));
    factors_balance(&f, &m->e, NULL);
    double before = 1;
    for (int overshoot = 0; overshoot < 2; overshoot++) {
        before = 1;
        for (uint32_t shots = 1; shots <= 4096; shots *= 4) {
            struct radiosity_solution out[2];
            double total[2] = {0, 0};
            for (int ambient = 0; ambient < 2; ambient++) {
                const struct radiosity_system system = {
                    .e = &m->e, .f = &f, .factors = &ff};
                struct solver_settings settings = solver_defaults;
                settings.solver = "shooting";
                settings.tolerance = 1e-5;
                settings.steps_max = shots;
                settings.ambient = ambient;
                settings.overshoot = overshoot;
                assert_true(radiosity_solve(&out[ambient], &system, &settings));
                for (uint32_t i = 0; i < m->e.count; i++)
                    total[ambient] += out[ambient].b[i][0] * m->element[i].area;
            }
            const double term = total[1] - total[0];
            print_message("%u shots%s: total %.4f, with ambient %.4f of %.4f\n", shots,
                          overshoot ? " over" : "", total[0], total[1], truth);
            assert_near(total[1] / truth, 1, 1e-4);
            assert_true(fabs(term) <= before * truth);
            before = fabs(term) / truth + 1e-3;
            assert_true(out[1].error <= 1);
            solution_free(&out[0]);
            solution_free(&out[1]);
        }
        assert_true(before < 2e-2);
    }
    factors_free(&f);
    mesh_free(m);
}

// C1': irradiance at a point of the cube from the radiosity of all elements.
static double gathered(const struct solved *r, struct vec3 p, struct vec3 n)
{
    double h = 0;
    for (uint32_t i = 0; i < r->s.count; i++) {
        const struct element *e = &r->m->element[i];
        h += r->s.b[i][0] * lambert_polygon(p, n, e->corner, e->corner_count);
    }
    return h;
}

static void continuous_centres(void **state)
{
    (void)state;
    const uint32_t n = 8;
    struct mesh *m = mesh_cube(n);
    for (uint32_t i = 0; i < m->e.count; i++)
        paint(&m->element[i], .5, i < n * n);
    struct solver_settings settings = solver_defaults;
    settings.tolerance = 1e-6;
    struct solved r = solve(m, &form_factor_defaults, &settings, true);
    const double ceiling = gathered(&r, vec3(.5, .5, 1), vec3(0, 0, -1));
    const double floor = gathered(&r, vec3(.5, .5, 0), vec3(0, 0, 1));
    const double wall = gathered(&r, vec3(0, .5, .5), vec3(1, 0, 0));
    print_message("centres: %.6f %.6f %.6f\n", ceiling, floor, wall);
    assert_near(ceiling / .3952088, 1, 2e-3);
    assert_near(floor / .1836103, 1, 2e-3);
    assert_near(wall / .3552952, 1, 2e-3);
    solved_free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_walls),
        cmocka_unit_test(open_squares_p8),
        cmocka_unit_test(slow_convergence),
        cmocka_unit_test(solvers_agree),
        cmocka_unit_test(overshooting),
        cmocka_unit_test(deterministic),
        cmocka_unit_test(stochastic_is_unbiased),
        cmocka_unit_test(continuous_cube),
        cmocka_unit_test(cylinder_p9),
        cmocka_unit_test(ambient_f8),
        cmocka_unit_test(continuous_centres),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
