// Progressive refinement (Cohen et al. 1988): the element with the most unshot power
// shoots to all others. A row of form factors is enough for a shot, so no matrix is
// needed.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "radiosity/solver.h"

struct shooting {
    const struct radiosity_system *s;
    const struct solver_settings *settings;
    struct radiosity_solution *out;
    struct factor_state *factors; // rows are computed where there is no matrix
    float *row;
    bool *has_shot;
    double (*unshot)[3], (*source)[3];
    double rho[3]; // mean reflectance
    double area;   // of all elements
};

static double channels(const double x[3]) { return x[0] + x[1] + x[2]; }

static double unshot_power(const struct shooting *w)
{
    double sum = 0;
    for (uint32_t i = 0; i < w->s->e->count; i++)
        sum += w->s->e->element[i].area *
               (fabs(w->unshot[i][0]) + fabs(w->unshot[i][1]) + fabs(w->unshot[i][2]));
    return sum;
}

static uint32_t brightest(const struct shooting *w)
{
    uint32_t best = 0;
    double most = -1;
    for (uint32_t i = 0; i < w->s->e->count; i++) {
        const double p = w->s->e->element[i].area * fabs(channels(w->unshot[i]));
        if (p > most) {
            most = p;
            best = i;
        }
    }
    return best;
}

// Light that is still on its way, as if it were the same everywhere: unshot power,
// reflected without end by the mean reflectance.
static void ambient_of(const struct shooting *w, double ambient[3])
{
    ambient[0] = ambient[1] = ambient[2] = 0;
    for (uint32_t i = 0; i < w->s->e->count; i++)
        for (int c = 0; c < 3; c++)
            ambient[c] += w->s->e->element[i].area * w->unshot[i][c];
    for (int c = 0; c < 3; c++)
        ambient[c] /= w->area * (1 - w->rho[c]);
}

static const float *row_of(struct shooting *w, uint32_t i)
{
    const uint32_t n = w->s->e->count;
    if (w->s->f)
        return w->s->f->f + (size_t)i * n;
    factor_row(w->factors, i, w->row);
    return w->row;
}

static void shoot(struct shooting *w, uint32_t i, const float *row, const double b[3])
{
    const struct element *e = w->s->e->element;
    double own[3] = {0, 0, 0};
    if (!w->has_shot[i])
        element_emission(&e[i], own);
    w->has_shot[i] = true;
    for (uint32_t j = 0; j < w->s->e->count; j++) {
        if (row[j] == 0)
            continue;
        // What arrives of a row of i, by reciprocity.
        const double f = (double)row[j] * e[i].area / e[j].area;
        double rho[3];
        element_reflectance(&e[j], rho);
        for (int c = 0; c < 3; c++) {
            w->out->h_emitted[j][c] += f * own[c];
            w->unshot[j][c] += rho[c] * f * b[c];
            w->out->b[j][c] += rho[c] * f * b[c];
        }
    }
    for (int c = 0; c < 3; c++)
        w->unshot[i][c] -= b[c];
}

// Shoots, with more than is unshot where that is sure to come back (Feda, Purgathofer
// 1992); what leaves more unshot than there was is taken back.
static void step(struct shooting *w)
{
    const uint32_t i = brightest(w);
    const float *row = row_of(w, i);
    double b[3], more[3], ambient[3], rho[3];
    memcpy(b, w->unshot[i], sizeof b);
    if (!w->settings->overshoot) {
        shoot(w, i, row, b);
        return;
    }
    ambient_of(w, ambient);
    element_reflectance(&w->s->e->element[i], rho);
    for (int c = 0; c < 3; c++)
        more[c] = rho[c] * fmax(ambient[c], 0);
    const double before = unshot_power(w);
    shoot(w, i, row, b);
    shoot(w, i, row, more);
    if (unshot_power(w) > before) {
        for (int c = 0; c < 3; c++)
            more[c] = -more[c];
        shoot(w, i, row, more);
    }
}

static double error_left(const struct shooting *w)
{
    double reflected = 0, rho = 0;
    for (uint32_t i = 0; i < w->s->e->count; i++)
        reflected +=
            w->s->e->element[i].area * (channels(w->out->b[i]) - channels(w->source[i]));
    for (int c = 0; c < 3; c++)
        rho = fmax(rho, w->rho[c]);
    const double coming = unshot_power(w) * rho / (1 - rho);
    return reflected + coming > 0 ? coming / (reflected + coming) : 0;
}

// Irradiance from radiosity, where nothing is gathered at the end.
static void irradiance(struct shooting *w)
{
    for (uint32_t i = 0; i < w->s->e->count; i++) {
        double rho[3];
        element_reflectance(&w->s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            w->out->h[i][c] =
                rho[c] > 0 ? (w->out->b[i][c] - w->source[i][c]) / rho[c] : 0;
            if (rho[c] <= 0)
                w->out->h[i][c] = w->out->h_emitted[i][c];
        }
    }
}

void solve_shooting(struct radiosity_solution *out, const struct radiosity_system *s,
                    const struct solver_settings *settings)
{
    const size_t n = s->e->count;
    const uint32_t most = settings->steps_max ? settings->steps_max : UINT32_MAX;
    struct shooting w = {.s = s, .settings = settings, .out = out};
    w.unshot = must_calloc(n, sizeof *w.unshot);
    w.source = must_calloc(n, sizeof *w.source);
    w.row = must_calloc(n, sizeof *w.row);
    w.has_shot = must_calloc(n, sizeof *w.has_shot);
    if (!s->f)
        w.factors = factor_state_new(s->e, s->factors);
    system_source(s, w.source);
    memcpy(w.unshot, w.source, n * sizeof *w.unshot);
    memcpy(out->b, w.source, n * sizeof *out->b);
    for (int c = 0; c < 3; c++)
        w.rho[c] = mean_reflectance(s->e, c);
    for (size_t i = 0; i < n; i++)
        w.area += s->e->element[i].area;
    out->error = error_left(&w);
    // The estimate costs as much as a shot from a matrix.
    for (out->converged = n == 0;
         !out->converged && out->steps < most && !watch_cancelled(settings->watch);) {
        step(&w);
        out->steps++;
        out->error = error_left(&w);
        out->converged = out->error <= settings->tolerance;
        watch_tell(settings->watch, fmin(1, settings->tolerance / out->error));
    }
    if (settings->ambient) {
        double ambient[3];
        ambient_of(&w, ambient);
        for (size_t i = 0; i < n; i++) {
            double rho[3];
            element_reflectance(&s->e->element[i], rho);
            for (int c = 0; c < 3; c++)
                out->b[i][c] += rho[c] * ambient[c];
        }
    }
    if (s->f) {
        solution_gather(out, s, settings->threads);
    } else {
        irradiance(&w);
        out->rays = w.factors->ray_count;
        factor_state_free(w.factors);
    }
    free(w.unshot);
    free(w.source);
    free(w.row);
    free(w.has_shot);
}
