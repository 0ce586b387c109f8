#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "math/elementary.h"
#include "trace/accel.h"
#include "trace/inside.h"
#include "trace/layers.h"
#include "trace/media.h"
#include "trace/near_zero.h"
#include "trace/paint.h"
#include "trace/photons.h"
#include "trace/shade_kernel.h"
#include "trace/shadow_list.h"
#include "trace/sky.h"

// Shadow rays end this much before a lamp: half of the digits of a double. A surface that
// the lamp lies on (a ceiling) is met within the rounding of its place, which the cosine
// divides, and throws no shadow on its own side at cosines down to about 2^-26.
static const double before_lamp = 1 - 0x1p-26;

// What an occluder lets through, summed over its textures (spec/lighting.md 7.3).
struct occluder {
    struct tracer *t;
    struct vec3 d; // towards the light
    double caustics;
    struct rgb pass;
};

static void occluder_plain(void *user, const struct surface_view *v,
                           const struct texture *x, const struct texture_point *at,
                           const struct texture_chain *chain, double weight)
{
    struct occluder *o = user;
    struct rgb pass = {1, 1, 1};
    for (uint32_t i = x->layer_count; i-- > 0;) {
        struct layer l;
        layer_eval(o->t, v, &x->layer[i], at, chain, o->caustics != 0, &l);
        if (l.found)
            pass = rgb_mul(pass, l.pass);
        if (o->caustics != 0) {
            const double c = fabs(vec3_dot(l.n, o->d));
            pass = rgb_scale((float)(1 + det_pow_single(c, o->caustics)), pass);
        }
    }
    o->pass = rgb_add(o->pass, rgb_scale((float)weight, pass));
}

static struct rgb occluder_filter(struct tracer *t, const struct interaction *at,
                                  struct vec3 d)
{
    struct surface_view view;
    surface_view_init(&view, at, d);
    struct occluder o = {.t = t, .d = d, .caustics = at->surface->interior->caustics};
    texture_walk(t, &view, occluder_plain, &o);
    return o.pass;
}

// ---- among transparent things --------------------------------------------------------

// A shadow ray on its way to the lamp.
struct shadow_walk {
    const struct inside *inside;
    struct rgb pass;
    double t; // so far
    uint32_t ray;
    bool air;        // fog and the like dim this light
    uint8_t photons; // photons_instead
};

static const struct rgb none = {0, 0, 0}, all = {1, 1, 1};

static struct rgb surface_pass(struct tracer *t, const struct ray *ray,
                               const struct hit *hit, const struct surface *surface)
{
    const struct even_pass *known = &t->job->pass[surface - t->job->world->surface];
    if (known->known)
        return known->pass;
    struct interaction at;
    trace_interaction(t->job->world, ray, hit, &at);
    return occluder_filter(t, &at, ray->d);
}

// Fog and media of the scene on the stretch up to t, where it is hollow.
static void air_between(struct tracer *t, struct shadow_walk *s, const struct ray *ray,
                        double end)
{
    if (inside_hollow(s->inside))
        s->pass = rgb_mul(
            s->pass, air_filter(t, vec3_mad(ray->o, s->t, ray->d), ray->d, end - s->t));
}

// How far on a shape that is searched from where the ray begins may find this crossing again.
static double found_again(const struct world *w, const struct hit *hit)
{
    return w->accel->leaf_shape[hit->b.leaf] == PACKET_LANES ? 2 * hit->b.dt : 0;
}

// Whether the surface lets light of this lamp through.
static bool is_clear(const struct shadow_walk *s, const struct surface *surface)
{
    return !surface->opaque && !(s->photons && photons_instead_of(surface, s->photons));
}

// Crosses the surface that was hit, behind media that let `dim` pass; false: nothing
// passes. known: what the surface lets through, unless it is NULL.
static bool walk_on(struct tracer *t, struct shadow_walk *s, const struct ray *ray,
                    const struct hit *hit, struct rgb dim, const struct rgb *known)
{
    const struct world *w = t->job->world;
    const struct surface *surface = &w->surface[w->leaf[hit->b.leaf].surface];
    struct rgb pass = none;
    if (is_clear(s, surface))
        pass = known ? *known : surface_pass(t, ray, hit, surface);
    if (s->air)
        air_between(t, s, ray, hit->b.t);
    const struct interior *x = surface->interior;
    if (t->job->has_media && s->inside)
        pass = rgb_mul(pass, dim);
    if (inside_find(s->inside, x)) {
        if (x->fade_power > 0 && fabs(x->fade_distance) > NEAR_ZERO)
            pass = rgb_mul(pass, interior_fade(x, hit->b.t - s->t));
        s->inside = inside_remove(t->arena, s->inside, x);
    } else {
        s->inside = inside_enter(t, s->inside, x);
    }
    s->pass = rgb_mul(s->pass, pass);
    s->t = hit->b.t + found_again(w, hit);
    if (fmaxf(fabsf(pass.r), fmaxf(fabsf(pass.g), fabsf(pass.b))) >= (float)NEAR_ZERO)
        return true;
    s->pass = none;
    return false;
}

// The stretch up to what was hit, for media.
static struct media_dark stretch_of(const struct shadow_walk *s, const struct ray *ray,
                                    double end)
{
    return (struct media_dark){.inside = s->inside,
                               .o = vec3_mad(ray->o, s->t, ray->d),
                               .d = ray->d,
                               .s = end - s->t};
}

// The light that passes, with opaque objects known not to be in the way.
static struct rgb walk_alone(struct tracer *t, const struct shadow_request *r, bool air)
{
    struct shadow_walk s = {r->inside, all, 0, 0, air, r->photons};
    struct ray_query q = {{r->o, r->d, 0, before_lamp * r->t_max}, OBJECT_NO_SHADOW};
    struct hit hit;
    struct rgb dim;
    bool on;
    do {
        q.ray.t_min = s.t;
        hit = trace_closest_1(t->job->world->clear, t->scratch, &q);
        on = hit.b.t < r->t_max;
        struct media_dark m = {.pass = all};
        if (on && t->job->has_media && s.inside) {
            m = stretch_of(&s, &q.ray, hit.b.t);
            media_shadows(t, &m, 1);
        }
        dim = m.pass;
    } while (on && walk_on(t, &s, &q.ray, &hit, dim, NULL));
    if (air && !on)
        air_between(t, &s, &q.ray, r->t_max);
    return s.pass;
}

static struct ray batch_ray(const struct ray_batch *b, uint32_t k)
{
    return (struct ray){{b->o[0][k], b->o[1][k], b->o[2][k]},
                        {b->d[0][k], b->d[1][k], b->d[2][k]},
                        b->t_min[k],
                        b->t_max[k]};
}

static void walk_put(struct ray_batch *to, uint32_t i, const struct ray_batch *from,
                     const struct shadow_walk *s)
{
    for (int a = 0; a < 3; a++) {
        to->o[a][i] = from->o[a][s->ray];
        to->d[a][i] = from->d[a][s->ray];
    }
    to->t_min[i] = s->t;
    to->t_max[i] = from->t_max[s->ray];
}

// The end of a ray's way, as walk_alone.
static void walk_end(struct tracer *t, struct shadow_walk *s,
                     const struct shadow_batch *b, const double *air_end)
{
    const struct ray ray = batch_ray(b->rays, s->ray);
    if (s->air)
        air_between(t, s, &ray, air_end[s->ray]);
    b->pass[s->ray] = s->pass;
}

enum { DIM = 64 }; // rays that media dim together

// What media let through up to what the walks [begin, end) have hit.
static void walks_dim(struct tracer *t, const struct shadow_walk *s, uint32_t begin,
                      uint32_t end, struct rgb *dim)
{
    struct media_dark dark[DIM];
    uint32_t n = 0;
    for (uint32_t i = begin; i < end; i++)
        if (s[i].inside && t->walk_hit->t[i] < t->walk_rays->t_max[i]) {
            const struct ray ray = batch_ray(t->walk_rays, i);
            dark[n++] = stretch_of(&s[i], &ray, t->walk_hit->t[i]);
        }
    media_shadows(t, dark, n);
    n = 0;
    for (uint32_t i = begin; i < end; i++)
        dim[i - begin] = s[i].inside && t->walk_hit->t[i] < t->walk_rays->t_max[i]
                             ? dark[n++].pass
                             : all;
}

// What textures let through where the walks have hit, eight hits of a surface at a time.
struct painted_pass {
    struct rgb pass[BATCH_SIZE];
    bool known[BATCH_SIZE];
};

// The surface of a walk's hit that paint_pass is asked about; UINT32_MAX: none.
static uint32_t filter_of(const struct tracer *t, const struct shadow_walk *s, uint32_t i)
{
    const struct job *job = t->job;
    if (!(t->walk_hit->t[i] < t->walk_rays->t_max[i]))
        return UINT32_MAX;
    const uint32_t surface = job->world->leaf[t->walk_hit->leaf[i]].surface;
    return !job->pass[surface].known && paint_filters(job, surface) &&
                   is_clear(s, &job->world->surface[surface])
               ? surface
               : UINT32_MAX;
}

static void walks_paint(struct tracer *t, const struct shadow_walk *s, uint32_t n,
                        struct painted_pass *out)
{
    enum { NEAR = 64 }; // rays among which those of a surface are looked for
    uint32_t surface[BATCH_SIZE];
    for (uint32_t i = 0; i < n; i++) {
        surface[i] = filter_of(t, &s[i], i);
        out->known[i] = false;
    }
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t one = surface[i];
        uint16_t ray[8];
        uint32_t count = 0;
        struct rgb pass[8];
        for (uint32_t k = i; one != UINT32_MAX && k < n && k < i + NEAR && count < 8; k++)
            if (surface[k] == one)
                ray[count++] = (uint16_t)k;
        if (count < 2)
            continue;
        paint_pass(t, one, ray, count, pass);
        for (uint32_t k = 0; k < count; k++) {
            out->pass[ray[k]] = pass[k];
            out->known[ray[k]] = true;
            surface[ray[k]] = UINT32_MAX;
        }
    }
}

// The same for the rays of a batch that nothing opaque stops: those that meet surfaces
// go from one to the next together. air_end[i]: where the lamp is, for rays that the air
// dims, or 0; NULL: none are.
static void walk_batch(struct tracer *t, struct shadow_batch *b, uint32_t count,
                       const double *air_end)
{
    const struct job *job = t->job;
    struct shadow_walk *s = t->walk;
    struct painted_pass painted;
    uint32_t n = 0;
    for (uint32_t first = 0; first < count; first += 8) {
        unsigned lit = 0, met = 0;
        for (uint32_t i = 0; i < 8 && first + i < count; i++) {
            b->pass[first + i] = all;
            lit |= (unsigned)!b->occluded[first + i] << i;
        }
        if (lit)
            met = lit & job->kernels->meets(job->clear, job->clear_count, b->rays, first);
        if (t->list && !air_end && met)
            met = shadow_list_take(t, b, first, met);
        for (lit = air_end ? lit : met; lit; lit &= lit - 1) {
            const uint32_t i = (uint32_t)__builtin_ctz(lit), k = first + i;
            s[n] = (struct shadow_walk){wave_inside(t, b->slot[k]), all,          0, k,
                                        air_end && air_end[k] > 0,  b->photons[k]};
            if (met >> i & 1)
                n++;
            else
                walk_end(t, &s[n], b, air_end);
        }
    }
    if (t->list)
        shadow_list_end(t, b);
    while (n) {
        for (uint32_t i = 0; i < n; i++)
            walk_put(t->walk_rays, i, b->rays, &s[i]);
        t->walk_rays->count = n;
        trace_closest(t->job->world->clear, t->scratch, t->walk_rays, t->walk_hit);
        uint32_t left = 0;
        if (job->paint)
            walks_paint(t, s, n, &painted);
        for (uint32_t first = 0; first < n; first += DIM) {
            struct rgb dim[DIM];
            const uint32_t end = n - first < DIM ? n : first + DIM;
            if (t->job->has_media)
                walks_dim(t, s, first, end, dim);
            for (uint32_t i = first; i < end; i++) {
                const struct ray ray = batch_ray(t->walk_rays, i);
                const struct hit hit = hit_batch_at(t->walk_hit, i);
                if (!(hit.b.t < ray.t_max))
                    walk_end(t, &s[i], b, air_end);
                else if (walk_on(t, &s[i], &ray, &hit,
                                 t->job->has_media ? dim[i - first] : all,
                                 job->paint && painted.known[i] ? &painted.pass[i]
                                                                : NULL))
                    s[left++] = s[i];
                else
                    b->pass[s[i].ray] = none;
            }
        }
        n = left;
    }
}

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
        return walk_alone(t, r, air);
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
    t->walk = must_calloc(BATCH_SIZE, sizeof *t->walk);
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

// air_end[i]: see walk_batch.
static void batch_trace(struct tracer *t, struct shadow_batch *b, uint32_t count,
                        const double *air_end)
{
    b->rays->count = count;
    for (uint32_t i = 0; i < count; i++)
        b->rays->t_max[i] *= before_lamp;
    trace_occluded(t->job->world, t->scratch, b->rays, b->occluded);
    if (b->pass)
        walk_batch(t, b, count, air_end);
}

// What of light that nothing opaque stops gets past the rest along ray k of a batch.
static struct rgb rest_passes(struct tracer *t, const struct shadow_batch *b, uint32_t k,
                              double air_end)
{
    if (b->pass)
        return b->pass[k];
    if (!(air_end > 0))
        return all;
    const struct ray ray = batch_ray(b->rays, k);
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
