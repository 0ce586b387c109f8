#include "trace/subsurface.h"

#include "base/arena.h"
#include "math/color.h"
#include "math/elementary.h"
#include "math/pi.h"
#include "trace/inside.h"
#include "trace/subsurface_kernel.h"

// What a hit asks of the material.
struct sss {
    struct shading *s;
    const struct subsurface_plan *plan;
    struct sss_channel channel[3];
    double mm;  // of a scene unit
    double eta; // index of the material over that around it
    double out; // of light inside that leaves towards the eye
    struct vec3 n;
};

// ---- the material --------------------------------------------------------------------

// The mean of Fresnel's reflectance over the half sphere, fitted.
static double mean_reflectance(double eta)
{
    if (eta >= 1)
        return (1 - 1 / eta) / 4 + 0.75 * det_pow(1 - 1 / eta, 4.5);
    return eta * eta - det_pow(eta, 2.25);
}

static struct sss_channel channel_of(double albedo, double translucency, double a)
{
    static const double clearest = 1e-6; // mm: below this, light does not travel
    struct sss_channel c;
    c.albedo = albedo;
    c.sigma_s = 1 / fmax(translucency, clearest);
    c.sigma_t = c.albedo > 0 ? c.sigma_s / c.albedo : INFINITY;
    c.sigma_tr = sqrt(3 * (c.sigma_t - c.sigma_s) * c.sigma_t);
    c.z_real = 1 / c.sigma_t;
    c.z_virtual = c.z_real * (1 + 4 * a / 3);
    return c;
}

static double transmittance(const struct sss *x, double cosine)
{
    return 1 - (double)fresnel_reflectance(fabs(cosine), x->eta);
}

static void material(struct sss *x, const struct layer *l)
{
    const struct finish *f = l->finish;
    const double fd = mean_reflectance(x->eta), a = (1 + fd) / (1 - fd);
    const struct rgb t = f->subsurface_translucency;
    const double color[8] = {(double)(l->color.r * f->matt),
                             (double)(l->color.g * f->matt),
                             (double)(l->color.b * f->matt)};
    double albedo[8];
    x->plan->kernels->albedos(color, a, albedo);
    x->channel[0] = channel_of(albedo[0], (double)t.r, a);
    x->channel[1] = channel_of(albedo[1], (double)t.g, a);
    x->channel[2] = channel_of(albedo[2], (double)t.b, a);
}

// ---- ways through the material -------------------------------------------------------

// The wall of the object from inside, where a ray has met one; false: something else is met,
// or nothing.
static bool wall_at(const struct sss *x, const struct ray *ray, const struct hit *hit,
                    struct interaction *at)
{
    const struct world *w = x->s->t->job->world;
    if (!(hit->b.t < INFINITY) ||
        w->surface[w->leaf[hit->b.leaf].surface].interior != x->s->at.surface->interior)
        return false;
    trace_interaction(w, ray, hit, at);
    if (vec3_dot(at->ng, ray->d) < 0)
        at->ng = vec3_neg(at->ng);
    if (vec3_dot(at->ns, ray->d) < 0)
        at->ns = vec3_neg(at->ns);
    return true;
}

// distance: to what is met, whatever it is.
static bool wall(const struct sss *x, struct vec3 o, struct vec3 d, double *distance,
                 struct interaction *at)
{
    const struct tracer *t = x->s->t;
    const struct ray_query q = {{o, d, 0, INFINITY}, 0};
    const struct hit hit = trace_closest_1(t->job->world, t->scratch, &q);
    *distance = hit.b.t;
    return wall_at(x, &q.ray, &hit, at);
}

// Adds a ray to those that look for walls together.
static void wall_ask(const struct tracer *t, struct vec3 o, struct vec3 d)
{
    struct ray_batch *b = t->wall_rays;
    const uint32_t i = b->count++;
    b->o[0][i] = o.x, b->o[1][i] = o.y, b->o[2][i] = o.z;
    b->d[0][i] = d.x, b->d[1][i] = d.y, b->d[2][i] = d.z;
}

// What one of them has met, as wall().
static bool wall_answer(const struct sss *x, uint32_t i, double *distance,
                        struct interaction *at)
{
    const struct tracer *t = x->s->t;
    const struct ray ray = ray_batch_line(t->wall_rays, i);
    *distance = t->wall_hit->t[i];
    if (!(*distance < INFINITY))
        return false;
    const struct hit hit = hit_batch_at(t->wall_hit, i);
    return wall_at(x, &ray, &hit, at);
}

// The direction inside of a ray that comes in; eta of the sides it leaves and enters.
static bool bent(struct vec3 d, struct vec3 n, double eta, struct vec3 *out)
{
    const double c = -vec3_dot(d, n), k = 1 + eta * eta * (c * c - 1);
    if (k < 0)
        return false;
    *out = vec3_normalize(vec3_mad(vec3_scale(eta, d), eta * c - sqrt(k), n));
    return true;
}

// The way of the ray from the eye on below the surface.
struct refracted {
    struct vec3 in;
    double through; // to what it meets
    bool is, leaves;
    struct interaction far; // where it leaves the object
};

static void refract(const struct sss *x, struct refracted *r)
{
    const struct shading *s = x->s;
    r->is = bent(s->path->d, x->n, 1 / x->eta, &r->in);
    r->leaves =
        r->is && wall(x, trace_offset(&s->at, r->in), r->in, &r->through, &r->far);
}

// ---- light of a lamp on places ---------------------------------------------------------

enum { ASKED = BATCH_SIZE };

// How many of `count` are asked at once.
static uint32_t asked_of(uint32_t count) { return count < ASKED ? count : ASKED; }

// Shadow rays that are asked together.
struct asking {
    struct shadow_request *request; // as all arrays here: as many as are asked at once
    struct rgb *factor;             // what comes through
    uint32_t *who;
    uint32_t count;
};

static struct asking asking_new(struct arena *a, uint32_t most)
{
    return (struct asking){arena_new_array(a, struct shadow_request, most),
                           arena_new_array(a, struct rgb, most),
                           arena_new_array(a, uint32_t, most), 0};
}

static void ask(struct asking *a, const struct sss *x, const struct lamp *lamp,
                const struct interaction *at, uint32_t who)
{
    struct lamp_view view;
    if (!lamp_view(lamp, lamp->light->location, at->p, &view))
        return;
    if (!(vec3_dot(at->ns, view.l) > 0))
        return;
    a->who[a->count] = who;
    a->request[a->count++] = (struct shadow_request){.o = trace_offset(at, view.l),
                                                     .d = view.l,
                                                     .t_max = view.distance,
                                                     .value = view.color,
                                                     .inside = x->s->path->inside,
                                                     .slot = x->s->t->slot,
                                                     .lamp = lamp->index};
}

static void answer(struct asking *a, const struct sss *x, const struct lamp *lamp)
{
    if (x->s->t->job->shadows && !lamp->light->shadowless)
        shadow_factors(x->s->t, a->request, a->count, a->factor);
    else
        for (uint32_t i = 0; i < a->count; i++)
            a->factor[i] = rgb(1, 1, 1);
}

// ---- light that was scattered often --------------------------------------------------

// A place where light may come in.
struct entry {
    struct interaction at;
    double weight; // the area it stands for, in mm^2
    double r2;     // its distance from the point that is seen, squared, in mm^2
};

// What comes out of it.
struct entry_light {
    struct rgb light;
    double weight, f[3];
    bool any;
};

// From where directions find the places: halfway to the wall across at most, and in front of
// what else lies below.
static struct vec3 base_of(const struct sss *x)
{
    static const double in_front = 1 - 1e-6;
    const struct shading *s = x->s;
    const double sigma_t =
        luminance(x->channel[0].sigma_t, x->channel[1].sigma_t, x->channel[2].sigma_t);
    double through;
    struct interaction far;
    const struct vec3 in = vec3_neg(x->n);
    if (wall(x, trace_offset(&s->at, in), in, &through, &far))
        through /= 2;
    else
        through *= in_front;
    return vec3_mad(s->at.p, -fmin(1 / sigma_t / x->mm, through), x->n);
}

// The places that directions from `first` on find from a point below the surface; who: the
// numbers of the directions; met: how many of them meet anything.
static uint32_t entries(const struct sss *x, struct vec3 base, uint32_t first,
                        uint32_t count, struct entry *out, uint32_t *who, uint32_t *met)
{
    static const double flattest = 0.01;
    const struct shading *s = x->s;
    const struct ray_batch *b = s->t->wall_rays;
    const double by_u = hash_unit(hash_mix(s->path->hash, 201)),
                 by_v = hash_unit(hash_mix(s->path->hash, 202));
    x->plan->kernels->ways(x->plan->u + first, x->plan->v + first, by_u, by_v, count,
                           b->d);
    s->t->wall_rays->count = count;
    for (uint32_t i = 0; i < count; i++)
        b->o[0][i] = base.x, b->o[1][i] = base.y, b->o[2][i] = base.z;
    trace_closest(s->t->job->world, s->t->scratch, b, s->t->wall_hit);
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        double t;
        struct entry *e = &out[n];
        const bool is_wall = wall_answer(x, i, &t, &e->at);
        *met += t < INFINITY;
        if (!is_wall)
            continue;
        const struct vec3 d = {b->d[0][i], b->d[1][i], b->d[2][i]};
        const struct vec3 apart = vec3_sub(e->at.p, s->at.p);
        e->weight =
            4 * PI * t * t / fmax(flattest, fabs(vec3_dot(e->at.ng, d))) * x->mm * x->mm;
        e->r2 = vec3_dot(apart, apart) * x->mm * x->mm;
        who[n++] = x->plan->index[first + i];
    }
    return n;
}

static void diffuse_lamp(const struct sss *x, const struct lamp *lamp, struct asking *a,
                         const struct entry *e, const uint32_t *who, uint32_t count,
                         struct entry_light *out)
{
    double r2[ASKED + 8], f[3][ASKED + 8];
    a->count = 0;
    for (uint32_t i = 0; i < count; i++)
        ask(a, x, lamp, &e[i].at, i);
    answer(a, x, lamp);
    for (uint32_t i = 0; i < a->count + 7; i++)
        r2[i] = i < a->count ? e[a->who[i]].r2 : 1;
    for (int k = 0; k < 3; k++)
        x->plan->kernels->dipoles(&x->channel[k], r2, a->count, f[k]);
    for (uint32_t i = 0; i < a->count; i++) {
        const struct entry *at = &e[a->who[i]];
        const double c = vec3_dot(at->at.ns, a->request[i].d);
        out[who[a->who[i]]] =
            (struct entry_light){rgb_mul(a->request[i].value, a->factor[i]),
                                 c * transmittance(x, c) * x->out * at->weight,
                                 {f[0][i], f[1][i], f[2][i]},
                                 true};
    }
}

// Adds up in the order of the directions.
static void lights_add(const struct entry_light *e, uint32_t count, double sum[3])
{
    for (uint32_t i = 0; i < count; i++) {
        if (!e[i].any)
            continue;
        sum[0] += e[i].weight * (double)e[i].light.r * e[i].f[0];
        sum[1] += e[i].weight * (double)e[i].light.g * e[i].f[1];
        sum[2] += e[i].weight * (double)e[i].light.b * e[i].f[2];
    }
}

static void diffuse(const struct sss *x, struct asking *a, uint32_t count, double out[3])
{
    struct tracer *t = x->s->t;
    const struct lamp_list *list = &t->job->lamps[x->s->at.surface->light_group];
    const size_t all = (size_t)count * list->count;
    struct entry_light *lit = arena_new_array(t->arena, struct entry_light, all + 1);
    struct entry *e = arena_new_array(t->arena, struct entry, asked_of(count));
    uint32_t *who = arena_new_array(t->arena, uint32_t, asked_of(count)), met = 0;
    const struct vec3 base = base_of(x);
    for (uint32_t first = 0; first < count; first += ASKED) {
        const uint32_t n = entries(x, base, first, asked_of(count - first), e, who, &met);
        for (uint32_t i = 0; i < list->count && n; i++)
            if (!list->lamp[i]->inert)
                diffuse_lamp(x, list->lamp[i], a, e, who, n, lit + (size_t)i * count);
    }
    double sum[3] = {0, 0, 0};
    for (uint32_t i = 0; i < list->count; i++)
        lights_add(lit + (size_t)i * count, count, sum);
    for (int k = 0; k < 3 && met; k++)
        out[k] += sum[k] / met;
}

// ---- light that was scattered once ---------------------------------------------------

// Where on the refracted ray, `depth` mm along it, for one channel.
struct inner {
    struct vec3 p;
    double depth;
    uint32_t channel, number;
};

// What of the light that comes in at a wall, in the direction of a request, reaches the eye.
static double once(const struct sss *x, const struct inner *q, double way,
                   const struct interaction *at, struct vec3 d, struct vec3 in)
{
    static const double phase = 0.25;
    const struct sss_channel *c = &x->channel[q->channel];
    const double cosine = vec3_dot(at->ns, d);
    const double inner = sqrt(fmax(0, 1 - (1 - cosine * cosine) / (x->eta * x->eta)));
    if (!(inner > 0))
        return 0;
    const double straight = way * x->mm * cosine / inner,
                 g = fabs(vec3_dot(at->ns, in)) / inner;
    return cosine * c->sigma_s * phase * transmittance(x, cosine) * x->out /
           (c->sigma_t * (1 + g)) * det_exp(-c->sigma_t * (straight + q->depth));
}

static uint32_t inner_points(const struct sss *x, const struct refracted *r,
                             uint32_t count, struct inner *out)
{
    const struct shading *s = x->s;
    uint32_t n = 0;
    for (uint32_t k = 0; k < 3; k++) {
        const struct sss_channel *c = &x->channel[k];
        for (uint32_t i = 0; i < count && c->sigma_t < INFINITY; i++) {
            const uint32_t h = hash_mix(hash_mix(s->path->hash, 300 + k), i);
            const double depth = -det_log(1 - hash_unit(h)) / c->sigma_t;
            if (depth < r->through * x->mm)
                out[n++] =
                    (struct inner){vec3_mad(s->at.p, depth / x->mm, r->in), depth, k, i};
        }
    }
    return n;
}

// The light of one lamp at the points, at most ASKED; at: room for as many walls.
static void single_lamp(const struct sss *x, const struct lamp *lamp,
                        const struct refracted *r, struct asking *a,
                        const struct inner *q, uint32_t count, struct interaction *at,
                        double *out)
{
    struct tracer *t = x->s->t;
    double way[ASKED];
    uint32_t who[ASKED];
    t->wall_rays->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        struct lamp_view view;
        out[i] = 0;
        if (!lamp_view(lamp, lamp->light->location, q[i].p, &view))
            continue;
        who[t->wall_rays->count] = i;
        wall_ask(t, q[i].p, view.l);
    }
    trace_closest(t->job->world, t->scratch, t->wall_rays, t->wall_hit);
    a->count = 0;
    for (uint32_t i = 0; i < t->wall_rays->count; i++)
        if (wall_answer(x, i, &way[i], &at[i]))
            ask(a, x, lamp, &at[i], i);
    answer(a, x, lamp);
    for (uint32_t i = 0; i < a->count; i++) {
        const uint32_t k = a->who[i];
        const struct inner *from = &q[who[k]];
        const struct rgb color = rgb_mul(a->request[i].value, a->factor[i]);
        out[who[k]] = once(x, from, way[k], &at[k], a->request[i].d, r->in) *
                      (double)(from->channel == 0   ? color.r
                               : from->channel == 1 ? color.g
                                                    : color.b);
    }
}

static void single(const struct sss *x, const struct refracted *r, struct asking *a,
                   uint32_t count, double out[3])
{
    struct tracer *t = x->s->t;
    const struct lamp_list *list = &t->job->lamps[x->s->at.surface->light_group];
    if (!r->is)
        return;
    struct inner *q = arena_new_array(t->arena, struct inner, 3 * (size_t)count);
    const uint32_t points = inner_points(x, r, count, q);
    double *light = arena_new_array(t->arena, double, (size_t)points * list->count + 1);
    struct interaction *at =
        arena_new_array(t->arena, struct interaction, asked_of(points));
    for (uint32_t j = 0; j < list->count; j++)
        for (uint32_t i = 0; i < points; i += ASKED)
            if (!list->lamp[j]->inert)
                single_lamp(x, list->lamp[j], r, a, q + i, asked_of(points - i), at,
                            light + (size_t)j * points + i);
    double sum[3] = {0, 0, 0};
    for (uint32_t i = 0; i < points; i++)
        for (uint32_t j = 0; j < list->count; j++)
            if (!list->lamp[j]->inert)
                sum[q[i].channel] += light[(size_t)j * points + i];
    for (int k = 0; k < 3; k++)
        out[k] += sum[k] / count;
}

// ---- light that was not scattered ----------------------------------------------------

static void unscattered(const struct sss *x, const struct layer *l,
                        const struct refracted *r)
{
    const struct shading *s = x->s;
    struct vec3 d;
    if (!r->leaves)
        return;
    const double way = r->through * x->mm;
    const struct rgb clear = {(float)det_exp(-x->channel[0].sigma_t * way),
                              (float)det_exp(-x->channel[1].sigma_t * way),
                              (float)det_exp(-x->channel[2].sigma_t * way)};
    if (!bent(r->in, vec3_neg(r->far.ng), x->eta, &d))
        return;
    struct path p = *s->path;
    p.o = trace_offset(&r->far, d);
    p.d = d;
    p.hash = hash_mix(p.hash, 400);
    p.through = rgb_mul(p.through, rgb_mul(l->filter, clear));
    p.through_t = 0;
    p.weight *= rgb_max(clear);
    path_emit(s->t, &p);
}

void shade_subsurface(struct shading *s, const struct layer *l)
{
    const struct job *job = s->t->job;
    const struct subsurface_settings *set = &job->scene->settings.subsurface;
    const struct interior *own = s->at.surface->interior;
    if (inside_find(s->path->inside, own))
        return;
    struct sss x = {.s = s,
                    .plan = job->subsurface,
                    .mm = job->scene->settings.mm_per_unit,
                    .eta = fresnel_index(s->path->inside, own),
                    .n = s->view.n};
    x.out = transmittance(&x, vec3_dot(s->path->d, x.n));
    material(&x, l);
    const struct arena_mark mark = arena_mark(s->t->arena);
    const uint32_t often = (uint32_t)set->samples_diffuse,
                   few = (uint32_t)set->samples_single;
    struct asking a =
        asking_new(s->t->arena, asked_of(often > 3 * few ? often : 3 * few));
    struct refracted r;
    double light[3] = {0, 0, 0};
    refract(&x, &r);
    diffuse(&x, &a, often, light);
    single(&x, &r, &a, few, light);
    arena_rewind(s->t->arena, mark);
    s->t->last_push = (struct inside_pushed){0}; // may have stood behind the mark
    tracer_add(s->t, rgb_mul(rgb_mul(s->path->through, l->filter),
                             rgb((float)light[0], (float)light[1], (float)light[2])));
    unscattered(&x, l, &r);
}
