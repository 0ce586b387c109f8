#ifndef TRACE_SHADE_AIR_H
#define TRACE_SHADE_AIR_H

// Fogs between the beginnings of eight rays and what they hit: fogs_apply in lanes.
#include "math/quick_lanes.h"
#include "scene/noise_kernel.h"
#include "scene/pigment_tape.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"
#include "trace/sky.h"

// ground_density.
LANES_INLINE struct real8 ground_density8(struct real8 h1, struct real8 h2)
{
    const struct real8 none = r8_set(0), one = r8_set(1), off = r8_sub(h1, h2);
    const struct mask8 high1 = r8_lt(none, h1), high2 = r8_lt(none, h2);
    const struct real8 a1 = r8_select(high1, quick_atan2_8(h1, one), h1);
    const struct real8 a2 = r8_select(high2, quick_atan2_8(h2, one), h2);
    const struct mask8 level =
        m8_and(m8_and(high1, high2), r8_lt(r8_abs(off), r8_set(NEAR_ZERO)));
    const struct real8 at = r8_div(one, r8_add(r8_mul(h1, h1), one));
    const struct real8 mean = r8_select(level, at, r8_div(r8_sub(a1, a2), off));
    const struct mask8 low = m8_and(r8_le(h1, none), r8_le(h2, none));
    return r8_select(low, one, mean);
}

// fog_clear.
LANES_INLINE struct float8 fog_clear8(const struct job *job, const struct fog *f,
                                      struct vec8 o, struct vec8 d, struct real8 s)
{
    struct real8 way = r8_div(s, r8_set(f->distance));
    if (f->has_turbulence) {
        const struct turbulence *b = &f->turbulence;
        const struct vec8 middle = v8_mad(o, r8_div(s, r8_set(2)), d);
        double p[3][8], v[8];
        r8_store(p[0], r8_mul(middle.x, r8_set(b->amount.x)));
        r8_store(p[1], r8_mul(middle.y, r8_set(b->amount.y)));
        r8_store(p[2], r8_mul(middle.z, r8_set(b->amount.z)));
        noise_turbulence8(job->kernels->surface->noise, (const double(*)[8])p,
                          (double)b->lambda, (double)b->omega, b->octaves,
                          job->scene->settings.noise_generator, v);
        const struct real8 swirl =
            r8_min(r8_mul(r8_load(v), r8_set(f->turb_depth)), r8_set(1));
        way = r8_mul(way, r8_sub(r8_set(1), r8_mul(r8_exp_single(r8_neg(way)), swirl)));
    }
    if (f->type == FOG_GROUND && f->alt != 0) {
        const struct vec8 up = V8_SET(f->up);
        const struct real8 offset = r8_set(f->offset), alt = r8_set(f->alt);
        const struct real8 h1 = r8_div(r8_sub(v8_dot(o, up), offset), alt);
        const struct real8 h2 = r8_div(r8_sub(v8_dot(v8_mad(o, s, d), up), offset), alt);
        way = r8_mul(way, ground_density8(h1, h2));
    }
    return f8_max(f8_of(r8_exp_single(r8_neg(way))), f8_set(f->color.transmit));
}

// What eight rays see of all fogs and through them.
struct fog_view {
    float pass[3][8], glow[3][8];
};

LANES_INLINE void fog_view(const struct job *job, struct vec8 o, struct vec8 d,
                           struct real8 s, struct fog_view *out)
{
    struct float8 pass[3], glow[3];
    for (int c = 0; c < 3; c++) {
        pass[c] = f8_set(1);
        glow[c] = f8_set(0);
    }
    for (uint32_t i = job->scene->fog_count; i-- > 0;) {
        const struct fog *f = job->scene->fog[i];
        if (f->distance == 0)
            continue;
        const float color[3] = {f->color.r, f->color.g, f->color.b}, k = f->color.filter;
        const struct float8 clear = fog_clear8(job, f, o, d, s);
        for (int c = 0; c < 3; c++) {
            pass[c] = f8_mul(pass[c], f8_mul(clear, f8_set((1 - k) + k * color[c])));
            glow[c] = f8_add(glow[c], f8_mul(f8_sub(f8_set(1), clear), f8_set(color[c])));
        }
    }
    for (int c = 0; c < 3; c++) {
        f8_store(out->pass[c], pass[c]);
        f8_store(out->glow[c], glow[c]);
    }
}

static void fogs(struct tracer *t)
{
    struct wavefront *w = &t->wave;
    const struct ray_batch *b = t->rays;
    for (uint32_t k = 0; k < w->count; k += 8) {
        struct fog_view v;
        double end[8];
        for (uint32_t i = 0; i < 8; i++)
            end[i] = k + i < w->count && t->hit->t[k + i] < INFINITY ? t->hit->t[k + i]
                                                                     : air_far;
        fog_view(t->job,
                 (struct vec8){r8_load(b->o[0] + k), r8_load(b->o[1] + k),
                               r8_load(b->o[2] + k)},
                 (struct vec8){r8_load(b->d[0] + k), r8_load(b->d[1] + k),
                               r8_load(b->d[2] + k)},
                 r8_load(end), &v);
        for (uint32_t i = 0; i < 8 && k + i < w->count; i++) {
            const uint32_t slot = w->slot[k + i];
            if (!inside_hollow(wave_inside(t, slot)))
                continue;
            for (int c = 0; c < 3; c++) {
                w->own[c][slot] += w->through[c][slot] * v.glow[c][i];
                w->through[c][slot] *= v.pass[c][i];
            }
            w->through_t[slot] *=
                rgb_luminance(rgb(v.pass[0][i], v.pass[1][i], v.pass[2][i]));
        }
    }
}

#endif
