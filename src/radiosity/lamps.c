// Light sources that are no elements: lamps and the sky.
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "radiosity/radiosity.h"
#include "radiosity/sequence.h"
#include "trace/lamp.h"
#include "trace/sky.h"
#include "trace/tracer.h"

struct gather {
    const struct patches *p;
    uint32_t points;
    double (*out)[3];
    bool sky;
};

struct gather_state {
    struct tracer *t;
    void *of_enclosure;
};

static void *begin(void *user)
{
    const struct gather *g = user;
    struct gather_state *s = must_calloc(1, sizeof *s);
    s->t = tracer_new(g->p->job);
    s->of_enclosure = g->p->enclosure.thread_begin(g->p->enclosure.user);
    return s;
}

static void end(void *user, void *state)
{
    const struct gather *g = user;
    struct gather_state *s = state;
    tracer_free(s->t);
    g->p->enclosure.thread_end(s->of_enclosure);
    free(s);
}

// Irradiance by one lamp at a point, shadows included.
static struct rgb lamp_at(struct gather_state *s, const struct lamp *lamp,
                          const struct element_point *at, const double x[4])
{
    const struct light *light = lamp->light;
    struct vec3 from = light->location;
    if (light->area) {
        const struct lamp_grid grid = lamp_grid_of(lamp, at->p);
        from = lamp_grid_point(lamp, &grid, floor(x[2] * light->size1),
                               floor(x[3] * light->size2));
    }
    struct lamp_view view;
    if (!lamp_view(lamp, from, at->p, &view))
        return rgb(0, 0, 0);
    const double cosine = vec3_dot(view.l, at->normal);
    if (cosine <= 0)
        return rgb(0, 0, 0);
    struct rgb c = rgb_scale((float)cosine, view.color);
    if (light->shadowless || !s->t->job->shadows)
        return c;
    const struct shadow_request r = {.o = vec3_mad(at->p, at->error, at->normal),
                                     .d = view.l,
                                     .t_max = view.distance,
                                     .value = c,
                                     .lamp = lamp->index};
    arena_reset(s->t->arena);
    return rgb_mul(c, shadow_factor(s->t, &r));
}

// The sky's colour in a direction of the cosine, nothing where something is in the way.
static struct rgb sky_at(struct gather_state *s, const struct element_point *at,
                         const double x[4])
{
    const struct vec3 d = cosine_direction(at->normal, x[2], x[3]);
    const struct ray_query q = {{vec3_mad(at->p, at->error, at->normal), d, 0, INFINITY},
                                OBJECT_NO_RADIOSITY};
    if (trace_closest_1(s->t->job->world, s->t->scratch, &q).b.t < INFINITY)
        return rgb(0, 0, 0);
    float clear;
    return sky_color(s->t->job, d, true, &clear);
}

static void gather_element(const struct gather *g, struct gather_state *s, uint32_t i)
{
    const struct patches *p = g->p;
    const struct job *job = p->job;
    const struct chart *chart = &p->chart[p->cell[p->element_cell[i] / 2].chart];
    const struct leaf *leaf = &job->world->leaf[chart->leaf];
    const struct lamp_list *list =
        &job->lamps[job->world->surface[leaf->surface].light_group];
    double sum[3] = {0, 0, 0};
    uint32_t found = 0;
    for (uint32_t k = 0; k < 4 * g->points && found < g->points; k++) {
        struct element_point at;
        double x[4];
        sobol_point(k, i, x);
        if (!p->enclosure.point(s->of_enclosure, i, x[0], x[1], &at))
            continue;
        found++;
        struct rgb c = {0, 0, 0};
        for (uint32_t l = 0; l < list->count; l++)
            c = rgb_add(c, lamp_at(s, list->lamp[l], &at, x));
        if (g->sky)
            c = rgb_add(c, sky_at(s, &at, x));
        sum[0] += (double)c.r;
        sum[1] += (double)c.g;
        sum[2] += (double)c.b;
    }
    for (int c = 0; c < 3; c++)
        g->out[i][c] = found ? sum[c] / found : 0;
}

static void work(void *user, void *state, uint32_t from, uint32_t to)
{
    for (uint32_t i = from; i < to; i++)
        gather_element(user, state, i);
}

void lamps_gather(const struct patches *p, uint32_t points, int threads, double (*out)[3])
{
    const struct scene *scene = p->job->scene;
    const struct rgbft b = scene->background;
    struct gather g = {p, points, out,
                       scene->sky ||
                           (scene->has_background && (b.r != 0 || b.g != 0 || b.b != 0))};
    memset(out, 0, p->element_count * sizeof *out);
    if (!p->job->lamp_count && !g.sky)
        return;
    if (g.sky)
        g.points = 16 * points;
    const struct parallel run = {.threads = threads,
                                 .piece = 64,
                                 .watch = p->settings.watch,
                                 .tells = true,
                                 .user = &g,
                                 .begin = begin,
                                 .end = end,
                                 .work = work};
    parallel_run(&run, p->element_count);
}
