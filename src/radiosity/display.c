// What the picture takes from a solution.
#include <math.h>

#include "radiosity/radiosity.h"
#include "radiosity/sequence.h"
#include "trace/tracer.h"

static struct rgb of_double(const double c[3])
{
    return rgb((float)c[0], (float)c[1], (float)c[2]);
}

// Irradiance by elements, interpolated. *own: the element of the hit.
static struct rgb mesh_light(const struct radiosity *r, struct tracer *t,
                             const struct indirect_query *q, uint32_t *own)
{
    uint32_t element[4] = {ELEMENT_NONE};
    double weight[4], sum[3] = {0, 0, 0};
    const uint32_t n =
        patch_around(r->patches, t->scratch, q->ray, q->hit, q->at, element, weight);
    for (uint32_t k = 0; k < n; k++)
        for (int c = 0; c < 3; c++)
            sum[c] += weight[k] * r->shown[element[k]][c];
    *own = element[0];
    return of_double(sum);
}

// Irradiance by rays to the elements around.
static struct rgb gathered_light(const struct radiosity *r, struct tracer *t,
                                 struct vec3 o, struct vec3 n, uint32_t hash)
{
    const struct world *w = r->patches->job->world; // as patches see it
    double sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < r->settings.gather; k++) {
        double s[4], own[3];
        sobol_point(k, hash, s);
        const struct vec3 d = cosine_direction(n, s[0], s[1]);
        const struct ray_query q = {{o, d, 0, INFINITY}, OBJECT_NO_RADIOSITY};
        const struct hit hit = trace_closest_1(w, t->scratch, &q);
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
    // The surface itself, not a bump, decides what is seen.
    const struct vec3 o = trace_offset(q->at, q->side);
    uint32_t own = ELEMENT_NONE;
    struct rgb c = r->settings.gather ? gathered_light(r, t, o, q->side, q->hash)
                                      : mesh_light(r, t, q, &own);
    if (r->emitter_count)
        c = rgb_add(c, emitters_light(r, state, t, o, q->side, own, q->hash));
    return c;
}

static void open(const void *data, struct vec3 p, struct open_light *out)
{
    const struct radiosity *r = data;
    volume_light(r->volume, p, out);
}

struct indirect radiosity_indirect(const struct radiosity *r)
{
    return (struct indirect){.data = r,
                             .begin = emitters_begin,
                             .end = emitters_end,
                             .irradiance = irradiance,
                             .open = r->volume ? open : NULL};
}

struct rgb radiosity_of_hit(const struct radiosity *r, struct trace_scratch *scratch,
                            const struct ray *ray, const struct hit *hit)
{
    const uint32_t e = patch_of_hit(r->patches, scratch, ray, hit);
    return e == ELEMENT_NONE ? rgb(0, 0, 0) : of_double(r->solution.b[e]);
}
