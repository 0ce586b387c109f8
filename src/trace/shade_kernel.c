// Shading eight hits at a time, compiled once per instruction set as
// trace/packet_kernel.c. Each expression is that of the general rule, named beside it, in
// the same order: the bits are the same.
#include "trace/shade_kernel.h"

#include "math/isa.h"
#include "trace/shade_air.h"
#include "trace/shade_bounce.h"
#include "trace/shade_camera.h"
#include "trace/shade_caustic.h"
#include "trace/shade_color.h"
#include "trace/shade_judge.h"
#include "trace/shade_lights.h"
#include "trace/shade_place.h"

// ---- places -----------------------------------------------------------------------------

LANES_INLINE struct real8 gather(const double *from, const struct simple_group *g,
                                 bool in_row)
{
    return in_row ? r8_load(from + g->ray[0]) : r8_load_at(from, g->ray);
}

static bool wants_uv(const struct tracer *t, const struct leaf *const leaf[8])
{
    bool wants = false;
    for (int i = 0; i < 8 && t->job->simple_uv; i++)
        wants |= t->job->world->surface[leaf[i]->surface].wants_uv;
    return wants;
}

// The hits of a group; returns whether they are of several leaves.
LANES_INLINE bool group_hits(struct tracer *t, const uint16_t *ray, uint32_t count,
                             struct simple_group *g, const struct leaf *leaf[8])
{
    uint32_t differ = 0;
    g->live = (1u << count) - 1;
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t k = ray[i < count ? i : 0];
        g->ray[i] = k;
        g->slot[i] = t->wave.slot[k];
        differ |= t->hit->leaf[k] ^ t->hit->leaf[ray[0]];
        leaf[i] = &t->job->world->leaf[t->hit->leaf[k]];
    }
    return differ;
}

LANES_INLINE void group_points(struct tracer *t, const struct leaf *const leaf[8],
                               bool differ, bool uv, struct simple_group *g)
{
    const struct ray_batch *b = t->rays;
    const bool rays_in_row = g->live == 255 && g->ray[7] - g->ray[0] == 7;
    const struct vec8 o = {gather(b->o[0], g, rays_in_row),
                           gather(b->o[1], g, rays_in_row),
                           gather(b->o[2], g, rays_in_row)};
    const struct vec8 d = {gather(b->d[0], g, rays_in_row),
                           gather(b->d[1], g, rays_in_row),
                           gather(b->d[2], g, rays_in_row)};
    const struct real8 at = gather(t->hit->t, g, rays_in_row);
    const struct place_rays r = {
        .d = d,
        .dt = gather(t->hit->dt, g, rays_in_row),
        .part = gather(t->hit->part, g, rays_in_row),
        .size = r8_add(v8_max_abs(o), r8_mul(r8_abs(at), v8_max_abs(d))),
        .hit = t->hit,
        .ray = g->ray};
    struct place8 x; // not set to zero: it is large
    x.p = v8_mad(o, at, d);
    if (uv) {
        place_each(t, g, &x);
        memcpy(g->uv, x.uv, sizeof g->uv);
    } else if (!differ) {
        place_leaf(leaf[0], &r, g->live, &x);
    } else if (!place_spheres(leaf, &r, &x)) {
        place_mixed(leaf, &r, g->live, &x);
    }
    v8_store(g->d, d);
    v8_store(g->p, x.p);
    v8_store(g->ng, x.ng);
    r8_store(g->error, x.error);
    const struct mask8 turned = r8_lt(r8_set(0), v8_dot(x.ns, d));
    v8_store(g->n, v8_select(turned, v8_neg(x.ns), x.ns));
    g->turned = m8_bits(turned);
    g->in_row = rays_in_row;
    for (uint32_t i = 0; i < 8; i++)
        g->in_row &= g->slot[i] == g->slot[0] + i;
    for (int c = 0; c < 3; c++) {
        const float *through = t->wave.through[c];
        if (g->in_row)
            f8_store(g->through[c], f8_load(through + g->slot[0]));
        else
            for (uint32_t i = 0; i < 8; i++)
                g->through[c][i] = through[g->slot[i]];
    }
    g->bare = 0;
}

static void place(struct tracer *t, const uint16_t *ray, uint32_t count,
                  struct simple_group *g)
{
    const struct leaf *leaf[8];
    const bool differ = group_hits(t, ray, count, g, leaf);
    group_points(t, leaf, differ, wants_uv(t, leaf), g);
    if (!differ)
        colors_of(t, leaf[0]->surface, g, 255);
    else
        colors(t, leaf, g);
    g->bare &= g->live;
    g->live &= ~g->bare;
}

static void points(struct tracer *t, const uint16_t *ray, uint32_t count, bool uv,
                   struct simple_group *g)
{
    const struct leaf *leaf[8];
    const bool differ = group_hits(t, ray, count, g, leaf);
    group_points(t, leaf, differ, uv, g);
}

// ---- light ------------------------------------------------------------------------------

static void own(struct tracer *t, const struct simple_class *c,
                const struct simple_group *g)
{
    const struct rgb8 color = rgb8_load((const float(*)[8])g->color);
    add_own(t, g, g->live,
            rgb8_mul(rgb8_load((const float(*)[8])g->through),
                     rgb8_mul(color, rgb8_scale(f8_load(g->att), rgb8_set(c->own)))));
}

static void own_sheets(struct tracer *t, const struct paint_group *g)
{
    const struct paint_sheet *s = t->paint->sheet + g->sheet;
    for (uint32_t i = 0; i < g->sheet_count; i++)
        add_own(t, &g->hits, s[i].lanes,
                rgb8_mul(rgb8_load((const float(*)[8])g->hits.through),
                         sheet_own(t->job, &s[i])));
}

static bool views(const struct lamp *lamp, uint32_t count, struct ray_batch *rays,
                  uint8_t *dark, float *color, uint32_t stride)
{
    bool any = false;
    for (uint32_t i = 0; i < count; i += 8) {
        const struct vec8 p = {r8_load(rays->o[0] + i), r8_load(rays->o[1] + i),
                               r8_load(rays->o[2] + i)};
        struct light8 v = direction8(lamp, p);
        double at[3][8];
        v8_store(at, p);
        const struct real8 factor = attenuation8(lamp, (const double(*)[8])at, &v);
        const unsigned none = m8_bits(r8_eq(factor, r8_set(0)));
        const struct rgb8 c = rgb8_scale(f8_of(factor), v.color);
        r8_store(rays->d[0] + i, v.to.x);
        r8_store(rays->d[1] + i, v.to.y);
        r8_store(rays->d[2] + i, v.to.z);
        r8_store(rays->t_max + i, v.distance);
        f8_store(color + i, c.r);
        f8_store(color + stride + i, c.g);
        f8_store(color + 2 * stride + i, c.b);
        for (uint32_t k = 0; k < 8; k++)
            dark[i + k] = none >> k & 1;
        any |= none;
    }
    return any;
}

// Between two numbers, both left out.
LANES_INLINE struct mask8 inside8(struct real8 x, struct real8 most)
{
    return m8_and(r8_lt(r8_set(0), x), r8_lt(x, most));
}

// Those for which cut_roots of trace/media_lit.c finds nothing on the way and in_cone is false
// in its middle.
static unsigned misses_cone(const struct lamp *lamp, const double o[3][8],
                            const double d[3][8], const double s[8])
{
    const struct vec8 from = v8_sub(v8_load(o), V8_SET(lamp->light->location)),
                      to = v8_load(d), axis = V8_SET(lamp->light->axis);
    const struct real8 e = v8_dot(from, axis), f = v8_dot(to, axis), b = v8_dot(from, to),
                       c = v8_dot(from, from), length = r8_load(s), none = r8_set(0);
    const struct real8 k = r8_set(lamp->cos_falloff * lamp->cos_falloff);
    const struct real8 qa = r8_sub(r8_mul(f, f), k),
                       qb = r8_sub(r8_mul(f, e), r8_mul(k, b)),
                       qc = r8_sub(r8_mul(e, e), r8_mul(k, c));
    const struct real8 q = r8_sub(r8_mul(qb, qb), r8_mul(qa, qc));
    const struct real8 root =
        r8_neg(r8_add(qb, r8_copysign(r8_sqrt(r8_max(q, none)), qb)));
    const unsigned cut = m8_bits(inside8(r8_div(qc, root), length)) |
                         m8_bits(inside8(r8_div(root, qa), length));
    const struct vec8 middle = v8_mad(from, r8_div(length, r8_set(2)), to);
    const unsigned lit =
        m8_bits(r8_le(r8_mul(r8_set(lamp->cos_falloff), r8_sqrt(v8_dot(middle, middle))),
                      v8_dot(middle, axis)));
    return ~lit & (m8_bits(r8_lt(q, none)) | ~cut) & 255;
}

// ---- sums ---------------------------------------------------------------------------------

static void lit(struct wavefront *w, const struct shadow_batch *b, uint32_t count)
{
    for (uint32_t k = 0; k < count; k += 8) {
        const uint16_t *slot = b->slot + k;
        const uint32_t n = count - k < 8 ? count - k : 8;
        unsigned dark = 0;
        uint32_t apart = n ^ 8; // 0: neighbours
        for (uint32_t i = 0; i < n; i++) {
            dark |= (unsigned)b->occluded[k + i] << i;
            apart |= slot[i] ^ (slot[0] + i);
        }
        unsigned bright = ~dark & ((1u << n) - 1);
        for (int c = 0; c < 3 && bright && !apart; c++) {
            float *to = w->lit[c] + slot[0];
            const struct float8 value = f8_load(b->value[c] + k);
            f8_store(to, f8_add(f8_load(to), f8_select(dark, f8_set(0), value)));
        }
        for (; apart && bright; bright &= bright - 1) {
            const int i = __builtin_ctz(bright);
            for (int c = 0; c < 3; c++)
                w->lit[c][slot[i]] += b->value[c][k + (uint32_t)i];
        }
    }
}

static void sums(const struct wavefront *w, struct sample_sum *out)
{
    uint32_t i = 0;
    for (; i + 8 <= w->count; i += 8)
        f8_store_rows(
            &out[i].light.r, f8_add(f8_load(w->own[0] + i), f8_load(w->lit[0] + i)),
            f8_add(f8_load(w->own[1] + i), f8_load(w->lit[1] + i)),
            f8_add(f8_load(w->own[2] + i), f8_load(w->lit[2] + i)), f8_load(w->t + i));
    for (; i < w->count; i++)
        out[i] =
            (struct sample_sum){{w->own[0][i] + w->lit[0][i], w->own[1][i] + w->lit[1][i],
                                 w->own[2][i] + w->lit[2][i]},
                                w->t[i]};
}

static void exps(const double *x, uint32_t count, float *out)
{
    for (uint32_t i = 0; i < count; i += 8)
        f8_store(out + i, f8_of(r8_exp_single(r8_load(x + i))));
}

static void exp_single(double *x, uint32_t count)
{
    for (uint32_t i = 0; i < count; i += 8)
        r8_store(x + i, r8_exp_single(r8_load(x + i)));
}

static void focus(const double n[3][8], const double d[3][8], double caustics,
                  float out[8])
{
    const struct real8 cosine = r8_abs(v8_dot(v8_load(n), v8_load(d)));
    f8_store(out, f8_of(r8_add(r8_set(1), r8_pow_single(cosine, caustics))));
}

// ---- boxes --------------------------------------------------------------------------------

LANES_INLINE void slab8_meet(double min, double max, struct real8 o, struct real8 inv,
                             struct real8 *t0, struct real8 *t1)
{
    const struct mask8 back = r8_lt(inv, r8_set(0));
    const struct real8 a = r8_mul(r8_sub(r8_set(min), o), inv);
    const struct real8 b = r8_mul(r8_sub(r8_set(max), o), inv);
    *t0 = r8_max(r8_select(back, b, a), *t0); // NaN: the origin in a face
    *t1 = r8_min(r8_mul(r8_select(back, a, b), r8_set(1 + 2 * GAMMA(3))), *t1);
}

static unsigned meets(const struct aabb *box, uint32_t count,
                      const struct ray_batch *rays, uint32_t first)
{
    const struct real8 one = r8_set(1);
    const struct real8 ox = r8_load(rays->o[0] + first), oy = r8_load(rays->o[1] + first),
                       oz = r8_load(rays->o[2] + first);
    const struct real8 ix = r8_div(one, r8_load(rays->d[0] + first)),
                       iy = r8_div(one, r8_load(rays->d[1] + first)),
                       iz = r8_div(one, r8_load(rays->d[2] + first));
    unsigned met = 0;
    for (uint32_t i = 0; i < count && met != 255; i++) {
        struct real8 t0 = r8_load(rays->t_min + first), t1 = r8_load(rays->t_max + first);
        slab8_meet(box[i].min.x, box[i].max.x, ox, ix, &t0, &t1);
        slab8_meet(box[i].min.y, box[i].max.y, oy, iy, &t0, &t1);
        slab8_meet(box[i].min.z, box[i].max.z, oz, iz, &t0, &t1);
        met |= m8_bits(r8_le(t0, t1));
    }
    return met;
}

media_add_fn OF_ISA(media_add_);

const struct shade_kernels OF_ISA(shade_kernels_) = {ISA_TEXT,
                                                     &OF_ISA(surface_kernels_),
                                                     camera,
                                                     place,
                                                     own,
                                                     light,
                                                     bounce,
                                                     lit,
                                                     sums,
                                                     exps,
                                                     exp_single,
                                                     focus,
                                                     judge,
                                                     differ,
                                                     meets,
                                                     fogs,
                                                     toward,
                                                     views,
                                                     misses_cone,
                                                     points,
                                                     texture_space,
                                                     world_normals,
                                                     sheet_pass,
                                                     own_sheets,
                                                     light_sheets,
                                                     mirror_sheet,
                                                     caustics,
                                                     OF_ISA(media_add_)};
