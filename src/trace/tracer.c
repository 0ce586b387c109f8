#include "trace/tracer.h"
#include "trace/area.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "trace/inside.h"
#include "trace/media.h"
#include "trace/mesh_samples.h"
#include "trace/paint.h"
#include "trace/photons.h"
#include "trace/shade_kernel.h"
#include "trace/simple.h"
#include "trace/wave.h"

// Rays that start at their origin and end nowhere.
static struct ray_batch *endless_new(void)
{
    struct ray_batch *b = ray_batch_new(BATCH_SIZE);
    for (uint32_t i = 0; i < b->capacity; i++) {
        b->t_min[i] = 0;
        b->t_max[i] = INFINITY;
        b->hidden_by[i] = 0;
    }
    return b;
}

static void near_photons_init(struct tracer *t)
{
    const bool gathers = t->job->settings.purpose == RENDER_GATHER;
    const enum photon_use use = gathers ? PHOTON_SAMPLE : PHOTON_PICTURE;
    t->near_photons = photon_near_new(t->job->photons->gather[use].max, use);
}

struct tracer *tracer_new(const struct job *job)
{
    struct tracer *t = must_align(_Alignof(struct tracer), 1, sizeof *t);
    memset(t, 0, sizeof *t);
    t->job = job;
    t->scratch = trace_scratch_new(job->world);
    t->arena = arena_new(64 * 1024);
    t->camera_arena = arena_new(1024);
    t->rays = endless_new();
    t->hit = hit_batch_new(BATCH_SIZE);
    shadow_init(t);
    area_init(t);
    simple_init(t);
    paint_init(t);
    if (job->quiet)
        t->settled = must_calloc(BATCH_SIZE, sizeof *t->settled);
    if (job->settings.indirect.begin)
        t->indirect = job->settings.indirect.begin(job->settings.indirect.data);
    media_init(t);
    if (job->subsurface) {
        t->wall_rays = endless_new();
        t->wall_hit = hit_batch_new(BATCH_SIZE);
    }
    if (job->photons)
        near_photons_init(t);
    if (camera_has_one_eye(job->camera))
        t->camera_inside = inside_at(t->camera_arena, job->world, job->camera->location);
    else if (job->quick_camera)
        t->eye_inside = must_calloc(BATCH_SIZE, sizeof *t->eye_inside);
    return t;
}

void tracer_free(struct tracer *t)
{
    if (t->job->settings.indirect.end)
        t->job->settings.indirect.end(t->indirect);
    trace_scratch_free(t->scratch);
    arena_free(t->arena);
    arena_free(t->camera_arena);
    ray_batch_free(t->rays);
    ray_batch_free(t->wall_rays);
    wave_frames_free(t->frame);
    path_queue_free(&t->camera_queue);
    shadow_end(t);
    area_end(t);
    simple_end(t);
    media_end(t);
    photon_near_free(t->near_photons);
    free(t->eye_inside);
    free(t->settled);
    paint_end(t);
    hit_batch_free(t->hit);
    hit_batch_free(t->wall_hit);
    free(t->sum);
    free(t->power);
    free(t);
}

static void begin(struct tracer *t, uint32_t count)
{
    arena_reset(t->arena);
    t->last_push = (struct inside_pushed){0};
    t->sum_count = 0;
    t->samples += count;
}

static void results(const struct tracer *t, uint32_t count, float (*out)[4])
{
    for (uint32_t i = 0; i < count; i++) {
        const struct sample_sum *s = &t->sum[i];
        out[i][0] = s->light.r;
        out[i][1] = s->light.g;
        out[i][2] = s->light.b;
        out[i][3] = s->t;
    }
}

// What may be around the origins of rays.
static struct objects_around around_rays(const struct tracer *t,
                                         const struct tracer_ray *ray, uint32_t count)
{
    struct aabb box = aabb_empty();
    for (uint32_t i = 0; i < count; i++)
        if (ray[i].exists)
            box = aabb_add(box, ray[i].ray.o);
    return objects_around(t->job->world, box);
}

static void rays_run(struct tracer *t, const struct tracer_ray *ray, uint32_t count)
{
    const bool one_eye = camera_has_one_eye(t->job->camera);
    struct objects_around around;
    if (!one_eye)
        around = around_rays(t, ray, count);
    begin(t, count);
    wave_sums_grow(t, count);
    t->camera_queue.count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (!ray[i].exists) {
            t->sum[i].t = 1;
            continue;
        }
        struct path *p = path_queue_add(&t->camera_queue);
        *p = (struct path){.o = ray[i].ray.o,
                           .d = ray[i].ray.d,
                           .through = {1, 1, 1},
                           .through_t = 1,
                           .weight = 1,
                           .flags = ray[i].flags,
                           .sample = i,
                           .hash = tracer_position_hash(ray[i].position)};
        p->inside = one_eye ? t->camera_inside
                            : inside_among(t->arena, t->job->world, &around, p->o);
    }
    wave_run(t, &t->camera_queue);
}

void tracer_rays(struct tracer *t, const struct tracer_ray *ray, uint32_t count,
                 float (*out)[4])
{
    rays_run(t, ray, count);
    results(t, count, out);
}

struct path *tracer_paths_room(struct tracer *t, uint32_t count)
{
    struct path_queue *q = &t->camera_queue;
    const uint32_t first = q->count;
    path_queue_reserve(q, count);
    q->count += count;
    for (uint32_t i = first; i < q->count; i++)
        q->order[i] = i;
    return q->at + first;
}

const struct sample_sum *tracer_paths(struct tracer *t, struct first_hit *first)
{
    struct path_queue *q = &t->camera_queue;
    begin(t, q->count);
    wave_sums_grow(t, q->count);
    t->first = first;
    t->first_level = q->count ? q->at[0].level : 0;
    wave_run(t, q);
    t->first = NULL;
    q->count = 0;
    return t->sum;
}

static void samples_one_by_one(struct tracer *t, const struct vec2 *position,
                               const struct vec2 *on_lens, uint32_t count)
{
    struct tracer_ray ray[BATCH_SIZE];
    const struct render_settings *s = &t->job->settings;
    const struct camera *c = t->job->camera;
    struct camera_lens lens;
    if (on_lens)
        lens = camera_lens_of(c);
    for (uint32_t i = 0; i < count; i++) {
        const struct vec2 at = ray[i].position = position[i];
        ray[i].flags = 0;
        ray[i].exists = on_lens
                            ? camera_lens_ray(c, &lens, at.u, at.v, s->width, s->height,
                                              on_lens[i], &ray[i].ray)
                            : camera_ray(c, at.u, at.v, s->width, s->height, &ray[i].ray);
    }
    rays_run(t, ray, count);
}

// The interiors around the eyes of the rays that the camera's kernel made.
static void eyes_look(struct tracer *t, uint32_t count)
{
    const struct ray_batch *b = t->rays;
    struct aabb box = aabb_empty();
    for (uint32_t i = 0; i < count; i++)
        box = aabb_add(box, vec3(b->o[0][i], b->o[1][i], b->o[2][i]));
    const struct objects_around around = objects_around(t->job->world, box);
    for (uint32_t i = 0; i < count; i++)
        t->eye_inside[i] = inside_among(t->arena, t->job->world, &around,
                                        vec3(b->o[0][i], b->o[1][i], b->o[2][i]));
}

// The camera's rays are made and traced as if they were all; what they see is put where
// their positions are. Where there is no ray nothing is seen.
static void run_with_gaps(struct tracer *t, const struct vec2 *position, uint32_t count,
                          const uint16_t *place, uint32_t made)
{
    struct vec2 kept[BATCH_SIZE];
    for (uint32_t i = 0; i < made; i++)
        kept[i] = position[place[i]];
    wave_run_camera(t, kept, made);
    for (uint32_t i = count, k = made; i-- > 0;)
        t->sum[i] = k && place[k - 1] == i ? t->sum[--k] : (struct sample_sum){.t = 1};
}

// Rays in the order in which a wave sorts them.
static bool is_in_order(const struct ray_batch *b, uint32_t count)
{
    unsigned turned = 0;
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 1; i < count; i++)
            turned |= (unsigned)((b->d[k][i] < 0) != (b->d[k][0] < 0));
    return !turned;
}

// Makes the rays of the camera eight at a time; false: they are to be made one by one, since
// samples are taken in the order in which hits ask, which is that of the rays' octants.
static bool make_rays(struct tracer *t, const struct vec2 *position,
                      const struct vec2 *on_lens, uint32_t count, uint16_t *place,
                      uint32_t *made)
{
    const struct job *job = t->job;
    if (!job->quick_camera)
        return false;
    *made = job->kernels->camera(job, position, on_lens, count, t->rays, place);
    return job->settings.purpose != RENDER_SCOUT || is_in_order(t->rays, *made);
}

const struct sample_sum *tracer_batch(struct tracer *t, const struct vec2 *position,
                                      const struct vec2 *on_lens, uint32_t count)
{
    uint16_t place[BATCH_SIZE];
    uint32_t made;
    if (tracer_gives_up(t)) {
        wave_sums_reserve(t, count);
        memset(t->sum, 0, count * sizeof *t->sum);
    } else if (make_rays(t, position, on_lens, count, place, &made)) {
        begin(t, count);
        wave_sums_reserve(t, count); // all are set by the camera's wave
        if (t->eye_inside)
            eyes_look(t, made);
        if (made < count)
            run_with_gaps(t, position, count, place, made);
        else
            wave_run_camera(t, position, count);
    } else {
        samples_one_by_one(t, position, on_lens, count);
    }
    return t->sum;
}

void tracer_samples(struct tracer *t, const struct vec2 *position, uint32_t count,
                    float (*out)[4])
{
    if (t->job->camera->mesh) {
        mesh_samples(t, position, count, out);
        return;
    }
    for (uint32_t first = 0; first < count; first += BATCH_SIZE) {
        const uint32_t n = count - first < BATCH_SIZE ? count - first : BATCH_SIZE;
        tracer_batch(t, position + first, NULL, n);
        results(t, n, out + first);
    }
}
