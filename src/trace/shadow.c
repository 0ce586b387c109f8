#include "math/elementary.h"
#include "trace/inside.h"
#include "trace/layers.h"
#include "trace/sky.h"

static const double zero = 1e-10; // spec/lighting.md 0

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
            pass = rgb_scale((float)(1 + det_pow(c, o->caustics)), pass);
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

struct rgb shadow_filter(struct tracer *t, const struct shadow_request *r)
{
    const struct job *job = t->job;
    struct ray_query q = {{r->o, r->d, 0, r->t_max}, OBJECT_NO_SHADOW};
    const struct inside *inside = r->inside;
    struct rgb c = {1, 1, 1};
    for (;;) {
        const struct hit hit = trace_closest_1(job->world, t->scratch, &q);
        if (!(hit.b.t < r->t_max))
            return c;
        struct interaction at;
        trace_interaction(job->world, &q.ray, &hit, &at);
        if (at.surface->opaque)
            return rgb(0, 0, 0);
        struct rgb pass = occluder_filter(t, &at, r->d);
        const struct interior *x = at.surface->interior;
        if (inside_find(inside, x)) {
            if (x->fade_power > 0 && fabs(x->fade_distance) > zero)
                pass = rgb_mul(pass, interior_fade(x, hit.b.t - q.ray.t_min));
            inside = inside_remove(t->arena, inside, x);
        } else {
            inside = inside_push(t->arena, inside, x);
        }
        if (fmaxf(fabsf(pass.r), fmaxf(fabsf(pass.g), fabsf(pass.b))) < (float)zero)
            return rgb(0, 0, 0);
        c = rgb_mul(c, pass);
        q.ray.t_min = hit.b.t;
    }
}

// Fog on the way to the light, for lights that are attenuated by it.
static struct rgb shadow_fog(struct tracer *t, const struct shadow_request *r,
                             struct rgb c)
{
    const struct light *light = t->job->lamp[r->lamp].light;
    if (!light->media_attenuation || !light->media_interaction || !t->job->atmosphere ||
        !t->job->scene->fog_count || !inside_hollow(r->inside))
        return c;
    return rgb_mul(c, fog_filter(t->job, r->o, r->d, r->t_max));
}

static struct rgb shadow_rest(struct tracer *t, const struct shadow_request *r)
{
    struct rgb c = {1, 1, 1};
    if (t->job->world->has_transparent)
        c = shadow_filter(t, r);
    return shadow_fog(t, r, c);
}

struct rgb shadow_factor(struct tracer *t, const struct shadow_request *r)
{
    if (!(r->t_max > 0))
        return rgb(1, 1, 1);
    const struct ray_query q = {{r->o, r->d, 0, r->t_max}, OBJECT_NO_SHADOW};
    if (trace_occluded_1(t->job->world, t->scratch, &q))
        return rgb(0, 0, 0);
    return shadow_rest(t, r);
}

void shadow_add(struct tracer *t, const struct shadow_request *r)
{
    t->shadow[t->shadow_count++] = *r;
    if (t->shadow_count == BATCH_SIZE)
        shadow_flush(t);
}

static void shadow_put(struct ray_batch *b, uint32_t i, const struct shadow_request *r)
{
    b->o[0][i] = r->o.x;
    b->o[1][i] = r->o.y;
    b->o[2][i] = r->o.z;
    b->d[0][i] = r->d.x;
    b->d[1][i] = r->d.y;
    b->d[2][i] = r->d.z;
    b->t_min[i] = 0;
    b->t_max[i] = r->t_max;
    b->hidden_by[i] = OBJECT_NO_SHADOW;
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
    if (!count)
        return;
    shadow_sort(t);
    for (uint32_t i = 0; i < count; i++)
        shadow_put(t->shadow_rays, t->shadow_order[i], &t->shadow[i]);
    t->shadow_rays->count = count;
    trace_occluded(t->job->world, t->scratch, t->shadow_rays, t->occluded);
    t->shadow_count = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (t->occluded[t->shadow_order[i]])
            continue;
        const struct shadow_request *r = &t->shadow[i];
        const struct rgb c = rgb_mul(r->value, shadow_rest(t, r));
        t->sum[r->sample].lit = rgb_add(t->sum[r->sample].lit, c);
    }
}
