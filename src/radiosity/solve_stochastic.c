// Stochastic Jacobi iteration by incremental shooting (Neumann et al. 1995; Bekaert 1999,
// 6): rays carry the power that was received and not yet sent on. No factor is stored,
// and what a ray carries arrives or leaves the scene. Two independent halves give an
// error bar. Sums are of whole numbers, so that their order does not matter.
#include <math.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "radiosity/solve_gather.h"
#include "radiosity/solve_smooth.h"

enum { SHOT_BATCH = 1024, SHOT_TRIES = 64 };

struct shots {
    const struct radiosity_system *s;
    const struct solver_settings *settings;
    uint32_t seed;
    double (*power)[3];              // to be shot
    double *expected;                // rays of each element
    uint64_t *first;                 // prefix sums of the rays cast
    uint32_t *used;                  // of each element's sequence
    double scale;                    // units of `received` in a unit of power
    atomic_int_fast64_t *received;   // 3 per element; then what left the scene
    double (*h)[3], (*h_emitted)[3]; // of one pass
    double lost[3];
    uint64_t rays;
};

static void shots_init(struct shots *w, const struct radiosity_system *s,
                       const struct solver_settings *settings, uint32_t half)
{
    const size_t n = s->e->count;
    *w = (struct shots){
        .s = s, .settings = settings, .seed = sequence_seed(settings->seed, half)};
    w->power = must_calloc(n, sizeof *w->power);
    w->expected = must_calloc(n, sizeof *w->expected);
    w->first = must_calloc(n + 1, sizeof *w->first);
    w->used = must_calloc(n, sizeof *w->used);
    w->received = must_calloc(3 * n + 3, sizeof *w->received);
    w->h = must_calloc(n, sizeof *w->h);
    w->h_emitted = must_calloc(n, sizeof *w->h_emitted);
}

static void shots_free(struct shots *w)
{
    free(w->power);
    free(w->expected);
    free(w->first);
    free(w->used);
    free(w->received);
    free(w->h);
    free(w->h_emitted);
}

// Rays in proportion to power, by systematic sampling. Returns their number.
static uint64_t shots_plan(struct shots *w, double rays)
{
    const size_t n = w->s->e->count;
    double total = 0, so_far = 0, offset[4], most = 0, channel[3] = {0, 0, 0};
    for (size_t i = 0; i < n; i++) {
        total += w->power[i][0] + w->power[i][1] + w->power[i][2];
        for (int c = 0; c < 3; c++)
            channel[c] += w->power[i][c];
    }
    for (int c = 0; c < 3; c++)
        most = fmax(most, channel[c]);
    // Far below 2^63, also where few rays stand for many weak elements.
    w->scale = most > 0 ? 0x1p56 / most : 0;
    random_point((uint32_t)w->rays, w->seed, offset);
    for (size_t i = 0; i < n; i++) {
        const double p = w->power[i][0] + w->power[i][1] + w->power[i][2];
        w->expected[i] = total > 0 ? rays * p / total : 0;
        const double from = floor(so_far + offset[0]);
        so_far += w->expected[i];
        const double to = floor(so_far + offset[0]);
        w->first[i + 1] = w->first[i] + (uint64_t)(to - from);
    }
    return w->first[n];
}

static void receive(struct shots *w, size_t slot, const double power[3])
{
    for (int c = 0; c < 3; c++)
        atomic_fetch_add_explicit(&w->received[3 * slot + (size_t)c],
                                  (int_fast64_t)llrint(power[c] * w->scale),
                                  memory_order_relaxed);
}

static uint32_t element_of_ray(const struct shots *w, uint64_t ray)
{
    size_t low = 0, high = w->s->e->count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (w->first[middle] <= ray)
            low = middle;
        else
            high = middle;
    }
    return (uint32_t)low;
}

static void ray_start(const struct shots *w, const struct factor_state *s, uint32_t i,
                      uint32_t index)
{
    const uint32_t seed = sequence_seed(i, w->seed);
    struct element_point from;
    double x[4];
    sobol_point(index, seed, x);
    const double u = x[2], v = x[3];
    // Where an element does not exist another point is drawn.
    for (uint32_t k = 0; k < SHOT_TRIES && !element_at(s, i, x[0], x[1], &from); k++)
        random_point(index, sequence_seed(seed, k + 1), x);
    ray_put(s->rays, &from, cosine_direction(from.normal, u, v), INFINITY);
}

// What one ray of element i carries: all its power in equal parts where it surely has
// rays, its expected part else; either way the mean is right.
static void ray_power(const struct shots *w, uint32_t i, double out[3])
{
    const double count = (double)(w->first[i + 1] - w->first[i]);
    const double share = w->expected[i] >= 1 ? count : w->expected[i];
    for (int c = 0; c < 3; c++)
        out[c] = w->power[i][c] / share;
}

static void *begin(void *user)
{
    const struct shots *w = user;
    return factor_state_new(w->s->e, w->s->factors);
}

static void end(void *user, void *state)
{
    (void)user;
    factor_state_free(state);
}

static void batches(void *user, void *state, uint32_t from, uint32_t to)
{
    struct shots *w = user;
    struct factor_state *s = state;
    const uint32_t n = w->s->e->count;
    uint32_t sender[SHOT_BATCH];
    for (uint64_t b = from; b < to; b++) {
        const uint64_t first = b * SHOT_BATCH;
        const uint64_t last =
            first + SHOT_BATCH < w->first[n] ? first + SHOT_BATCH : w->first[n];
        uint32_t i = element_of_ray(w, first);
        s->rays->count = 0;
        for (uint64_t r = first; r < last; r++) {
            while (w->first[i + 1] <= r)
                i++;
            sender[r - first] = i;
            ray_start(w, s, i, w->used[i] + (uint32_t)(r - w->first[i]));
        }
        w->s->e->closest(s->of_enclosure, s->rays, s->met);
        for (uint32_t r = 0; r < s->rays->count; r++) {
            double power[3];
            ray_power(w, sender[r], power);
            receive(w, s->met[r] == ELEMENT_NONE ? n : s->met[r], power);
        }
    }
}

// Shoots all power once; what arrives, per area, is added to h and, reflected, is the
// new power.
static void shots_step(struct shots *w, double rays, double (*h)[3])
{
    const uint32_t n = w->s->e->count;
    const uint64_t cast = shots_plan(w, rays);
    for (size_t k = 0; k < 3 * (size_t)n + 3; k++)
        atomic_store_explicit(&w->received[k], 0, memory_order_relaxed);
    const struct parallel run = {.threads = w->settings->threads,
                                 .piece = 1,
                                 .watch = w->settings->watch,
                                 .user = w,
                                 .begin = begin,
                                 .end = end,
                                 .work = batches};
    parallel_run(&run, (uint32_t)((cast + SHOT_BATCH - 1) / SHOT_BATCH));
    w->rays += cast;
    for (uint32_t i = 0; i <= n; i++) {
        for (int c = 0; c < 3; c++) {
            const double got =
                w->scale > 0 ? (double)w->received[3 * (size_t)i + (size_t)c] / w->scale
                             : 0;
            if (i == n) {
                w->lost[c] += got;
                continue;
            }
            double rho[3];
            element_reflectance(&w->s->e->element[i], rho);
            h[i][c] += got / w->s->e->element[i].area;
            w->power[i][c] = rho[c] * got;
        }
        if (i < n)
            w->used[i] += (uint32_t)(w->first[i + 1] - w->first[i]);
    }
}

static double power_sum(const struct shots *w)
{
    double sum = 0;
    for (uint32_t i = 0; i < w->s->e->count; i++)
        sum += w->power[i][0] + w->power[i][1] + w->power[i][2];
    return sum;
}

// One solution from about `rays` rays: emission first, then what it leaves and the lamps
// give, bounce by bounce.
static void shots_pass(struct shots *w, double rays)
{
    static const double negligible = 1e-4; // of the power that was emitted
    const uint32_t n = w->s->e->count;
    double rho = 0, emitted, total;
    for (int c = 0; c < 3; c++)
        rho = fmax(rho, mean_reflectance(w->s->e, c));
    memset(w->h, 0, n * sizeof *w->h);
    memset(w->h_emitted, 0, n * sizeof *w->h_emitted);
    memset(w->lost, 0, sizeof w->lost);
    for (uint32_t i = 0; i < n; i++) {
        element_emission(&w->s->e->element[i], w->power[i]);
        for (int c = 0; c < 3; c++)
            w->power[i][c] *= w->s->e->element[i].area;
    }
    double(*source)[3] = must_calloc(n, sizeof *source);
    system_source(w->s, source);
    total = 0;
    for (uint32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            total += source[i][c] * w->s->e->element[i].area;
    emitted = power_sum(w);
    if (emitted > 0)
        shots_step(w, fmax(1, rays * (1 - rho) * emitted / total), w->h_emitted);
    for (uint32_t i = 0; i < n; i++) {
        double own[3];
        element_emission(&w->s->e->element[i], own);
        for (int c = 0; c < 3; c++)
            w->power[i][c] += (source[i][c] - own[c]) * w->s->e->element[i].area;
    }
    free(source);
    for (double left = power_sum(w); left > negligible * total; left = power_sum(w))
        shots_step(w, fmax(1, rays * (1 - rho) * left / total), w->h);
    for (uint32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            w->h[i][c] += w->h_emitted[i][c];
}

static void mix(double (*mean)[3], double (*pass)[3], uint32_t n, double weight)
{
    for (uint32_t i = 0; i < n; i++)
        for (int c = 0; c < 3; c++)
            mean[i][c] += weight * (pass[i][c] - mean[i][c]);
}

static void finish(struct radiosity_solution *out, const struct radiosity_system *s,
                   const struct shots w[2])
{
    double left = 0, right = 0;
    system_source(s, out->b);
    for (uint32_t i = 0; i < out->count; i++) {
        double rho[3];
        element_reflectance(&s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            const double area = s->e->element[i].area;
            left += area * (1 - rho[c]) * out->h[i][c];
            right += area * out->b[i][c];
            out->b[i][c] += rho[c] * out->h[i][c];
        }
    }
    // Of the last pass of both halves.
    for (int c = 0; c < 3; c++)
        left += (w[0].lost[c] + w[1].lost[c]) / 2;
    out->defect = right > 0 ? left / right - 1 : 0;
}

// ---- the whole ---------------------------------------------------------------------
struct halves {
    const struct radiosity_system *s;
    const struct solver_settings *settings;
    struct radiosity_solution *out;
    struct shots shots[2];
    struct light_part mean[2];
    struct smoother smoother;
    double done; // rays of the mean so far
};

// Adds passes of `weight` rays each to the means of the halves.
static void halves_add(struct halves *w, double weight)
{
    const uint32_t n = w->out->count;
    const double share = weight / (w->done + weight);
    for (int k = 0; k < 2; k++) {
        mix(w->mean[k].h, w->shots[k].h, n, share);
        mix(w->mean[k].h_emitted, w->shots[k].h_emitted, n, share);
    }
    w->done += weight;
    w->out->steps++;
    const struct light_part out = {w->out->h, w->out->h_emitted};
    w->out->error = smoother_mean(&w->smoother, w->mean, &out);
    w->out->converged = w->settings->rays || w->out->error <= w->settings->tolerance;
    // Four times the rays halve the error.
    const double left = w->out->error / w->settings->tolerance;
    watch_tell(w->settings->watch, w->out->converged ? 1 : 1 / (left * left));
}

static void shoot(struct halves *w, double rays)
{
    for (int k = 0; k < 2; k++)
        shots_pass(&w->shots[k], rays);
    halves_add(w, rays);
}

// From what was shot, elements gather until the error is met, each half by itself.
static void gather(struct halves *w, uint32_t most)
{
    enum { FIRST_RAYS = 32 };
    const uint32_t n = w->out->count;
    struct gather g[2];
    double(*b)[3] = must_calloc(n, sizeof *b);
    double(*source)[3] = must_calloc(n, sizeof *source);
    system_source(w->s, source);
    for (uint32_t k = 0; k < 2; k++)
        gather_init(&g[k], w->s, w->settings, k);
    uint32_t first = 0, count = FIRST_RAYS;
    w->done = 0; // what was shot is but the beginning
    while (w->out->steps < most && !w->out->converged &&
           !watch_cancelled(w->settings->watch)) {
        for (int k = 0; k < 2; k++) {
            for (uint32_t i = 0; i < n; i++) {
                double rho[3];
                element_reflectance(&w->s->e->element[i], rho);
                for (int c = 0; c < 3; c++)
                    b[i][c] = source[i][c] + rho[c] * w->mean[k].h[i][c];
            }
            w->out->rays +=
                gather_pass(&g[k], b, first, count, w->shots[k].h, w->shots[k].h_emitted);
        }
        halves_add(w, count);
        first += count;
        count = first; // as many again
    }
    for (int k = 0; k < 2; k++)
        gather_free(&g[k]);
    free(b);
    free(source);
}

// In a closed scene all that is sent is absorbed. What was gathered meets that up to a
// factor, the error of everything at once, in which noise of single elements does not
// cancel. A factor leaves what is dark dark.
static void balance(struct radiosity_solution *out, const struct radiosity_system *s)
{
    double(*source)[3] = must_calloc(out->count, sizeof *source);
    double sent[3] = {0, 0, 0}, absorbed[3] = {0, 0, 0};
    system_source(s, source);
    for (uint32_t i = 0; i < out->count; i++) {
        double rho[3];
        element_reflectance(&s->e->element[i], rho);
        for (int c = 0; c < 3; c++) {
            sent[c] += s->e->element[i].area * source[i][c];
            absorbed[c] += s->e->element[i].area * (1 - rho[c]) * out->h[i][c];
        }
    }
    for (uint32_t i = 0; i < out->count; i++)
        for (int c = 0; c < 3; c++)
            out->h[i][c] *= absorbed[c] > 0 ? sent[c] / absorbed[c] : 1;
    free(source);
}

void solve_stochastic(struct radiosity_solution *out, const struct radiosity_system *s,
                      const struct solver_settings *settings)
{
    static const double start = 16; // rays an element
    const uint32_t n = s->e->count;
    const uint32_t most = settings->steps_max ? settings->steps_max : 12;
    struct halves w = {.s = s, .settings = settings, .out = out};
    for (uint32_t k = 0; k < 2; k++) {
        shots_init(&w.shots[k], s, settings, k);
        w.mean[k].h = must_calloc(n, sizeof *w.mean[k].h);
        w.mean[k].h_emitted = must_calloc(n, sizeof *w.mean[k].h_emitted);
    }
    smoother_init(&w.smoother, s, settings->threads);
    if (n && !watch_cancelled(settings->watch))
        shoot(&w, settings->rays ? (double)settings->rays / 2 : fmax(start * n, 4096));
    const bool gathers = n && !out->converged;
    if (gathers)
        gather(&w, most);
    if (gathers && s->closed)
        balance(out, s);
    finish(out, s, w.shots);
    out->rays += w.shots[0].rays + w.shots[1].rays;
    out->bytes = (double)n * STOCHASTIC_BYTES;
    for (int k = 0; k < 2; k++) {
        shots_free(&w.shots[k]);
        free(w.mean[k].h);
        free(w.mean[k].h_emitted);
    }
    smoother_free(&w.smoother);
}
