#ifndef TRACE_SHADE_CAMERA_H
#define TRACE_SHADE_CAMERA_H

// Rays of cameras, eight at a time: camera_ray.
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

static void camera(const struct job *job, const struct vec2 *position, uint32_t count,
                   struct ray_batch *out)
{
    const struct camera *c = job->camera;
    const struct real8 width = r8_set(job->settings.width),
                       height = r8_set(job->settings.height), half = r8_set(0.5);
    const struct vec8 right = V8_SET(c->right), up = V8_SET(c->up);
    const struct vec8 location = V8_SET(c->location), direction = V8_SET(c->direction);
    const bool parallel = c->kind == CAMERA_ORTHOGRAPHIC;
    for (uint32_t i = 0; i < count; i += 8) {
        const struct vec2 *from = position + i;
        struct vec2 last[8];
        struct real8 px, py;
        if (i + 8 > count) {
            for (uint32_t k = 0; k < 8; k++)
                last[k] = position[i + k < count ? i + k : i];
            from = last;
        }
        r8_load_pairs(&from->u, &px, &py);
        const struct real8 u = r8_sub(r8_div(px, width), half);
        const struct real8 v = r8_sub(half, r8_div(py, height));
        const struct vec8 at =
            v8_mad(v8_mad(parallel ? location : direction, u, right), v, up);
        const struct vec8 o = parallel ? at : location;
        const struct vec8 d = v8_normalize(parallel ? direction : at);
        r8_store(out->o[0] + i, o.x);
        r8_store(out->o[1] + i, o.y);
        r8_store(out->o[2] + i, o.z);
        r8_store(out->d[0] + i, d.x);
        r8_store(out->d[1] + i, d.y);
        r8_store(out->d[2] + i, d.z);
        for (uint32_t k = 0; k < 8; k++)
            out->hidden_by[i + k] = OBJECT_NO_IMAGE;
    }
}

#endif
