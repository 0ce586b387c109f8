// Light in the open, for media: what a grid of points sees of the patches.
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "radiosity/radiosity.h"
#include "radiosity/ray_put.h"
#include "radiosity/sequence.h"
#include "scene/effects.h"
#include "scene/texture.h"
#include "trace/sky.h"
#include "trace/tracer.h"

enum {
    CELLS = 16,            // along the longest side
    RAYS = 256,            // of a cell
    LAMP_POINTS = 256,     // of all emitters, looked at from a cell
    LAMP_LEAST = 4,        // of each
    BEAMS = OPEN_BEAMS / 8 // of a cell
};

// What reaches a cell's middle, as struct open_light.
struct cell_light {
    double all[3];
    struct vec3 from[3];
    struct open_beam beam[BEAMS];
    uint32_t beam_count;
    bool known; // false: within something
};

struct volume {
    struct aabb box;
    uint32_t n[3];
    struct vec3 step;
    struct cell_light *light; // at the cells' middles
};

// ---- where media are -----------------------------------------------------------------
static bool scatters(const struct media *const *media, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (media[i]->scattering_type && rgb_max(media[i]->scattering) > 0)
            return true;
    return false;
}

// Empty: nowhere.
static struct aabb media_box(const struct job *job)
{
    const struct world *w = job->world;
    struct aabb all = aabb_empty(), limit = aabb_add(w->bounds, job->camera->location);
    if (scatters(job->scene->media, job->scene->media_count))
        all = limit;
    for (uint32_t i = 0; i < w->leaf_count; i++) {
        const struct interior *in = w->surface[w->leaf[i].surface].interior;
        if (scatters(in->media, in->media_count))
            all = aabb_join(all, aabb_meet(w->object[w->leaf[i].object].bounds, limit));
    }
    return all;
}

// ---- what a point sees -----------------------------------------------------------------
static void add(struct cell_light *to, struct vec3 d, const double radiance[3],
                double weight)
{
    for (int c = 0; c < 3; c++) {
        to->all[c] += weight * radiance[c];
        to->from[c] = vec3_mad(to->from[c], weight * radiance[c], d);
    }
}

// What patches reflect, and give off unless they are looked at by themselves, and the sky.
// Returns whether the point lies in the open: not most of what it sees is without light.
static bool look_around(const struct radiosity *r, struct tracer *t, struct vec3 o,
                        uint32_t seed, struct cell_light *out)
{
    const struct patches *p = r->patches;
    uint32_t dark = 0;
    for (uint32_t k = 0; k < RAYS; k++) {
        double x[4], own[3], b[3] = {0, 0, 0};
        sobol_point(k, seed, x);
        const double z = 1 - 2 * x[0], rho = sqrt(fmax(0, 1 - z * z)),
                     angle = 2 * PI * x[1];
        const struct vec3 d = vec3(rho * det_cos(angle), rho * det_sin(angle), z);
        const struct ray_query q = {{o, d, 0, INFINITY}, OBJECT_NO_RADIOSITY};
        const struct hit hit = trace_closest_1(p->job->world, t->scratch, &q);
        if (hit.b.t < INFINITY) {
            const uint32_t e = patch_of_hit(p, t->scratch, &q.ray, &hit);
            if (e == ELEMENT_NONE) {
                dark++;
                continue;
            }
            element_emission(&p->element[e], own);
            for (int c = 0; c < 3; c++)
                b[c] = r->solution.b[e][c] - (r->emitter_count ? own[c] : 0);
        } else {
            float clear;
            const struct rgb sky = sky_color(p->job, d, true, &clear);
            b[0] = (double)sky.r, b[1] = (double)sky.g, b[2] = (double)sky.b;
        }
        add(out, d, b, 4.0 / RAYS);
    }
    return 2 * dark < RAYS;
}

// The light of an emitter: as part of a beam if it comes from about one direction, else as light
// from all around. Where there are too many beams it is that, too.
static void add_seen(struct cell_light *to, struct vec3 sum, double weight,
                     const double radiance[3])
{
    static const double narrow =
        0.97; // length of the mean direction: a disc 40 degrees wide
    static const double same = 0.95; // cosine of 18 degrees
    const double length = vec3_length(sum);
    if (!(length > 0))
        return;
    const struct vec3 d = vec3_scale(1 / length, sum);
    uint32_t k = 0;
    while (k < to->beam_count && vec3_dot(to->beam[k].to, d) < same)
        k++;
    if (k == BEAMS || length < narrow * weight) {
        for (int c = 0; c < 3; c++) {
            to->all[c] += weight * radiance[c];
            to->from[c] = vec3_mad(to->from[c], radiance[c], sum);
        }
        return;
    }
    struct open_beam *b = &to->beam[k];
    if (k == to->beam_count)
        to->beam[to->beam_count++] = (struct open_beam){.to = d};
    const double before = b->light[0] + b->light[1] + b->light[2],
                 more = weight * (radiance[0] + radiance[1] + radiance[2]);
    if (before + more > 0)
        b->to = vec3_normalize(vec3_add(vec3_scale(before, b->to), vec3_scale(more, d)));
    for (int c = 0; c < 3; c++)
        b->light[c] += weight * radiance[c];
}

// What an emitter gives, from points of it.
static void look_at(const struct radiosity *r, struct tracer *t, struct vec3 o,
                    const struct emitter *e, uint32_t seed, struct cell_light *out)
{
    const struct patches *p = r->patches;
    const uint32_t share = LAMP_POINTS / r->emitter_count;
    const uint32_t count = share > LAMP_LEAST ? share : LAMP_LEAST;
    const double power = e->e.area / (PI * count), near = e->e.area / count;
    double own[3], all = 0;
    struct vec3 sum = {0, 0, 0};
    element_emission(&e->e, own);
    for (uint32_t k = 0; k < count; k++) {
        struct element_point at;
        double x[4];
        sobol_point(k, seed, x);
        if (!patch_cell_point(p, t->scratch, &e->at, e->side, e->e.partial, x[0], x[1],
                              &at))
            continue;
        const struct vec3 d = vec3_sub(point_lifted(&at), o);
        const double r2 = vec3_dot(d, d), length = sqrt(r2),
                     cosine = -vec3_dot(d, at.normal) / length;
        const struct ray_query q = {{o, d, 0, SHORT_OF_EMITTER}, OBJECT_NO_RADIOSITY};
        if (!(cosine > 0) || trace_occluded_1(p->job->world, t->scratch, &q))
            continue;
        // Nearer than the points lie to each other one of them has no bound.
        const double weight = power * cosine / fmax(r2, near);
        all += weight;
        sum = vec3_mad(sum, weight / length, d);
    }
    add_seen(out, sum, all, own);
}

static void *begin(void *user)
{
    const struct radiosity *r = user;
    return tracer_new(r->patches->job);
}

static void end(void *user, void *state)
{
    (void)user;
    tracer_free(state);
}

static void cells(void *user, void *state, uint32_t from, uint32_t to)
{
    const struct radiosity *r = user;
    const struct volume *v = r->volume;
    for (uint32_t i = from; i < to; i++) {
        const double at[3] = {i % v->n[0] + .5, i / v->n[0] % v->n[1] + .5,
                              i / v->n[0] / v->n[1] + .5};
        const struct vec3 o = vec3_add(
            v->box.min, vec3(at[0] * v->step.x, at[1] * v->step.y, at[2] * v->step.z));
        v->light[i].known = look_around(r, state, o, i, &v->light[i]);
        for (uint32_t k = 0; k < r->emitter_count && v->light[i].known; k++)
            look_at(r, state, o, &r->emitter[k], sequence_seed(i, k), &v->light[i]);
    }
}

void volume_find(struct radiosity *r)
{
    const struct job *job = r->patches->job;
    const struct aabb box = job->has_media ? media_box(job) : aabb_empty();
    if (aabb_is_empty(box) || !aabb_is_finite(box))
        return;
    struct volume *v = must_calloc(1, sizeof *v);
    const struct vec3 size = vec3_sub(box.max, box.min);
    const double cell = fmax(size.x, fmax(size.y, size.z)) / CELLS;
    for (int k = 0; k < 3; k++)
        v->n[k] = (uint32_t)fmax(1, ceil(vec3_axis(size, k) / cell - 1e-9));
    v->box = box;
    v->step = vec3(size.x / v->n[0], size.y / v->n[1], size.z / v->n[2]);
    const uint32_t count = v->n[0] * v->n[1] * v->n[2];
    v->light = must_calloc(count, sizeof *v->light);
    r->volume = v;
    const struct parallel run = {.threads = r->settings.solver.threads,
                                 .piece = 16,
                                 .watch = r->settings.watch,
                                 .user = r,
                                 .begin = begin,
                                 .end = end,
                                 .work = cells};
    parallel_run(&run, count);
}

void volume_free(struct volume *v)
{
    if (!v)
        return;
    free(v->light);
    free(v);
}

// ---- between the cells -----------------------------------------------------------------
// The two cells beside a place along an axis, and how far it is from the first.
static double beside(const struct volume *v, int axis, double at, uint32_t cell[2])
{
    const double x = (at - vec3_axis(v->box.min, axis)) / vec3_axis(v->step, axis) - .5;
    const double last = v->n[axis] - 1, low = fmin(fmax(x, 0), last), first = floor(low);
    cell[0] = (uint32_t)first;
    cell[1] = cell[0] + (first < last);
    return low - first;
}

static void cell_add(struct open_light *out, const struct cell_light *cell, double weight)
{
    for (int c = 0; c < 3; c++) {
        out->all[c] += weight * cell->all[c];
        out->from[c] = vec3_mad(out->from[c], weight, cell->from[c]);
    }
    for (uint32_t k = 0; k < cell->beam_count && weight > 0; k++) {
        struct open_beam *b = &out->beam[out->beam_count++];
        *b = cell->beam[k];
        for (int c = 0; c < 3; c++)
            b->light[c] *= weight;
    }
}

void volume_light(const struct volume *v, struct vec3 p, struct open_light *out)
{
    uint32_t cell[3][2];
    double share[3], sum = 0;
    memset(out->all, 0, sizeof out->all);
    memset(out->from, 0, sizeof out->from);
    out->beam_count = 0;
    for (int k = 0; k < 3; k++)
        share[k] = beside(v, k, vec3_axis(p, k), cell[k]);
    for (int k = 0; k < 8; k++) {
        const int i = k & 1, j = k >> 1 & 1, m = k >> 2;
        const uint32_t at = (cell[2][m] * v->n[1] + cell[1][j]) * v->n[0] + cell[0][i];
        const double weight = (i ? share[0] : 1 - share[0]) *
                              (j ? share[1] : 1 - share[1]) *
                              (m ? share[2] : 1 - share[2]);
        if (v->light[at].known) {
            sum += weight;
            cell_add(out, &v->light[at], weight);
        }
    }
    if (!(sum > 0))
        return;
    for (int c = 0; c < 3; c++) {
        out->all[c] /= sum;
        out->from[c] = vec3_scale(1 / sum, out->from[c]);
        for (uint32_t k = 0; k < out->beam_count; k++)
            out->beam[k].light[c] /= sum;
    }
}
