// Solvers that treat the whole matrix: elimination and conjugate gradients.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "radiosity/solver.h"

// ---- elimination -----------------------------------------------------------------
static double reflectance(const struct radiosity_system *s, size_t i, int channel)
{
    double rho[3];
    element_reflectance(&s->e->element[i], rho);
    return rho[channel];
}

// I - rho F for a channel, row by row.
static void matrix_fill(const struct radiosity_system *s, int channel, double *m)
{
    const size_t n = s->e->count;
    for (size_t i = 0; i < n; i++) {
        const double rho = reflectance(s, i, channel);
        for (size_t j = 0; j < n; j++)
            m[i * n + j] = (i == j ? 1 : 0) - rho * (double)s->f->f[i * n + j];
    }
}

// Eliminates below the diagonal, in place, with x as three right sides. No pivots are
// needed: rows sum to at least 1 - rho, the diagonal dominates.
static void eliminate(double *m, double (*x)[3], size_t n, struct watch *watch)
{
    for (size_t k = 0; k < n && !watch_cancelled(watch); k++) {
        const double *pivot = m + k * n;
        for (size_t i = k + 1; i < n; i++) {
            double *row = m + i * n;
            if (row[k] == 0)
                continue;
            const double q = row[k] / pivot[k];
            for (size_t j = k + 1; j < n; j++)
                row[j] -= q * pivot[j];
            for (int c = 0; c < 3; c++)
                x[i][c] -= q * x[k][c];
        }
    }
    for (size_t i = n; i-- > 0;) {
        const double *row = m + i * n;
        for (size_t j = i + 1; j < n; j++)
            for (int c = 0; c < 3; c++)
                x[i][c] -= row[j] * x[j][c];
        for (int c = 0; c < 3; c++)
            x[i][c] /= row[i];
    }
}

static bool channels_equal(const struct radiosity_system *s)
{
    for (size_t i = 0; i < s->e->count; i++) {
        const struct rgb r = s->e->element[i].reflectance;
        if (r.r != r.g || r.g != r.b)
            return false;
    }
    return true;
}

void solve_elimination(struct radiosity_solution *out, const struct radiosity_system *s,
                       const struct solver_settings *settings)
{
    const size_t n = s->e->count;
    double *m = must_calloc(n * n, sizeof *m);
    double(*x)[3] = must_calloc(n, sizeof *x);
    const bool grey = channels_equal(s);
    for (int c = 0; c < (grey ? 1 : 3); c++) {
        system_source(s, x);
        matrix_fill(s, c, m);
        eliminate(m, x, n, settings->watch);
        for (size_t i = 0; i < n; i++)
            for (int k = 0; k < 3; k++)
                if (grey || k == c)
                    out->b[i][k] = x[i][k];
    }
    free(m);
    free(x);
    out->steps = 1;
    out->converged = true;
    solution_gather(out, s, settings->threads);
    out->error = 0;
    out->bytes += (double)n * (double)n * sizeof(double);
}

// ---- conjugate gradients -----------------------------------------------------------
// With z = sqrt(rho A) H the system is (1 - K) z = g, K symmetric.
struct cg {
    const struct radiosity_system *s;
    double (*weight)[3]; // sqrt(rho A)
    double (*x)[3], (*r)[3], (*p)[3], (*q)[3], (*b)[3];
};

// q = (1 - K) p.
static void cg_apply(struct cg *g, int threads)
{
    const size_t n = g->s->e->count;
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            g->b[i][c] = g->weight[i][c] * g->p[i][c] / g->s->e->element[i].area;
    factors_apply(g->s->f, g->b, g->q, threads);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            g->q[i][c] = g->p[i][c] - g->weight[i][c] * g->q[i][c];
}

static void dot(double (*a)[3], double (*b)[3], size_t n, double out[3])
{
    out[0] = out[1] = out[2] = 0;
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            out[c] += a[i][c] * b[i][c];
}

static void cg_start(struct cg *g, int threads)
{
    const size_t n = g->s->e->count;
    system_source(g->s, g->b);
    factors_apply(g->s->f, g->b, g->r, threads);
    for (size_t i = 0; i < n; i++) {
        double rho[3];
        element_reflectance(&g->s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            g->weight[i][c] = sqrt(rho[c] * g->s->e->element[i].area);
            g->r[i][c] *= g->weight[i][c];
            g->p[i][c] = g->r[i][c];
        }
    }
}

// One step of conjugate gradients; now and next: |r|^2 before and after it.
static void cg_step(struct cg *g, size_t n, int threads, const double now[3],
                    double next[3])
{
    double pq[3];
    cg_apply(g, threads);
    dot(g->p, g->q, n, pq);
    for (size_t i = 0; i < n; i++) {
        for (int c = 0; c < 3; c++) {
            const double step = pq[c] > 0 ? now[c] / pq[c] : 0;
            g->x[i][c] += step * g->p[i][c];
            g->r[i][c] -= step * g->q[i][c];
        }
    }
    dot(g->r, g->r, n, next);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            g->p[i][c] = g->r[i][c] + (now[c] > 0 ? next[c] / now[c] : 0) * g->p[i][c];
}

// A bound on the relative error: the smallest eigenvalue of 1 - K is at least 1 - rho, and
// |z| at least that of the first gathering.
static double cg_error(const double first[3], const double now[3], const double rho[3])
{
    double error = 0;
    for (int c = 0; c < 3; c++) {
        const double amplify = 1 / fmax(1 - rho[c], 1e-6);
        const double e = first[c] > 0 ? sqrt(now[c] / first[c]) * amplify : 0;
        error = fmax(error, e);
    }
    return error;
}

void solve_cg(struct radiosity_solution *out, const struct radiosity_system *s,
              const struct solver_settings *settings)
{
    const size_t n = s->e->count;
    const uint32_t most = settings->steps_max ? settings->steps_max : 1000;
    struct cg g = {s,
                   must_calloc(n, sizeof *g.weight),
                   must_calloc(n, sizeof *g.x),
                   must_calloc(n, sizeof *g.r),
                   must_calloc(n, sizeof *g.p),
                   must_calloc(n, sizeof *g.q),
                   must_calloc(n, sizeof *g.b)};
    double first[3], now[3], next[3], rho_most[3] = {0, 0, 0};
    cg_start(&g, settings->threads);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            rho_most[c] = fmax(rho_most[c], reflectance(s, i, c));
    dot(g.r, g.r, n, first);
    memcpy(now, first, sizeof now);
    while (out->steps < most && !out->converged && !watch_cancelled(settings->watch)) {
        cg_step(&g, n, settings->threads, now, next);
        memcpy(now, next, sizeof now);
        out->error = cg_error(first, now, rho_most);
        out->converged = out->error <= settings->tolerance;
        out->steps++;
    }
    system_source(s, g.b);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            out->b[i][c] =
                g.b[i][c] + (s->e->element[i].area > 0
                                 ? g.weight[i][c] * g.x[i][c] / s->e->element[i].area
                                 : 0);
    solution_gather(out, s, settings->threads);
    free(g.weight);
    free(g.x);
    free(g.r);
    free(g.p);
    free(g.q);
    free(g.b);
}
