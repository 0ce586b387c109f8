#ifndef TRACE_SHADE_BOUNCE_H
#define TRACE_SHADE_BOUNCE_H

// Where the light of eight hits goes on.
#include "trace/paint.h"
#include "trace/shade.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

// trace_offset.
LANES_INLINE struct vec8 offset8(const struct simple_group *g, struct vec8 d)
{
    const struct vec8 ng = v8_load((const double(*)[8])g->ng);
    const struct real8 side =
        r8_select(r8_lt(v8_dot(d, ng), r8_set(0)), r8_set(-1), r8_set(1));
    const struct real8 by = r8_mul(r8_mul(r8_set(2), side), r8_load(g->error));
    return v8_mad(v8_load((const double(*)[8])g->p), by, ng);
}

// fresnel of trace/shade_transmit.c.
LANES_INLINE struct real8 fresnel8(struct real8 c, struct real8 n)
{
    const struct real8 one = r8_set(1);
    const struct real8 s = r8_sub(r8_add(r8_mul(n, n), r8_mul(c, c)), one);
    const struct mask8 all = r8_le(s, r8_set(0));
    const struct real8 g = r8_sqrt(s);
    const struct real8 a = r8_div(r8_sub(g, c), r8_add(g, c));
    const struct real8 b = r8_div(r8_sub(r8_mul(c, r8_add(g, c)), one),
                                  r8_add(r8_mul(c, r8_sub(g, c)), one));
    const struct real8 f =
        r8_mul(r8_mul(r8_mul(r8_set(0.5), a), a), r8_add(one, r8_mul(b, b)));
    return r8_select(all, one, r8_max(r8_set(0), r8_min(one, f)));
}

// finish_reflectivity; fills in b->weight.
LANES_INLINE struct rgb8 reflectivity8(const struct finish *f, struct rgb8 color,
                                       struct real8 cosine, struct simple_bounce *b)
{
    struct real8 share;
    if (f->fresnel) {
        share = fresnel8(cosine, r8_load(b->index));
    } else {
        share = r8_sub(r8_set(1), cosine);
        if (f->reflection_falloff != 1)
            share =
                r8_pow_single(r8_max(r8_set(0), share), (double)f->reflection_falloff);
        const struct real8 less = r8_sub(share, r8_set(1));
        share = r8_select(r8_lt(r8_abs(share), r8_set(NEAR_ZERO)), r8_set(0), share);
        share = r8_select(r8_lt(r8_abs(less), r8_set(NEAR_ZERO)), r8_set(1), share);
    }
    const struct float8 part = f8_of(share);
    struct rgb8 r =
        rgb8_add(rgb8_scale(f8_sub(f8_set(1), part), rgb8_set(f->reflection_min)),
                 rgb8_scale(part, rgb8_set(f->reflection_max)));
    const float most = fmaxf(rgb_max(f->reflection_min), rgb_max(f->reflection_max));
    f8_store(b->weight, f->fresnel ? f8_max(f8_max(r.r, r.g), r.b) : f8_set(most));
    return f->reflection_metallic != 0
               ? metal_tint8(r, color, f->reflection_metallic, cosine)
               : r;
}

LANES_INLINE struct float8 f8_abs(struct float8 x)
{
    return f8_max(x, f8_sub(f8_set(0), x));
}

// rgb_luminance.
LANES_INLINE struct float8 luminance8(struct rgb8 c)
{
    return f8_add(f8_add(f8_mul(f8_set((float)LUMINANCE_RED), c.r),
                         f8_mul(f8_set((float)LUMINANCE_GREEN), c.g)),
                  f8_mul(f8_set((float)LUMINANCE_BLUE), c.b));
}

// What mirrored rays count (shade_mirrors of trace/shade_transmit.c). share: of the surface,
// trans: what passes the layers above, both NULL: all.
LANES_INLINE void mirrored_light(const struct simple_group *g, struct rgb8 m,
                                 const float *share, const float *trans,
                                 struct simple_bounce *b)
{
    const struct float8 own = f8_load(b->weight),
                        weight = f8_mul(f8_load(b->from_weight),
                                        trans ? f8_mul(f8_load(trans), own) : own);
    b->mirrors = f8_le(f8_set(b->least), weight) & ~black8(m);
    if (share)
        m = rgb8_scale(f8_load(share), m);
    rgb8_store(b->mirrored, rgb8_mul(m, rgb8_load((const float(*)[8])g->through)));
    f8_store(b->mirror_weight, weight);
}

// What rays through the surface count (shade_refract).
LANES_INLINE void passing_light(const struct simple_class *c,
                                const struct simple_group *g, struct simple_bounce *b)
{
    const struct float8 one = f8_set(1), least = f8_set(b->least);
    struct rgb8 fade = rgb8_load((const float(*)[8])b->fade);
    if (b->fading) {
        struct float8 e[3];
        for (int i = 0; i < 3; i++)
            e[i] = f8_of(r8_exp_single(r8_load(b->exponent[i])));
        fade = (struct rgb8){f8_select(b->fading, f8_mul(fade.r, e[0]), fade.r),
                             f8_select(b->fading, f8_mul(fade.g, e[1]), fade.g),
                             f8_select(b->fading, f8_mul(fade.b, e[2]), fade.b)};
    }
    struct rgb8 pass = rgb8_load((const float(*)[8])b->pass);
    if (c->finish->conserve_energy) {
        const struct rgb8 m = rgb8_load((const float(*)[8])b->mirror);
        pass = rgb8_mul(pass, (struct rgb8){f8_min(f8_sub(one, m.r), one),
                                            f8_min(f8_sub(one, m.g), one),
                                            f8_min(f8_sub(one, m.b), one)});
    }
    const struct float8 trans = f8_min(f8_abs(luminance8(pass)), one);
    const struct float8 most =
        f8_max(f8_max(f8_abs(pass.r), f8_abs(pass.g)), f8_abs(pass.b));
    const struct float8 weight = f8_mul(f8_load(b->from_weight), most);
    const struct rgb8 through = rgb8_load((const float(*)[8])g->through);
    const struct rgb8 back = rgb8_mul(through, fade);
    struct rgb8 on = rgb8_mul(back, pass);
    if (b->straight) {
        const struct rgb8 all = rgb8_mul(through, rgb8_mul(fade, pass));
        on = (struct rgb8){f8_select(b->straight, all.r, on.r),
                           f8_select(b->straight, all.g, on.g),
                           f8_select(b->straight, all.b, on.b)};
    }
    rgb8_store(b->back, back);
    rgb8_store(b->bent, on);
    f8_store(b->bent_weight, weight);
    f8_store(b->clarity, f8_mul(luminance8(fade), trans));
    b->passes = f8_le(least, trans) & ~f8_le(trans, least);
    b->counts = f8_le(least, weight);
}

static void bounce(const struct simple_class *c, const struct simple_group *g,
                   struct simple_bounce *b)
{
    const struct vec8 d = v8_load((const double(*)[8])g->d),
                      n = v8_load((const double(*)[8])g->n);
    const struct real8 along = v8_dot(d, n), cosine = r8_neg(along);
    const struct rgb8 mirror =
        reflectivity8(c->finish, rgb8_load((const float(*)[8])g->color), cosine, b);
    rgb8_store(b->mirror, mirror);
    const struct vec8 back = v8_normalize(v8_mad(d, r8_mul(r8_set(-2), along), n));
    v8_store(b->mirror_d, back);
    v8_store(b->mirror_o, offset8(g, back));
    mirrored_light(g, mirror, NULL, NULL, b);
    if (!c->clear)
        return;
    passing_light(c, g, b);
    const struct real8 eta = r8_load(b->eta), one = r8_set(1);
    const struct real8 k =
        r8_add(one, r8_mul(r8_mul(eta, eta), r8_sub(r8_mul(cosine, cosine), one)));
    const struct real8 by = r8_sub(r8_mul(eta, cosine), r8_sqrt(k));
    const struct vec8 bent = v8_normalize(v8_mad(
        (struct vec8){r8_mul(eta, d.x), r8_mul(eta, d.y), r8_mul(eta, d.z)}, by, n));
    b->total = m8_bits(r8_lt(k, r8_set(0))) & ~b->straight;
    v8_store(b->bent_d, bent);
    v8_store(b->bent_o, offset8(g, bent));
}

// `mirrored` of trace/shade_transmit.c.
LANES_INLINE struct vec8 mirrored8(struct vec8 d, struct vec8 n, struct vec8 surface)
{
    const struct real8 zero = r8_set(0), twice = r8_set(-2);
    const struct vec8 q = v8_mad(d, r8_mul(twice, v8_dot(d, n)), n);
    const struct real8 up = v8_dot(q, surface);
    const struct vec8 plain = v8_mad(d, r8_mul(twice, v8_dot(d, surface)), surface);
    const struct vec8 lifted = v8_mad(q, r8_mul(twice, up), surface);
    const struct vec8 other = v8_select(r8_lt(v8_dot(q, n), zero), plain, lifted);
    return v8_normalize(v8_select(r8_lt(up, zero), other, q));
}

static void mirror_sheet(const struct paint_group *g, const struct paint_sheet *s,
                         const float share[8], struct simple_bounce *b)
{
    const struct vec8 d = v8_load((const double(*)[8])g->hits.d),
                      n = v8_load((const double(*)[8])s->n);
    const struct rgb8 mirror =
        reflectivity8(s->layer->finish, rgb8_load((const float(*)[8])s->color),
                      r8_neg(v8_dot(d, n)), b);
    const struct vec8 back = mirrored8(d, n, v8_load((const double(*)[8])g->hits.n));
    v8_store(b->mirror_d, back);
    v8_store(b->mirror_o, offset8(&g->hits, back));
    mirrored_light(&g->hits, mirror, share, s->trans, b);
}

#endif
