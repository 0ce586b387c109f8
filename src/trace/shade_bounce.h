#ifndef TRACE_SHADE_BOUNCE_H
#define TRACE_SHADE_BOUNCE_H

// Where the light of eight hits goes on.
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

// finish_reflectivity.
LANES_INLINE void reflectivity8(const struct simple_class *k,
                                const struct simple_group *g, struct real8 cosine,
                                struct simple_bounce *b)
{
    const struct finish *f = k->finish;
    struct real8 share;
    if (f->fresnel) {
        share = fresnel8(cosine, r8_load(b->index));
    } else {
        share = r8_sub(r8_set(1), cosine);
        if (f->reflection_falloff != 1)
            share =
                r8_pow_single(r8_max(r8_set(0), share), (double)f->reflection_falloff);
        const struct real8 less = r8_sub(share, r8_set(1));
        share = r8_select(r8_lt(r8_abs(share), r8_set(zero)), r8_set(0), share);
        share = r8_select(r8_lt(r8_abs(less), r8_set(zero)), r8_set(1), share);
    }
    const struct float8 part = f8_of(share);
    const struct rgb8 r =
        rgb8_add(rgb8_scale(f8_sub(f8_set(1), part), rgb8_set(f->reflection_min)),
                 rgb8_scale(part, rgb8_set(f->reflection_max)));
    f8_store(b->mirror[0], r.r);
    f8_store(b->mirror[1], r.g);
    f8_store(b->mirror[2], r.b);
    const float most = fmaxf(rgb_max(f->reflection_min), rgb_max(f->reflection_max));
    for (int i = 0; i < 8; i++) {
        struct rgb c = {b->mirror[0][i], b->mirror[1][i], b->mirror[2][i]};
        b->weight[i] = f->fresnel ? rgb_max(c) : most;
        if (f->reflection_metallic == 0)
            continue;
        c = metal_tint(c, rgb(g->color[0][i], g->color[1][i], g->color[2][i]),
                       f->reflection_metallic, b->cosine[i]);
        b->mirror[0][i] = c.r;
        b->mirror[1][i] = c.g;
        b->mirror[2][i] = c.b;
    }
}

static void bounce(const struct simple_class *c, const struct simple_group *g,
                   struct simple_bounce *b)
{
    const struct vec8 d = v8_load((const double(*)[8])g->d),
                      n = v8_load((const double(*)[8])g->n);
    const struct real8 along = v8_dot(d, n), cosine = r8_neg(along);
    r8_store(b->cosine, cosine);
    reflectivity8(c, g, cosine, b);
    const struct vec8 back = v8_normalize(v8_mad(d, r8_mul(r8_set(-2), along), n));
    v8_store(b->mirror_d, back);
    v8_store(b->mirror_o, offset8(g, back));
    if (!c->clear)
        return;
    const struct real8 eta = r8_load(b->eta), one = r8_set(1);
    const struct real8 k =
        r8_add(one, r8_mul(r8_mul(eta, eta), r8_sub(r8_mul(cosine, cosine), one)));
    const struct real8 by = r8_sub(r8_mul(eta, cosine), r8_sqrt(k));
    const struct vec8 bent = v8_normalize(v8_mad(
        (struct vec8){r8_mul(eta, d.x), r8_mul(eta, d.y), r8_mul(eta, d.z)}, by, n));
    b->total = m8_bits(r8_lt(k, r8_set(0)));
    for (int i = 0; i < 3 && b->fading; i++)
        f8_store(b->fade[i], f8_of(r8_exp_single(r8_load(b->exponent[i]))));
    v8_store(b->bent_d, bent);
    v8_store(b->bent_o, offset8(g, bent));
}

#endif
