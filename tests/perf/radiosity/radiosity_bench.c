// One solution of a scene whose truth is known, as a line of a table: scene, method,
// solver, patches, error of the reflected light (relative rms over surfaces or patches),
// user CPU and wall seconds, rays, bytes, steps, the solver's own estimate.
#define _DEFAULT_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

#include "api/context.h"
#include "base/arena.h"
#include "radiosity/radiosity.h"

struct sum {
    double area, h[3];
};

// ---- truths ----------------------------------------------------------------------------
// Irradiance by surface of the Cornell box for a light of radiosity 1 (particle tracing,
// 1e8 particles), in the order of the scene: light, floor, ceiling, back, right, left,
// short top and sides, tall top and sides.
static const double cornell[16][3] = {
    {0.011394, 0.010454, 0.009008},    {0.0090689, 0.0088400, 0.0078402},
    {0.0083087, 0.0073108, 0.0059764}, {0.0137741, 0.0132337, 0.0117231},
    {0.0148453, 0.0143999, 0.0133418}, {0.0132363, 0.0121969, 0.0113562},
    {0.025696, 0.026194, 0.024555},    {0.0013115, 0.0038147, 0.0014248},
    {0.0079103, 0.0101912, 0.0076353}, {0.0088587, 0.0065057, 0.0062168},
    {0.0011324, 0.0007172, 0.0006599}, {0.059159, 0.056632, 0.055742},
    {0.0064886, 0.0059277, 0.0053309}, {0.0073973, 0.0100371, 0.0071589},
    {0.0082001, 0.0058322, 0.0052822}, {0.0071249, 0.0008553, 0.0008086}};

static uint32_t leaf_of(const struct patches *p, uint32_t i)
{
    return p->chart[p->cell[p->element_cell[i] / 2].chart].leaf;
}

// The blocks are hollow in the scene; their inner sides are dark and none of the table's.
static bool is_within_block(const struct element *e, uint32_t k)
{
    static const struct vec3 middle[2] = {{185.5, 82.5, 168.5}, {368.5, 165, 351.25}};
    return k >= 6 && vec3_dot(e->normal, vec3_sub(e->centre, middle[k >= 11])) < 0;
}

// Relative rms of surface means, weighted by area and reflectance.
static double cornell_error(const struct radiosity *r, bool print)
{
    struct sum s[16] = {0};
    double rho[16][3] = {{0}}, off = 0, all = 0, light = 0;
    const struct patches *p = r->patches;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        const uint32_t k = p->job->world->leaf[leaf_of(p, i)].object;
        // The lid's upper side is none of the table's.
        if (k >= 16 || (k == 0 && e->normal.y > 0) || is_within_block(e, k))
            continue;
        s[k].area += e->area;
        element_reflectance(e, rho[k]);
        for (int c = 0; c < 3; c++)
            s[k].h[c] += e->area * r->solution.h[i][c];
        light = fmax(light, (double)e->emission.r);
    }
    for (int k = 0; k < 16; k++) {
        for (int c = 0; c < 3; c++) {
            const double h = s[k].h[c] / s[k].area / light, d = h - cornell[k][c];
            off += s[k].area * rho[k][c] * rho[k][c] * d * d;
            all += s[k].area * rho[k][c] * rho[k][c] * cornell[k][c] * cornell[k][c];
        }
        if (print)
            fprintf(stderr, "%2d: area %.1f, %+.2f %% %+.2f %% %+.2f %%\n", k, s[k].area,
                    100 * (s[k].h[0] / s[k].area / light / cornell[k][0] - 1),
                    100 * (s[k].h[1] / s[k].area / light / cornell[k][1] - 1),
                    100 * (s[k].h[2] / s[k].area / light / cornell[k][2] - 1));
    }
    return sqrt(off / all);
}

// The cube of reflectance .5 with a floor of 1: means of floor, ceiling and walls.
static double cube_error(const struct radiosity *r)
{
    static const double truth[3] = {.2087232, .3424320, .3622112}; // H for a floor of 1
    struct sum s[3] = {0};
    double off = 0, all = 0;
    const struct patches *p = r->patches;
    double light = 0;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        const int k = e->normal.z > .5 ? 0 : e->normal.z < -.5 ? 1 : 2;
        s[k].area += e->area;
        s[k].h[0] += e->area * r->solution.h[i][0];
        light = fmax(light, (double)e->emission.r);
    }
    for (int k = 0; k < 3; k++) {
        const double d = s[k].h[0] / s[k].area / light - truth[k];
        off += (k == 2 ? 4 : 1) * d * d;
        all += (k == 2 ? 4 : 1) * truth[k] * truth[k];
    }
    return sqrt(off / all);
}

// Exact for every patch: the dome of S6 has H = (2.0408 - 1) / .6, the disc .8163 / .4.
static double cap_error(const struct radiosity *r)
{
    double off = 0, all = 0;
    const struct patches *p = r->patches;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        const double b = e->curved ? 1.04081632653061224 : 0.816326530612244898;
        const double d = (e->curved ? .6 : .4) * r->solution.h[i][0] - b;
        off += e->area * d * d;
        all += e->area * b * b;
    }
    return sqrt(off / all);
}

// C4: means of both discs.
static double discs_error(const struct radiosity *r)
{
    struct sum s[2] = {0};
    const struct patches *p = r->patches;
    for (uint32_t i = 0; i < p->element_count; i++) {
        const struct element *e = &p->element[i];
        const int k = e->normal.z < 0;
        s[k].area += e->area;
        s[k].h[0] += e->area * .8 * r->solution.h[i][0];
    }
    const double a = s[0].h[0] / s[0].area - .1067181835151;
    const double b = s[1].h[0] / s[1].area - .33924340803155;
    return sqrt((a * a + b * b) /
                (.1067181835151 * .1067181835151 + .33924340803155 * .33924340803155));
}

static double user_seconds(void)
{
    struct rusage u;
    getrusage(RUSAGE_SELF, &u);
    return (double)u.ru_utime.tv_sec + 1e-6 * (double)u.ru_utime.tv_usec;
}

int main(int argc, char **argv)
{
    if (argc < 6) {
        fprintf(stderr,
                "usage: radiosity_bench SCENE.pov METHOD SOLVER PATCHES TOLERANCE "
                "[RAYS] [ERROR]\n");
        return 64;
    }
    struct lambert_context *ctx = lambert_context_new();
    if (lambert_load_file(ctx, argv[1]) != LAMBERT_OK) {
        fprintf(stderr, "%s\n", lambert_error(ctx));
        return 1;
    }
    struct arena *a = arena_new(4096);
    struct job job;
    job_init(&job, a, ctx->world, &render_settings_default);
    struct radiosity_options o = radiosity_defaults;
    o.factors.method = argv[2];
    o.solver.solver = argv[3];
    o.patches.count = atof(argv[4]);
    o.solver.tolerance = atof(argv[5]);
    o.solver.rays = argc > 6 ? (uint64_t)atof(argv[6]) : 0;
    o.error = argc > 7 ? atof(argv[7]) : 0;
    const char *resolution = getenv("RESOLUTION"), *threads = getenv("THREADS");
    if (resolution)
        o.factors.resolution = atoi(resolution);
    if (getenv("FACTOR_RAYS"))
        o.factors.rays = atoi(getenv("FACTOR_RAYS"));
    o.patches.threads = o.factors.threads = o.solver.threads =
        threads ? atoi(threads) : 1;
    o.memory = 4e9;
    char error[512];
    const double start = user_seconds();
    struct radiosity *r = radiosity_new(&job, &o, NULL, error, sizeof error);
    if (!r) {
        fprintf(stderr, "%s\n", error);
        return 1;
    }
    const double user = user_seconds() - start;
    const char *slash = strrchr(argv[1], '/'), *name = slash ? slash + 1 : argv[1];
    const double off = strncmp(name, "cornell", 7) == 0
                           ? cornell_error(r, getenv("PRINT"))
                       : strncmp(name, "cap", 3) == 0   ? cap_error(r)
                       : strncmp(name, "discs", 5) == 0 ? discs_error(r)
                                                        : cube_error(r);
    printf("%.*s\t%s%s\t%s\t%u\t%.5g\t%.4g\t%.4g\t%.4g\t%.4g\t%u\t%.3g\n",
           (int)strcspn(name, "."), name, argv[2], resolution ? resolution : "",
           r->report.solver, r->report.elements, off, user, r->report.seconds,
           (double)r->report.rays, r->report.bytes, r->report.steps, r->report.error);
    radiosity_free(r);
    arena_free(a);
    lambert_context_free(ctx);
    return 0;
}
