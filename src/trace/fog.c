#include "base/arena.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "math/quick.h"
#include "scene/noise.h"
#include "trace/media.h"
#include "trace/near_zero.h"
#include "trace/shade_kernel.h"
#include "trace/sky.h"

void bows_init(struct job *job, struct arena *a)
{
    static const double margin = 1e-9;
    const struct scene *s = job->scene;
    struct bow *bow = arena_new_array(a, struct bow, s->rainbow_count);
    for (uint32_t i = 0; i < s->rainbow_count; i++) {
        const struct rainbow *r = s->rainbow[i];
        const struct vec3 axis = vec3_normalize(r->direction);
        const struct vec3 right = vec3_normalize(vec3_cross(r->up, axis));
        bow[i] = (struct bow){r,           axis,
                              right,       vec3_normalize(vec3_cross(axis, right)),
                              .least = -1, .most = 2};
        // Jitter moves an angle by so much of the width.
        const double wide = r->width * DEGREE, off = fabs(r->jitter * wide);
        if (!(wide > 0))
            continue;
        const double first = r->angle * DEGREE - off,
                     last = r->angle * DEGREE + wide + off;
        if (first > 0 && first < PI)
            bow[i].most = det_cos(first) + margin;
        if (last > 0 && last < PI)
            bow[i].least = det_cos(last) - margin;
    }
    job->bow = bow;
}

// The mean density of a ground fog between two heights, in units of its scale: the
// density is 1 below 0 and 1/(h^2+1) above, so its integral is an arc tangent.
static double ground_density(double h1, double h2)
{
    if (h1 <= 0 && h2 <= 0)
        return 1;
    if (h1 > 0 && h2 > 0 && fabs(h1 - h2) < NEAR_ZERO)
        return 1 / (h1 * h1 + 1);
    const double a1 = h1 > 0 ? quick_atan2(h1, 1) : h1;
    const double a2 = h2 > 0 ? quick_atan2(h2, 1) : h2;
    return (a1 - a2) / (h1 - h2);
}

// How much turbulence thins a fog at the middle of the way through it.
static double fog_swirl(const struct job *job, const struct fog *f, struct vec3 middle)
{
    const struct turbulence *t = &f->turbulence;
    const double v =
        noise_turbulence(vec3_mul(middle, t->amount), (double)t->lambda, (double)t->omega,
                         t->octaves, job->scene->settings.noise_generator);
    return fmin(1, v * f->turb_depth);
}

// How much of what lies behind is seen.
static float fog_clear(const struct job *job, const struct fog *f, struct vec3 o,
                       struct vec3 d, double s)
{
    double way = s / f->distance;
    if (f->has_turbulence)
        way *= 1 - det_exp_single(-way) * fog_swirl(job, f, vec3_mad(o, s / 2, d));
    if (f->type == FOG_GROUND && f->alt != 0) {
        const double h1 = (vec3_dot(o, f->up) - f->offset) / f->alt;
        const double h2 = (vec3_dot(vec3_mad(o, s, d), f->up) - f->offset) / f->alt;
        way *= ground_density(h1, h2);
    }
    const float e = (float)det_exp_single(-way);
    return e > f->color.transmit ? e : f->color.transmit;
}

static struct rgb fog_pass(const struct fog *f, float clear)
{
    const float k = f->color.filter;
    return rgb(clear * ((1 - k) + k * f->color.r), clear * ((1 - k) + k * f->color.g),
               clear * ((1 - k) + k * f->color.b));
}

struct rgb air_filter(struct tracer *t, struct vec3 o, struct vec3 d, double s)
{
    const struct job *job = t->job;
    struct rgb pass = {1, 1, 1};
    for (uint32_t i = job->scene->fog_count; i-- > 0;) {
        const struct fog *f = job->scene->fog[i];
        if (f->distance != 0)
            pass = rgb_mul(pass, fog_pass(f, fog_clear(job, f, o, d, s)));
    }
    if (job->has_air_media)
        pass = rgb_mul(pass, media_air_shadow(t, o, d, s));
    return pass;
}

// What the fogs add and let pass: the kernels' `fogs` is the same for eight rays.
static void fogs_apply(struct tracer *t, struct path *path, double s)
{
    struct rgb pass = {1, 1, 1}, glow = {0, 0, 0};
    for (uint32_t i = t->job->scene->fog_count; i-- > 0;) {
        const struct fog *f = t->job->scene->fog[i];
        if (f->distance == 0)
            continue;
        const float clear = fog_clear(t->job, f, path->o, path->d, s);
        pass = rgb_mul(pass, fog_pass(f, clear));
        glow = rgb_add(glow, rgb_scale(1 - clear, rgbft_rgb(f->color)));
    }
    tracer_add(t, rgb_mul(path->through, glow));
    path->through = rgb_mul(path->through, pass);
    path->through_t *= rgb_luminance(pass);
}

static bool bow_may_be_seen(const struct bow *bow, struct vec3 d)
{
    const double along = vec3_dot(bow->axis, d);
    return along >= 0 && along >= bow->least && along <= bow->most &&
           bow->rainbow->colors;
}

// The colour of the bow at the angle of d and how much of it the sky lets through.
static bool rainbow_at(const struct bow *bow, const struct path *path, double s,
                       struct rgbft *color, double *keep)
{
    const struct rainbow *r = bow->rainbow;
    if (!bow_may_be_seen(bow, path->d))
        return false;
    const double along = vec3_dot(bow->axis, path->d);
    const double x = vec3_dot(path->d, bow->right), y = vec3_dot(path->d, bow->up);
    const double l = sqrt(x * x + y * y);
    const double around = l > 0 ? fabs(det_acos(fmax(-1, fmin(1, y / l)))) : 0;
    const double arc = r->arc_angle * DEGREE / 2, falloff = r->falloff_angle * DEGREE / 2;
    if (around > arc)
        return false;
    double index = (det_acos(fmin(1, along)) - r->angle * DEGREE) / (r->width * DEGREE);
    if (r->jitter != 0)
        index += (2 * hash_unit(hash_mix(path->hash, 77)) - 1) * r->jitter;
    if (index < 0 || index > 1 - NEAR_ZERO)
        return false;
    uint32_t a, b;
    double f;
    map_find(r->colors->key, r->colors->count, index, &a, &b, &f);
    const struct rgbft ca = r->colors->color[a], cb = r->colors->color[b];
    const float g = (float)f, h = a == b ? 1 : 1 - g, k = a == b ? 0 : g;
    *color =
        (struct rgbft){h * ca.r + k * cb.r, h * ca.g + k * cb.g, h * ca.b + k * cb.b,
                       h * ca.filter + k * cb.filter, h * ca.transmit + k * cb.transmit};
    double fade = 0;
    if (around > falloff && arc > falloff) {
        const double q = (around - falloff) / (arc - falloff);
        fade = q * q * (3 - 2 * q);
    }
    const double c = fade * (1 - (double)color->transmit) + (double)color->transmit;
    *keep = fmax(det_exp(-s / r->distance), c);
    return true;
}

static void rainbows_apply(struct tracer *t, struct path *path, double s)
{
    struct rgb pass = {0, 0, 0}, glow = {0, 0, 0};
    float pass_t = 1;
    int count = 0;
    for (uint32_t i = 0; i < t->job->scene->rainbow_count; i++) {
        struct rgbft c;
        double keep;
        if (!rainbow_at(&t->job->bow[i], path, s, &c, &keep))
            continue;
        const float k = (float)keep, f = (float)(c.filter * (1 - keep));
        pass = rgb_add(pass, rgb(k * ((1 - f) + f * c.r), k * ((1 - f) + f * c.g),
                                 k * ((1 - f) + f * c.b)));
        glow = rgb_add(glow, rgb_scale(1 - k, rgbft_rgb(c)));
        pass_t *= k * c.transmit;
        count++;
    }
    if (!count)
        return;
    const float mean = 1.0f / (float)count;
    tracer_add(t, rgb_mul(path->through, rgb_scale(mean, glow)));
    path->through = rgb_mul(path->through, rgb_scale(mean, pass));
    path->through_t *= pass_t;
}

static void air_apply(struct tracer *t, struct path *path, double s, uint32_t group)
{
    const struct scene *scene = t->job->scene;
    if (t->job->general && scene->fog_count)
        fogs_apply(t, path, s);
    if (t->job->general && t->job->has_air_media)
        media_air_apply(t, path, s, group);
    if (scene->rainbow_count)
        rainbows_apply(t, path, s);
}

// Whether ray k of the batch may see a rainbow: most see none.
static bool bows_may_be_seen(const struct tracer *t, uint32_t k)
{
    const struct job *job = t->job;
    const struct vec3 d = {t->rays->d[0][k], t->rays->d[1][k], t->rays->d[2][k]};
    bool any = false;
    for (uint32_t i = 0; i < job->scene->rainbow_count && !any; i++)
        any = bow_may_be_seen(&job->bow[i], d);
    return any;
}

void air_wave(struct tracer *t)
{
    const struct job *job = t->job;
    struct wavefront *w = &t->wave;
    for (uint32_t i = 0; i < w->count && !w->path; i++)
        w->through_t[i] = 1;
    const bool general = job->general && (job->scene->fog_count || job->has_air_media);
    if (job->scene->fog_count && !job->general)
        job->kernels->fogs(t);
    if (job->has_air_media && !job->general)
        media_air_wave(t);
    for (uint32_t k = 0; k < w->count && (general || job->scene->rainbow_count); k++) {
        if (!general && !bows_may_be_seen(t, k))
            continue;
        struct path p = wave_path(t, t->slot = w->slot[k]);
        const bool hit = t->hit->t[k] < INFINITY;
        if (!inside_hollow(p.inside))
            continue;
        const struct world *world = job->world;
        const uint32_t group =
            hit ? world->surface[world->leaf[t->hit->leaf[k]].surface].light_group : 0;
        air_apply(t, &p, hit ? t->hit->t[k] : air_far, group);
        w->through[0][t->slot] = p.through.r;
        w->through[1][t->slot] = p.through.g;
        w->through[2][t->slot] = p.through.b;
        w->through_t[t->slot] = p.through_t;
    }
    if (job->has_media && !job->general)
        media_wave(t);
}
