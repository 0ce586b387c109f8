// What the picture takes from a solution.
#include <math.h>
#include <stdlib.h>

#include "radiosity/polygon.h"
#include "radiosity/radiosity.h"
#include "radiosity/sequence.h"
#include "trace/tracer.h"

enum { EMITTER_RAYS = 16 };

static struct rgb of_double(const double c[3])
{
    return rgb((float)c[0], (float)c[1], (float)c[2]);
}

// Whether a point of an emitting element is seen.
static bool emitter_seen(struct tracer *t, struct vec3 o, struct vec3 to)
{
    // Ends short of the emitter, which is no obstacle to itself.
    const struct ray_query q = {{o, vec3_sub(to, o), 0, 1 - 1e-4}, OBJECT_NO_RADIOSITY};
    return !trace_occluded_1(t->job->world, t->scratch, &q);
}

// Whether Lambert's formula of the corners is exact for an element.
static bool is_polygon(const struct element *e)
{
    return !e->curved && !e->partial && fabsf(e->coverage - 1) < 1e-5f;
}

// What the emitting elements give at a point by Lambert's formula, summed up into up_to.
// Returns the part of polygons.
static double emitters_sum(const struct radiosity *r, struct vec3 o, struct vec3 n,
                           double *up_to)
{
    double sum = 0, polygons = 0;
    for (uint32_t i = 0; i < r->emitter_count; i++) {
        const struct element *x = &r->patches->element[r->emitter[i]];
        const double c = lambert_polygon(o, n, x->corner, x->corner_count) *
                         (double)x->coverage * (double)rgb_max(x->emission);
        sum += c;
        polygons += is_polygon(x) ? c : 0;
        up_to[i] = sum;
    }
    return polygons;
}

// Irradiance of the emitting elements at a point: shadow rays to points of their true
// surfaces, elements drawn by what they give. Of polygons the points say what part of
// Lambert's sum is open; of other elements they are the integral.
static struct rgb emitters_light(const struct radiosity *r, struct tracer *t,
                                 struct vec3 o, struct vec3 n, uint32_t hash)
{
    // Of a point relative to the mean: nearer than an element's size it has no bound.
    static const double weight_most = 8;
    double up_to[EMITTERS_MOST], s[4], all = 0;
    const double polygons = emitters_sum(r, o, n, up_to);
    const double sum = r->emitter_count ? up_to[r->emitter_count - 1] : 0;
    const struct element_point here = {o, n, 0};
    struct rgb open = {0, 0, 0}, other = {0, 0, 0};
    if (sum <= 0)
        return open;
    random_point(0, hash, s);
    for (uint32_t k = 0, i = 0; k < EMITTER_RAYS; k++) {
        const double at = (k + s[0]) / EMITTER_RAYS * sum;
        while (i + 1 < r->emitter_count && up_to[i] <= at)
            i++;
        const struct element *e = &r->patches->element[r->emitter[i]];
        struct element_point to;
        double x[4];
        sobol_point(k, hash, x);
        if (!patch_element_point(r->patches, t->scratch, r->emitter[i], x[0], x[1], &to))
            continue;
        const double share = up_to[i] - (i ? up_to[i - 1] : 0);
        const double most = rgb_max(e->emission);
        const double weight =
            fmin(point_kernel(&here, &to) * e->area * most / share, weight_most);
        const bool polygon = is_polygon(e);
        all += polygon ? weight : 0;
        if (!(weight > 0) || !emitter_seen(t, o, to.p))
            continue;
        struct rgb *into = polygon ? &open : &other;
        *into = rgb_add(*into, rgb_scale((float)(weight / most), e->emission));
    }
    open = rgb_scale(all > 0 ? (float)(polygons / all) : 0, open);
    return rgb_add(open, rgb_scale((float)(sum / EMITTER_RAYS), other));
}

// Irradiance by elements, interpolated.
static struct rgb mesh_light(const struct radiosity *r, struct tracer *t,
                             const struct ray *ray, const struct hit *hit)
{
    uint32_t element[4];
    double weight[4], sum[3] = {0, 0, 0};
    const uint32_t n = patch_around(r->patches, t->scratch, ray, hit, element, weight);
    for (uint32_t k = 0; k < n; k++)
        for (int c = 0; c < 3; c++)
            sum[c] += weight[k] * r->shown[element[k]][c];
    return of_double(sum);
}

// Irradiance by rays to the elements around.
static struct rgb gathered_light(const struct radiosity *r, struct tracer *t,
                                 struct vec3 o, struct vec3 n, uint32_t hash)
{
    double sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < r->settings.gather; k++) {
        double s[4], own[3];
        sobol_point(k, hash, s);
        const struct vec3 d = cosine_direction(n, s[0], s[1]);
        const struct ray_query q = {{o, d, 0, INFINITY}, OBJECT_NO_RADIOSITY};
        const struct hit hit = trace_closest_1(t->job->world, t->scratch, &q);
        if (!(hit.b.t < INFINITY))
            continue;
        const uint32_t e = patch_of_hit(r->patches, t->scratch, &q.ray, &hit);
        if (e == ELEMENT_NONE)
            continue;
        element_emission(&r->patches->element[e], own);
        for (int c = 0; c < 3; c++)
            sum[c] += r->solution.b[e][c] - (r->emitter_count ? own[c] : 0);
    }
    for (int c = 0; c < 3; c++)
        sum[c] /= r->settings.gather;
    return of_double(sum);
}

static struct rgb irradiance(const void *data, void *state, struct tracer *t,
                             const struct indirect_query *q)
{
    const struct radiosity *r = data;
    (void)state;
    // The surface itself, not a bump, decides what is seen.
    const struct vec3 o = trace_offset(q->at, q->side);
    struct rgb c = r->settings.gather ? gathered_light(r, t, o, q->side, q->hash)
                                      : mesh_light(r, t, q->ray, q->hit);
    if (r->emitter_count)
        c = rgb_add(c, emitters_light(r, t, o, q->side, q->hash));
    return c;
}

struct indirect radiosity_indirect(const struct radiosity *r)
{
    return (struct indirect){.data = r, .irradiance = irradiance};
}

struct rgb radiosity_of_hit(const struct radiosity *r, struct trace_scratch *scratch,
                            const struct ray *ray, const struct hit *hit)
{
    const uint32_t e = patch_of_hit(r->patches, scratch, ray, hit);
    return e == ELEMENT_NONE ? rgb(0, 0, 0) : of_double(r->solution.b[e]);
}
