// A last gathering for the stochastic solver: every element looks around. What rays find
// is the mean of many elements, so that the noise of single ones does not matter, and
// spread evenly over the hemisphere they err far less than rays that arrive by chance.
#include "radiosity/solve_gather.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/factor_nodes.h"
#include "radiosity/polygon.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"

enum { GATHER_BATCH = 1024, GATHER_TRIES = 64 };

void gather_init(struct gather *g, const struct radiosity_system *s,
                 const struct solver_settings *settings, uint32_t half)
{
    // Emitters that few rays would find by themselves are looked at instead.
    static const double few = .05; // of the area
    const uint32_t n = s->e->count;
    double area = 0, glowing = 0;
    *g = (struct gather){
        .s = s, .settings = settings, .seed = sequence_seed(settings->seed, 2 + half)};
    g->emitter = must_calloc(n, sizeof *g->emitter);
    g->up_to = must_calloc(n, sizeof *g->up_to);
    g->radius = must_calloc(n, sizeof *g->radius);
    g->rank = must_calloc(n, sizeof *g->rank);
    g->rays = must_calloc(n, sizeof *g->rays);
    for (uint32_t i = 0; i < n; i++) {
        const struct element *e = &s->e->element[i];
        double own[3];
        element_emission(e, own);
        area += e->area;
        g->rank[i] = ELEMENT_NONE;
        if (own[0] + own[1] + own[2] <= 0)
            continue;
        glowing += e->area;
        g->power += e->area * (own[0] + own[1] + own[2]);
        g->up_to[g->emitter_count] = g->power;
        g->radius[g->emitter_count] = polygon_radius(e);
        g->rank[i] = g->emitter_count;
        g->emitter[g->emitter_count++] = i;
    }
    g->direct = glowing < few * area;
}

void gather_free(struct gather *g)
{
    free(g->emitter);
    free(g->up_to);
    free(g->radius);
    free(g->rank);
    free(g->rays);
}

static bool point_of(const struct factor_state *s, uint32_t element, uint32_t seed,
                     uint32_t index, double x[4], struct element_point *out)
{
    sobol_point(index, seed, x);
    const double u = x[2], v = x[3];
    bool found = element_at(s, element, x[0], x[1], out);
    // Where an element does not exist another point is drawn.
    for (uint32_t k = 0; k < GATHER_TRIES && !found; k++) {
        random_point(index, sequence_seed(seed, k + 1), x);
        found = element_at(s, element, x[0], x[1], out);
    }
    x[2] = u;
    x[3] = v;
    return found;
}

static void *begin(void *user)
{
    const struct gather *g = user;
    return factor_state_new(g->s->e, g->s->factors);
}

static void end(void *user, void *state)
{
    (void)user;
    factor_state_free(state);
}

// ---- which emitters are looked at ---------------------------------------------------
// Where one looks from: a flat element or one point, or, curved, with any normal.
struct looker {
    struct vec3 o, n;
    double radius;
    bool curved;
};

static struct looker looker_of(const struct element *e)
{
    return (struct looker){e->centre, e->normal, polygon_radius(e), e->curved};
}

// An emitter that lies before one so closely that what it gives differs from point to
// point too much to be guessed beforehand is left to rays, which find it often.
static bool is_close(const struct gather *g, uint32_t k, const struct looker *at)
{
    static const double gap = .3; // of the sizes
    const struct element *e = &g->s->e->element[g->emitter[k]];
    const struct vec3 d = vec3_sub(e->centre, at->o);
    const double sizes = g->radius[k] + at->radius, r = vec3_length(d);
    const double away = at->curved || e->curved ? r : fabs(vec3_dot(d, at->n));
    return r < sizes && away < gap * sizes;
}

// Whether rays from there bring what element j sends of its own.
static bool rays_bring(const struct gather *g, uint32_t j, const struct looker *at)
{
    return g->rank[j] != ELEMENT_NONE && is_close(g, g->rank[j], at);
}

// The same of rays from all over element i.
static bool rays_bring_to(const struct gather *g, uint32_t j, uint32_t i)
{
    if (g->rank[j] == ELEMENT_NONE) // most
        return false;
    const struct looker at = looker_of(&g->s->e->element[i]);
    return rays_bring(g, j, &at);
}

// ---- what rays find ----------------------------------------------------------------
static void found(const struct gather *g, struct factor_state *s, const uint32_t *sender)
{
    g->s->e->closest(s->of_enclosure, s->rays, s->met);
    for (uint32_t r = 0; r < s->rays->count; r++) {
        const uint32_t i = sender[r], j = s->met[r];
        if (j == ELEMENT_NONE)
            continue;
        double own[3];
        element_emission(&g->s->e->element[j], own);
        const bool brought = !g->direct || rays_bring_to(g, j, i);
        for (int c = 0; c < 3; c++) {
            g->h[i][c] += g->b[j][c] - (g->direct ? own[c] : 0);
            if (brought)
                g->h_emitted[i][c] += own[c];
        }
    }
    s->rays->count = 0;
}

static void around(void *user, void *state, uint32_t from, uint32_t to)
{
    const struct gather *g = user;
    struct factor_state *s = state;
    uint32_t sender[GATHER_BATCH];
    s->rays->count = 0;
    for (uint32_t i = from; i < to; i++) {
        const uint32_t seed = sequence_seed(i, g->seed);
        g->rays[i] = 0;
        for (uint32_t k = 0; k < g->count; k++) {
            struct element_point at;
            double x[4];
            if (!point_of(s, i, seed, g->first + k, x, &at))
                continue;
            sender[s->rays->count] = i;
            ray_put(s->rays, &at, cosine_direction(at.normal, x[2], x[3]), INFINITY);
            g->rays[i]++;
            if (s->rays->count == GATHER_BATCH)
                found(g, s, sender);
        }
    }
    if (s->rays->count)
        found(g, s, sender);
    for (uint32_t i = from; i < to; i++) {
        for (int c = 0; c < 3; c++) {
            g->h[i][c] /= fmax(g->rays[i], 1);
            g->h_emitted[i][c] /= fmax(g->rays[i], 1);
        }
    }
}

// ---- what emitters give ------------------------------------------------------------
// Emitters that looks are drawn from: up to LOCAL_MOST by about what they give to where
// one looks from, more by their power.
enum { LOCAL_MOST = 256 };
struct drawing {
    const double *up_to;
    double total, local[LOCAL_MOST];
};

// About what emitter k gives there but for what rays bring, and more than nothing where
// any point of it gives any point there anything: cosines are the greatest there are.
static double may_give(const struct gather *g, uint32_t k, const struct looker *at)
{
    static const double blur = .3; // of the sizes: how near points of both are
    if (is_close(g, k, at))
        return 0;
    const struct element *e = &g->s->e->element[g->emitter[k]];
    const double power = g->up_to[k] - (k ? g->up_to[k - 1] : 0);
    const double size = blur * (g->radius[k] + at->radius);
    const struct vec3 d = vec3_sub(e->centre, at->o);
    const double d2 = vec3_dot(d, d) + size * size, r = sqrt(d2);
    const double here = at->curved ? r : vec3_dot(d, at->n) + g->radius[k];
    const double there = e->curved ? r : at->radius - vec3_dot(d, e->normal);
    return here > 0 && there > 0 ? power * fmin(here, r) * fmin(there, r) / (d2 * d2) : 0;
}

static void drawing_init(struct drawing *w, const struct gather *g,
                         const struct looker *at)
{
    w->up_to = g->up_to;
    w->total = g->power;
    if (g->emitter_count > LOCAL_MOST)
        return;
    w->up_to = w->local;
    w->total = 0;
    for (uint32_t k = 0; k < g->emitter_count; k++)
        w->local[k] = w->total += may_give(g, k, at);
}

static uint32_t emitter_at(const struct gather *g, const struct drawing *w, double x,
                           double *chance)
{
    uint32_t low = 0, high = g->emitter_count - 1;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (w->up_to[middle] > x * w->total)
            high = middle;
        else
            low = middle + 1;
    }
    *chance = (w->up_to[low] - (low ? w->up_to[low - 1] : 0)) / w->total;
    return low;
}

struct look {
    uint32_t sender;
    double light[3];
};

static void arrived(const struct gather *g, struct factor_state *s, const struct look *l)
{
    if (g->s->e->occluded)
        g->s->e->occluded(s->of_enclosure, s->rays, s->hidden);
    for (uint32_t r = 0; r < s->rays->count; r++)
        for (int c = 0; c < 3 && !(g->s->e->occluded && s->hidden[r]); c++)
            g->h_emitted[l[r].sender][c] += l[r].light[c] / g->count;
    s->rays->count = 0;
}

// Points of the element look at points of emitters, drawn by power: Lambert's formula of
// the emitter, and whether the way is free.
static void at_emitters(void *user, void *state, uint32_t from, uint32_t to)
{
    const struct gather *g = user;
    struct factor_state *s = state;
    struct look look[GATHER_BATCH];
    s->rays->count = 0;
    for (uint32_t i = from; i < to; i++) {
        const uint32_t seed = sequence_seed(i, ~g->seed);
        const struct looker self = looker_of(&g->s->e->element[i]);
        double offset[4];
        struct drawing w;
        random_point(g->first, seed, offset);
        drawing_init(&w, g, &self);
        for (uint32_t k = 0; k < g->count && w.total > 0; k++) {
            struct element_point at, of;
            double x[4], own[3], chance;
            const uint32_t e =
                g->emitter[emitter_at(g, &w, (k + offset[0]) / g->count, &chance)];
            if (rays_bring(g, e, &self) || !point_of(s, i, seed, g->first + k, x, &at))
                continue;
            const double seen = factor_from_point(s, &at, e);
            double y[4];
            if (seen <= 0 ||
                !point_of(s, e, sequence_seed(seed, g->first + k), 0, y, &of))
                continue;
            element_emission(&g->s->e->element[e], own);
            struct look *l = &look[s->rays->count];
            l->sender = i;
            for (int c = 0; c < 3; c++)
                l->light[c] = own[c] * seen / chance;
            ray_put_between(s->rays, &at, &of);
            if (s->rays->count == GATHER_BATCH)
                arrived(g, s, look);
        }
    }
    if (s->rays->count)
        arrived(g, s, look);
    for (uint32_t i = from; i < to; i++)
        for (int c = 0; c < 3; c++)
            g->h[i][c] += g->h_emitted[i][c];
}

// ---- at a point --------------------------------------------------------------------
static void point_around(const struct gather *g, struct factor_state *s,
                         const struct element_point *at, uint32_t seed, uint32_t rays,
                         double h[3])
{
    const struct looker self = {at->p, at->normal, 0, false};
    s->rays->count = 0;
    for (uint32_t k = 0; k < rays; k++) {
        double x[4];
        sobol_point(k, seed, x);
        ray_put(s->rays, at, cosine_direction(at->normal, x[0], x[1]), INFINITY);
    }
    g->s->e->closest(s->of_enclosure, s->rays, s->met);
    for (uint32_t r = 0; r < rays; r++) {
        double own[3];
        if (s->met[r] == ELEMENT_NONE)
            continue;
        element_emission(&g->s->e->element[s->met[r]], own);
        const bool brought = !g->direct || rays_bring(g, s->met[r], &self);
        for (int c = 0; c < 3; c++)
            h[c] += (g->b[s->met[r]][c] - (brought ? 0 : own[c])) / rays;
    }
    s->rays->count = 0;
}

static void point_emitters(const struct gather *g, struct factor_state *s,
                           const struct element_point *at, uint32_t seed, uint32_t rays,
                           double h[3])
{
    double light[GATHER_BATCH][3], offset[4];
    struct drawing w;
    random_point(0, seed, offset);
    const struct looker self = {at->p, at->normal, 0, false};
    drawing_init(&w, g, &self);
    s->rays->count = 0;
    for (uint32_t k = 0; k < rays && w.total > 0; k++) {
        struct element_point of;
        double y[4], own[3], chance;
        const uint32_t e = g->emitter[emitter_at(g, &w, (k + offset[0]) / rays, &chance)];
        const double seen = rays_bring(g, e, &self) ? 0 : factor_from_point(s, at, e);
        if (seen <= 0 || !point_of(s, e, sequence_seed(seed, k), 0, y, &of))
            continue;
        element_emission(&g->s->e->element[e], own);
        for (int c = 0; c < 3; c++)
            light[s->rays->count][c] = own[c] * seen / chance / rays;
        ray_put_between(s->rays, at, &of);
    }
    if (g->s->e->occluded)
        g->s->e->occluded(s->of_enclosure, s->rays, s->hidden);
    for (uint32_t r = 0; r < s->rays->count; r++)
        for (int c = 0; c < 3 && !(g->s->e->occluded && s->hidden[r]); c++)
            h[c] += light[r][c];
    s->rays->count = 0;
}

void gather_at(const struct gather *g, struct factor_state *s,
               const struct element_point *at, uint32_t seed, uint32_t rays, double h[3])
{
    const uint32_t n = rays < GATHER_BATCH ? rays : GATHER_BATCH;
    h[0] = h[1] = h[2] = 0;
    point_around(g, s, at, sequence_seed(seed, 0), n, h);
    if (g->direct && g->emitter_count)
        point_emitters(g, s, at, sequence_seed(seed, 1), n, h);
}

uint64_t gather_pass(struct gather *g, double (*b)[3], uint32_t first, uint32_t count,
                     double (*h)[3], double (*h_emitted)[3])
{
    const uint32_t n = g->s->e->count;
    g->b = b;
    g->h = h;
    g->h_emitted = h_emitted;
    g->first = first;
    g->count = count;
    memset(h, 0, n * sizeof *h);
    memset(h_emitted, 0, n * sizeof *h_emitted);
    struct parallel run = {.threads = g->settings->threads,
                           .piece = 16,
                           .watch = g->settings->watch,
                           .user = g,
                           .begin = begin,
                           .end = end,
                           .work = around};
    parallel_run(&run, n);
    if (!g->direct || !g->emitter_count)
        return (uint64_t)n * count;
    g->count = count / 2 > 0 ? count / 2 : 1;
    run.work = at_emitters;
    parallel_run(&run, n);
    return (uint64_t)n * (count + g->count);
}
