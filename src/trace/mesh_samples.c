#include "trace/mesh_samples.h"

#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "scene/mesh_camera.h"

// Rays of several samples, to be traced together.
struct bundle {
    struct tracer_ray ray[BATCH_SIZE];
    float color[BATCH_SIZE][4];
    uint32_t sample[BATCH_SIZE];
    uint32_t count;
    struct mesh_camera_memo memo;
};

// As camera_mesh_ray.
static bool ray_of(const struct job *job, struct bundle *b, struct vec2 at, uint32_t k,
                   struct ray *out)
{
    const struct camera *c = job->camera;
    const struct render_settings *s = &job->settings;
    if (c->normal)
        return camera_mesh_ray(c, at.u, at.v, s->width, s->height, k, out);
    out->t_min = 0;
    out->t_max = INFINITY;
    return mesh_camera_ray(c, at.u, at.v, s->width, s->height, k, &b->memo, &out->o,
                           &out->d);
}

static void bundle_trace(struct tracer *t, struct bundle *b, double (*sum)[4])
{
    if (!b->count)
        return; // no pixel has a ray
    tracer_rays(t, b->ray, b->count, b->color);
    for (uint32_t i = 0; i < b->count; i++)
        for (int k = 0; k < 4; k++)
            sum[b->sample[i]][k] += (double)b->color[i][k];
    b->count = 0;
}

// Whether the pixel has ray k; adds it to the bundle.
static bool bundle_put(const struct job *job, struct bundle *b, struct vec2 at,
                       uint32_t sample, uint32_t k)
{
    const struct render_settings *s = &job->settings;
    struct tracer_ray *r = &b->ray[b->count];
    if (!ray_of(job, b, at, k, &r->ray))
        return false;
    // What is random along the rays of a pixel differs from one to the next.
    r->position = (struct vec2){at.u, at.v + (double)k * s->height};
    r->exists = true;
    r->flags = job->reach > 0 ? PATH_SHORT : 0;
    b->sample[b->count++] = sample;
    return true;
}

void mesh_samples(struct tracer *t, const struct vec2 *position, uint32_t count,
                  float (*out)[4])
{
    const struct job *job = t->job;
    struct bundle *b = must_malloc(1, sizeof *b);
    double(*sum)[4] = must_calloc(count, sizeof *sum);
    uint32_t *rays = must_calloc(count, sizeof *rays);
    b->count = 0;
    b->memo = (struct mesh_camera_memo){.mesh = NULL};
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t k = 0; k < job->camera->mesh->rays; k++) {
            if (b->count == BATCH_SIZE)
                bundle_trace(t, b, sum);
            rays[i] += bundle_put(job, b, position[i], i, k);
        }
    }
    bundle_trace(t, b, sum);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++)
            out[i][k] = rays[i] ? (float)(sum[i][k] / rays[i]) : k == 3 ? 1 : 0;
    free(b);
    free(sum);
    free(rays);
}
