#include "trace/media.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/memory.h"
#include "math/chi_square.h"
#include "scene/effects.h"
#include "scene/pigment_tape.h"
#include "scene/texture.h"
#include "trace/inside.h"
#include "trace/media_march.h"
#include "trace/shade_kernel.h"

bool media_inside(const struct inside *list)
{
    if (!inside_hollow(list))
        return false;
    for (; list; list = list->outer)
        if (list->interior->media_count)
            return true;
    return false;
}

// The media of all interiors of a list, the outermost first.
static const struct media *const *media_of(struct arena *a, const struct inside *list,
                                           uint32_t *count)
{
    uint32_t n = 0;
    for (const struct inside *i = list; i; i = i->outer)
        n += i->interior->media_count;
    const struct media **all = arena_new_array(a, const struct media *, n + 1);
    *count = n;
    for (const struct inside *i = list; i; i = i->outer)
        for (uint32_t k = i->interior->media_count; k-- > 0;)
            all[--n] = i->interior->media[k];
    return all;
}

struct media_walker media_walker(struct tracer *t, const struct media_way *way,
                                 const uint8_t *missed, uint8_t lane)
{
    const uint32_t most = t->job->lamps[way->group].count;
    struct media_walker w = {.way = way};
    if (most) {
        struct media_lamp *lamp =
            arena_new_array(t->media[WAY_EYE].arena, struct media_lamp, most + 1);
        w.lamp_count = media_lamps(t->job, way, missed, lane, lamp);
        w.lamp = lamp;
    }
    return w;
}

static void apply(struct tracer *t, struct path *path, const struct media_mix *mix,
                  const struct media_way *way)
{
    struct media_scratch *s = &t->media[WAY_EYE];
    struct media_walker w = media_walker(t, way, NULL, 0);
    struct media_march m = {
        .t = t, .scratch = s, .mix = mix, .walker = &w, .walker_count = 1};
    m.interval =
        media_intervals(s->arena, mix, way->s, w.lamp, w.lamp_count, &m.interval_count);
    const struct media_result r = media_walk(&m);
    const struct rgb light = {(float)r.light.x, (float)r.light.y, (float)r.light.z};
    const struct rgb pass = {(float)r.pass.x, (float)r.pass.y, (float)r.pass.z};
    tracer_add(t, rgb_mul(path->through, light));
    path->through = rgb_mul(path->through, pass);
    path->through_t *= rgb_luminance(pass);
}

struct media_mix media_mix_inside(struct tracer *t, const struct inside *list)
{
    struct arena *a = t->media[WAY_EYE].arena;
    arena_reset(a);
    uint32_t count;
    const struct media *const *media = media_of(a, list, &count);
    return media_mix_of(media, count);
}

void media_apply(struct tracer *t, struct path *path, double s, uint32_t group)
{
    if (!media_inside(path->inside))
        return;
    const struct media_mix mix = media_mix_inside(t, path->inside);
    const struct media_way way = {path->o, path->d,    s,      path->inside,
                                  group,   path->hash, t->slot};
    apply(t, path, &mix, &way);
}

void media_air_apply(struct tracer *t, struct path *path, double s, uint32_t group)
{
    const struct scene *scene = t->job->scene;
    arena_reset(t->media[WAY_EYE].arena);
    const struct media_mix mix = media_mix_of(scene->media, scene->media_count);
    const struct media_way way = {
        path->o, path->d, s, path->inside, group, hash_mix(path->hash, MEDIA_AIR_HASH),
        t->slot};
    apply(t, path, &mix, &way);
}

// ---- shadows -------------------------------------------------------------------------

static uint32_t hash_of_double(uint32_t h, double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return hash_mix(hash_mix(h, (uint32_t)bits), (uint32_t)(bits >> 32));
}

// The mix of those that take light away.
static struct media_mix dark_mix(struct arena *a, const struct media *const *media,
                                 uint32_t count)
{
    const struct media **dark = arena_new_array(a, const struct media *, count + 1);
    return media_mix_of(dark, media_opaque_only(media, count, dark));
}

static struct rgb rgb_of(struct vec3 v)
{
    return rgb((float)v.x, (float)v.y, (float)v.z);
}

static struct media_way shadow_way(struct vec3 o, struct vec3 d, double s)
{
    // A shadow ray has no history of its own: where it runs tells it apart.
    uint32_t h = hash_of_double(5, o.x);
    h = hash_of_double(h, o.y + o.z);
    return (struct media_way){.o = o, .d = d, .s = s, .hash = hash_of_double(h, d.x)};
}

static struct rgb shadow_through(struct tracer *t, const struct media_mix *mix,
                                 struct vec3 o, struct vec3 d, double length)
{
    struct media_scratch *s = &t->media[WAY_SHADOW];
    if (mix->even) // none at all, too
        return rgb_of(media_even_pass(mix->everywhere.extinction, length));
    const struct media_way way = shadow_way(o, d, length);
    struct media_walker w = {.way = &way};
    struct media_march m = {.t = t,
                            .scratch = s,
                            .mix = mix,
                            .walker = &w,
                            .walker_count = 1,
                            .depth_only = true};
    m.interval = media_intervals(s->arena, mix, length, NULL, 0, &m.interval_count);
    return rgb_of(media_walk(&m).pass);
}

struct rgb media_shadow(struct tracer *t, const struct inside *list, struct vec3 o,
                        struct vec3 d, double s)
{
    struct media_dark one = {.inside = list, .o = o, .d = d, .s = s};
    media_shadows(t, &one, 1);
    return one.pass;
}

bool media_same(const struct inside *a, const struct inside *b)
{
    for (; a && b; a = a->outer, b = b->outer)
        if (a->interior != b->interior)
            return false;
    return a == b; // both at the end
}

enum { TOGETHER = 64 }; // rays at most

// The first rays of `ray`, all in the media `mix`, together; returns how many there were.
static uint32_t walk_few(struct tracer *t, const struct media_mix *mix,
                         struct media_dark *ray, uint32_t count)
{
    struct media_scratch *s = &t->media[WAY_SHADOW];
    const uint32_t most = media_stride(mix);
    struct media_way way[TOGETHER];
    uint32_t first[TOGETHER + 1] = {0}, n = 0;
    struct media_walker walker[TOGETHER];
    struct media_result result[TOGETHER];
    struct media_interval *all = arena_new_array(s->arena, struct media_interval, most);
    for (; n < count && n < TOGETHER; n++) {
        uint32_t intervals;
        way[n] = shadow_way(ray[n].o, ray[n].d, ray[n].s);
        const struct media_interval *own =
            media_intervals(s->arena, mix, way[n].s, NULL, 0, &intervals);
        if (intervals > most - first[n])
            break;
        for (uint32_t k = 0; k < intervals; k++) {
            all[first[n] + k] = own[k];
            all[first[n] + k].walker = n;
        }
        walker[n] = (struct media_walker){.way = &way[n]};
        first[n + 1] = first[n] + intervals;
    }
    struct media_march m = {.t = t,
                            .scratch = s,
                            .mix = mix,
                            .walker = walker,
                            .walker_count = n,
                            .interval = all,
                            .interval_count = first[n],
                            .depth_only = true};
    media_walk_together(&m, first, result);
    for (uint32_t i = 0; i < n; i++)
        ray[i].pass = rgb_of(result[i].pass);
    return n;
}

// Rays that are in the same media.
static void shadows_of_run(struct tracer *t, struct media_dark *ray, uint32_t count)
{
    struct arena *a = t->media[WAY_SHADOW].arena;
    arena_reset(a);
    uint32_t all;
    const struct media *const *media = media_of(a, ray->inside, &all);
    const struct media_mix mix = dark_mix(a, media, all);
    const bool together = mix.count && media_goes_together(&mix, true) &&
                          (uint32_t)mix.rules->intervals <= media_stride(&mix);
    for (uint32_t i = 0; i < count;) {
        if (together) {
            i += walk_few(t, &mix, &ray[i], count - i);
        } else {
            ray[i].pass = shadow_through(t, &mix, ray[i].o, ray[i].d, ray[i].s);
            i++;
        }
    }
}

void media_shadows(struct tracer *t, struct media_dark *ray, uint32_t count)
{
    for (uint32_t i = 0, end; i < count; i = end) {
        end = i + 1;
        ray[i].pass = rgb(1, 1, 1);
        if (!media_inside(ray[i].inside))
            continue;
        while (end < count && media_same(ray[end].inside, ray[i].inside))
            end++;
        shadows_of_run(t, &ray[i], end - i);
    }
}

struct rgb media_air_shadow(struct tracer *t, struct vec3 o, struct vec3 d, double s)
{
    const struct scene *scene = t->job->scene;
    struct media_scratch *shadow = &t->media[WAY_SHADOW];
    if (shadow->air_even)
        return rgb_of(media_even_pass(shadow->air_extinction, s));
    arena_reset(shadow->arena);
    const struct media_mix mix =
        dark_mix(shadow->arena, scene->media, scene->media_count);
    return shadow_through(t, &mix, o, d, s);
}

bool media_air_is_even(const struct tracer *t)
{
    return t->job->has_air_media && !t->job->scene->fog_count &&
           t->media[WAY_SHADOW].air_even;
}

void media_air_even_shadows(struct tracer *t, const double *s, uint32_t count,
                            struct rgb *out)
{
    const struct vec3 lost = t->media[WAY_SHADOW].air_extinction;
    double x[3 * BATCH_SIZE + 8];
    for (uint32_t i = 0; i < count; i++) {
        x[3 * i] = -(s[i] * lost.x);
        x[3 * i + 1] = -(s[i] * lost.y);
        x[3 * i + 2] = -(s[i] * lost.z);
    }
    for (uint32_t i = 3 * count; i % 8; i++)
        x[i] = 0;
    t->job->kernels->exp_single(x, 3 * count);
    const bool clear = lost.x == 0 && lost.y == 0 && lost.z == 0;
    for (uint32_t i = 0; i < count; i++)
        out[i] = clear ? rgb(1, 1, 1)
                       : rgb((float)x[3 * i], (float)x[3 * i + 1], (float)x[3 * i + 2]);
}

// ---- preparation -----------------------------------------------------------------------

static bool wants_thresholds(const struct media *m)
{
    return m->method != 3 && m->samples_max > m->samples_min;
}

// Bounds what tables of thresholds hold.
enum { THRESHOLDS = 1024 };

static void threshold_add(struct job *job, struct arena *a, struct media_threshold *all,
                          const struct media *m)
{
    const int n = m->samples_max < THRESHOLDS ? m->samples_max : THRESHOLDS;
    double *enough = arena_new_array(a, double, (size_t)n + 2);
    chi_square_thresholds((double)m->confidence, (double)m->variance, n, n + 1, enough);
    all[job->media_threshold_count++] = (struct media_threshold){m, enough, (uint32_t)n};
}

// Calls visit for every medium of the scene; those of shared interiors several times.
static void each_media(const struct job *job,
                       void (*visit)(void *user, const struct media *m), void *user)
{
    const struct world *w = job->world;
    for (uint32_t i = 0; i < job->scene->media_count; i++)
        visit(user, job->scene->media[i]);
    for (uint32_t i = 0; i < w->surface_count; i++) {
        const struct interior *x = w->surface[i].interior;
        if (i && x == w->surface[i - 1].interior)
            continue;
        for (uint32_t k = 0; k < x->media_count; k++)
            visit(user, x->media[k]);
    }
}

struct gathering {
    struct job *job;
    struct arena *arena;
    struct media_threshold *all;
    uint32_t count, wanted;
    const struct media **media; // count of them
};

static void count_one(void *user, const struct media *m)
{
    struct gathering *g = user;
    g->count++;
    g->wanted += wants_thresholds(m);
}

static void take_one(void *user, const struct media *m)
{
    struct gathering *g = user;
    if (!wants_thresholds(m))
        return;
    for (uint32_t i = 0; i < g->job->media_threshold_count; i++)
        if (g->all[i].media == m)
            return;
    threshold_add(g->job, g->arena, g->all, m);
}

static void note_one(void *user, const struct media *m)
{
    struct gathering *g = user;
    g->media[g->count++] = m;
}

static int by_address(const void *a, const void *b)
{
    const struct media *const *p = a, *const *q = b;
    return (*p > *q) - (*p < *q);
}

static void tapes_compile(struct gathering *g)
{
    struct pigment_compiler c = {.arena = g->arena};
    struct media_tapes *all = arena_new_array(g->arena, struct media_tapes, g->count);
    g->media = arena_new_array(g->arena, const struct media *, g->count);
    g->count = 0;
    each_media(g->job, note_one, g);
    qsort(g->media, g->count, sizeof *g->media, by_address);
    for (uint32_t i = 0; i < g->count; i++) {
        const struct media *m = g->media[i];
        if (i && m == g->media[i - 1])
            continue;
        const struct pigment_tape **tape =
            arena_new_array(g->arena, const struct pigment_tape *, m->density_count + 1);
        for (uint32_t k = 0; k < m->density_count; k++)
            tape[k] = pigment_compile(&c, m->density[k]);
        all[g->job->media_tapes_count++] = (struct media_tapes){m, tape};
    }
    g->job->media_tapes = all;
}

void media_compile(struct job *job, struct arena *a)
{
    struct gathering g = {.job = job, .arena = a};
    if (!job->air)
        return;
    each_media(job, count_one, &g);
    job->has_media = g.count > 0;
    job->has_air_media = job->scene->media_count > 0;
    if (g.count)
        tapes_compile(&g);
    if (!g.wanted)
        return;
    g.all = arena_new_array(a, struct media_threshold, g.wanted);
    each_media(job, take_one, &g);
    job->media_threshold = g.all;
}

void media_init(struct tracer *t)
{
    if (!t->job->has_media)
        return;
    t->media = must_calloc(2, sizeof *t->media);
    for (int i = 0; i < 2; i++)
        t->media[i].arena = arena_new(4096);
    struct media_scratch *s = &t->media[WAY_SHADOW];
    const struct scene *scene = t->job->scene;
    const struct media_mix air = dark_mix(s->arena, scene->media, scene->media_count);
    s->air_even = air.even;
    s->air_extinction = air.everywhere.extinction;
}

void media_end(struct tracer *t)
{
    for (int i = 0; t->media && i < 2; i++) {
        arena_free(t->media[i].arena);
        free(t->media[i].sample);
        free(t->media[i].span);
        free(t->media[i].exp);
        free(t->media[i].value);
    }
    free(t->media);
}
