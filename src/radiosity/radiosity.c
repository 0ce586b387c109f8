#include "radiosity/radiosity.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/memory.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"

const struct radiosity_options radiosity_defaults = {
    .patches = {.count = 8000, .samples = 3, .depth = 2},
    .factors = {.method = "analytic",
                .points = 3,
                .tolerance = 1e-3,
                .depth = 4,
                .shadow_rays = 8,
                .visibility = 2.5e-4,
                .rays = 4096,
                .resolution = 128},
    .solver = {.solver = "auto",
               .tolerance = 1e-2,
               .ambient = true,
               .overshoot = true,
               .link_error = 1e-3},
    .lamp_rays = 4,
};

enum { DENSE_MOST = 100 }; // elements up to which `auto` stores the matrix
static const double gib = 1073741824.0;

static double memory_limit(const struct radiosity_options *s)
{
    if (s->memory > 0)
        return s->memory;
    const long pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
    return pages > 0 && size > 0 ? (double)pages * (double)size / 2 : 4 * gib;
}

// Whether no ray from the elements leaves the scene, of `points`; few may be lost to
// slivers that are no part of an element.
static bool is_closed(const struct patches *p, int points)
{
    enum { BATCH = 1024, SEED = 99 };
    const struct enclosure *e = &p->enclosure;
    void *state = e->thread_begin(e->user);
    struct ray_batch *rays = ray_batch_new(BATCH);
    uint32_t *met = must_calloc(BATCH, sizeof *met), escaped = 0;
    const uint32_t n = e->count, few = (uint32_t)points / 1000;
    for (uint32_t k = 0; k < (uint32_t)points && escaped <= few;) {
        for (rays->count = 0; rays->count < BATCH && k < (uint32_t)points; k++) {
            struct element_point from;
            double x[4];
            random_point(k, SEED, x);
            // Knuth's multiplicative hash: elements in no order of theirs.
            if (e->point(state, (uint32_t)((uint64_t)k * 2654435761u % n), x[0], x[1],
                         &from))
                ray_put(rays, &from, cosine_direction(from.normal, x[2], x[3]), INFINITY);
        }
        e->closest(state, rays, met);
        for (uint32_t i = 0; i < rays->count; i++)
            escaped += met[i] == ELEMENT_NONE;
    }
    free(met);
    ray_batch_free(rays);
    e->thread_end(state);
    return escaped <= few;
}

static const char *solver_for(const struct radiosity_options *s, uint32_t n)
{
    if (strcmp(s->solver.solver, "auto") != 0)
        return s->solver.solver;
    // A number of rays means the solver that sends them.
    const bool dense = !s->solver.rays && n <= DENSE_MOST;
    return dense && factors_bytes(n) <= memory_limit(s) ? "gauss-seidel" : "stochastic";
}

// Bytes a solver takes besides the elements.
static double bytes_needed(const char *solver, uint32_t n)
{
    const enum solver_kind k = solver_find(solver);
    double bytes = (double)STOCHASTIC_BYTES * n;
    if (solver_needs_matrix(k))
        bytes += factors_bytes(n);
    if (k == SOLVER_elimination)
        bytes += (double)n * n * sizeof(double);
    return bytes;
}

// Whether the solver finds room; an error says how much is missing.
static bool has_memory(const struct radiosity *r, const char *solver, double need,
                       char *error, size_t error_size)
{
    const uint32_t n = r->patches->enclosure.count;
    const double limit = memory_limit(&r->settings);
    if (need > limit)
        snprintf(error, error_size,
                 "solver '%s' needs %.1f GiB for %u patches, %.1f GiB may be taken; "
                 "'stochastic' needs %.1f GiB",
                 solver, need / gib, n, limit / gib, bytes_needed("stochastic", n) / gib);
    return need <= limit;
}

// The matrix of form factors, for solvers that want one.
static bool level_factors(struct radiosity *r, bool closed, struct factors *f,
                          char *error, size_t error_size)
{
    const struct enclosure *e = &r->patches->enclosure;
    struct radiosity_report *report = &r->report;
    if (!factors_compute(f, e, &r->settings.factors)) {
        snprintf(error, error_size, "no memory for %.1f GiB of form factors",
                 factors_bytes(e->count) / gib);
        return false;
    }
    report->row_sum_least = f->row_sum_least;
    report->row_sum_most = f->row_sum_most;
    report->asymmetry = f->asymmetry;
    if (closed)
        factors_balance(f, e, r->settings.watch);
    else if (!f->symmetric)
        factors_symmetrize(f, e);
    report->balanced = f->balanced;
    return true;
}

static void report_solution(struct radiosity_report *report,
                            const struct radiosity_solution *s)
{
    report->rays += s->rays;
    report->links = s->links;
    report->steps = s->steps;
    report->defect = s->defect;
    report->error = s->error;
    report->converged = s->converged;
}

bool radiosity_level(struct radiosity *r, char *error, size_t error_size)
{
    enum { CLOSURE_POINTS = 4096 };
    const struct enclosure *e = &r->patches->enclosure;
    struct solver_settings solver = r->settings.solver;
    struct radiosity_report *report = &r->report;
    struct factors f = {0};
    struct radiosity_system system = {
        .e = e, .lamps = (const double(*)[3])r->lamps, .factors = &r->settings.factors};
    solver.solver = solver_for(&r->settings, e->count);
    report->bytes = bytes_needed(solver.solver, e->count);
    struct watch *const watch = r->settings.watch;
    if (!has_memory(r, solver.solver, report->bytes, error, error_size) ||
        watch_cancelled(watch))
        return false;
    report->solver = solver.solver;
    report->method = r->settings.factors.method;
    report->closed =
        r->settings.closure != CLOSURE_REPORT && is_closed(r->patches, CLOSURE_POINTS);
    system.closed = r->settings.closure == CLOSURE_ENFORCE ||
                    (r->settings.closure == CLOSURE_AUTO && report->closed);
    if (solver_needs_matrix(solver_find(solver.solver))) {
        // Shares of the time as they are where factors are stored; a solver without a
        // matrix takes all of it.
        const double from = watch ? watch->from : 0, to = watch ? watch->to : 1;
        watch_part(watch, from, from + .9 * (to - from));
        if (!level_factors(r, system.closed, &f, error, error_size))
            return false;
        system.f = &f;
        watch_part(watch, from + .9 * (to - from), to);
    }
    const bool ok = radiosity_solve(&r->solution, &system, &solver);
    report->rays += f.rays;
    report_solution(report, &r->solution);
    factors_free(&f);
    watch_tell(watch, 1);
    if (!ok)
        snprintf(error, error_size, "no memory for %u patches", e->count);
    return ok && !watch_cancelled(watch);
}

// Slivers where surfaces cut each other meet few rays: they are shown as the mean of
// themselves and the neighbours they see, by area.
static void find_shown(struct radiosity *r)
{
    static const double small = .5; // of a whole cell
    const struct patches *p = r->patches;
    const uint32_t n = p->element_count;
    double(*h)[3] = must_calloc(n, sizeof *h);
    r->shown = must_calloc(n, sizeof *r->shown);
    for (uint32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            h[i][c] = r->solution.h[i][c] -
                      (r->emitter_count ? r->solution.h_emitted[i][c] : 0);
    for (uint32_t i = 0; i < n; i++) {
        double area = p->element[i].area, sum[3];
        for (int c = 0; c < 3; c++)
            sum[c] = area * h[i][c];
        for (int k = 0; k < 8 && (double)p->element[i].coverage < small; k++) {
            const uint32_t j = patch_neighbour(p, i, k);
            if (j == ELEMENT_NONE)
                continue;
            area += p->element[j].area;
            for (int c = 0; c < 3; c++)
                sum[c] += p->element[j].area * h[j][c];
        }
        for (int c = 0; c < 3; c++)
            r->shown[i][c] = sum[c] > 0 ? sum[c] / area : 0;
    }
    free(h);
}

void radiosity_level_free(struct radiosity *r)
{
    solution_free(&r->solution);
    free(r->lamps);
    r->lamps = NULL;
    patches_free(r->patches);
    r->patches = NULL;
}

static bool single_level(struct radiosity *r, const struct job *job, const char *saved,
                         char *error, size_t error_size)
{
    watch_part(r->settings.watch, 0, .1);
    r->patches = patches_build(job, &r->settings.patches);
    if (!r->patches || !r->patches->element_count) {
        snprintf(error, error_size, "no surface of the scene can be cut into patches");
        return false;
    }
    r->lamps = must_calloc(r->patches->element_count, sizeof *r->lamps);
    watch_part(r->settings.watch, .1, .15);
    lamps_gather(r->patches, r->settings.lamp_rays, r->settings.solver.threads, r->lamps);
    r->key = radiosity_key(r);
    if (saved) {
        r->report.loaded = radiosity_load(r, saved, error, error_size);
        return r->report.loaded;
    }
    watch_part(r->settings.watch, .15, 1);
    return radiosity_level(r, error, error_size);
}

struct radiosity *radiosity_new(const struct job *job,
                                const struct radiosity_options *settings,
                                const char *saved, char *error, size_t error_size)
{
    struct radiosity *r = must_calloc(1, sizeof *r);
    const double start = clock_seconds(CLOCK_MONOTONIC);
    r->settings = *settings;
    r->settings.patches.watch = r->settings.factors.watch = r->settings.solver.watch =
        settings->watch;
    r->report.error = -1;
    job = clear_left_out(job, &r->clear);
    const bool ok = settings->error > 0 && !saved
                        ? radiosity_to_error(r, job, error, error_size)
                        : single_level(r, job, saved, error, error_size);
    if (!ok || watch_cancelled(settings->watch)) {
        radiosity_free(r);
        return NULL;
    }
    if (!r->report.levels)
        r->report.levels = 1;
    r->report.elements = r->patches->element_count;
    r->report.seconds = clock_seconds(CLOCK_MONOTONIC) - start;
    emitters_find(r);
    find_shown(r);
    volume_find(r);
    return r;
}

void radiosity_free(struct radiosity *r)
{
    if (!r)
        return;
    radiosity_level_free(r);
    clear_world_free(r->clear);
    volume_free(r->volume);
    free(r->emitter);
    free(r->between);
    free(r->edges.a[0]);
    free(r->shown);
    free(r);
}
