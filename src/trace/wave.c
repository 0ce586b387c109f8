#include <stdlib.h>

#include "base/arena.h"
#include "math/elementary.h"
#include "trace/inside.h"
#include "trace/tracer.h"

// A generation with more rays than this is traced in pieces, so that memory stays
// bounded however strongly rays branch. Pieces are whole samples, or, of one sample
// that alone has more, parts of fixed size: either way the order in which a sample's
// light is added up does not depend on its neighbours.
enum { WAVE_MAX = 8192 };

struct wave_frame {
    struct path_queue next[2];
    struct wave_frame *deeper;
};

static void *grow(void *at, uint32_t *capacity, size_t size)
{
    *capacity = *capacity ? 2 * *capacity : 256;
    at = realloc(at, *capacity * size);
    if (!at)
        abort();
    return at;
}

struct path *path_queue_add(struct path_queue *q)
{
    if (q->count == q->capacity)
        q->at = grow(q->at, &q->capacity, sizeof *q->at);
    return &q->at[q->count++];
}

void path_emit(struct tracer *t, struct path_queue *next, const struct path *path)
{
    if (path->level < t->job->max_level && path->weight >= t->job->adc_bailout)
        *path_queue_add(next) = *path;
}

void power_emit(struct tracer *t, const struct path *path, struct rgb factor,
                float exponent)
{
    if (path->level >= t->job->max_level || path->weight < t->job->adc_bailout)
        return;
    if (t->power_count == t->power_capacity)
        t->power = grow(t->power, &t->power_capacity, sizeof *t->power);
    t->power[t->power_count++] =
        (struct power_request){*path, factor, exponent, path->sample};
}

void tracer_add(struct tracer *t, uint32_t sample, struct rgb c)
{
    struct sample_sum *s = &t->sum[sample];
    s->local = rgb_add(s->local, c);
}

static void sums_grow(struct tracer *t, uint32_t count)
{
    while (t->sum_count + count > t->sum_capacity)
        t->sum = grow(t->sum, &t->sum_capacity, sizeof *t->sum);
    for (uint32_t i = 0; i < count; i++)
        t->sum[t->sum_count + i] = (struct sample_sum){0};
    t->sum_count += count;
}

static void batch_put(struct ray_batch *b, uint32_t i, const struct path *p)
{
    b->o[0][i] = p->o.x;
    b->o[1][i] = p->o.y;
    b->o[2][i] = p->o.z;
    b->d[0][i] = p->d.x;
    b->d[1][i] = p->d.y;
    b->d[2][i] = p->d.z;
    b->t_min[i] = 0;
    b->t_max[i] = INFINITY;
    b->hidden_by[i] = p->flags & PATH_REFLECTED ? OBJECT_NO_REFLECTION : OBJECT_NO_IMAGE;
}

static float powered(float c, float exponent)
{
    return c > 0 ? (float)det_pow(c, exponent) : 0;
}

// Mirrored light with an exponent is not linear in what the mirror sees: these rays
// are traced to the end on their own and then added.
static void powers_run(struct tracer *t)
{
    const uint32_t count = t->power_count, base = t->sum_count;
    struct power_request *request = t->power;
    t->power = NULL;
    t->power_count = t->power_capacity = 0;
    sums_grow(t, count);
    struct path_queue queue = {0};
    for (uint32_t i = 0; i < count; i++) {
        struct path *p = path_queue_add(&queue);
        *p = request[i].path;
        p->sample = base + i;
    }
    wave_run(t, &queue);
    for (uint32_t i = 0; i < count; i++) {
        const struct sample_sum *s = &t->sum[base + i];
        const struct rgb c = rgb_add(s->local, s->lit);
        const float e = request[i].exponent;
        tracer_add(t, request[i].sample,
                   rgb_mul(request[i].factor,
                           rgb(powered(c.r, e), powered(c.g, e), powered(c.b, e))));
    }
    t->sum_count = base;
    free(queue.at);
    free(request);
}

static void generation(struct tracer *t, const struct path *path, uint32_t count,
                       struct path_queue *next)
{
    for (uint32_t begin = 0; begin < count; begin += BATCH_SIZE) {
        const uint32_t n = count - begin < BATCH_SIZE ? count - begin : BATCH_SIZE;
        for (uint32_t i = 0; i < n; i++)
            batch_put(t->rays, i, &path[begin + i]);
        t->rays->count = n;
        trace_closest(t->job->world, t->scratch, t->rays, t->hit);
        for (uint32_t i = 0; i < n; i++) {
            if (t->hit[i].b.t < INFINITY)
                shade_hit(t, &path[begin + i], &t->hit[i], next);
            else
                shade_miss(t, &path[begin + i]);
        }
    }
    shadow_flush(t);
    if (t->power_count)
        powers_run(t);
}

// How many of the rays from `begin` on make the next piece.
static uint32_t piece(const struct path_queue *q, uint32_t begin)
{
    const uint32_t left = q->count - begin;
    if (left <= WAVE_MAX)
        return left;
    const uint32_t first = q->at[begin].sample;
    uint32_t end = begin + WAVE_MAX;
    if (q->at[end].sample == first)
        return WAVE_MAX; // a part of one sample; its rest may join the next piece
    while (q->at[end].sample == q->at[end - 1].sample)
        end--;
    return end - begin;
}

static void frame_run(struct tracer *t, struct wave_frame **slot, struct path *path,
                      uint32_t count)
{
    if (!*slot && !(*slot = calloc(1, sizeof **slot)))
        abort();
    struct wave_frame *f = *slot;
    int turn = 0;
    while (count) {
        struct path_queue *next = &f->next[turn];
        next->count = 0;
        generation(t, path, count, next);
        if (next->count > WAVE_MAX) {
            for (uint32_t i = 0, n; i < next->count; i += n) {
                n = piece(next, i);
                frame_run(t, &f->deeper, next->at + i, n);
            }
            return;
        }
        path = next->at;
        count = next->count;
        turn = !turn;
    }
}

void wave_run(struct tracer *t, struct path_queue *queue)
{
    struct wave_frame *frame = NULL;
    for (uint32_t i = 0, n; i < queue->count; i += n) {
        n = piece(queue, i);
        frame_run(t, &frame, queue->at + i, n);
    }
    while (frame) {
        struct wave_frame *deeper = frame->deeper;
        free(frame->next[0].at);
        free(frame->next[1].at);
        free(frame);
        frame = deeper;
    }
}

struct tracer *tracer_new(const struct job *job)
{
    struct tracer *t = calloc(1, sizeof *t);
    if (!t)
        abort();
    t->job = job;
    t->scratch = trace_scratch_new(job->world);
    t->arena = arena_new(64 * 1024);
    t->camera_arena = arena_new(1024);
    t->rays = ray_batch_new(BATCH_SIZE);
    t->shadow_rays = ray_batch_new(BATCH_SIZE);
    t->hit = calloc(BATCH_SIZE, sizeof *t->hit);
    t->occluded = calloc(BATCH_SIZE, 1);
    t->shadow = calloc(BATCH_SIZE, sizeof *t->shadow);
    t->shadow_order = calloc(BATCH_SIZE, sizeof *t->shadow_order);
    t->lamp_begin = calloc(job->lamp_count + 1, sizeof *t->lamp_begin);
    if (!t->hit || !t->occluded || !t->shadow || !t->shadow_order || !t->lamp_begin)
        abort();
    if (camera_has_one_eye(job->camera))
        t->camera_inside = inside_at(t->camera_arena, job->world, job->camera->location);
    return t;
}

void tracer_free(struct tracer *t)
{
    trace_scratch_free(t->scratch);
    arena_free(t->arena);
    arena_free(t->camera_arena);
    ray_batch_free(t->rays);
    ray_batch_free(t->shadow_rays);
    free(t->hit);
    free(t->occluded);
    free(t->shadow);
    free(t->shadow_order);
    free(t->lamp_begin);
    free(t->sum);
    free(t->power);
    free(t);
}

// The random numbers of a sample depend on its place alone.
static uint32_t position_hash(struct vec2 p)
{
    // 1/1024 of a pixel tells all sample places apart.
    const int32_t x = (int32_t)floor(p.u * 1024), y = (int32_t)floor(p.v * 1024);
    return hash_mix(hash_mix(1, (uint32_t)x), (uint32_t)y);
}

void tracer_rays(struct tracer *t, const struct tracer_ray *ray, uint32_t count,
                 float (*out)[4])
{
    arena_reset(t->arena);
    t->sum_count = 0;
    sums_grow(t, count);
    struct path_queue queue = {0};
    for (uint32_t i = 0; i < count; i++) {
        if (!ray[i].exists) {
            t->sum[i].t = 1;
            continue;
        }
        struct path *p = path_queue_add(&queue);
        *p = (struct path){.o = ray[i].ray.o,
                           .d = ray[i].ray.d,
                           .through = {1, 1, 1},
                           .through_t = 1,
                           .weight = 1,
                           .sample = i,
                           .hash = position_hash(ray[i].position)};
        p->inside = camera_has_one_eye(t->job->camera)
                        ? t->camera_inside
                        : inside_at(t->arena, t->job->world, p->o);
    }
    wave_run(t, &queue);
    free(queue.at);
    for (uint32_t i = 0; i < count; i++) {
        const struct sample_sum *s = &t->sum[i];
        const struct rgb c = rgb_add(s->local, s->lit);
        out[i][0] = c.r;
        out[i][1] = c.g;
        out[i][2] = c.b;
        out[i][3] = s->t;
    }
    t->samples += count;
}

void tracer_samples(struct tracer *t, const struct vec2 *position, uint32_t count,
                    float (*out)[4])
{
    struct tracer_ray ray[BATCH_SIZE];
    const struct render_settings *s = &t->job->settings;
    for (uint32_t begin = 0; begin < count; begin += BATCH_SIZE) {
        const uint32_t n = count - begin < BATCH_SIZE ? count - begin : BATCH_SIZE;
        for (uint32_t i = 0; i < n; i++) {
            const struct vec2 p = position[begin + i];
            ray[i].position = p;
            ray[i].exists =
                camera_ray(t->job->camera, p.u, p.v, s->width, s->height, &ray[i].ray);
        }
        tracer_rays(t, ray, n, out + begin);
    }
}
