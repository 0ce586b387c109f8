#ifndef TRACE_SHADE_SHEETS_H
#define TRACE_SHADE_SHEETS_H

// Layers of painted hits: shade_plain, add_own and layers_lit in lanes.
#include "math/color.h"
#include "math/isa.h"
#include "math/pi.h"
#include "math/trig_lanes.h"
#include "scene/noise_kernel.h"
#include "trace/paint.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"
#include "trace/shade_lit.h"

// rgbft_pass of a pigment, less what the surface mirrors.
LANES_INLINE struct float8 pass8(const struct paint_sheet *s, const float mirror[3][8],
                                 int k)
{
    const struct float8 one = f8_set(1);
    const struct float8 p =
        f8_add(f8_mul(f8_load(s->color[k]), f8_load(s->color[3])), f8_load(s->color[4]));
    return mirror ? f8_mul(p, f8_min(f8_sub(one, f8_load(mirror[k])), one)) : p;
}

// layer_color.
LANES_INLINE struct float8 opacity8(const struct paint_sheet *s, bool old)
{
    const struct float8 one = f8_set(1), filter = f8_load(s->color[3]),
                        transmit = f8_load(s->color[4]);
    if (!old)
        return f8_sub(f8_sub(one, filter), transmit);
    const struct float8 most =
        f8_max(f8_max(f8_load(s->color[0]), f8_load(s->color[1])), f8_load(s->color[2]));
    return f8_sub(one, f8_add(f8_mul(filter, most), transmit));
}

static unsigned sheet_pass(const struct job *job, struct paint_sheet *s,
                           const float mirror[3][8], struct paint_coat *coat)
{
    static const float luminance_of[3] = {(float)LUMINANCE_RED, (float)LUMINANCE_GREEN,
                                          (float)LUMINANCE_BLUE};
    const struct float8 trans = f8_load(coat->trans);
    float weight[8];
    r8_store_floats(weight, r8_load(coat->weight));
    if (s->layer->covers && job->old_layers) {
        f8_store(s->color[4], f8_add(f8_load(s->color[4]), f8_load(s->color[3])));
        f8_store(s->color[3], f8_set(0));
    }
    f8_store(s->att, opacity8(s, job->old_opacity));
    f8_store(s->trans, trans);
    memcpy(s->filter, coat->filter, sizeof s->filter);
    if (!s->found)
        return s->lanes;
    coat->any |= s->found;
    struct float8 sum = f8_set(0);
    for (int k = 0; k < 3; k++) {
        const struct float8 before = f8_load(coat->passed[k]);
        const struct float8 passed = f8_mul(before, pass8(s, mirror, k));
        const struct float8 part = f8_mul(f8_set(luminance_of[k]), passed);
        sum = k ? f8_add(sum, part) : part;
        f8_store(coat->passed[k], f8_select(s->found, passed, before));
        f8_store(coat->filter[k], f8_select(s->found, f8_mul(f8_load(weight), passed),
                                            f8_load(coat->filter[k])));
    }
    const struct float8 all = f8_min(f8_max(sum, f8_sub(f8_set(0), sum)), f8_set(1));
    const struct float8 left = f8_select(s->found, all, trans);
    f8_store(coat->trans, left);
    return s->lanes & ~f8_le(left, f8_set(job->adc_bailout));
}

LANES_INLINE struct rgb8 sheet_own(const struct job *job, const struct paint_sheet *s)
{
    const struct finish *f = s->layer->finish;
    const struct rgb own = rgb_add(rgb_mul(f->ambient, job->ambient_light), f->emission);
    return rgb8_mul(rgb8_mul(rgb8_load((const float(*)[8])s->color),
                             rgb8_load((const float(*)[8])s->filter)),
                    rgb8_scale(f8_load(s->att), rgb8_set(own)));
}

// irid_factor.
static struct rgb8 irid8(const struct job *job, const struct finish *f,
                         const struct simple_group *h, struct vec8 n, struct vec8 to)
{
    struct real8 thickness = r8_set((double)f->irid_thickness);
    if (f->irid_turbulence != 0) {
        double noise[8];
        noise_turbulence8(&OF_ISA(noise_kernels_), (const double(*)[8])h->p, 2, 0.5, 5,
                          job->scene->settings.noise_generator, noise);
        const struct real8 uneven = r8_sub(r8_mul(r8_set(2), r8_load(noise)), r8_set(1));
        thickness =
            r8_mul(thickness,
                   r8_add(r8_set(1), r8_mul(r8_set((double)f->irid_turbulence), uneven)));
    }
    const struct vec8 d = v8_load((const double(*)[8])h->d);
    const struct real8 way = r8_mul(r8_mul(r8_set(2 * PI), thickness),
                                    r8_add(r8_abs(v8_dot(n, to)), r8_abs(v8_dot(n, d))));
    const struct rgb w = job->irid_wavelength;
    const float length[3] = {w.r, w.g, w.b};
    struct float8 c[3];
    for (int k = 0; k < 3; k++)
        c[k] = f8_add(f8_set(1),
                      f8_mul(f8_set(f->irid),
                             f8_of(det_cos8(r8_div(way, r8_set((double)length[k]))))));
    return (struct rgb8){c[0], c[1], c[2]};
}

// Adds the light of a lamp that one layer sends on; returns the lanes that get some.
LANES_INLINE unsigned sheet_lit(const struct tracer *t, const struct paint_sheet *s,
                                const struct simple_group *h, bool side_test,
                                const struct lamp *lamp, struct vec8 to, unsigned live,
                                struct rgb8 *sum)
{
    live &= s->lanes;
    if (!live || !finish_takes_light(s->layer->finish))
        return 0;
    float crand[8] = {0};
    if (s->layer->finish->crand > 0)
        for (int i = 0; i < 8; i++)
            crand[i] =
                (float)hash_unit(hash_mix(wave_hash(t, h->slot[i]), lamp->index + 100));
    const struct lit_layer l = {s->layer->finish,
                                (const double(*)[8])h->d,
                                (const double(*)[8])s->n,
                                (const float(*)[8])s->color,
                                s->att,
                                crand};
    struct rgb8 c = lit8(&l, side_test, lamp->dull, to, &live);
    if (live && l.finish->irid != 0)
        c = rgb8_mul(c, irid8(t->job, l.finish, h, v8_load(l.n), to));
    c = rgb8_mul(c, rgb8_load((const float(*)[8])s->filter));
    sum->r = f8_select(live, f8_add(sum->r, c.r), sum->r);
    sum->g = f8_select(live, f8_add(sum->g, c.g), sum->g);
    sum->b = f8_select(live, f8_add(sum->b, c.b), sum->b);
    return live;
}

#endif
