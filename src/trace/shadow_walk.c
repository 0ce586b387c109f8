#include "trace/shadow_walk.h"

#include <math.h>

#include "base/memory.h"
#include "math/elementary.h"
#include "math/larger.h"
#include "trace/accel.h"
#include "trace/coincident.h"
#include "trace/inside.h"
#include "trace/layers.h"
#include "trace/media.h"
#include "trace/near_zero.h"
#include "trace/paint.h"
#include "trace/photons.h"
#include "trace/shade_kernel.h"
#include "trace/shadow_list.h"
#include "trace/sky.h"

static const struct rgb none = {0, 0, 0}, all = {1, 1, 1};

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

struct rgb surface_filter(struct tracer *t, const struct interaction *at, struct vec3 d,
                          double caustics)
{
    struct surface_view view;
    surface_view_init(&view, at, d);
    struct occluder o = {.t = t, .d = d, .caustics = caustics};
    texture_walk(t, &view, occluder_plain, &o);
    return o.pass;
}

// A shadow ray on its way to the lamp.
struct shadow_walk {
    const struct inside *inside;
    struct rgb pass;
    double t; // so far
    uint32_t ray;
    bool air;        // fog and the like dim this light
    uint8_t photons; // photons_instead
};

static struct rgb surface_pass(struct tracer *t, const struct ray *ray,
                               const struct hit *hit, const struct surface *surface)
{
    const struct even_pass *known = &t->job->pass[surface - t->job->world->surface];
    if (known->known)
        return known->pass;
    struct interaction at;
    trace_interaction(t->job->world, ray, hit, &at);
    return surface_filter(t, &at, ray->d, surface->interior->caustics);
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

// Crosses a surface that lets `pass` through, at the end of a way of this length.
static bool cross(struct tracer *t, struct shadow_walk *s, const struct interior *x,
                  double way, struct rgb pass)
{
    if (inside_find(s->inside, x)) {
        if (x->fade_power > 0 && fabs(x->fade_distance) > NEAR_ZERO)
            pass = rgb_mul(pass, interior_fade(x, way));
        s->inside = inside_remove(t->arena, s->inside, x);
    } else {
        s->inside = inside_enter(t, s->inside, x);
    }
    s->pass = rgb_mul(s->pass, pass);
    if (fmaxf(fabsf(pass.r), fmaxf(fabsf(pass.g), fabsf(pass.b))) >= (float)NEAR_ZERO)
        return true;
    s->pass = none;
    return false;
}

// Crosses the faces of other clear bodies that lie in that of the hit.
static bool cross_contacts(struct tracer *t, struct shadow_walk *s, const struct ray *ray,
                           const struct hit *hit, double way)
{
    const struct world *w = t->job->world;
    const struct ray_query q = {.ray = *ray, .hidden_by = OBJECT_NO_SHADOW};
    struct hit other[CONTACTS_MOST];
    const uint32_t count = coincident_contacts(w, t->scratch, &q, hit, other);
    bool on = true;
    for (uint32_t i = 0; i < count && on; i++) {
        const struct surface *x = &w->surface[w->leaf[other[i].b.leaf].surface];
        on = cross(t, s, x->interior, way,
                   is_clear(s, x) ? surface_pass(t, ray, &other[i], x) : none);
        s->t = larger(other[i].b.t + found_again(w, &other[i]), s->t);
    }
    return on;
}

// Crosses the surface that was hit, behind media that let `dim` pass; false: nothing
// passes. known: what the surface lets through, unless it is NULL.
static bool walk_on(struct tracer *t, struct shadow_walk *s, const struct ray *ray,
                    const struct hit *hit, struct rgb dim, const struct rgb *known)
{
    const struct world *w = t->job->world;
    const struct surface *surface = &w->surface[w->leaf[hit->b.leaf].surface];
    const double way = hit->b.t - s->t;
    struct rgb pass = none;
    if (is_clear(s, surface))
        pass = known ? *known : surface_pass(t, ray, hit, surface);
    if (s->air)
        air_between(t, s, ray, hit->b.t);
    if (t->job->has_media && s->inside)
        pass = rgb_mul(pass, dim);
    s->t = hit->b.t + found_again(w, hit);
    return cross(t, s, surface->interior, way, pass) &&
           (!surface->in_contact || cross_contacts(t, s, ray, hit, way));
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

struct rgb shadow_walk_alone(struct tracer *t, const struct shadow_request *r, bool air)
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
    const struct ray ray = ray_batch_at(b->rays, s->ray);
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
            const struct ray ray = ray_batch_at(t->walk_rays, i);
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

// Begins the walks of those rays of a batch that nothing opaque stops and that meet the box of
// something clear; ends those of the others. Returns how many there are.
static uint32_t walks_begin(struct tracer *t, struct shadow_batch *b, uint32_t count,
                            const double *air_end)
{
    const struct job *job = t->job;
    struct shadow_walk *s = t->walk;
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
    return n;
}

// Takes the first n walks across the next surface. Returns how many go on, which stand first.
static uint32_t walks_on(struct tracer *t, struct shadow_batch *b, uint32_t n,
                         const double *air_end)
{
    const struct job *job = t->job;
    struct shadow_walk *s = t->walk;
    struct painted_pass painted;
    uint32_t left = 0;
    if (job->paint)
        walks_paint(t, s, n, &painted);
    for (uint32_t first = 0; first < n; first += DIM) {
        struct rgb dim[DIM];
        const uint32_t end = n - first < DIM ? n : first + DIM;
        if (job->has_media)
            walks_dim(t, s, first, end, dim);
        for (uint32_t i = first; i < end; i++) {
            const struct ray ray = ray_batch_at(t->walk_rays, i);
            const struct hit hit = hit_batch_at(t->walk_hit, i);
            if (!(hit.b.t < ray.t_max))
                walk_end(t, &s[i], b, air_end);
            else if (walk_on(t, &s[i], &ray, &hit, job->has_media ? dim[i - first] : all,
                             job->paint && painted.known[i] ? &painted.pass[i] : NULL))
                s[left++] = s[i];
            else
                b->pass[s[i].ray] = none;
        }
    }
    return left;
}

void shadow_walk_batch(struct tracer *t, struct shadow_batch *b, uint32_t count,
                       const double *air_end)
{
    uint32_t n = walks_begin(t, b, count, air_end);
    if (t->list)
        shadow_list_end(t, b);
    while (n) {
        for (uint32_t i = 0; i < n; i++)
            walk_put(t->walk_rays, i, b->rays, &t->walk[i]);
        t->walk_rays->count = n;
        trace_closest(t->job->world->clear, t->scratch, t->walk_rays, t->walk_hit);
        n = walks_on(t, b, n, air_end);
    }
}

struct shadow_walk *shadow_walks_new(void)
{
    return must_calloc(BATCH_SIZE, sizeof(struct shadow_walk));
}
