#include "trace/wave.h"

#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/elementary.h"
#include "trace/area.h"
#include "trace/coincident.h"
#include "trace/paint.h"
#include "trace/scout.h"
#include "trace/shade_kernel.h"
#include "trace/simple.h"
#include "trace/sky.h"

// A generation with more rays than this is traced in pieces, so that memory stays
// bounded however strongly rays branch. Pieces are whole samples, or, of one sample
// that alone has more, parts of fixed size: either way the order in which a sample's
// light is added up does not depend on its neighbours.
enum { WAVE_MAX = 8192 };

struct wave_frame {
    struct path_queue next[2];
    struct wave_frame *deeper;
};

void wave_sums_reserve(struct tracer *t, uint32_t count)
{
    t->sum_count += count;
    if (t->sum_count > t->sum_capacity) {
        t->sum_capacity = 2 * t->sum_count;
        t->sum = must_realloc(t->sum, t->sum_capacity, sizeof *t->sum);
    }
}

void wave_sums_grow(struct tracer *t, uint32_t count)
{
    wave_sums_reserve(t, count);
    memset(t->sum + t->sum_count - count, 0, count * sizeof *t->sum);
}

static float powered(float c, float exponent)
{
    return c > 0 ? (float)det_pow_single(c, exponent) : 0;
}

// Mirrored light with an exponent is not linear in what the mirror sees: these rays
// are traced to the end on their own and then added.
static void powers_run(struct tracer *t)
{
    const uint32_t count = t->power_count, base = t->sum_count;
    struct power_request *request = t->power;
    struct wave_frame *frame = t->frame;
    t->power = NULL;
    t->frame = NULL;
    t->power_count = t->power_capacity = 0;
    wave_sums_grow(t, count);
    struct path_queue queue = {0};
    for (uint32_t i = 0; i < count; i++) {
        struct path *p = path_queue_add(&queue);
        *p = request[i].path;
        p->sample = base + i;
    }
    wave_run(t, &queue);
    wave_frames_free(t->frame);
    t->frame = frame;
    for (uint32_t i = 0; i < count; i++) {
        const struct rgb c = t->sum[base + i].light;
        const float e = request[i].exponent;
        struct sample_sum *s = &t->sum[request[i].sample];
        s->light = rgb_add(
            s->light, rgb_mul(request[i].factor,
                              rgb(powered(c.r, e), powered(c.g, e), powered(c.b, e))));
    }
    t->sum_count = base;
    path_queue_free(&queue);
    free(request);
}

// ---- batches --------------------------------------------------------------

struct path wave_path(const struct tracer *t, uint32_t slot)
{
    const struct wavefront *w = &t->wave;
    if (w->path) {
        struct path p = w->path[w->order[slot]];
        if (t->job->has_air) {
            p.through =
                rgb(w->through[0][slot], w->through[1][slot], w->through[2][slot]);
            p.through_t = w->through_t[slot];
        }
        return p;
    }
    return (struct path){
        .o = {t->rays->o[0][slot], t->rays->o[1][slot], t->rays->o[2][slot]},
        .d = {t->rays->d[0][slot], t->rays->d[1][slot], t->rays->d[2][slot]},
        .inside = wave_inside(t, slot),
        .through = {w->through[0][slot], w->through[1][slot], w->through[2][slot]},
        .through_t = t->job->has_air ? w->through_t[slot] : 1,
        .weight = 1,
        .sample = slot,
        .hash = tracer_position_hash(w->position[slot])};
}

uint32_t wave_hash(const struct tracer *t, uint32_t slot)
{
    const struct wavefront *w = &t->wave;
    return w->path ? w->path[w->order[slot]].hash
                   : tracer_position_hash(w->position[slot]);
}

const struct inside *wave_inside(const struct tracer *t, uint32_t slot)
{
    const struct wavefront *w = &t->wave;
    return w->path         ? w->path[w->order[slot]].inside
           : t->eye_inside ? t->eye_inside[slot]
                           : t->camera_inside;
}

static void miss_add(struct tracer *t, uint32_t slot, struct rgb c, float clear)
{
    struct wavefront *w = &t->wave;
    const float through_t = w->path || t->job->has_air ? w->through_t[slot] : 1;
    t->slot = slot;
    tracer_add(
        t,
        rgb_mul(rgb(w->through[0][slot], w->through[1][slot], w->through[2][slot]), c));
    w->t[slot] += through_t * clear;
}

// Rays that see the sky, until there are eight.
struct misses {
    double d[3][8];
    bool opaque[8];
    uint16_t slot[8];
    uint32_t count;
};

static void misses_shade(struct tracer *t, struct misses *m)
{
    struct rgb c[8];
    float clear[8];
    for (uint32_t i = m->count; i < 8; i++)
        for (int a = 0; a < 3; a++)
            m->d[a][i] = m->d[a][0];
    sky_colors(t->job, (const double(*)[8])m->d, m->count, m->opaque, c, clear);
    for (uint32_t i = 0; i < m->count; i++)
        miss_add(t, m->slot[i], c[i], clear[i]);
    m->count = 0;
}

static void misses_add(struct tracer *t, struct misses *m, uint32_t k)
{
    const struct ray_batch *b = t->rays;
    for (int a = 0; a < 3; a++)
        m->d[a][m->count] = b->d[a][k];
    m->opaque[m->count] = b->hidden_by[k] & OBJECT_NO_REFLECTION;
    m->slot[m->count++] = t->wave.slot[k];
    if (m->count == 8)
        misses_shade(t, m);
}

static void missed(struct tracer *t, uint32_t k)
{
    const struct job *job = t->job;
    const bool opaque = t->rays->hidden_by[k] & OBJECT_NO_REFLECTION;
    float clear = job->sky_clear[opaque];
    const struct rgb c = sky_color(
        job, vec3(t->rays->d[0][k], t->rays->d[1][k], t->rays->d[2][k]), opaque, &clear);
    miss_add(t, t->wave.slot[k], c, clear);
}

// The rays from k on, up to the first that is no miss, see the same sky; returns that.
static uint32_t missed_evenly(struct tracer *t, uint32_t k)
{
    const struct job *job = t->job;
    struct wavefront *w = &t->wave;
    const uint32_t count = w->count;
    const double *hit = t->hit->t;
    const unsigned *hidden_by = t->rays->hidden_by;
    const bool fades = w->path || job->has_air;
    for (; k < count && !(hit[k] < INFINITY); k++) {
        const uint32_t slot = w->slot[k];
        const bool opaque = hidden_by[k] & OBJECT_NO_REFLECTION;
        const struct rgb c = job->sky[opaque];
        w->own[0][slot] += w->through[0][slot] * c.r;
        w->own[1][slot] += w->through[1][slot] * c.g;
        w->own[2][slot] += w->through[2][slot] * c.b;
        w->t[slot] += (fades ? w->through_t[slot] : 1) * job->sky_clear[opaque];
    }
    return k;
}

static void sums_add(struct tracer *t)
{
    const struct wavefront *w = &t->wave;
    if (!w->path) { // the first light of samples 0 to count - 1
        t->job->kernels->sums(w, t->sum);
        return;
    }
    for (uint32_t i = 0; i < w->count; i++) {
        struct sample_sum *s = &t->sum[w->sample[i]];
        s->light = rgb_add(s->light,
                           rgb(w->own[0][i] + w->lit[0][i], w->own[1][i] + w->lit[1][i],
                               w->own[2][i] + w->lit[2][i]));
        s->t += w->t[i];
    }
}

// Keeps what the first rays of samples met.
static void first_keep(struct tracer *t)
{
    const struct wavefront *w = &t->wave;
    for (uint32_t k = 0; k < w->count; k++) {
        const struct path *p = &w->path[w->order[w->slot[k]]];
        if (p->level == t->first_level) {
            t->first[p->sample] = (struct first_hit){t->hit->t[k], t->hit->leaf[k]};
        }
    }
}

// Shades the hits of rays from k up to `end`, one by one.
static void shade_alone(struct tracer *t, uint32_t k, uint32_t end)
{
    for (; k < end; k++) {
        if ((t->settled && t->settled[k]) ||
            (t->job->collects ? paint_ask(t, k) : paint_take(t, k)))
            continue;
        t->slot = t->wave.slot[k];
        const struct path p = wave_path(t, t->slot);
        const struct hit hit = hit_batch_at(t->hit, k);
        shade_hit(t, &p, &hit);
    }
}

// The end of the row of rays from k on that hit one leaf, where there are media, inside the
// same interiors.
static uint32_t run_end(const struct tracer *t, uint32_t k)
{
    const struct wavefront *w = &t->wave;
    uint32_t end = k + 1;
    while (end < w->count && t->hit->leaf[end] == t->hit->leaf[k] &&
           t->hit->t[end] < INFINITY &&
           (!t->job->has_media ||
            wave_inside(t, w->slot[end]) == wave_inside(t, w->slot[k])))
        end++;
    return end;
}

// Traces and shades the rays of the batch.
static void wave_trace(struct tracer *t)
{
    struct wavefront *w = &t->wave;
    for (int k = 0; k < 3; k++) {
        memset(w->own[k], 0, w->count * sizeof w->own[k][0]);
        memset(w->lit[k], 0, w->count * sizeof w->lit[k][0]);
    }
    memset(w->t, 0, w->count * sizeof w->t[0]);
    const uint32_t first = w->next->count;
    struct misses sky = {.count = 0};
    trace_closest(t->job->world, t->scratch, t->rays, t->hit);
    if (t->job->world->has_coincident)
        coincident_hits(t->job->world, t->scratch, t->rays, t->hit);
    if (t->first)
        first_keep(t);
    if (t->job->has_air)
        air_wave(t);
    if (t->settled)
        scout_settle(t);
    if (t->job->collects)
        paint_first(t);
    for (uint32_t k = 0, end; k < w->count && !tracer_gives_up(t); k = end) {
        end = k + 1;
        if (!(t->hit->t[k] < INFINITY)) {
            if (t->job->even_sky)
                end = missed_evenly(t, k);
            else if (t->job->sky_tape)
                misses_add(t, &sky, k);
            else
                missed(t, k);
            continue;
        }
        end = run_end(t, k);
        if (!simple_take(t, k, end - k))
            shade_alone(t, k, end);
        else if (t->job->collects)
            simple_ask(t, k, end);
    }
    if (sky.count)
        misses_shade(t, &sky);
    paint_shade(t);
    simple_shade(t);
    shadow_flush(t);
    area_flush(t);
    sums_add(t);
    path_queue_sort(w->next, first);
}

// Traces rays of a generation; what they send on is appended to next.
static void generation(struct tracer *t, const struct path *path, const uint32_t *order,
                       uint32_t count, struct path_queue *next)
{
    struct wavefront *w = &t->wave;
    for (uint32_t begin = 0; begin < count && !tracer_gives_up(t); begin += BATCH_SIZE) {
        w->count = count - begin < BATCH_SIZE ? count - begin : BATCH_SIZE;
        w->path = path;
        w->order = order + begin;
        w->next = next;
        wave_put(t);
        wave_trace(t);
    }
    if (t->power_count)
        powers_run(t);
}

// How many of the rays from `begin` on make the next piece.
static uint32_t piece(const struct path_queue *q, uint32_t begin)
{
    const uint32_t left = q->count - begin;
    if (left <= WAVE_MAX)
        return left;
    const uint32_t first = q->at[q->order[begin]].sample;
    uint32_t end = begin + WAVE_MAX;
    if (q->at[q->order[end]].sample == first)
        return WAVE_MAX; // a part of one sample; its rest may join the next piece
    while (q->at[q->order[end]].sample == q->at[q->order[end - 1]].sample)
        end--;
    return end - begin;
}

static struct wave_frame *frame_at(struct wave_frame **slot)
{
    if (!*slot)
        *slot = must_calloc(1, sizeof **slot);
    return *slot;
}

static void frame_run(struct tracer *t, struct wave_frame **slot, const struct path *path,
                      const uint32_t *order, uint32_t count);

// Traces what a generation sent on, and all that comes of it.
static void next_run(struct tracer *t, struct wave_frame *f, int turn)
{
    for (;;) {
        const struct path_queue *q = &f->next[turn];
        if (q->count > WAVE_MAX) {
            for (uint32_t i = 0, n; i < q->count; i += n) {
                n = piece(q, i);
                frame_run(t, &f->deeper, q->at, q->order + i, n);
            }
            return;
        }
        if (!q->count)
            return;
        turn = !turn;
        f->next[turn].count = 0;
        generation(t, q->at, q->order, q->count, &f->next[turn]);
    }
}

static void frame_run(struct tracer *t, struct wave_frame **slot, const struct path *path,
                      const uint32_t *order, uint32_t count)
{
    struct wave_frame *f = frame_at(slot);
    f->next[0].count = 0;
    generation(t, path, order, count, &f->next[0]);
    next_run(t, f, 0);
}

void wave_frames_free(struct wave_frame *frame)
{
    while (frame) {
        struct wave_frame *deeper = frame->deeper;
        path_queue_free(&frame->next[0]);
        path_queue_free(&frame->next[1]);
        free(frame);
        frame = deeper;
    }
}

void wave_run(struct tracer *t, const struct path_queue *queue)
{
    for (uint32_t i = 0, n; i < queue->count; i += n) {
        n = piece(queue, i);
        frame_run(t, &t->frame, queue->at, queue->order + i, n);
    }
}

void wave_run_camera(struct tracer *t, const struct vec2 *position, uint32_t count)
{
    struct wave_frame *f = frame_at(&t->frame);
    struct wavefront *w = &t->wave;
    f->next[0].count = 0;
    w->count = t->rays->count = count;
    w->path = NULL;
    w->position = position;
    w->next = &f->next[0];
    for (uint32_t i = 0; i < count; i++) {
        w->slot[i] = (uint16_t)i;
        for (int k = 0; k < 3; k++)
            w->through[k][i] = 1;
    }
    wave_trace(t);
    if (t->power_count)
        powers_run(t);
    next_run(t, f, 0);
}
