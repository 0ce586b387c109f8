#ifndef TRACE_SHADE_COLOR_H
#define TRACE_SHADE_COLOR_H

// Colours and normals of the patterns at eight hits.
#include "scene/pattern_math.h"
#include "scene/pigment_tape.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

// A checker of two colours in the lanes of `bits`; false: the pattern needs the general
// rule.
LANES_INLINE bool checker8(const struct surface *s, const struct simple_surface *x,
                           struct simple_group *g, unsigned bits)
{
    static const double far = 1e8; // what pattern_warp clamps to lies beyond
    const struct transform *m = &s->texture_transform;
    struct vec8 p = v8_load((const double(*)[8])g->p);
    if (!m->identity)
        p = v8_row_times(v8_sub(p, V8_SET(m->offset)), &m->inverse);
    for (const struct warp *w = x->pigment->pattern->warps; w; w = w->next)
        if (!w->transform.identity)
            p = v8_row_times(v8_sub(p, V8_SET(w->transform.offset)),
                             &w->transform.inverse);
    if (bits & ~m8_bits(r8_le(v8_max_abs(p), r8_set(far))))
        return false;
    const struct real8 e = r8_set(PATTERN_EDGE);
    const struct real8 cell =
        r8_add(r8_add(r8_floor(r8_add(p.x, e)), r8_floor(r8_add(p.y, e))),
               r8_floor(r8_add(p.z, e)));
    const struct real8 even = r8_mul(r8_floor(r8_mul(cell, r8_set(0.5))), r8_set(2));
    const unsigned odd = m8_bits(r8_lt(even, cell));
    const float *const color[2] = {&x->color[0].r, &x->color[1].r};
    for (int k = 0; k < 3; k++) {
        const struct float8 c = f8_select(odd, f8_set(color[1][k]), f8_set(color[0][k]));
        f8_store(g->color[k], bits == 255 ? c : f8_select(bits, c, f8_load(g->color[k])));
    }
    return true;
}

// The points of a group as patterns see them, and in the space of the texture: surfaces
// mapped by uv are textured in the plane of u and v.
LANES_INLINE struct pattern_packet packet_of(const struct tracer *t,
                                             const struct simple_group *g)
{
    return (struct pattern_packet){(const double(*)[8])g->p, (const double(*)[8])g->n,
                                   (const double(*)[8])g->d,
                                   t->job->simple_uv ? (const double(*)[8])g->uv : NULL};
}

// m: of the texture, which those of a uv mapped object have not.
static const struct transform *texture_place8(const struct surface *s,
                                              const struct transform *m,
                                              const struct simple_group *g,
                                              double place[3][8])
{
    if (s->flags & OBJECT_UV_MAPPING) {
        memcpy(place, g->uv, sizeof g->uv);
        memset(place[2], 0, sizeof place[2]);
        return &transform_identity;
    }
    v8_store(place, v8_inverse_point(m, v8_load((const double(*)[8])g->p)));
    return m;
}

static void texture_space(const struct surface *s, const struct transform *m,
                          const struct simple_group *g, double place[3][8],
                          double normal[3][8])
{
    m = texture_place8(s, m, g, place);
    v8_store(normal, v8_inverse_normal(m, v8_load((const double(*)[8])g->n)));
}

static void world_normals(const struct surface *s, const struct transform *m,
                          double v[3][8])
{
    if (s->flags & OBJECT_UV_MAPPING)
        m = &transform_identity;
    v8_store(v, v8_normalize(v8_normal(m, v8_load((const double(*)[8])v))));
}

// The normals of a layer in the lanes of `bits`.
static void normals8(const struct tracer *t, const struct surface *s,
                     const struct simple_surface *x, struct simple_group *g,
                     unsigned bits)
{
    const struct pattern_packet packet = packet_of(t, g);
    const struct vec8 before = v8_load((const double(*)[8])g->n);
    double place[3][8], v[3][8];
    const struct transform *m = texture_place8(s, &s->texture_transform, g, place);
    v8_store(v, v8_inverse_normal(m, before));
    t->job->kernels->surface->perturb(x->normal, &packet, (const double(*)[8])place, bits,
                                      v);
    const struct vec8 n = v8_normal(m, v8_load((const double(*)[8])v));
    v8_store(g->n, v8_select(m8_of(bits), v8_normalize(n), before));
}

// The colours of a pigment in the lanes of `bits`.
static void tape8(const struct tracer *t, const struct surface *s,
                  const struct simple_surface *x, struct simple_group *g, unsigned bits)
{
    const struct pattern_packet packet = packet_of(t, g);
    double place[3][8];
    float color[5][8];
    texture_place8(s, &s->texture_transform, g, place);
    const unsigned found = t->job->kernels->surface->colors(
        x->tape, &packet, (const double(*)[8])place, bits, color);
    g->bare |= bits & ~found;
    if (bits == 255) {
        memcpy(g->color, color, sizeof g->color);
        return;
    }
    for (; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        for (int c = 0; c < 3; c++)
            g->color[c][i] = color[c][i];
    }
}

// The colours of lanes that share a surface.
LANES_INLINE void colors_of(struct tracer *t, uint32_t surface, struct simple_group *g,
                            unsigned bits)
{
    const struct simple_surface *x = &t->job->simple[surface];
    const struct surface *s = &t->job->world->surface[surface];
    if (x->normal)
        normals8(t, s, x, g, bits);
    if (bits == 255 && x->kind == SIMPLE_SOLID) {
        f8_store(g->color[0], f8_set(x->color[0].r));
        f8_store(g->color[1], f8_set(x->color[0].g));
        f8_store(g->color[2], f8_set(x->color[0].b));
        f8_store(g->att, f8_set(x->att));
        return;
    }
    f8_store(g->att, bits == 255 ? f8_set(x->att)
                                 : f8_select(bits, f8_set(x->att), f8_load(g->att)));
    if (x->kind == SIMPLE_CHECKER && !(s->flags & OBJECT_UV_MAPPING) &&
        checker8(s, x, g, bits))
        return;
    if (x->kind != SIMPLE_SOLID) {
        tape8(t, s, x, g, bits);
        return;
    }
    for (; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        g->color[0][i] = x->color[0].r;
        g->color[1][i] = x->color[0].g;
        g->color[2][i] = x->color[0].b;
    }
}

static void colors(struct tracer *t, const struct leaf *const leaf[8],
                   struct simple_group *g)
{
    for (unsigned left = 255; left;) {
        const uint32_t surface = leaf[__builtin_ctz(left)]->surface;
        unsigned bits = 0;
        for (unsigned i = 0; i < 8; i++)
            bits |= (unsigned)(leaf[i]->surface == surface) << i;
        colors_of(t, surface, g, bits);
        left &= ~bits;
    }
}

#endif
