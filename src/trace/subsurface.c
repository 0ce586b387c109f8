#include "trace/subsurface.h"

#include "base/arena.h"
#include "math/elementary.h"
#include "math/halton.h"
#include "trace/inside.h"

static const double pi = 3.14159265358979323846;

// One colour channel of a material; lengths in mm.
struct channel {
    double albedo, sigma_s, sigma_t, sigma_tr;
    double z_real, z_virtual; // depths of the dipole's two lights
};

// What a hit asks of the material.
struct sss {
    struct shading *s;
    struct channel channel[3];
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

// What a half space sends back of light that falls on it, by its albedo.
static double half_space(double albedo, double a)
{
    const double q = sqrt(3 * (1 - albedo));
    return albedo / 2 * (1 + det_exp(-4.0 / 3 * a * q)) * det_exp(-q);
}

// The albedo that gives a half space this colour.
static double albedo_of(double color, double a)
{
    double low = 0, high = 1;
    for (int i = 0; i < 40; i++) {
        const double middle = (low + high) / 2;
        if (half_space(middle, a) < color)
            low = middle;
        else
            high = middle;
    }
    return (low + high) / 2;
}

static struct channel channel_of(double color, double translucency, double a)
{
    static const double clearest = 1e-6; // mm: below this, light does not travel
    struct channel c;
    c.albedo = albedo_of(color, a);
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
    x->channel[0] = channel_of((double)(l->color.r * f->matt), (double)t.r, a);
    x->channel[1] = channel_of((double)(l->color.g * f->matt), (double)t.g, a);
    x->channel[2] = channel_of((double)(l->color.b * f->matt), (double)t.b, a);
}

// ---- ways through the material -------------------------------------------------------

// The wall of the object from inside; false: something else is met.
static bool wall(const struct sss *x, struct vec3 o, struct vec3 d, double *distance,
                 struct interaction *at)
{
    const struct tracer *t = x->s->t;
    const struct ray_query q = {{o, d, 0, INFINITY}, 0};
    const struct hit hit = trace_closest_1(t->job->world, t->scratch, &q);
    if (!(hit.b.t < INFINITY))
        return false;
    trace_interaction(t->job->world, &q.ray, &hit, at);
    *distance = hit.b.t;
    if (vec3_dot(at->ng, d) < 0)
        at->ng = vec3_neg(at->ng);
    if (vec3_dot(at->ns, d) < 0)
        at->ns = vec3_neg(at->ns);
    return at->surface->interior == x->s->at.surface->interior;
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

// ---- light that was scattered often --------------------------------------------------

// A place where light may come in.
struct entry {
    struct interaction at;
    double weight; // the area it stands for, in mm^2
    double r2;     // its distance from the point that is seen, squared, in mm^2
};

static double reflectance(const struct channel *c, double r2)
{
    double sum = 0;
    for (int i = 0; i < 2; i++) {
        const double z = i ? c->z_virtual : c->z_real, d2 = z * z + r2, d = sqrt(d2);
        sum += z * (c->sigma_tr + 1 / d) * det_exp(-c->sigma_tr * d) / d2;
    }
    return c->albedo / (4 * pi) * sum;
}

static double turned(double v, uint32_t hash) { return fmod(v + hash_unit(hash), 1); }

// Directions around a point below the surface find the places.
static uint32_t entries(const struct sss *x, uint32_t count, struct entry *out)
{
    static const double flattest = 0.01;
    const struct shading *s = x->s;
    const double grey = 0.297 * x->channel[0].sigma_t + 0.589 * x->channel[1].sigma_t +
                        0.114 * x->channel[2].sigma_t;
    double depth = 1 / grey / x->mm, through;
    struct interaction far;
    const struct vec3 in = vec3_neg(x->n);
    if (wall(x, trace_offset(&s->at, in), in, &through, &far))
        depth = fmin(depth, through / 2);
    const struct vec3 base = vec3_mad(s->at.p, -depth, x->n);
    uint32_t n = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double u = turned(halton(i + 1, 2), hash_mix(s->path->hash, 201));
        const double v = turned(halton(i + 1, 3), hash_mix(s->path->hash, 202));
        const double y = 1 - 2 * u, r = sqrt(fmax(0, 1 - y * y));
        const struct vec3 d = {r * det_cos(2 * pi * v), y, r * det_sin(2 * pi * v)};
        double t;
        struct entry *e = &out[n];
        if (!wall(x, base, d, &t, &e->at))
            continue;
        const struct vec3 apart = vec3_sub(e->at.p, s->at.p);
        e->weight =
            4 * pi * t * t / fmax(flattest, fabs(vec3_dot(e->at.ng, d))) * x->mm * x->mm;
        e->r2 = vec3_dot(apart, apart) * x->mm * x->mm;
        n++;
    }
    return n;
}

// Light of one lamp at places on the surface, eight shadow rays and more at a time.
struct asking {
    struct shadow_request request[64];
    struct rgb factor[64];
    uint32_t who[64];
    uint32_t count;
};

static bool ask(struct asking *a, const struct sss *x, const struct lamp *lamp,
                const struct interaction *at, uint32_t who)
{
    struct lamp_view view;
    if (!lamp_view(lamp, lamp->light->location, at->p, &view))
        return false;
    if (!(vec3_dot(at->ns, view.l) > 0))
        return false;
    a->who[a->count] = who;
    a->request[a->count++] = (struct shadow_request){.o = trace_offset(at, view.l),
                                                     .d = view.l,
                                                     .t_max = view.distance,
                                                     .value = view.color,
                                                     .inside = x->s->path->inside,
                                                     .slot = x->s->t->slot,
                                                     .lamp = lamp->index};
    return true;
}

static void answer(struct asking *a, const struct sss *x, const struct lamp *lamp)
{
    if (x->s->t->job->shadows && !lamp->light->shadowless)
        shadow_factors(x->s->t, a->request, a->count, a->factor);
    else
        for (uint32_t i = 0; i < a->count; i++)
            a->factor[i] = rgb(1, 1, 1);
}

static void add(double sum[3], struct rgb c, double k, const double f[3])
{
    sum[0] += k * (double)c.r * f[0];
    sum[1] += k * (double)c.g * f[1];
    sum[2] += k * (double)c.b * f[2];
}

static void diffuse_lamp(const struct sss *x, const struct lamp *lamp,
                         const struct entry *e, uint32_t count, double sum[3])
{
    for (uint32_t first = 0; first < count; first += 64) {
        struct asking a = {.count = 0};
        for (uint32_t i = first; i < count && i < first + 64; i++)
            ask(&a, x, lamp, &e[i].at, i);
        answer(&a, x, lamp);
        for (uint32_t i = 0; i < a.count; i++) {
            const struct entry *at = &e[a.who[i]];
            const double c = vec3_dot(at->at.ns, a.request[i].d);
            const double f[3] = {reflectance(&x->channel[0], at->r2),
                                 reflectance(&x->channel[1], at->r2),
                                 reflectance(&x->channel[2], at->r2)};
            add(sum, rgb_mul(a.request[i].value, a.factor[i]),
                c * transmittance(x, c) * x->out * at->weight, f);
        }
    }
}

static void diffuse(const struct sss *x, uint32_t count, double out[3])
{
    struct tracer *t = x->s->t;
    const struct lamp_list *list = &t->job->lamps[x->s->at.surface->light_group];
    const struct arena_mark mark = arena_mark(t->arena);
    struct entry *e = arena_new_array(t->arena, struct entry, count);
    const uint32_t found = entries(x, count, e);
    double sum[3] = {0, 0, 0};
    for (uint32_t i = 0; i < list->count && found; i++)
        if (!list->lamp[i]->inert)
            diffuse_lamp(x, list->lamp[i], e, found, sum);
    for (int k = 0; k < 3 && found; k++)
        out[k] += sum[k] / found;
    arena_rewind(t->arena, mark);
    t->last_push = (struct inside_pushed){0}; // may have stood behind the mark
}

// ---- light that was scattered once ---------------------------------------------------

// From the lamp to a point on the refracted ray `in`, s mm along it.
static double once(const struct sss *x, const struct channel *c, const struct lamp *lamp,
                   struct vec3 q, double s, struct vec3 in, struct rgb *color)
{
    static const double phase = 0.25;
    struct lamp_view view;
    struct interaction at;
    struct asking a = {.count = 0};
    double way;
    if (!lamp_view(lamp, lamp->light->location, q, &view) ||
        !wall(x, q, view.l, &way, &at) || !ask(&a, x, lamp, &at, 0))
        return 0;
    const double cosine = vec3_dot(at.ns, a.request[0].d);
    answer(&a, x, lamp);
    *color = rgb_mul(a.request[0].value, a.factor[0]);
    const double inner = sqrt(fmax(0, 1 - (1 - cosine * cosine) / (x->eta * x->eta)));
    if (!(inner > 0))
        return 0;
    const double straight = way * x->mm * cosine / inner,
                 g = fabs(vec3_dot(at.ns, in)) / inner;
    return cosine * c->sigma_s * phase * transmittance(x, cosine) * x->out /
           (c->sigma_t * (1 + g)) * det_exp(-c->sigma_t * (straight + s));
}

static void single(const struct sss *x, uint32_t count, double out[3])
{
    const struct shading *s = x->s;
    const struct lamp_list *list = &s->t->job->lamps[s->at.surface->light_group];
    struct vec3 in;
    struct interaction far;
    double through;
    if (!bent(s->path->d, x->n, 1 / x->eta, &in) ||
        !wall(x, trace_offset(&s->at, in), in, &through, &far))
        return;
    for (int k = 0; k < 3; k++) {
        const struct channel *c = &x->channel[k];
        double sum = 0;
        for (uint32_t i = 0; i < count && c->sigma_t < INFINITY; i++) {
            const uint32_t h = hash_mix(hash_mix(s->path->hash, 300 + (uint32_t)k), i);
            const double depth = -det_log(1 - hash_unit(h)) / c->sigma_t;
            if (!(depth < through * x->mm))
                continue;
            const struct vec3 q = vec3_mad(s->at.p, depth / x->mm, in);
            for (uint32_t j = 0; j < list->count; j++) {
                struct rgb color = {0, 0, 0};
                if (list->lamp[j]->inert)
                    continue;
                const double f = once(x, c, list->lamp[j], q, depth, in, &color);
                sum += f * (double)(k == 0 ? color.r : k == 1 ? color.g : color.b);
            }
        }
        out[k] += sum / count;
    }
}

// ---- light that was not scattered ----------------------------------------------------

static void unscattered(const struct sss *x, const struct layer *l)
{
    const struct shading *s = x->s;
    struct vec3 in, d;
    struct interaction far;
    double through;
    if (!bent(s->path->d, x->n, 1 / x->eta, &in) ||
        !wall(x, trace_offset(&s->at, in), in, &through, &far))
        return;
    const double way = through * x->mm;
    const struct rgb clear = {(float)(x->out * det_exp(-x->channel[0].sigma_t * way)),
                              (float)(x->out * det_exp(-x->channel[1].sigma_t * way)),
                              (float)(x->out * det_exp(-x->channel[2].sigma_t * way))};
    if (!bent(in, vec3_neg(far.ng), x->eta, &d))
        return;
    struct path p = *s->path;
    p.o = trace_offset(&far, d);
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
                    .mm = job->scene->settings.mm_per_unit,
                    .eta = fresnel_index(s->path->inside, own),
                    .n = s->view.n};
    x.out = transmittance(&x, vec3_dot(s->path->d, x.n));
    material(&x, l);
    double light[3] = {0, 0, 0};
    diffuse(&x, (uint32_t)set->samples_diffuse, light);
    single(&x, (uint32_t)set->samples_single, light);
    tracer_add(s->t, rgb_mul(rgb_mul(s->path->through, l->filter),
                             rgb((float)light[0], (float)light[1], (float)light[2])));
    unscattered(&x, l);
}
