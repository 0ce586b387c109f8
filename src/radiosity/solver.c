#include "radiosity/solver.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"

const struct solver_settings solver_defaults = {
    .solver = "gauss-seidel",
    .tolerance = 1e-4,
    .ambient = true,
    .link_error = 1e-3,
};

static const struct row {
    const char *name;
    solver_function *solve;
    bool matrix;
} solvers[] = {
#define SOLVER(name, option, function, matrix, help) {option, function, matrix},
#include "radiosity/solvers.def"
#undef SOLVER
};

enum solver_kind solver_find(const char *name)
{
    enum solver_kind k = 0;
    while (k < SOLVER_COUNT && strcmp(solvers[k].name, name) != 0)
        k++;
    return k;
}

const char *solver_name(enum solver_kind k) { return solvers[k].name; }

bool solver_needs_matrix(enum solver_kind k) { return solvers[k].matrix; }

bool solution_init(struct radiosity_solution *s, uint32_t count)
{
    *s = (struct radiosity_solution){.count = count, .error = -1};
    s->b = calloc((size_t)count + 1, sizeof *s->b);
    s->h = calloc((size_t)count + 1, sizeof *s->h);
    s->h_emitted = calloc((size_t)count + 1, sizeof *s->h_emitted);
    if (s->b && s->h && s->h_emitted)
        return true;
    solution_free(s);
    return false;
}

void solution_free(struct radiosity_solution *s)
{
    free(s->b);
    free(s->h);
    free(s->h_emitted);
    *s = (struct radiosity_solution){0};
}

bool radiosity_solve(struct radiosity_solution *out, const struct radiosity_system *s,
                     const struct solver_settings *settings)
{
    if (!solution_init(out, s->e->count))
        return false;
    solvers[solver_find(settings->solver)].solve(out, s, settings);
    return true;
}

void system_source(const struct radiosity_system *s, double (*source)[3])
{
    for (uint32_t i = 0; i < s->e->count; i++) {
        double rho[3];
        element_reflectance(&s->e->element[i], rho);
        element_emission(&s->e->element[i], source[i]);
        for (int c = 0; c < 3 && s->lamps; c++)
            source[i][c] += rho[c] * s->lamps[i][c];
    }
}

struct product {
    const struct factors *f;
    double (*b)[3], (*h)[3];
};

static void product_rows(void *user, void *state, uint32_t begin, uint32_t end)
{
    const struct product *p = user;
    const size_t n = p->f->count;
    (void)state;
    for (size_t i = begin; i < end; i++) {
        const float *f = p->f->f + i * n;
        double sum[3] = {0, 0, 0};
        for (size_t j = 0; j < n; j++) {
            const double w = (double)f[j];
            sum[0] += w * p->b[j][0];
            sum[1] += w * p->b[j][1];
            sum[2] += w * p->b[j][2];
        }
        memcpy(p->h[i], sum, sizeof sum);
    }
}

void factors_apply(const struct factors *f, double (*b)[3], double (*h)[3], int threads)
{
    struct product p = {f, b, h};
    const struct parallel run = {
        .threads = threads, .piece = 64, .user = &p, .work = product_rows};
    parallel_run(&run, f->count);
}

double mean_reflectance(const struct enclosure *e, int channel)
{
    double sum = 0, area = 0;
    for (uint32_t i = 0; i < e->count; i++) {
        double rho[3];
        element_reflectance(&e->element[i], rho);
        sum += e->element[i].area * rho[channel];
        area += e->element[i].area;
    }
    return area > 0 ? fmin(sum / area, 1 - 1e-6) : 0;
}

// The defect of the energy identity, sum A (1 - R rho) h = sum A R S with R the row sums:
// what elements send out arrives. By channel, relative to the right side.
static void energy_defect(const struct radiosity_system *s, double (*h)[3],
                          const double *row_sum, double defect[3])
{
    double(*source)[3] = must_calloc(s->e->count, sizeof *source);
    double left[3] = {0, 0, 0}, right[3] = {0, 0, 0};
    system_source(s, source);
    for (uint32_t i = 0; i < s->e->count; i++) {
        const double sees = row_sum ? row_sum[i] : 1, area = s->e->element[i].area;
        double rho[3];
        element_reflectance(&s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            left[c] += area * (1 - sees * rho[c]) * h[i][c];
            right[c] += area * sees * source[i][c];
        }
    }
    for (int c = 0; c < 3; c++)
        defect[c] = right[c] > 0 ? left[c] / right[c] - 1 : 0;
    free(source);
}

void solution_gather(struct radiosity_solution *out, const struct radiosity_system *s,
                     int threads)
{
    const size_t n = s->e->count;
    double(*e)[3] = must_calloc(n, sizeof *e);
    double *row_sum = must_calloc(n, sizeof *row_sum), defect[3];
    factors_apply(s->f, out->b, out->h, threads);
    for (size_t i = 0; i < n; i++)
        element_emission(&s->e->element[i], e[i]);
    factors_apply(s->f, e, out->h_emitted, threads);
    system_source(s, e);
    for (size_t i = 0; i < n; i++) {
        double rho[3];
        element_reflectance(&s->e->element[i], rho);
        for (int c = 0; c < 3; c++)
            out->b[i][c] = e[i][c] + rho[c] * out->h[i][c];
        for (size_t j = 0; j < n; j++)
            row_sum[i] += (double)s->f->f[i * n + j];
    }
    energy_defect(s, out->h, row_sum, defect);
    out->defect = 0;
    for (int c = 0; c < 3; c++)
        if (fabs(defect[c]) > fabs(out->defect))
            out->defect = defect[c];
    out->bytes = factors_bytes(s->f->count);
    free(e);
    free(row_sum);
}
