// Light from lamps, as far as nothing is in its way.
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "trace/inside.h"
#include "trace/media.h"
#include "trace/shade_kernel.h"
#include "trace/shadow_list.h"
#include "trace/shadow_walk.h"
#include "trace/sky.h"

static const struct rgb none = {0, 0, 0}, all = {1, 1, 1};

// Whether something that fills the scene may dim the light of lamps.
static bool has_dimming_air(const struct job *job)
{
    return job->air && (job->scene->fog_count || job->has_air_media);
}

bool air_counts(const struct job *job, uint32_t lamp)
{
    const struct light *light = job->lamp[lamp].light;
    return light->media_attenuation && light->media_interaction && has_dimming_air(job);
}

// What passes of light that nothing stops and that the air dims.
static struct rgb airy(struct tracer *t, const struct inside *inside, struct vec3 o,
                       struct vec3 d, double length)
{
    return inside_hollow(inside) ? air_filter(t, o, d, length) : all;
}

struct rgb shadow_factor(struct tracer *t, const struct shadow_request *r)
{
    if (!(r->t_max > 0))
        return all;
    const struct ray_query q = {{r->o, r->d, 0, before_lamp * r->t_max},
                                OBJECT_NO_SHADOW};
    if (trace_occluded_1(t->job->world, t->scratch, &q))
        return none;
    const bool air = air_counts(t->job, r->lamp);
    if (t->job->world->has_transparent)
        return shadow_walk_alone(t, r, air);
    return air ? airy(t, r->inside, r->o, r->d, r->t_max) : all;
}

// ---- batches -------------------------------------------------------------------------

static struct ray_batch *shadow_rays_new(void)
{
    struct ray_batch *b = ray_batch_new(BATCH_SIZE);
    for (uint32_t i = 0; i < b->capacity; i++) {
        b->t_min[i] = 0;
        b->hidden_by[i] = OBJECT_NO_SHADOW;
    }
    return b;
}

void shadow_init(struct tracer *t)
{
    t->simple.rays = shadow_rays_new();
    t->rest.rays = shadow_rays_new();
    t->near.rays = shadow_rays_new();
    t->shadow = must_calloc(BATCH_SIZE, sizeof *t->shadow);
    t->shadow_order = must_calloc(BATCH_SIZE, sizeof *t->shadow_order);
    t->lamp_begin = must_calloc(t->job->lamp_count + 1, sizeof *t->lamp_begin);
    if (!t->job->world->has_transparent)
        return;
    t->simple.pass = must_calloc(BATCH_SIZE, sizeof *t->simple.pass);
    t->rest.pass = must_calloc(BATCH_SIZE, sizeof *t->rest.pass);
    t->near.pass = must_calloc(BATCH_SIZE, sizeof *t->near.pass);
    t->walk = shadow_walks_new();
    t->walk_hit = hit_batch_new(BATCH_SIZE);
    t->walk_rays = shadow_rays_new();
    if (t->job->lists_crossings)
        t->list = shadow_list_new();
}

void shadow_end(struct tracer *t)
{
    ray_batch_free(t->simple.rays);
    ray_batch_free(t->rest.rays);
    ray_batch_free(t->near.rays);
    ray_batch_free(t->walk_rays);
    free(t->simple.pass);
    free(t->rest.pass);
    free(t->near.pass);
    free(t->walk);
    shadow_list_free(t->list);
    hit_batch_free(t->walk_hit);
    free(t->shadow);
    free(t->shadow_order);
    free(t->lamp_begin);
}

// air_end[i]: see shadow_walk_batch.
static void batch_trace(struct tracer *t, struct shadow_batch *b, uint32_t count,
                        const double *air_end)
{
    b->rays->count = count;
    for (uint32_t i = 0; i < count; i++)
        b->rays->t_max[i] *= before_lamp;
    trace_occluded(t->job->world, t->scratch, b->rays, b->occluded);
    if (b->pass)
        shadow_walk_batch(t, b, count, air_end);
}

// What of light that nothing opaque stops gets past the rest along ray k of a batch.
static struct rgb rest_passes(struct tracer *t, const struct shadow_batch *b, uint32_t k,
                              double air_end)
{
    if (b->pass)
        return b->pass[k];
    if (!(air_end > 0))
        return all;
    const struct ray ray = ray_batch_at(b->rays, k);
    return airy(t, wave_inside(t, b->slot[k]), ray.o, ray.d, air_end);
}

// The same of all that nothing stops; air_end: NULL where no air dims.
static void rests_pass(struct tracer *t, const struct shadow_batch *b, uint32_t count,
                       const double *air_end, struct rgb *out)
{
    const bool even = air_end && !b->pass && media_air_is_even(t);
    if (even)
        media_air_even_shadows(t, air_end, count, out);
    for (uint32_t i = 0; i < count; i++) {
        if (b->occluded[i])
            continue;
        if (!even)
            out[i] = rest_passes(t, b, i, air_end ? air_end[i] : 0);
        else if (!(air_end[i] > 0) || !inside_hollow(wave_inside(t, b->slot[i])))
            out[i] = all;
    }
}

void shadow_flush_simple(struct tracer *t, uint32_t count)
{
    struct rgb pass[BATCH_SIZE];
    struct shadow_batch *b = &t->simple;
    double air_end[BATCH_SIZE];
    const bool air = has_dimming_air(t->job);
    for (uint32_t k = 0; k < count && air; k++)
        air_end[k] = b->air[k] ? b->rays->t_max[k] : 0;
    batch_trace(t, b, count, air ? air_end : NULL);
    if (!b->pass && !air) {
        t->job->kernels->lit(&t->wave, b, count);
        return;
    }
    rests_pass(t, b, count, air ? air_end : NULL, pass);
    for (uint32_t k = 0; k < count; k++) {
        if (b->occluded[k])
            continue;
        const struct rgb c = rgb(b->value[0][k], b->value[1][k], b->value[2][k]);
        tracer_lit(t, b->slot[k], rgb_mul(c, pass[k]));
    }
}

void shadow_add(struct tracer *t, const struct shadow_request *r)
{
    t->shadow[t->shadow_count++] = *r;
    if (t->shadow_count == BATCH_SIZE)
        shadow_flush(t);
}

static void shadow_put(struct shadow_batch *b, uint32_t i, const struct shadow_request *r)
{
    b->rays->o[0][i] = r->o.x;
    b->rays->o[1][i] = r->o.y;
    b->rays->o[2][i] = r->o.z;
    b->rays->d[0][i] = r->d.x;
    b->rays->d[1][i] = r->d.y;
    b->rays->d[2][i] = r->d.z;
    b->rays->t_max[i] = r->t_max;
    b->slot[i] = (uint16_t)r->slot;
    b->photons[i] = r->photons;
}

static double air_end_of(const struct job *job, const struct shadow_request *r)
{
    return air_counts(job, r->lamp) ? r->t_max : 0;
}

void shadow_factors(struct tracer *t, const struct shadow_request *r, uint32_t count,
                    struct rgb *out)
{
    struct shadow_batch *b = &t->near;
    double air_end[BATCH_SIZE];
    if (!count)
        return;
    for (uint32_t i = 0; i < count; i++) {
        shadow_put(b, i, &r[i]);
        air_end[i] = air_end_of(t->job, &r[i]);
    }
    batch_trace(t, b, count, has_dimming_air(t->job) ? air_end : NULL);
    for (uint32_t i = 0; i < count; i++)
        out[i] = !(r[i].t_max > 0) ? all
                 : b->occluded[i]  ? none
                                   : rest_passes(t, b, i, air_end[i]);
}

void shadow_factors_near(struct tracer *t, uint32_t lamp, uint32_t count, struct rgb *out)
{
    struct shadow_batch *b = &t->near;
    const bool air = air_counts(t->job, lamp);
    double air_end[BATCH_SIZE];
    if (air)
        memcpy(air_end, b->rays->t_max, count * sizeof *air_end);
    batch_trace(t, b, count, air ? air_end : NULL);
    rests_pass(t, b, count, air ? air_end : NULL, out);
    for (uint32_t i = 0; i < count; i++)
        if (!(b->rays->t_max[i] > 0))
            out[i] = all;
        else if (b->occluded[i])
            out[i] = none;
}

// Rays to the same lamp side by side, so that packets stay together.
static void shadow_sort(struct tracer *t)
{
    uint32_t n = 0;
    if (t->job->lamp_count == 1) {
        for (uint32_t i = 0; i < t->shadow_count; i++)
            t->shadow_order[i] = i;
        return;
    }
    for (uint32_t i = 0; i < t->job->lamp_count; i++)
        t->lamp_begin[i] = 0;
    for (uint32_t i = 0; i < t->shadow_count; i++)
        t->lamp_begin[t->shadow[i].lamp]++;
    for (uint32_t i = 0; i < t->job->lamp_count; i++) {
        const uint32_t of_lamp = t->lamp_begin[i];
        t->lamp_begin[i] = n;
        n += of_lamp;
    }
    for (uint32_t i = 0; i < t->shadow_count; i++)
        t->shadow_order[i] = t->lamp_begin[t->shadow[i].lamp]++;
}

void shadow_flush(struct tracer *t)
{
    const uint32_t count = t->shadow_count;
    struct shadow_batch *b = &t->rest;
    double air_end[BATCH_SIZE];
    if (!count)
        return;
    shadow_sort(t);
    for (uint32_t i = 0; i < count; i++) {
        shadow_put(b, t->shadow_order[i], &t->shadow[i]);
        air_end[t->shadow_order[i]] = air_end_of(t->job, &t->shadow[i]);
    }
    batch_trace(t, b, count, has_dimming_air(t->job) ? air_end : NULL);
    t->shadow_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t k = t->shadow_order[i];
        if (b->occluded[k])
            continue;
        const struct shadow_request *r = &t->shadow[i];
        tracer_lit(t, r->slot, rgb_mul(r->value, rest_passes(t, b, k, air_end[k])));
    }
}
