// What the solution is off by, found by looking: at points of the elements the
// interpolated light is held against what rays from there find. Two independent sets of
// rays have independent noise, so that the product of what each is off by has none in the
// mean, and few rays a point do.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/radiosity.h"
#include "radiosity/sequence.h"
#include "radiosity/solve_gather.h"

enum { PROBES = 1024, RAYS_LEAST = 32, RAYS_MOST = 512 };

struct probing {
    const struct radiosity *r;
    const struct gather *gather;
    uint32_t *first;  // point of each element, in order of the elements
    uint32_t rays;    // of a point and half
    double total;     // area
    double (*sum)[3]; // squares by area of what is off and of all; of the former, squared
};

static void *begin(void *user)
{
    const struct probing *p = user;
    return factor_state_new(&p->r->patches->enclosure, &p->r->settings.factors);
}

static void end(void *user, void *state)
{
    (void)user;
    factor_state_free(state);
}

static void probe_point(const struct probing *p, struct factor_state *s,
                        struct trace_scratch *scratch, uint32_t i, uint32_t k)
{
    const struct radiosity *r = p->r;
    const struct patches *patches = r->patches;
    const struct cell *c = &patches->cell[patches->element_cell[i] / 2];
    const struct patch_probe probe = {scratch, patches};
    const uint32_t seed = sequence_seed(i, 17 + k);
    struct element_point at;
    struct interaction met;
    struct hit hit;
    struct ray ray;
    uint32_t around[4];
    double x[4], weight[4], shown[3] = {0, 0, 0}, seen[2][3], rho[3];
    sobol_point(k, i, x);
    if (!patch_point(&probe, c, patches->element_cell[i] & 1, x[0], x[1], &at, &hit,
                     &ray))
        return;
    trace_interaction(patches->job->world, &ray, &hit, &met);
    const uint32_t n = patch_around(patches, scratch, &ray, &hit, &met, around, weight);
    for (uint32_t j = 0; j < n; j++)
        for (int m = 0; m < 3; m++)
            shown[m] += weight[j] * r->solution.h[around[j]][m];
    for (uint32_t half = 0; half < 2; half++)
        gather_at(p->gather, s, &at, sequence_seed(seed, half), p->rays, seen[half]);
    element_reflectance(&patches->element[i], rho);
    const double area = p->total / PROBES;
    double off = 0;
    for (int m = 0; m < 3; m++) {
        off += area * rho[m] * rho[m] * (shown[m] - seen[0][m]) * (shown[m] - seen[1][m]);
        p->sum[i][1] += area * rho[m] * rho[m] * shown[m] * shown[m];
    }
    p->sum[i][0] += off;
    p->sum[i][2] += off * off;
}

static void work(void *user, void *state, uint32_t from, uint32_t to)
{
    const struct probing *p = user;
    struct trace_scratch *scratch = trace_scratch_new(p->r->patches->job->world);
    for (uint32_t i = from; i < to; i++)
        for (uint32_t k = p->first[i]; k < p->first[i + 1]; k++)
            probe_point(p, state, scratch, i, k - p->first[i]);
    trace_scratch_free(scratch);
}

// So many points, by area.
static void points_share(struct probing *p)
{
    const struct patches *patches = p->r->patches;
    double up_to = 0;
    for (uint32_t i = 0; i < patches->element_count; i++)
        p->total += patches->element[i].area;
    for (uint32_t i = 0; i < patches->element_count; i++) {
        up_to += patches->element[i].area;
        p->first[i + 1] = (uint32_t)(PROBES * fmin(up_to / p->total, 1) + .5);
    }
}

// One round over all points; sums up what they find.
static void probe_round(struct probing *p, double sum[3])
{
    const struct radiosity *r = p->r;
    const uint32_t n = r->patches->element_count;
    const struct parallel run = {.threads = r->settings.solver.threads,
                                 .piece = 16,
                                 .watch = r->settings.watch,
                                 .user = p,
                                 .begin = begin,
                                 .end = end,
                                 .work = work};
    memset(p->sum, 0, n * sizeof *p->sum);
    parallel_run(&run, n);
    sum[0] = sum[1] = sum[2] = 0;
    for (uint32_t i = 0; i < n; i++)
        for (int k = 0; k < 3; k++)
            sum[k] += p->sum[i][k];
}

double radiosity_probe(struct radiosity *r, double *share)
{
    // What is off stands out of the noise by so much, or there are more rays.
    static const double clear = 2;
    const uint32_t n = r->patches->element_count;
    struct radiosity_system system = {.e = &r->patches->enclosure,
                                      .factors = &r->settings.factors};
    struct gather g;
    struct probing p = {.r = r, .gather = &g, .rays = RAYS_LEAST};
    double sum[3];
    gather_init(&g, &system, &r->settings.solver, 0);
    g.b = r->solution.b;
    p.sum = must_calloc(n, sizeof *p.sum);
    p.first = must_calloc(n + 1, sizeof *p.first);
    points_share(&p);
    for (;; p.rays *= 2) {
        probe_round(&p, sum);
        r->report.rays += (uint64_t)PROBES * 2 * p.rays;
        if (sum[0] > clear * sqrt(sum[2]) || p.rays >= RAYS_MOST)
            break;
    }
    for (uint32_t i = 0; i < n; i++)
        share[i] = fmax(p.sum[i][0], 0);
    free(p.sum);
    free(p.first);
    gather_free(&g);
    return sum[1] > 0 && sum[0] > 0 ? sqrt(sum[0] / sum[1]) : 0;
}
