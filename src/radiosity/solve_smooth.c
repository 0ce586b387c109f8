// The width of the smoothing is chosen by validation: the error of a smoothed half is
// what it is off from the other half, which knows nothing of it, less the noise of that.
#include "radiosity/solve_smooth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"

enum { PASSES_MOST = 256 };

// Binomial weights of the eight neighbours, an element's own being 4.
static const double binomial[8] = {1, 2, 1, 2, 2, 1, 2, 1};

void smoother_init(struct smoother *m, const struct radiosity_system *s, int threads)
{
    const struct enclosure *e = s->e;
    *m = (struct smoother){.s = s, .threads = threads};
    if (!e->neighbour || !e->count)
        return;
    m->beside = must_calloc(8 * (size_t)e->count, sizeof *m->beside);
    for (uint32_t i = 0; i < e->count; i++) {
        uint32_t *to = m->beside + 8 * (size_t)i;
        for (int k = 0; k < 8; k++)
            to[k] = e->neighbour(e->user, i, k);
        for (int k = 0; k < 4; k++)
            if (to[k] == ELEMENT_NONE || to[7 - k] == ELEMENT_NONE)
                to[k] = to[7 - k] = ELEMENT_NONE;
        if (e->element[i].surface >= m->surfaces)
            m->surfaces = e->element[i].surface + 1;
    }
    for (int k = 0; k < 6; k++)
        m->work[k] = must_calloc(e->count, sizeof *m->work[k]);
    m->sum = must_calloc(6 * (size_t)m->surfaces, sizeof *m->sum);
}

void smoother_free(struct smoother *m)
{
    free(m->beside);
    free(m->sum);
    for (int k = 0; k < 6; k++)
        free(m->work[k]);
    *m = (struct smoother){0};
}

// ---- one pass ----------------------------------------------------------------------
struct pass {
    const struct smoother *m;
    double (*from)[3], (*to)[3];
};

static void pass_work(void *user, void *state, uint32_t begin, uint32_t end)
{
    const struct pass *x = user;
    const struct element *element = x->m->s->e->element;
    (void)state;
    for (uint32_t i = begin; i < end; i++) {
        const uint32_t *beside = x->m->beside + 8 * (size_t)i;
        double all = 4 * element[i].area, sum[3];
        for (int c = 0; c < 3; c++)
            sum[c] = all * x->from[i][c];
        for (int k = 0; k < 4; k++) {
            const uint32_t a = beside[k], b = beside[7 - k];
            if (a == ELEMENT_NONE)
                continue;
            const double w = binomial[k] * fmin(element[a].area, element[b].area);
            all += 2 * w;
            for (int c = 0; c < 3; c++)
                sum[c] += w * (x->from[a][c] + x->from[b][c]);
        }
        for (int c = 0; c < 3; c++)
            x->to[i][c] = sum[c] / all;
    }
}

// What arrives at each surface stays.
static void conserve(const struct smoother *m, double (*raw)[3], double (*h)[3])
{
    const struct enclosure *e = m->s->e;
    double *const before = m->sum, *const after = m->sum + 3 * (size_t)m->surfaces;
    memset(m->sum, 0, 6 * (size_t)m->surfaces * sizeof *m->sum);
    for (uint32_t i = 0; i < e->count; i++) {
        const size_t at = 3 * (size_t)e->element[i].surface;
        for (size_t c = 0; c < 3; c++) {
            before[at + c] += e->element[i].area * raw[i][c];
            after[at + c] += e->element[i].area * h[i][c];
        }
    }
    for (uint32_t i = 0; i < e->count; i++) {
        const size_t at = 3 * (size_t)e->element[i].surface;
        for (size_t c = 0; c < 3; c++)
            if (after[at + c] > 0)
                h[i][c] *= before[at + c] / after[at + c];
    }
}

// Smooths `h` by some passes; `spare` is overwritten.
static void passes_run(const struct smoother *m, double (*raw)[3], double (*h)[3],
                       double (*spare)[3], uint32_t passes)
{
    const uint32_t n = m->s->e->count;
    struct pass x = {m, h, spare};
    const struct parallel run = {
        .threads = m->threads, .piece = 4096, .user = &x, .work = pass_work};
    for (uint32_t k = 0; k < passes; k++) {
        parallel_run(&run, n);
        double(*swap)[3] = x.from;
        x.from = x.to;
        x.to = swap;
    }
    if (x.from != h)
        memcpy(h, x.from, n * sizeof *h);
    conserve(m, raw, h);
}

// ---- how far -----------------------------------------------------------------------
// Sum of squares of the difference of what is reflected.
static double apart(const struct smoother *m, double (*a)[3], double (*b)[3])
{
    double sum = 0;
    for (uint32_t i = 0; i < m->s->e->count; i++) {
        double rho[3];
        element_reflectance(&m->s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            const double d = rho[c] * (a[i][c] - b[i][c]);
            sum += m->s->e->element[i].area * d * d;
        }
    }
    return sum;
}

// The halves, smoothed as far as that makes each more like the other.
static void part_smooth(const struct smoother *m, double (*raw[2])[3],
                        double (*best[2])[3])
{
    const size_t bytes = m->s->e->count * sizeof *best[0];
    double(*at[2])[3] = {m->work[4], m->work[5]};
    double(*spare)[3] = must_calloc(m->s->e->count, sizeof *spare);
    double least = apart(m, raw[0], raw[1]);
    uint32_t done = 0;
    for (int k = 0; k < 2; k++) {
        memcpy(best[k], raw[k], bytes);
        memcpy(at[k], raw[k], bytes);
    }
    for (uint32_t passes = 1; passes <= PASSES_MOST && least > 0; passes *= 2) {
        for (int k = 0; k < 2; k++)
            passes_run(m, raw[k], at[k], spare, passes - done);
        done = passes;
        const double off = (apart(m, at[0], raw[1]) + apart(m, at[1], raw[0])) / 2;
        if (off >= least)
            break;
        least = off;
        for (int k = 0; k < 2; k++)
            memcpy(best[k], at[k], bytes);
    }
    free(spare);
}

static void halves_raw(const struct smoother *m, const struct light_part half[2],
                       double (*h[2])[3], double (*e[2])[3])
{
    for (int k = 0; k < 2; k++)
        for (uint32_t i = 0; i < m->s->e->count; i++)
            for (int c = 0; c < 3; c++) {
                e[k][i][c] = half[k].h_emitted[i][c];
                h[k][i][c] = half[k].h[i][c] - e[k][i][c];
            }
}

double smoother_mean(struct smoother *m, const struct light_part half[2],
                     const struct light_part *out)
{
    const uint32_t n = m->s->e->count;
    double off = apart(m, half[0].h, half[1].h) / 4;
    if (m->beside) {
        double(*raw[2])[3] = {m->work[0], m->work[1]};
        double(*best[2])[3] = {m->work[2], m->work[3]};
        double(*emitted[2])[3] = {must_calloc(n, sizeof **emitted),
                                  must_calloc(n, sizeof **emitted)};
        halves_raw(m, half, raw, emitted);
        part_smooth(m, emitted, best);
        for (uint32_t i = 0; i < n; i++)
            for (int c = 0; c < 3; c++) {
                out->h_emitted[i][c] = (best[0][i][c] + best[1][i][c]) / 2;
                emitted[0][i][c] = best[0][i][c];
                emitted[1][i][c] = best[1][i][c];
            }
        part_smooth(m, raw, best);
        for (uint32_t i = 0; i < n; i++)
            for (int c = 0; c < 3; c++) {
                best[0][i][c] += emitted[0][i][c];
                best[1][i][c] += emitted[1][i][c];
                out->h[i][c] = (best[0][i][c] + best[1][i][c]) / 2;
            }
        // Each half errs by bias and its own noise; of the mean the noise is half.
        const double noise = apart(m, half[0].h, half[1].h) / 2;
        const double own = apart(m, best[0], best[1]) / 2;
        const double each =
            (apart(m, best[0], half[1].h) + apart(m, best[1], half[0].h)) / 2 - noise;
        off = fmin(off, fmax(each - own / 2, own / 2));
        free(emitted[0]);
        free(emitted[1]);
    } else {
        for (uint32_t i = 0; i < n; i++)
            for (int c = 0; c < 3; c++) {
                out->h[i][c] = (half[0].h[i][c] + half[1].h[i][c]) / 2;
                out->h_emitted[i][c] =
                    (half[0].h_emitted[i][c] + half[1].h_emitted[i][c]) / 2;
            }
    }
    double all = 0;
    for (uint32_t i = 0; i < n; i++) {
        double rho[3];
        element_reflectance(&m->s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            const double b = rho[c] * out->h[i][c];
            all += m->s->e->element[i].area * b * b;
        }
    }
    return all > 0 ? sqrt(off / all) : 0;
}
