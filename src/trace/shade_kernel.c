// Shading eight hits at a time, compiled once per instruction set as
// trace/packet_kernel.c. Each expression is that of the general rule, named beside it, in
// the same order: the bits are the same.
#include "trace/shade_kernel.h"

#include "math/elementary.h"
#include "scene/noise_kernel.h"
#include "trace/shade.h"
#include "trace/shade_lanes.h"
#include "trace/shade_place.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
#define TEXT_(a)     #a
#define TEXT(a)      TEXT_(a)

static const double zero = 1e-10; // spec/lighting.md 0

// ---- cameras (camera_ray) ---------------------------------------------------------------

static void camera(const struct job *job, const struct vec2 *position, uint32_t count,
                   struct ray_batch *out)
{
    const struct camera *c = job->camera;
    const struct real8 width = r8_set(job->settings.width),
                       height = r8_set(job->settings.height), half = r8_set(0.5);
    const struct vec8 right = V8_SET(c->right), up = V8_SET(c->up);
    const struct vec8 location = V8_SET(c->location), direction = V8_SET(c->direction);
    for (uint32_t i = 0; i < count; i += 8) {
        double px[8], py[8];
        for (uint32_t k = 0; k < 8; k++) {
            const struct vec2 *p = &position[i + k < count ? i + k : i];
            px[k] = p->u;
            py[k] = p->v;
        }
        const struct real8 u = r8_sub(r8_div(r8_load(px), width), half);
        const struct real8 v = r8_sub(half, r8_div(r8_load(py), height));
        const struct vec8 d = v8_normalize(v8_mad(v8_mad(direction, u, right), v, up));
        r8_store(out->o[0] + i, location.x);
        r8_store(out->o[1] + i, location.y);
        r8_store(out->o[2] + i, location.z);
        r8_store(out->d[0] + i, d.x);
        r8_store(out->d[1] + i, d.y);
        r8_store(out->d[2] + i, d.z);
        for (uint32_t k = 0; k < 8; k++)
            out->hidden_by[i + k] = OBJECT_NO_IMAGE;
    }
}

// ---- places -----------------------------------------------------------------------------

LANES_INLINE struct real8 gather(const double *from, const struct simple_group *g,
                                 bool in_row)
{
    if (in_row)
        return r8_load(from + g->ray[0]);
    double v[8];
    for (int i = 0; i < 8; i++)
        v[i] = from[g->ray[i]];
    return r8_load(v);
}

// A checker of two colours in the lanes of `bits`; false: the pattern needs the general
// rule.
LANES_INLINE bool checker8(const struct surface *s, const struct simple_surface *x,
                           struct simple_group *g, unsigned bits)
{
    static const double far = 1e8; // what pattern_warp clamps to lies beyond
    const double edge = 1e-10;     // as the pattern's
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
    const struct real8 e = r8_set(edge);
    const struct real8 cell =
        r8_add(r8_add(r8_floor(r8_add(p.x, e)), r8_floor(r8_add(p.y, e))),
               r8_floor(r8_add(p.z, e)));
    const struct real8 even = r8_mul(r8_floor(r8_mul(cell, r8_set(0.5))), r8_set(2));
    const unsigned odd = m8_bits(r8_lt(even, cell));
    for (; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        const struct rgb c = x->color[odd >> i & 1];
        g->color[0][i] = c.r;
        g->color[1][i] = c.g;
        g->color[2][i] = c.b;
    }
    return true;
}

// The points of a group as patterns see them, and in the space of the texture.
LANES_INLINE struct pattern_packet packet_of(const struct simple_group *g)
{
    return (struct pattern_packet){
        &PASTE(noise_kernels_, ISA), (const double(*)[8])g->p, (const double(*)[8])g->n,
        (const double(*)[8])g->d};
}

LANES_INLINE struct vec8 texture_place8(const struct surface *s,
                                        const struct simple_group *g)
{
    const struct transform *m = &s->texture_transform;
    const struct vec8 p = v8_load((const double(*)[8])g->p);
    return m->identity ? p : v8_row_times(v8_sub(p, V8_SET(m->offset)), &m->inverse);
}

// The normals of a layer in the lanes of `bits`.
static void normals8(const struct surface *s, const struct simple_surface *x,
                     struct simple_group *g, unsigned bits)
{
    const struct pattern_packet packet = packet_of(g);
    const struct transform *m = &s->texture_transform;
    const struct vec8 before = v8_load((const double(*)[8])g->n);
    double place[3][8], v[3][8];
    v8_store(place, texture_place8(s, g));
    v8_store(v, m->identity ? before : v8_times_column(&m->linear, before));
    normal_perturb8(x->normal, &packet, (const double(*)[8])place, v);
    struct vec8 n = v8_load((const double(*)[8])v);
    if (!m->identity)
        n = v8_times_column(&m->inverse, n);
    v8_store(g->n, v8_select(m8_of(bits), v8_normalize(n), before));
}

// The colours of a pattern with its colour map, in the lanes of `bits`.
static void pattern8(const struct surface *s, const struct simple_surface *x,
                     struct simple_group *g, unsigned bits)
{
    const struct pattern_packet packet = packet_of(g);
    double place[3][8];
    float color[3][8];
    v8_store(place, texture_place8(s, g));
    pigment_colors8(x->pigment, &packet, (const double(*)[8])place, color);
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
        normals8(s, x, g, bits);
    if (bits == 255 && x->kind == SIMPLE_SOLID) {
        f8_store(g->color[0], f8_set(x->color[0].r));
        f8_store(g->color[1], f8_set(x->color[0].g));
        f8_store(g->color[2], f8_set(x->color[0].b));
        f8_store(g->att, f8_set(x->att));
        return;
    }
    for (unsigned m = bits; m; m &= m - 1)
        g->att[__builtin_ctz(m)] = x->att;
    if (x->kind == SIMPLE_CHECKER && checker8(s, x, g, bits))
        return;
    if (x->kind != SIMPLE_SOLID) {
        pattern8(s, x, g, bits);
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

static void place(struct tracer *t, const uint16_t *ray, uint32_t count,
                  struct simple_group *g)
{
    const struct leaf *leaf[8];
    uint32_t part[8], same = 0;
    double hit_t[8], hit_dt[8];
    g->live = (1u << count) - 1;
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t k = ray[i < count ? i : 0];
        const struct boundary *b = &t->hit[k].b;
        g->ray[i] = k;
        g->slot[i] = t->wave.slot[k];
        leaf[i] = &t->job->world->leaf[b->leaf];
        part[i] = b->part;
        hit_t[i] = b->t;
        hit_dt[i] = b->dt;
        same += leaf[i] == leaf[0];
    }
    const struct ray_batch *b = t->rays;
    const bool rays_in_row = count == 8 && g->ray[7] - g->ray[0] == 7;
    const struct vec8 o = {gather(b->o[0], g, rays_in_row),
                           gather(b->o[1], g, rays_in_row),
                           gather(b->o[2], g, rays_in_row)};
    const struct vec8 d = {gather(b->d[0], g, rays_in_row),
                           gather(b->d[1], g, rays_in_row),
                           gather(b->d[2], g, rays_in_row)};
    const struct real8 at = r8_load(hit_t);
    const struct real8 size = r8_add(v8_max_abs(o), r8_mul(r8_abs(at), v8_max_abs(d)));
    struct place8 x = {.p = v8_mad(o, at, d)};
    if ((same == 8 && place_leaf(leaf[0], part, &x)) || place_spheres(leaf, &x)) {
        x.ns = x.ng;
        x.error = r8_add(r8_mul(r8_load(hit_dt), r8_abs(v8_dot(d, x.ng))),
                         place_error(leaf[0], size));
    } else {
        place_each(t, g, &x);
    }
    v8_store(g->d, d);
    v8_store(g->p, x.p);
    v8_store(g->ng, x.ng);
    r8_store(g->error, x.error);
    const struct mask8 turned = r8_lt(r8_set(0), v8_dot(x.ns, d));
    v8_store(g->n, v8_select(turned, v8_neg(x.ns), x.ns));
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
    if (same == 8)
        colors_of(t, leaf[0]->surface, g, 255);
    else
        colors(t, leaf, g);
}

// ---- light ------------------------------------------------------------------------------

LANES_INLINE void add_own(struct tracer *t, const struct simple_group *g, unsigned live,
                          struct rgb8 c)
{
    float(*own)[BATCH_SIZE] = t->wave.own;
    if (g->in_row && live == 255) {
        float *r = &own[0][g->slot[0]], *s = &own[1][g->slot[0]],
              *u = &own[2][g->slot[0]];
        f8_store(r, f8_add(f8_load(r), c.r));
        f8_store(s, f8_add(f8_load(s), c.g));
        f8_store(u, f8_add(f8_load(u), c.b));
        return;
    }
    float v[3][8];
    f8_store(v[0], c.r);
    f8_store(v[1], c.g);
    f8_store(v[2], c.b);
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        for (int k = 0; k < 3; k++)
            own[k][g->slot[i]] += v[k][i];
    }
}

static void own(struct tracer *t, const struct simple_class *c,
                const struct simple_group *g)
{
    const struct rgb8 color = rgb8_load((const float(*)[8])g->color);
    add_own(t, g, g->live,
            rgb8_mul(rgb8_load((const float(*)[8])g->through),
                     rgb8_mul(color, rgb8_scale(f8_load(g->att), rgb8_set(c->own)))));
}

// highlight_power in the lanes of `bits`; 0 elsewhere.
LANES_INLINE struct float8 powers8(struct real8 q, double n, unsigned bits)
{
    static const double dark = 40, by_squares = 4096;
    bits &= m8_bits(r8_le(r8_mul(r8_set(n), r8_sub(r8_set(1), q)), r8_set(dark)));
    struct real8 power = r8_set(bits ? 1 : 0);
    if (bits && n == floor(n) && n >= 0 && n <= by_squares) {
        for (uint32_t k = (uint32_t)n; k; k >>= 1) {
            if (k & 1)
                power = r8_mul(power, q);
            q = r8_mul(q, q);
        }
    } else if (bits) {
        power = r8_pow_single(r8_select(m8_of(bits), q, r8_set(1)), n);
    }
    return f8_of(r8_select(m8_of(bits), power, r8_set(0)));
}

// The sum of phong and specular (highlights of trace/shade_light.c).
LANES_INLINE struct float8 highlights8(const struct finish *f, struct vec8 d,
                                       struct vec8 n, struct vec8 to, unsigned live)
{
    struct float8 sum = f8_set(0);
    if (f->phong != 0) {
        const double least = f->phong_size < 60 ? 0 : 0.0008;
        const struct vec8 r = v8_mad(d, r8_mul(r8_set(-2), v8_dot(d, n)), n);
        const struct real8 q = v8_dot(r, to);
        const unsigned bits = live & m8_bits(r8_lt(r8_set(least), q));
        if (bits)
            sum = f8_add(
                sum, f8_mul(f8_set(f->phong), powers8(q, (double)f->phong_size, bits)));
    }
    if (f->specular != 0) {
        const struct vec8 h = v8_sub(to, d);
        const struct real8 q = v8_dot(h, n), length = r8_sqrt(v8_dot(h, h));
        const unsigned bits =
            live & m8_bits(m8_and(r8_lt(r8_set(0), q), r8_lt(r8_set(0), length)));
        if (bits)
            sum = f8_add(sum,
                         f8_mul(f8_set(f->specular),
                                powers8(r8_div(q, length), (double)f->roughness, bits)));
    }
    return sum;
}

// Metals tint their highlights, lane by lane.
static struct rgb8 tinted(const struct finish *f, const struct simple_group *g,
                          struct float8 sum, struct real8 facing)
{
    float s[8], c[3][8];
    double cosine[8];
    f8_store(s, sum);
    r8_store(cosine, facing);
    for (int i = 0; i < 8; i++) {
        struct rgb x = rgb_gray(s[i]);
        if (s[i] != 0)
            x = metal_tint(x, rgb(g->color[0][i], g->color[1][i], g->color[2][i]),
                           f->metallic, cosine[i]);
        c[0][i] = x.r;
        c[1][i] = x.g;
        c[2][i] = x.b;
    }
    return rgb8_load((const float(*)[8])c);
}

// layer_lit. Takes lanes that get nothing out of *live.
LANES_INLINE struct rgb8 lit8(const struct simple_class *k, const struct lamp *lamp,
                              const struct simple_group *g, struct vec8 to,
                              unsigned *live)
{
    const struct finish *f = k->finish;
    const struct vec8 n = v8_load((const double(*)[8])g->n);
    const struct real8 facing = v8_dot(n, to);
    unsigned back = 0;
    if (k->side_test) {
        back = *live & m8_bits(r8_lt(facing, r8_set(zero)));
        if (f->diffuse_back == 0) {
            *live &= ~back;
            back = 0;
        }
    }
    struct rgb8 c = rgb8_set((struct rgb){0, 0, 0});
    if (!*live)
        return c;
    if (f->diffuse > 0 || back) {
        struct real8 cosine = r8_abs(facing);
        if (f->brilliance != 1)
            cosine = r8_pow_single(cosine, (double)f->brilliance);
        float strength[8];
        for (int i = 0; i < 8; i++)
            strength[i] = fmaxf(0, back >> i & 1 ? f->diffuse_back : f->diffuse);
        c = rgb8_scale(f8_mul(f8_of(cosine), f8_mul(f8_load(strength), f8_load(g->att))),
                       rgb8_load((const float(*)[8])g->color));
    }
    if (!lamp->light->shadowless) {
        const struct vec8 d = v8_load((const double(*)[8])g->d);
        const struct float8 sum = highlights8(f, d, n, to, *live & ~back);
        if (f->metallic != 0)
            c = rgb8_add(c, tinted(f, g, sum, facing));
        else
            c = rgb8_add(c, (struct rgb8){sum, sum, sum});
    }
    return c;
}

struct light8 {
    struct vec8 to;
    struct real8 distance;
    struct rgb8 color;
};

// lamp_direction, from the lamp's centre.
LANES_INLINE struct light8 direction8(const struct lamp *lamp, struct vec8 p)
{
    const struct light *light = lamp->light;
    struct light8 v = {.color = rgb8_set(light->color)};
    const struct vec8 to = v8_sub(V8_SET(light->location), p);
    if (light->parallel || light->kind == LIGHT_CYLINDER) {
        struct lamp_view one;
        lamp_direction(lamp, light->location, light->location, &one);
        v.to = V8_SET(one.l);
        v.distance = v8_dot(to, v.to);
        return v;
    }
    v.distance = r8_sqrt(v8_dot(to, to));
    const struct real8 inv = r8_div(r8_set(1), v.distance);
    const struct vec8 unit = {r8_mul(inv, to.x), r8_mul(inv, to.y), r8_mul(inv, to.z)};
    v.to = v8_select(r8_lt(r8_set(0), v.distance), unit, to);
    return v;
}

static bool is_black(struct rgb c)
{
    const float e = (float)zero;
    return fabsf(c.r) < e && fabsf(c.g) < e && fabsf(c.b) < e;
}

// power, smooth and spot of trace/lamp.c.
LANES_INLINE struct real8 power8(struct real8 base, double exponent)
{
    return exponent == 0   ? r8_set(1)
           : exponent == 1 ? base
                           : r8_pow_single(base, exponent);
}

LANES_INLINE struct real8 smooth8(double low, double high, struct real8 v)
{
    const struct real8 t = r8_div(r8_sub(v, r8_set(low)), r8_set(high - low));
    const struct real8 s = r8_mul(r8_mul(t, t), r8_sub(r8_set(3), r8_mul(r8_set(2), t)));
    return r8_select(r8_lt(v, r8_set(low)), r8_set(0),
                     r8_select(r8_lt(v, r8_set(high)), s, r8_set(1)));
}

LANES_INLINE struct real8 spot8(const struct lamp *lamp, const struct light8 *v)
{
    const struct real8 along = v8_dot(v->to, V8_SET(lamp->light->axis));
    const struct real8 k = r8_select(r8_lt(r8_set(0), v->distance), r8_neg(along), along);
    const struct mask8 ahead = r8_lt(r8_set(0), k);
    if (!m8_bits(ahead))
        return r8_set(0);
    // Behind the lamp nothing is lit: any base will do.
    struct real8 factor = power8(r8_select(ahead, k, r8_set(1)), lamp->light->tightness);
    if (lamp->cos_radius > 0) {
        const struct real8 edge = smooth8(lamp->cos_falloff, lamp->cos_radius, k);
        factor =
            r8_select(r8_lt(k, r8_set(lamp->cos_radius)), r8_mul(factor, edge), factor);
    }
    return r8_select(ahead, factor, r8_set(0));
}

static struct real8 cylinders(const struct lamp *lamp, const struct simple_group *g,
                              const struct light8 *v)
{
    double to[3][8], distance[8], factor[8];
    v8_store(to, v->to);
    r8_store(distance, v->distance);
    for (int i = 0; i < 8; i++) {
        const struct lamp_view one = {
            {to[0][i], to[1][i], to[2][i]}, distance[i], lamp->light->color};
        factor[i] = lamp_attenuation(lamp, lamp->light->location,
                                     vec3(g->p[0][i], g->p[1][i], g->p[2][i]), &one);
    }
    return r8_load(factor);
}

// The rest of lamp_view (lamp_attenuation); returns the lanes that are lit.
LANES_INLINE unsigned attenuate(const struct lamp *lamp, const struct simple_group *g,
                                struct light8 *v)
{
    const struct light *l = lamp->light;
    struct real8 factor = r8_set(1);
    if (l->kind == LIGHT_CYLINDER) {
        factor = cylinders(lamp, g, v); // with its fading
    } else {
        if (l->kind == LIGHT_SPOT)
            factor = spot8(lamp, v);
        if (l->fade_power > 0 && l->fade_distance != 0)
            factor =
                r8_mul(factor,
                       r8_div(r8_set(2),
                              r8_add(r8_set(1),
                                     power8(r8_div(v->distance, r8_set(l->fade_distance)),
                                            l->fade_power))));
    }
    const unsigned dark = m8_bits(r8_eq(factor, r8_set(0)));
    if (dark == 255)
        return 0;
    v->color = rgb8_scale(f8_of(factor), v->color);
    const struct float8 e = f8_set((float)zero), o = f8_set(0);
    const unsigned seen = f8_le(e, f8_max(v->color.r, f8_sub(o, v->color.r))) |
                          f8_le(e, f8_max(v->color.g, f8_sub(o, v->color.g))) |
                          f8_le(e, f8_max(v->color.b, f8_sub(o, v->color.b)));
    return g->live & seen & ~dark;
}

LANES_INLINE unsigned black8(struct rgb8 c)
{
    const struct float8 o = f8_set(0);
    return f8_le(c.r, o) & f8_le(o, c.r) & f8_le(c.g, o) & f8_le(o, c.g) & f8_le(c.b, o) &
           f8_le(o, c.b);
}

// Queues the shadow rays of the lanes (trace_offset).
LANES_INLINE uint32_t queue8(struct tracer *t, const struct simple_group *g,
                             unsigned live, const struct light8 *v, struct rgb8 value,
                             uint32_t queued)
{
    struct shadow_batch *b = &t->simple;
    const struct vec8 ng = v8_load((const double(*)[8])g->ng);
    const struct real8 side =
        r8_select(r8_lt(v8_dot(v->to, ng), r8_set(0)), r8_set(-1), r8_set(1));
    const struct real8 by = r8_mul(r8_mul(r8_set(2), side), r8_load(g->error));
    const struct vec8 o = v8_mad(v8_load((const double(*)[8])g->p), by, ng);
    if (live == 255) {
        r8_store(b->rays->o[0] + queued, o.x);
        r8_store(b->rays->o[1] + queued, o.y);
        r8_store(b->rays->o[2] + queued, o.z);
        r8_store(b->rays->d[0] + queued, v->to.x);
        r8_store(b->rays->d[1] + queued, v->to.y);
        r8_store(b->rays->d[2] + queued, v->to.z);
        r8_store(b->rays->t_max + queued, v->distance);
        f8_store(b->value[0] + queued, value.r);
        f8_store(b->value[1] + queued, value.g);
        f8_store(b->value[2] + queued, value.b);
        for (uint32_t i = 0; i < 8; i++)
            b->slot[queued + i] = g->slot[i];
        return queued + 8;
    }
    double all[7][8];
    float c[3][8];
    v8_store(all, o);
    v8_store(all + 3, v->to);
    r8_store(all[6], v->distance);
    f8_store(c[0], value.r);
    f8_store(c[1], value.g);
    f8_store(c[2], value.b);
    for (; live; live &= live - 1, queued++) {
        const int i = __builtin_ctz(live);
        for (int k = 0; k < 3; k++) {
            b->rays->o[k][queued] = all[k][i];
            b->rays->d[k][queued] = all[3 + k][i];
            b->value[k][queued] = c[k][i];
        }
        b->rays->t_max[queued] = all[6][i];
        b->slot[queued] = g->slot[i];
    }
    return queued;
}

// shade_lamp.
static uint32_t light(struct tracer *t, const struct simple_class *c,
                      const struct lamp *lamp, const struct simple_group *g,
                      uint32_t groups, uint32_t queued)
{
    const struct light *l = lamp->light;
    const bool even =
        l->kind == LIGHT_POINT && !(l->fade_power > 0 && l->fade_distance != 0);
    const bool shadowed = t->job->shadows && !l->shadowless;
    if (even && is_black(l->color))
        return queued;
    for (const struct simple_group *end = g + groups; g < end; g++) {
        struct light8 v = direction8(lamp, v8_load((const double(*)[8])g->p));
        unsigned live = even ? g->live : attenuate(lamp, g, &v);
        if (!live)
            continue;
        const struct rgb8 sum = lit8(c, lamp, g, v.to, &live);
        if (!live)
            continue;
        struct rgb8 value =
            rgb8_mul(v.color, rgb8_add(rgb8_set((struct rgb){0, 0, 0}), sum));
        live &= ~black8(value);
        if (!live)
            continue;
        value = rgb8_mul(value, rgb8_load((const float(*)[8])g->through));
        const unsigned bare =
            shadowed ? live & m8_bits(r8_le(v.distance, r8_set(0))) : live;
        if (bare)
            add_own(t, g, bare, value);
        live &= ~bare;
        if (!live)
            continue;
        if (queued + 8 > BATCH_SIZE) {
            shadow_flush_simple(t, queued);
            queued = 0;
        }
        queued = queue8(t, g, live, &v, value, queued);
    }
    return queued;
}

// ---- ways on ------------------------------------------------------------------------------

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

const struct shade_kernels PASTE(shade_kernels_, ISA) = {TEXT(ISA), camera, place, own,
                                                         light,     bounce, meets};
