#include "trace/photons.h"

#include <stdlib.h>

#include "base/memory.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "trace/packet.h"
#include "trace/photon_volley.h"

// One of the two says yes and neither no.
static bool agreed(int a, int b) { return a >= 0 && b >= 0 && (a > 0 || b > 0); }

bool photons_refract(const struct photon_target *target, const struct light *light)
{
    return agreed(target ? target->refraction : 0, light->photon_refraction);
}

bool photons_reflect(const struct photon_target *target, const struct light *light)
{
    return agreed(target ? target->reflection : 0, light->photon_reflection);
}

static bool is_pair(const struct photon_target *target, const struct light *light)
{
    return !light->shadowless &&
           (photons_refract(target, light) || photons_reflect(target, light));
}

// Lights of light groups shoot no photons, others none at what they do not light.
static bool is_lit(const struct world *w, const struct surface *s)
{
    return !s->light_group || w->light_group[s->light_group - 1].global_lights;
}

// How an object is aimed at; NULL: it is not.
static const struct photon_target *target_of(const struct world *w,
                                             const struct world_object *o)
{
    for (uint32_t i = 0; i < o->leaf_count; i++) {
        const struct surface *s = &w->surface[w->leaf[o->first_leaf + i].surface];
        if (s->photons && s->photons->target && is_lit(w, s))
            return s->photons;
    }
    return NULL;
}

bool photons_wanted(const struct job *job)
{
    const struct world *w = job->world;
    if (!job->scene->settings.photons.on || !job->atmosphere)
        return false;
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct photon_target *target = target_of(w, &w->object[i]);
        for (uint32_t k = 0; target && k < w->light_count; k++)
            if (is_pair(target, w->light[k]))
                return true;
    }
    return false;
}

// ---- aiming --------------------------------------------------------------------------

// A lamp that shoots at an object.
struct aim {
    struct photon_gun gun;
    const struct photon_target *target;
    struct vec3 centre;       // of the target
    double size;              // radius around it
    struct vec3 to, left, up; // frame of the directions
    double distance;
    double widest; // angle, or length for parallel light
};

static bool is_parallel(const struct light *l)
{
    return l->parallel || l->kind == LIGHT_CYLINDER;
}

static struct vec3 across(struct vec3 d)
{
    const struct vec3 e = fabs(d.y) < 0.9 ? vec3(0, 1, 0) : vec3(0, 0, 1);
    return vec3_normalize(vec3_cross(d, e));
}

static bool aim_init(struct aim *a, const struct world *w, uint32_t object,
                     const struct photon_target *target, const struct lamp *lamp,
                     struct vec3 from)
{
    const struct aabb b = w->object[object].bounds;
    *a = (struct aim){.gun = {.lamp = lamp, .object = object, .from = from},
                      .target = target,
                      .centre = vec3_scale(0.5, vec3_add(b.min, b.max)),
                      .size = vec3_length(vec3_sub(b.max, b.min)) / 2};
    if (!(a->size < INFINITY))
        return false; // endless objects cannot be aimed at
    const struct vec3 way = vec3_sub(a->centre, from);
    if (is_parallel(lamp->light)) {
        a->to = lamp->light->axis;
        a->distance = vec3_dot(way, a->to);
        a->widest = a->size;
    } else {
        a->distance = vec3_length(way);
        a->to = a->distance > 0 ? vec3_scale(1 / a->distance, way) : vec3(0, 0, 1);
        a->widest = a->distance > a->size ? det_asin(a->size / a->distance) : PI;
    }
    a->left = across(a->to);
    a->up = vec3_cross(a->left, a->to);
    return true;
}

// The ray of a place in the beam.
static void aim_ray(const struct aim *a, double theta, double phi, struct vec3 *o,
                    struct vec3 *d)
{
    const struct vec3 out =
        vec3_add(vec3_scale(det_cos(phi), a->left), vec3_scale(det_sin(phi), a->up));
    if (is_parallel(a->gun.lamp->light)) {
        *d = a->to;
        *o = vec3_mad(vec3_mad(a->centre, -a->distance, a->to), theta, out);
    } else {
        *o = a->gun.from;
        *d = vec3_normalize(
            vec3_add(vec3_scale(det_cos(theta), a->to), vec3_scale(det_sin(theta), out)));
    }
}

// ---- shooting ------------------------------------------------------------------------

struct shooting {
    const struct job *job;
    struct photon_volley *volley;
    double spacing;
    uint32_t drawn;
    const volatile bool *cancel;
};

static double drawn(struct shooting *s) { return hash_unit(hash_mix(31, ++s->drawn)); }

// How far apart the rays of an aim are: an angle, or a length for parallel light.
static double step_of(const struct shooting *s, struct aim *a, uint32_t samples)
{
    double spread = a->target->spacing * s->spacing * sqrt(samples);
    if (is_parallel(a->gun.lamp->light)) {
        a->gun.spread = spread;
        return spread;
    }
    a->gun.spread = spread / a->distance;
    return det_atan(a->gun.spread);
}

// One ring of directions.
static void ring(struct shooting *s, const struct aim *a, double theta, double step)
{
    const double jitter = s->job->scene->settings.photons.jitter;
    const bool parallel = is_parallel(a->gun.lamp->light);
    const double turn = theta == 0 ? 2 * PI : step / (parallel ? theta : det_sin(theta));
    photon_volley_ring(s->volley);
    for (double phi = -PI + turn / 2 * drawn(s); phi < PI; phi += turn) {
        const double q = theta + (drawn(s) - 0.5) * jitter * step;
        const double f = phi + (drawn(s) - 0.5) * jitter * turn;
        struct vec3 o, d;
        aim_ray(a, q, f, &o, &d);
        photon_volley_shot(s->volley, o, d, hash_mix(17, s->drawn));
    }
}

// Rings that are flown together before it is known whether the first ones end the search.
enum {
    RINGS = 256,
    SHOTS_FIRST = 256, // so many, then a quarter of all before,
    SHOTS_MOST = 8192  // up to these: what is flown in vain stays a small part
};

struct rings {
    double theta[RINGS];
    uint32_t drawn[RINGS]; // when the ring was complete
};

static double volley_fill(struct shooting *s, const struct aim *a, double theta,
                          double step, uint32_t shots, struct rings *r)
{
    photon_volley_clear(s->volley);
    for (uint32_t i = 0;
         i < RINGS && theta < a->widest && photon_volley_shots(s->volley) < shots;
         i++, theta += step) {
        ring(s, a, theta, step);
        r->theta[i] = theta;
        r->drawn[i] = s->drawn;
    }
    return theta;
}

static bool is_cancelled(const struct shooting *s) { return s->cancel && *s->cancel; }

static void shoot(struct shooting *s, struct aim *a, uint32_t samples)
{
    const double autostop = s->job->scene->settings.photons.autostop;
    const double step = step_of(s, a, samples);
    uint32_t next = SHOTS_FIRST, all = 0;
    struct rings r;
    a->gun.share = 1.0f / (float)samples;
    bool any = false;
    if (!(step > 0))
        return;
    for (double theta = 0; theta < a->widest && !is_cancelled(s);) {
        theta = volley_fill(s, a, theta, step, next, &r);
        photon_volley_fly(s->volley, &a->gun);
        const uint32_t rings = photon_volley_rings(s->volley);
        for (uint32_t i = 0; i < rings; i++) {
            const uint32_t met = photon_volley_take(s->volley, i);
            if (!met && any && r.theta[i] > autostop * a->widest) {
                s->drawn = r.drawn[i]; // as if the rings after it had not been flown
                return;
            }
            any |= met > 0;
        }
        all += photon_volley_shots(s->volley);
        next = all / 4 < SHOTS_FIRST  ? SHOTS_FIRST
               : all / 4 < SHOTS_MOST ? all / 4
                                      : SHOTS_MOST;
    }
}

// All places that an area light shoots from, or the lamp's own.
static void shoot_from(struct shooting *s, uint32_t object,
                       const struct photon_target *target, const struct lamp *lamp)
{
    const struct light *l = lamp->light;
    struct aim a;
    if (!l->area || !l->photon_area) {
        if (aim_init(&a, s->job->world, object, target, lamp, l->location))
            shoot(s, &a, 1);
        return;
    }
    const struct lamp_grid grid =
        lamp_grid_of(lamp, s->job->world->object[object].bounds.min);
    const uint32_t samples = (uint32_t)l->size1 * (uint32_t)l->size2;
    for (int u = 0; u < l->size1; u++)
        for (int v = 0; v < l->size2 && !is_cancelled(s); v++)
            if (aim_init(&a, s->job->world, object, target, lamp,
                         lamp_grid_point(lamp, &grid, u, v)))
                shoot(s, &a, samples);
}

static const struct lamp *lamp_of(const struct job *job, const struct light *light)
{
    for (uint32_t i = 0; i < job->lamp_count; i++)
        if (job->lamp[i].light == light)
            return &job->lamp[i];
    return NULL;
}

typedef void each_pair(struct shooting *s, uint32_t object,
                       const struct photon_target *target, const struct lamp *lamp);

static void pairs(struct shooting *s, each_pair *visit)
{
    const struct world *w = s->job->world;
    for (uint32_t k = 0; k < w->light_count; k++) {
        const struct lamp *lamp = lamp_of(s->job, w->light[k]);
        for (uint32_t i = 0; i < w->object_count; i++) {
            const struct photon_target *target = target_of(w, &w->object[i]);
            if (target && !lamp->inert && !is_cancelled(s) &&
                is_pair(target, w->light[k]))
                visit(s, i, target, lamp);
        }
    }
}

// ---- count ---------------------------------------------------------------------------

// How many photons a pair is expected to leave, at spacing 1 (spec/lighting.md 11.2).
static void expect(struct shooting *s, uint32_t object,
                   const struct photon_target *target, const struct lamp *lamp)
{
    struct aim a;
    if (!aim_init(&a, s->job->world, object, target, lamp, lamp->light->location))
        return;
    const bool bends = photons_refract(target, lamp->light),
               mirrors = photons_reflect(target, lamp->light);
    const double across_target =
        a.size / (s->job->scene->settings.photons.spacing * target->spacing);
    double x = PI * across_target * across_target;
    if (bends && mirrors)
        x *= 1.5;
    if (target->collect)
        x *= bends && mirrors ? 3 : bends ? 2 : 1;
    s->spacing += x / 2;
}

static double spacing_of(const struct job *job)
{
    const struct photon_settings *p = &job->scene->settings.photons;
    if (p->count <= 0)
        return p->spacing;
    struct shooting s = {.job = job};
    pairs(&s, expect);
    return p->spacing * sqrt(s.spacing / p->count);
}

// ---- the whole -----------------------------------------------------------------------

static void map_finish(struct photon_map *m, const struct job *job, int which,
                       uint32_t max)
{
    const double *radius = &job->scene->settings.photons.radius[2 * which];
    struct photon_range *r = &m->range[PHOTON_PICTURE];
    photon_map_build(m, job->world->accel->kernels->photons);
    if (radius[0] > 0) {
        r->radius = radius[0];
    } else if (m->count) {
        photon_map_radius(m, max, which == 1);
        r->radius *= radius[1] * (which == 1 ? 2 : 1);
    }
    r->step = 2 * r->radius;
    r->last = 1;
    photon_map_ready(m, PHOTON_PICTURE);
}

static void shoot_all(struct photons *p, const struct job *job,
                      const volatile bool *cancel)
{
    const struct photon_settings *settings = &job->scene->settings.photons;
    // Photons end by limits of their own.
    struct job own = *job;
    own.photons = NULL;
    own.settings.indirect = (struct indirect){0};
    if (settings->max_trace_level > 0)
        own.max_level = settings->max_trace_level;
    if (settings->adc_bailout >= 0)
        own.adc_bailout = (float)settings->adc_bailout;
    struct shooting s = {.job = &own, .spacing = spacing_of(job), .cancel = cancel};
    s.volley = photon_volley_new(&own, p, cancel);
    pairs(&s, shoot_from);
    photon_volley_free(s.volley);
}

static void finish(struct photons *p, const struct job *job)
{
    const struct photon_settings *settings = &job->scene->settings.photons;
    struct photon_gather *g = &p->gather[PHOTON_PICTURE];
    const uint32_t total =
        p->surface.count > p->media.count ? p->surface.count : p->media.count;
    g->max = (uint32_t)(settings->gather_max > 0 ? settings->gather_max : 0);
    if (g->max > total)
        g->max = total ? total : 1;
    g->min = (uint32_t)(settings->gather_min > 0 ? settings->gather_min : 0);
    g->expand_increase = settings->expand_increase;
    g->expand_min = (uint32_t)(settings->expand_min > 0 ? settings->expand_min : 0);
    map_finish(&p->surface, job, 0, g->max);
    map_finish(&p->media, job, 1, g->max);
    if (!job->scene->settings.radiosity)
        return;
    p->gather[PHOTON_SAMPLE].max = photon_map_for_samples(&p->surface, g->max, false);
    photon_map_for_samples(&p->media, g->max, true);
}

struct photons *photons_shoot(const struct job *job, const struct photon_store *store,
                              const volatile bool *cancel)
{
    if (!photons_wanted(job))
        return NULL;
    struct photons *p = must_calloc(1, sizeof *p);
    if (!store || !store->load) {
        shoot_all(p, job, cancel);
    } else if (!store->load(store->user, p)) {
        photons_free(p);
        return NULL;
    }
    if (cancel && *cancel) // nobody looks at them: trees of millions take seconds
        p->surface.count = p->media.count = 0;
    else if (store && store->save)
        store->save(store->user, p);
    finish(p, job);
    return p;
}

void photons_free(struct photons *p)
{
    if (!p)
        return;
    photon_map_end(&p->surface);
    photon_map_end(&p->media);
    free(p);
}
