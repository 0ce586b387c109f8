// Solves a scene whose truth is known and writes a line of a table: scene, method,
// solver, settings, patches, error, user CPU seconds, rays, bytes, steps, estimate.
//
//   radiosity_bench SCENE.pov TRUTH.tsv [key=value ...]
//
// The truth is a table of bins by radiosity_truth; without one ("furnace") every patch
// receives 1. The error is that of the reflected light: the square root of the sum of
// area x (reflectance x error of the irradiance)^2 over that of area x (reflectance x
// irradiance)^2. Of several runs, each with a seed of its own, the median time and the
// root mean square of the errors are given; a run is not repeated after three seconds.
#define _DEFAULT_SOURCE
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "api/context.h"
#include "base/arena.h"
#include "radiosity/radiosity.h"
#include "truth.h"

enum { RUNS_MOST = 32 };

static double user_seconds(void)
{
    struct rusage u;
    getrusage(RUSAGE_SELF, &u);
    return (double)u.ru_utime.tv_sec + 1e-6 * (double)u.ru_utime.tv_usec;
}

// How far a long run is, and when.
static void tell(void *user, double share)
{
    (void)user;
    fprintf(stderr, "%.1f s: %.3g\n", user_seconds(), share);
}

// ---- the run -----------------------------------------------------------------------------
struct bench {
    struct radiosity_options o;
    int runs;
    bool interpolate, print, progress;
    char settings[256]; // as given, but for those with a column of their own
};

static void set(struct bench *b, char *text)
{
    char *value = strchr(text, '=');
    if (!value) {
        fprintf(stderr, "not understood: %s\n", text);
        exit(64);
    }
    *value++ = 0;
    const double number = atof(value);
    struct radiosity_options *o = &b->o;
    if (strcmp(text, "method") == 0)
        o->factors.method = value;
    else if (strcmp(text, "solver") == 0)
        o->solver.solver = value;
    else if (strcmp(text, "patches") == 0)
        o->patches.count = number;
    else if (strcmp(text, "tolerance") == 0)
        o->solver.tolerance = number;
    else if (strcmp(text, "error") == 0)
        o->error = number;
    else if (strcmp(text, "rays") == 0)
        o->solver.rays = (uint64_t)number;
    else if (strcmp(text, "factor-rays") == 0)
        o->factors.rays = (int)number;
    else if (strcmp(text, "shadow-rays") == 0)
        o->factors.shadow_rays = (int)number;
    else if (strcmp(text, "resolution") == 0)
        o->factors.resolution = (int)number;
    else if (strcmp(text, "threads") == 0)
        o->patches.threads = o->factors.threads = o->solver.threads = (int)number;
    else if (strcmp(text, "runs") == 0)
        b->runs = number < RUNS_MOST ? (int)number : RUNS_MOST;
    else if (strcmp(text, "interpolate") == 0)
        b->interpolate = number > 0;
    else if (strcmp(text, "print") == 0)
        b->print = number > 0;
    else if (strcmp(text, "progress") == 0)
        b->progress = number > 0;
    else {
        fprintf(stderr, "no such setting: %s\n", text);
        exit(64);
    }
    static const char *const own[] = {"method", "solver", "patches", "threads",
                                      "runs",   "print",  "progress"};
    for (size_t k = 0; k < sizeof own / sizeof own[0]; k++)
        if (strcmp(text, own[k]) == 0)
            return;
    const size_t end = strlen(b->settings);
    snprintf(b->settings + end, sizeof b->settings - end, "%s%s=%s", end ? "," : "", text,
             value);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void run(const struct bench *b, const struct job *job, const char *name)
{
    // Long ones are not run again.
    static const double enough = 3;
    double user[RUNS_MOST], square = 0, estimate = 0, spent = 0;
    int runs = 0;
    struct radiosity_report report = {0};
    const char *method = b->o.factors.method;
    for (int k = 0; k < b->runs && spent < enough; k++) {
        char error[512];
        struct radiosity_options o = b->o;
        struct watch watch = {.progress = tell, .to = 1};
        o.solver.seed = o.factors.seed = (uint32_t)k;
        if (b->progress)
            o.watch = &watch;
        const double start = user_seconds();
        struct radiosity *r = radiosity_new(job, &o, NULL, error, sizeof error);
        if (!r) {
            fprintf(stderr, "%s\n", error);
            exit(1);
        }
        user[k] = user_seconds() - start;
        const double off =
            bins ? truth_error(r, b->interpolate, b->print) : furnace_error(r, b->print);
        square += off * off;
        estimate += r->report.error;
        spent += user[k];
        runs++;
        report = r->report;
        radiosity_free(r);
    }
    qsort(user, (size_t)runs, sizeof user[0], by_value);
    printf("%s\t%s\t%s\t%s\t%u\t%.4g\t%.4g\t%.4g\t%.4g\t%u\t%.3g\t%d\n", name, method,
           report.solver, b->settings[0] ? b->settings : "-", report.elements,
           sqrt(square / runs), user[runs / 2], (double)report.rays, report.bytes,
           report.steps, estimate / runs, runs);
}

int main(int argc, char **argv)
{
    struct bench b = {.o = radiosity_defaults, .runs = 1};
    struct arena *a = arena_new(4096);
    struct job job;
    if (argc < 3) {
        fprintf(stderr,
                "usage: radiosity_bench SCENE.pov TRUTH.tsv|furnace [key=value ...]\n");
        return 64;
    }
    struct lambert_context *ctx = lambert_context_new();
    if (lambert_load_file(ctx, argv[1]) != LAMBERT_OK) {
        fprintf(stderr, "%s\n", lambert_error(ctx));
        return 1;
    }
    if (strcmp(argv[2], "furnace") != 0)
        truth_read(argv[2]);
    b.o.patches.threads = b.o.factors.threads = b.o.solver.threads = 1;
    b.o.memory = 4e9;
    for (int i = 3; i < argc; i++)
        set(&b, argv[i]);
    job_init(&job, a, ctx->world, &render_settings_default);
    const char *slash = strrchr(argv[1], '/'), *name = slash ? slash + 1 : argv[1];
    char scene[64];
    snprintf(scene, sizeof scene, "%.*s", (int)strcspn(name, "."), name);
    run(&b, &job, scene);
    arena_free(a);
    lambert_context_free(ctx);
    return 0;
}
