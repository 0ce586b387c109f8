// An error target: patches, factors and iterations are refined together.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "radiosity/radiosity.h"

enum { LEVELS_MOST = 12, FIRST_ELEMENTS = 150 };

// ---- what is refined ---------------------------------------------------------------
// What elements reflect; areas beside.
struct reflected {
    uint32_t count;
    double (*of)[3];
    double *area;
};

static struct reflected light_of(const struct radiosity *r)
{
    const uint32_t n = r->patches->element_count;
    struct reflected l = {n, must_calloc(n, sizeof *l.of),
                          must_calloc(n, sizeof *l.area)};
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

// Elements with the greatest steps to their neighbours, times the area, or found to be off
// by more, up to a share of all of that.
static bool *choose(const struct radiosity *r, const struct reflected *l,
                    const double *off)
{
    static const double share = .9;
    const uint32_t n = l->count;
    struct change *change = must_calloc(n, sizeof *change);
    bool *split = must_calloc(n, sizeof *split);
    double all = 0, sum = 0;
    for (uint32_t i = 0; i < n; i++) {
        double step = 0;
        for (int k = 0; k < 8; k++) {
            const uint32_t j = patch_neighbour(r->patches, i, k);
            for (int c = 0; c < 3 && j != ELEMENT_NONE; c++)
                step = fmax(step, fabs(l->of[i][c] - l->of[j][c]));
        }
        change[i] = (struct change){fmax(l->area[i] * step * step, off[i]), i};
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
    r->lamps = must_calloc(r->patches->element_count, sizeof *r->lamps);
    watch_part(r->settings.watch, begin + .1 * (end - begin), end);
    lamps_gather(r->patches, r->settings.lamp_rays, r->settings.solver.threads, r->lamps);
    r->report.levels = level + 1;
    return radiosity_level(r, error, error_size);
}

static void refine(struct radiosity *r, const double *off)
{
    struct reflected light = light_of(r);
    bool *split = choose(r, &light, off);
    light_free(&light);
    solution_free(&r->solution);
    free(r->lamps);
    r->lamps = NULL;
    free(patches_refine(r->patches, split));
    free(split);
}

static bool build(struct radiosity *r, const struct job *job, char *error,
                  size_t error_size)
{
    r->patches = patches_build(job, &r->settings.patches);
    if (r->patches && r->patches->element_count)
        return true;
    snprintf(error, error_size, "no surface of the scene can be cut into patches");
    return false;
}

// Anew, with as many alike cells as the target may take by what few of them were off by:
// squarer than what quarters of large ones are, and with no small cells beside large ones,
// between which light is interpolated worse.
static bool rebuild(struct radiosity *r, const struct job *job, char *error,
                    size_t error_size)
{
    static const double order = 1.1; // patches are as the error to minus this
    static const double most = 32;   // times as many
    const double more = pow(r->report.error / r->settings.error, order);
    r->settings.patches.count = r->patches->element_count * fmin(fmax(more, 2), most);
    radiosity_level_free(r);
    return build(r, job, error, error_size);
}

bool radiosity_to_error(struct radiosity *r, const struct job *job, char *error,
                        size_t error_size)
{
    static const double visibility = 2.5e-2; // error of a factor, of the target
    const double target = r->settings.error;
    double *off = NULL;
    bool ok = true;
    r->settings.patches.size = 0;
    r->settings.patches.count = FIRST_ELEMENTS;
    r->settings.solver.tolerance = target / 4;
    r->settings.factors.visibility =
        fmin(r->settings.factors.visibility, visibility * target);
    watch_part(r->settings.watch, 0, .05);
    if (!build(r, job, error, error_size))
        return false;
    r->report.error = 1;
    r->report.converged = false;
    for (uint32_t level = 0; ok && level < LEVELS_MOST; level++) {
        if (level == 1)
            ok = rebuild(r, job, error, error_size);
        else if (level)
            refine(r, off);
        free(off);
        off = NULL;
        if (!ok)
            break;
        ok = level_solve(r, level, error, error_size);
        off = must_calloc(r->patches->element_count, sizeof *off);
        r->report.error = ok ? fmax(radiosity_probe(r, off), r->solution.error) : 1;
        r->report.converged = ok && r->report.error <= target;
        if (r->report.converged)
            break;
    }
    free(off);
    if (ok)
        r->key = radiosity_key(r);
    return ok;
}
