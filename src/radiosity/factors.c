// The dense matrix of form factors.
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/form_factor.h"
#include "radiosity/hemicube.h"
#include "trace/intersect.h"

enum { FACTOR_RAYS = 1024 };

const struct form_factor_settings form_factor_defaults = {
    .method = "analytic",
    .points = 3,
    .tolerance = 1e-4,
    .depth = 8,
    .shadow_rays = 8,
    .visibility = 2.5e-4,
    .rays = 4096,
    .resolution = 128,
};

static const struct method {
    const char *name;
    pair_function *pair;
    row_function *row;
} methods[] = {
#define FORM_FACTOR(name, pair, row, help) {#name, pair, row},
#include "radiosity/form_factors.def"
#undef FORM_FACTOR
};

enum form_factor_method form_factor_find(const char *name)
{
    enum form_factor_method m = 0;
    while (m < FORM_FACTOR_COUNT && strcmp(methods[m].name, name) != 0)
        m++;
    return m;
}

const char *form_factor_name(enum form_factor_method m) { return methods[m].name; }

struct factor_state *factor_state_new(const struct enclosure *e,
                                      const struct form_factor_settings *s)
{
    struct factor_state *t = must_calloc(1, sizeof *t);
    t->enclosure = e;
    t->settings = s;
    t->of_enclosure = e->thread_begin ? e->thread_begin(e->user) : e->user;
    t->rays = ray_batch_new(FACTOR_RAYS);
    t->hidden = must_malloc(FACTOR_RAYS, sizeof *t->hidden);
    t->met = must_malloc(FACTOR_RAYS, sizeof *t->met);
    return t;
}

void factor_state_free(struct factor_state *s)
{
    if (s->enclosure->thread_end)
        s->enclosure->thread_end(s->of_enclosure);
    ray_batch_free(s->rays);
    hemicube_free(s->hemicube);
    free(s->nodes);
    free(s->hidden);
    free(s->met);
    free(s);
}

static double pair_of(struct factor_state *s, pair_function *pair, uint32_t i, uint32_t j)
{
    const struct element *a = &s->enclosure->element[i], *b = &s->enclosure->element[j];
    if (i == j)
        return factor_self(s, i);
    if (a->area <= 0 || pair_is_dark(a, b))
        return 0;
    // From the smaller one: its points see the larger whole.
    const bool turned = a->area > b->area;
    // No share is above one, whatever a quadrature finds where nodes nearly meet.
    const double f = fmin(1, turned ? pair(s, j, i) : pair(s, i, j));
    if (f <= 0)
        return 0;
    const double seen = f * pair_visibility(s, i < j ? i : j, i < j ? j : i, f);
    return turned ? seen * b->area / a->area : seen;
}

double pair_factor(struct factor_state *s, uint32_t i, uint32_t j)
{
    const struct method *m = &methods[form_factor_find(s->settings->method)];
    return pair_of(s, m->pair ? m->pair : factor_analytic, i, j);
}

void factor_row(struct factor_state *s, uint32_t i, float *row)
{
    const struct method *m = &methods[form_factor_find(s->settings->method)];
    if (m->row) {
        m->row(s, i, row);
        return;
    }
    for (uint32_t j = 0; j < s->enclosure->count; j++)
        row[j] = (float)pair_of(s, m->pair, i, j);
}

double factors_bytes(uint32_t count) { return (double)count * count * sizeof(float); }

struct assembly {
    struct factors *f;
    const struct enclosure *e;
    const struct form_factor_settings *s;
    const struct method *method;
    uint64_t *rays; // of each row
};

static void *begin(void *user)
{
    const struct assembly *a = user;
    return factor_state_new(a->e, a->s);
}

static void end(void *user, void *state)
{
    (void)user;
    factor_state_free(state);
}

static void rows(void *user, void *state, uint32_t first, uint32_t last)
{
    const struct assembly *a = user;
    struct factor_state *s = state;
    const size_t n = a->e->count;
    for (size_t i = first; i < last; i++) {
        const uint64_t before = s->ray_count;
        if (a->method->row) {
            a->method->row(s, (uint32_t)i, a->f->f + i * n);
        } else {
            // Reciprocity gives the other half.
            for (size_t j = i; j < n; j++) {
                const double f = pair_of(s, a->method->pair, (uint32_t)i, (uint32_t)j);
                a->f->f[i * n + j] = (float)f;
                if (f > 0)
                    a->f->f[j * n + i] =
                        (float)(f * a->e->element[i].area / a->e->element[j].area);
            }
        }
        a->rays[i] = s->ray_count - before;
    }
}

static void measure(struct factors *f, const struct enclosure *e)
{
    const size_t n = f->count;
    double area = 0, total = 0;
    f->row_sum_least = INFINITY;
    f->row_sum_most = f->asymmetry = 0;
    for (size_t i = 0; i < n; i++) {
        double sum = 0;
        for (size_t j = 0; j < n; j++) {
            sum += (double)f->f[i * n + j];
            if (!f->symmetric && j > i)
                f->asymmetry = fmax(f->asymmetry,
                                    fabs(e->element[i].area * (double)f->f[i * n + j] -
                                         e->element[j].area * (double)f->f[j * n + i]));
        }
        f->row_sum_least = fmin(f->row_sum_least, sum);
        f->row_sum_most = fmax(f->row_sum_most, sum);
        total += sum * e->element[i].area;
        area += e->element[i].area;
    }
    f->row_sum_mean = area > 0 ? total / area : 0;
    f->asymmetry = area > 0 ? f->asymmetry / (area / (double)n) : 0;
}

bool factors_compute(struct factors *f, const struct enclosure *e,
                     const struct form_factor_settings *s)
{
    const size_t n = e->count;
    *f = (struct factors){.count = e->count};
    uint64_t *rays = calloc(n + 1, sizeof *rays);
    f->f = calloc(n * n + 1, sizeof *f->f);
    if (!f->f || !rays) {
        free(rays);
        factors_free(f);
        return false;
    }
    struct assembly a = {f, e, s, &methods[form_factor_find(s->method)], rays};
    const struct parallel p = {.threads = s->threads,
                               .piece = 4,
                               .watch = s->watch,
                               .tells = true,
                               .user = &a,
                               .begin = begin,
                               .end = end,
                               .work = rows};
    parallel_run(&p, e->count);
    f->symmetric = a.method->pair != NULL;
    for (size_t i = 0; i < n; i++)
        f->rays += rays[i];
    free(rays);
    if (!watch_cancelled(s->watch))
        measure(f, e);
    return true;
}

void factors_free(struct factors *f)
{
    free(f->f);
    *f = (struct factors){0};
}

void factors_symmetrize(struct factors *f, const struct enclosure *e)
{
    enum { BLOCK = 64 };
    const size_t n = f->count;
    // In blocks, so that the transposed walk stays in the cache.
    for (size_t bi = 0; bi < n; bi += BLOCK) {
        for (size_t bj = bi; bj < n; bj += BLOCK) {
            for (size_t i = bi; i < bi + BLOCK && i < n; i++) {
                for (size_t j = bj > i + 1 ? bj : i + 1; j < bj + BLOCK && j < n; j++) {
                    const double ai = e->element[i].area, aj = e->element[j].area;
                    const double g =
                        (ai * (double)f->f[i * n + j] + aj * (double)f->f[j * n + i]) / 2;
                    f->f[i * n + j] = ai > 0 ? (float)(g / ai) : 0;
                    f->f[j * n + i] = aj > 0 ? (float)(g / aj) : 0;
                }
            }
        }
    }
    f->symmetric = true;
}

double factors_balance(struct factors *f, const struct enclosure *e, struct watch *watch)
{
    enum { ROUNDS = 100 };
    static const double exact = 1e-6; // floats hold no more
    const size_t n = f->count;
    double *scale = must_malloc(n + 1, sizeof *scale), worst = 0;
    if (!f->symmetric)
        factors_symmetrize(f, e);
    for (size_t i = 0; i < n; i++)
        scale[i] = 1;
    for (int round = 0; round < ROUNDS && !watch_cancelled(watch); round++) {
        worst = 0;
        for (size_t i = 0; i < n; i++) {
            double sum = 0;
            for (size_t j = 0; j < n; j++)
                sum += (double)f->f[i * n + j] * scale[j];
            sum *= scale[i];
            if (sum <= 0)
                continue;
            worst = fmax(worst, fabs(sum - 1));
            scale[i] /= sqrt(sum);
        }
        if (worst < exact)
            break;
    }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++)
            f->f[i * n + j] = (float)((double)f->f[i * n + j] * scale[i] * scale[j]);
    free(scale);
    f->balanced = true;
    return worst;
}
