// Gathering: Jacobi and Gauss-Seidel iterations over the rows.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/solver.h"

struct sweep {
    const struct radiosity_system *s;
    const struct solver_settings *settings;
    struct radiosity_solution *out;
    double (*source)[3];
    double (*sent)[3]; // sum over i of A_i rho_i F_ij: what is reflected of b_j = 1
    double (*next)[3]; // Jacobi
    uint32_t *room;    // of an element: those that see each other, in any number of steps
    uint32_t rooms;
    double (*mode)[3];    // per room: sum (A - sent) rho, what the constant leaves over
    double (*missing)[3]; // per room: how much of the constant is still to be added
    double change[3], previous[3];
};

// Rooms that no light passes between have constants of their own.
static void find_rooms(struct sweep *w)
{
    const size_t n = w->s->e->count;
    uint32_t *queue = must_calloc(n, sizeof *queue);
    w->room = must_calloc(n, sizeof *w->room);
    for (size_t i = 0; i < n; i++)
        w->room[i] = UINT32_MAX;
    for (size_t start = 0; start < n; start++) {
        if (w->room[start] != UINT32_MAX)
            continue;
        uint32_t count = 1;
        queue[0] = (uint32_t)start;
        w->room[start] = w->rooms;
        for (uint32_t k = 0; k < count; k++) {
            const float *f = w->s->f->f + queue[k] * n;
            for (size_t j = 0; j < n; j++) {
                if (f[j] <= 0 || w->room[j] != UINT32_MAX)
                    continue;
                w->room[j] = w->rooms;
                queue[count++] = (uint32_t)j;
            }
        }
        w->rooms++;
    }
    free(queue);
    w->mode = must_calloc(w->rooms, sizeof *w->mode);
    w->missing = must_calloc(w->rooms, sizeof *w->missing);
}

static void sweep_begin(struct sweep *w, const struct radiosity_system *s,
                        const struct solver_settings *settings,
                        struct radiosity_solution *out)
{
    const size_t n = s->e->count;
    *w = (struct sweep){.s = s, .settings = settings, .out = out};
    w->source = must_calloc(n, sizeof *w->source);
    w->sent = must_calloc(n, sizeof *w->sent);
    w->next = must_calloc(n, sizeof *w->next);
    system_source(s, w->source);
    memcpy(out->b, w->source, n * sizeof *out->b);
    for (size_t i = 0; i < n; i++) {
        double rho[3];
        element_reflectance(&s->e->element[i], rho);
        for (size_t j = 0; j < n; j++) {
            const double af = s->e->element[i].area * (double)s->f->f[i * n + j];
            for (int c = 0; c < 3; c++)
                w->sent[j][c] += af * rho[c];
        }
    }
    find_rooms(w);
    for (size_t j = 0; j < n; j++) {
        double rho[3];
        element_reflectance(&s->e->element[j], rho);
        for (int c = 0; c < 3; c++)
            w->mode[w->room[j]][c] += (s->e->element[j].area - w->sent[j][c]) * rho[c];
    }
}

static void sweep_end(struct sweep *w)
{
    solution_gather(w->out, w->s, w->settings->threads);
    free(w->source);
    free(w->sent);
    free(w->next);
    free(w->room);
    free(w->mode);
    free(w->missing);
}

// The sum of residuals in a room tells how much of the constant mode rho is missing there
// (a Galerkin step with one basis function). Adds it when asked.
static void constant_mode(struct sweep *w, bool add)
{
    const size_t n = w->s->e->count;
    const struct element *e = w->s->e->element;
    memset(w->missing, 0, w->rooms * sizeof *w->missing);
    for (size_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            w->missing[w->room[i]][c] += e[i].area * (w->source[i][c] - w->out->b[i][c]) +
                                         w->sent[i][c] * w->out->b[i][c];
    for (uint32_t k = 0; k < w->rooms; k++)
        for (int c = 0; c < 3; c++)
            w->missing[k][c] = w->mode[k][c] > 0 ? w->missing[k][c] / w->mode[k][c] : 0;
    for (size_t i = 0; i < n && add; i++) {
        double rho[3];
        element_reflectance(&e[i], rho);
        for (int c = 0; c < 3; c++)
            w->out->b[i][c] += w->missing[w->room[i]][c] * rho[c];
    }
}

// The error left: the constant mode by the energy identity, the rest by the change of the
// sweep continued as a geometric series.
static double error_left(const struct sweep *w)
{
    const size_t n = w->s->e->count;
    const struct element *e = w->s->e->element;
    double reflected[3] = {0, 0, 0}, mode[3] = {0, 0, 0}, worst = 0;
    for (size_t i = 0; i < n; i++) {
        double rho[3];
        element_reflectance(&e[i], rho);
        for (int c = 0; c < 3; c++) {
            reflected[c] += e[i].area * (w->out->b[i][c] - w->source[i][c]);
            mode[c] += e[i].area * rho[c] * fabs(w->missing[w->room[i]][c]);
        }
    }
    for (int c = 0; c < 3; c++) {
        if (reflected[c] <= 0)
            continue;
        const double q =
            w->previous[c] > 0 ? fmin(w->change[c] / w->previous[c], .999) : .5;
        const double rest = w->change[c] * q / (1 - q) + mode[c];
        worst = fmax(worst, rest / reflected[c]);
    }
    return worst;
}

static void row_gather(const struct sweep *w, size_t i, double b[3])
{
    const size_t n = w->s->e->count;
    const float *f = w->s->f->f + i * n;
    double(*from)[3] = w->out->b, rho[3];
    double sum[3] = {0, 0, 0};
    for (size_t j = 0; j < n; j++) {
        const double v = (double)f[j];
        sum[0] += v * from[j][0];
        sum[1] += v * from[j][1];
        sum[2] += v * from[j][2];
    }
    element_reflectance(&w->s->e->element[i], rho);
    for (int c = 0; c < 3; c++)
        b[c] = w->source[i][c] + rho[c] * sum[c];
}

static void jacobi_rows(void *user, void *state, uint32_t begin, uint32_t end)
{
    struct sweep *w = user;
    (void)state;
    for (size_t i = begin; i < end; i++)
        row_gather(w, i, w->next[i]);
}

static void count_change(struct sweep *w, size_t i, const double b[3])
{
    for (int c = 0; c < 3; c++)
        w->change[c] += w->s->e->element[i].area * fabs(b[c] - w->out->b[i][c]);
    memcpy(w->out->b[i], b, 3 * sizeof *b);
}

static void jacobi_sweep(struct sweep *w)
{
    const struct parallel run = {.threads = w->settings->threads,
                                 .piece = 64,
                                 .watch = w->settings->watch,
                                 .user = w,
                                 .work = jacobi_rows};
    parallel_run(&run, w->s->e->count);
    for (size_t i = 0; i < w->s->e->count; i++)
        count_change(w, i, w->next[i]);
}

static void gauss_seidel_sweep(struct sweep *w)
{
    for (size_t i = 0; i < w->s->e->count && !watch_cancelled(w->settings->watch); i++) {
        double b[3];
        row_gather(w, i, b);
        count_change(w, i, b);
    }
}

static void sweeps(struct radiosity_solution *out, const struct radiosity_system *s,
                   const struct solver_settings *settings, void (*sweep)(struct sweep *),
                   bool correct)
{
    struct sweep w;
    const uint32_t most = settings->steps_max ? settings->steps_max : 100000;
    sweep_begin(&w, s, settings, out);
    while (out->steps < most && !out->converged && !watch_cancelled(settings->watch)) {
        memcpy(w.previous, w.change, sizeof w.previous);
        memset(w.change, 0, sizeof w.change);
        sweep(&w);
        out->steps++;
        constant_mode(&w, correct);
        out->error = error_left(&w);
        out->converged = out->error <= settings->tolerance;
    }
    sweep_end(&w);
}

void solve_jacobi(struct radiosity_solution *out, const struct radiosity_system *s,
                  const struct solver_settings *settings)
{
    sweeps(out, s, settings, jacobi_sweep, false);
}

void solve_gauss_seidel(struct radiosity_solution *out, const struct radiosity_system *s,
                        const struct solver_settings *settings)
{
    sweeps(out, s, settings, gauss_seidel_sweep, settings->ambient);
}
