// An error target: patches, factors and iterations are refined together.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "radiosity/radiosity.h"

enum { LEVELS_MOST = 12, FIRST_ELEMENTS = 150 };

// ---- the estimate ------------------------------------------------------------------
// What elements reflect; areas beside.
struct reflected {
    uint32_t count;
    double (*of)[3];
    double *area;
};

static struct reflected light_of(const struct radiosity *r)
{
    const uint32_t n = r->patches->element_count;
    struct reflected l = {n, solver_alloc(n, sizeof *l.of),
                          solver_alloc(n, sizeof *l.area)};
    for (uint32_t i = 0; i < n; i++) {
        double rho[3];
        element_reflectance(&r->patches->element[i], rho);
        l.area[i] = r->patches->element[i].area;
        for (int c = 0; c < 3; c++)
            l.of[i][c] = rho[c] * (r->solution.h[i][c] + r->lamps[i][c]);
    }
    return l;
}

static void light_free(struct reflected *l)
{
    free(l->of);
    free(l->area);
    *l = (struct reflected){0};
}

// Relative rms difference of the means over the coarse elements: what a coarse element
// does wrong as a whole. Within an element light varies, which the picture interpolates.
static double difference(const struct reflected *fine, const uint32_t *origin,
                         const struct reflected *coarse)
{
    double off = 0, all = 0;
    double(*mean)[3] = solver_alloc(coarse->count, sizeof *mean);
    double *area = solver_alloc(coarse->count, sizeof *area);
    for (uint32_t i = 0; i < fine->count; i++) {
        area[origin[i]] += fine->area[i];
        for (int c = 0; c < 3; c++)
            mean[origin[i]][c] += fine->area[i] * fine->of[i][c];
    }
    for (uint32_t e = 0; e < coarse->count; e++) {
        for (int c = 0; c < 3 && area[e] > 0; c++) {
            const double b = mean[e][c] / area[e], d = b - coarse->of[e][c];
            off += area[e] * d * d;
            all += area[e] * b * b;
        }
    }
    free(mean);
    free(area);
    return all > 0 ? sqrt(off / all) : 0;
}

// ---- what is refined ---------------------------------------------------------------
struct change {
    double value;
    uint32_t element;
};

static int by_value(const void *a, const void *b)
{
    const struct change *x = a, *y = b;
    if (x->value != y->value)
        return x->value > y->value ? -1 : 1;
    return x->element < y->element ? -1 : 1;
}

// Elements with the greatest steps to their neighbours, times the area, up to a share of
// all such steps.
static bool *choose(const struct radiosity *r, const struct reflected *l)
{
    static const double share = .9;
    const uint32_t n = l->count;
    struct change *change = solver_alloc(n, sizeof *change);
    bool *split = solver_alloc(n, sizeof *split);
    double all = 0, sum = 0;
    for (uint32_t i = 0; i < n; i++) {
        double step = 0;
        for (int k = 0; k < 8; k++) {
            const uint32_t j = patch_neighbour(r->patches, i, k);
            for (int c = 0; c < 3 && j != ELEMENT_NONE; c++)
                step = fmax(step, fabs(l->of[i][c] - l->of[j][c]));
        }
        change[i] = (struct change){l->area[i] * step * step, i};
        all += change[i].value;
    }
    qsort(change, n, sizeof *change, by_value);
    // A quarter in any case: what does not change is no estimate.
    for (uint32_t k = 0; k < n && (sum < share * all || 4 * k < n); k++) {
        split[change[k].element] = true;
        sum += change[k].value;
    }
    free(change);
    return split;
}

// ---- levels ------------------------------------------------------------------------
static bool level_solve(struct radiosity *r, uint32_t level, char *error,
                        size_t error_size)
{
    // How many levels there will be is not known: each is half of what is left.
    const double begin = 1 - exp2(-(double)level), end = 1 - exp2(-(double)level - 1);
    r->lamps = solver_alloc(r->patches->element_count, sizeof *r->lamps);
    watch_part(r->settings.watch, begin + .1 * (end - begin), end);
    lamps_gather(r->patches, r->settings.lamp_rays, r->settings.solver.threads, r->lamps);
    r->report.levels = level + 1;
    return radiosity_level(r, error, error_size);
}

// From the step between two levels, continued: what is left after the last one falls as
// the steps do, within bounds.
static double error_left(double step, double before)
{
    static const double fast = .3, slow = .6;
    double q = .5;
    if (before > 0)
        q = fmin(fmax(step / before, fast), slow);
    return step * q / (1 - q);
}

static void refine(struct radiosity *r, struct reflected *light, uint32_t **origin)
{
    bool *split = choose(r, light);
    solution_free(&r->solution);
    free(r->lamps);
    r->lamps = NULL;
    *origin = patches_refine(r->patches, split);
    free(split);
}

bool radiosity_to_error(struct radiosity *r, const struct job *job, char *error,
                        size_t error_size)
{
    static const double visibility = 2.5e-2; // error of a factor, of the target
    const double target = r->settings.error;
    struct reflected last = {0};
    uint32_t *origin = NULL;
    double before = 0;
    bool ok = true;
    r->settings.patches.size = 0;
    r->settings.patches.count = FIRST_ELEMENTS;
    r->settings.solver.tolerance = target / 4;
    r->settings.factors.visibility =
        fmin(r->settings.factors.visibility, visibility * target);
    watch_part(r->settings.watch, 0, .05);
    r->patches = patches_build(job, &r->settings.patches);
    if (!r->patches || !r->patches->element_count) {
        snprintf(error, error_size, "no surface of the scene can be cut into patches");
        return false;
    }
    r->report.error = 1;
    r->report.converged = false;
    for (uint32_t level = 0; ok && level < LEVELS_MOST; level++) {
        if (level)
            refine(r, &last, &origin);
        ok = level_solve(r, level, error, error_size);
        struct reflected light = ok ? light_of(r) : (struct reflected){0};
        if (ok && level) {
            const double step = difference(&light, origin, &last);
            const double mesh = error_left(step, before);
            const double rest = fmax(r->solution.error, 0);
            r->report.error = sqrt(mesh * mesh + rest * rest);
            before = step;
        } else {
            r->report.error = 1;
        }
        r->report.converged = ok && r->report.error <= target;
        light_free(&last);
        last = light;
        free(origin);
        origin = NULL;
        if (r->report.converged)
            break;
    }
    light_free(&last);
    if (ok)
        r->key = radiosity_key(r);
    return ok;
}
