// Pigments and normals at eight points, compiled once per instruction set: ISA names it.
// Each expression is that of pattern.c, warp.c, pigment.c and normal.c, in the same order:
// the bits are the same.
#include <string.h>

#include "math/color.h"
#include "math/isa.h"
#include "math/lanes_vec.h"
#include "math/power_lanes.h"
#include "scene/image_map.h"
#include "scene/noise_kernel.h"
#include "scene/pattern_lanes.h"
#include "scene/pigment_tape.h"
#include "scene/plain_lanes.h"
#include "scene/ramp_lanes.h"
#include "scene/surface_eval.h"
#include "scene/warp.h"
#include "scene/warp_lanes.h"

#define NOISE (&OF_ISA(noise_kernels_))

typedef const double (*points8)[8];

static inline struct vec3 lane_of(points8 v, int i)
{
    return vec3(v[0][i], v[1][i], v[2][i]);
}

static inline void set_lane(double v[3][8], int i, struct vec3 x)
{
    v[0][i] = x.x, v[1][i] = x.y, v[2][i] = x.z;
}

// ---- points ---------------------------------------------------------------------------

static void turbulence_step(const struct turbulence *t, points8 from, double to[3][8])
{
    double d[3][8];
    noise_dturbulence8(NOISE, from, t->lambda, t->omega, t->octaves, d);
    const struct vec8 p = v8_load(from), move = v8_load((points8)d);
    v8_store(to, (struct vec8){r8_add(p.x, r8_mul(move.x, r8_set(t->amount.x))),
                               r8_add(p.y, r8_mul(move.y, r8_set(t->amount.y))),
                               r8_add(p.z, r8_mul(move.z, r8_set(t->amount.z)))});
}

static void warp_step(const struct warp *w, points8 from, double to[3][8])
{
    if (w->kind == WARP_TRANSFORM)
        v8_store(to, v8_inverse_point(&w->transform, v8_load(from)));
    else if (w->kind == WARP_TURBULENCE)
        turbulence_step(&w->turbulence, from, to);
    else if (w->kind == WARP_BLACK_HOLE)
        v8_store(to, black_hole8(w, v8_load(from)));
    else
        for (int i = 0; i < 8; i++)
            set_lane(to, i, warp_point(w, lane_of(from, i)));
}

LANES_INLINE struct real8 not_far8(struct real8 v)
{
    const struct real8 far = r8_set(WARP_FAR), near = r8_set(-WARP_FAR);
    return r8_select(r8_lt(far, v), far, r8_select(r8_lt(v, near), near, v));
}

LANES_INLINE void far_step(points8 from, double to[3][8])
{
    for (int a = 0; a < 3; a++)
        r8_store(to[a], not_far8(r8_load(from[a])));
}

static void warp(const struct pattern *p, double at[3][8])
{
    for (const struct warp *w = p->warps; w; w = w->next)
        warp_step(w, (points8)at, at);
    if (turbulence_is_warp(p))
        turbulence_step(p->turbulence, (points8)at, at);
    far_step((points8)at, at);
}

// ---- values ---------------------------------------------------------------------------

// fmod(v, PATTERN_MODULUS) of a magnitude below 2^26. The product with a part of the modulus
// that has 26 bits is exact, and so is each difference: all are whole multiples of 2^-52.
LANES_INLINE struct real8 folded8(struct real8 v)
{
    static const double high = 0x1.0000a8p0, low = PATTERN_MODULUS - 0x1.0000a8p0;
    const struct real8 a = r8_abs(v), m = r8_set(PATTERN_MODULUS);
    const struct real8 q = r8_floor(r8_div(a, m));
    struct real8 r = r8_sub(r8_sub(a, r8_mul(q, r8_set(high))), r8_mul(q, r8_set(low)));
    r = r8_select(r8_lt(r, r8_set(0)), r8_add(r, m), r);
    r = r8_select(r8_lt(r, m), r, r8_sub(r, m));
    return r8_copysign(r, v);
}

LANES_INLINE struct real8 modulo8(struct real8 v)
{
    const struct real8 a = r8_abs(v);
    const struct mask8 past = r8_le(r8_set(PATTERN_MODULUS), a);
    unsigned bits = m8_bits(past);
    if (!bits)
        return v;
    const unsigned near = m8_bits(r8_lt(a, r8_set(0x1p26)));
    struct real8 out = r8_select(past, folded8(v), v);
    if (!(bits & ~near))
        return out;
    double all[8], done[8];
    r8_store(all, v);
    r8_store(done, out);
    for (bits &= ~near; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        done[i] = fmod(all[i], PATTERN_MODULUS);
    }
    return r8_load(done);
}

LANES_INLINE struct real8 triangle8(struct real8 v)
{
    const struct real8 two = r8_set(2);
    const struct real8 up = r8_sub(v, r8_floor(v));
    const struct real8 down = r8_add(r8_add(v, r8_set(1)), r8_floor(r8_abs(v)));
    const struct real8 f = r8_select(r8_le(r8_set(0), v), up, down);
    return r8_select(r8_lt(f, r8_set(0.5)), r8_mul(two, f),
                     r8_mul(two, r8_sub(r8_set(1), f)));
}

static void wave_step(const struct pattern *p, double v[8])
{
    const struct real8 x = r8_load(v);
    switch (p->wave) {
    case WAVE_RAMP: break;
    case WAVE_TRIANGLE: r8_store(v, triangle8(x)); break;
    case WAVE_CUBIC:
        r8_store(v, r8_mul(r8_mul(x, x), r8_sub(r8_set(3), r8_mul(r8_set(2), x))));
        break;
    case WAVE_SINE:
        r8_store(v, r8_mul(r8_add(r8_set(1), cycloidal8(x)), r8_set(0.5)));
        break;
    case WAVE_SCALLOP: r8_store(v, r8_abs(cycloidal8(r8_mul(x, r8_set(0.5))))); break;
    case WAVE_POLY: r8_store(v, det_pow8(x, r8_set(p->exponent))); break;
    }
}

LANES_INLINE void finish8(const struct pattern *p, double out[8])
{
    struct real8 v = r8_load(out);
    if (p->frequency != 0)
        v = modulo8(r8_add(r8_mul(v, r8_set(p->frequency)), r8_set(p->phase)));
    v = r8_select(r8_lt(v, r8_set(0)), r8_sub(v, r8_floor(v)), v);
    r8_store(out, v);
    if (p->wave != WAVE_RAMP)
        wave_step(p, out);
}

static struct pattern_context context_of(const struct pattern_packet *k, int i)
{
    return (struct pattern_context){.p_world = lane_of(k->p_world, i),
                                    .normal = lane_of(k->normal, i),
                                    .ray_d = lane_of(k->ray_d, i),
                                    .uv = k->uv ? (struct vec2){k->uv[0][i], k->uv[1][i]}
                                                : (struct vec2){0, 0}};
}

static unsigned colors(const struct pigment_tape *t, const struct pattern_packet *packet,
                       const double place[3][8], unsigned live, float out[5][8]);

// pigment_pattern.
static void greys(const struct pattern *p, const struct pattern_packet *packet,
                  const double warped[3][8], unsigned live, double out[8])
{
    float c[5][8];
    const unsigned found = colors(p->tape, packet, warped, live, c);
    const struct real8 r = r8_of_floats(f8_load(c[0])), g = r8_of_floats(f8_load(c[1])),
                       b = r8_of_floats(f8_load(c[2]));
    const struct real8 grey = r8_add(
        r8_add(r8_mul(r8_set(LUMINANCE_RED), r), r8_mul(r8_set(LUMINANCE_GREEN), g)),
        r8_mul(r8_set(LUMINANCE_BLUE), b));
    r8_store(out, r8_select(m8_of(found), r8_of_floats(f8_of(grey)), r8_set(0)));
}

static void values(const struct pattern *p, const struct pattern_packet *packet,
                   const double warped[3][8], unsigned live, double out[8])
{
    if (p->tape) {
        greys(p, packet, warped, live, out);
    } else if (p->ops->plain) {
        r8_store(out, plain_value(p, v8_load(warped)));
    } else if (p->ops->values) {
        p->ops->values(p, NOISE, warped, out);
    } else {
        for (int i = 0; i < 8; i++) {
            out[i] = 0;
            if (!(live >> i & 1))
                continue;
            const struct pattern_context c = context_of(packet, i);
            out[i] = p->ops->value(p, lane_of(warped, i), &c);
        }
    }
    finish8(p, out);
}

// ---- colours --------------------------------------------------------------------------

struct level {
    _Alignas(64) double p[3][8]; // so that no vector lies across two lines
    double v[8], f[8];
    float c[5][8], low[5][8], high[5][8];
    uint32_t a[8], b[8]; // entries below and above the value
    unsigned live, found;
};

static void ramp_step(const struct pigment_ramp *r, int channels, unsigned live,
                      const double v[8], float out[5][8])
{
    if (r->quick && r->count <= 8) {
        ramp_quick(r, true, channels, r8_load(v), out);
        return;
    }
    if (r->quick) {
        ramp_quick(r, false, channels, r8_load(v), out);
        return;
    }
    for (; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        uint32_t a, b;
        double f;
        map_find(r->key, r->count, v[i], &a, &b, &f);
        for (int k = 0; k < channels; k++) {
            const float low = r->channel[k][a], high = r->channel[k][b];
            out[k][i] = a == b ? high : low + (float)(f * (high - low));
        }
    }
}

static void texel_step(const struct image_map *m, struct level *l, points8 at)
{
    l->found = 0;
    for (unsigned live = l->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        struct rgbft c;
        l->found |= (unsigned)image_map_color(m, lane_of(at, i), &c) << i;
        l->c[0][i] = c.r, l->c[1][i] = c.g, l->c[2][i] = c.b;
        l->c[3][i] = c.filter, l->c[4][i] = c.transmit;
    }
}

// As map_find, by halves where the keys ascend.
static void find_lane(const float *key, uint32_t count, bool ascending, double v,
                      uint32_t *a, uint32_t *b, double *f)
{
    if (!ascending) {
        map_find(key, count, v, a, b, f);
        return;
    }
    const uint32_t c = map_search(key, count, v);
    *a = *b = c;
    *f = 0;
    if (c == 0 || v >= key[c])
        return;
    *a = c - 1;
    *f = (v - key[c - 1]) / ((double)key[c] - key[c - 1]);
}

static void find_step(const struct pigment_keys *k, struct level *l)
{
    l->found = 0;
    if (k->ascending && k->count <= 8) {
        int32_t above[8], below[8];
        r8_store(l->f, between8(k->key, k->count, true, r8_load(l->v), above, below));
        for (int i = 0; i < 8; i++) {
            l->a[i] = k->entry[below[i]];
            l->b[i] = k->entry[above[i]];
        }
        return;
    }
    for (unsigned live = l->live; live; live &= live - 1) {
        const int i = __builtin_ctz(live);
        uint32_t a, b;
        find_lane(k->key, k->count, k->ascending, l->v[i], &a, &b, &l->f[i]);
        l->a[i] = k->entry[a];
        l->b[i] = k->entry[b];
    }
}

LANES_INLINE unsigned lanes_of(const uint32_t v[8], uint32_t x)
{
#if defined(__AVX2__)
    const __m256i same = _mm256_cmpeq_epi32(_mm256_loadu_si256((const __m256i *)v),
                                            _mm256_set1_epi32((int)x));
    return (unsigned)_mm256_movemask_ps(_mm256_castsi256_ps(same));
#else
    unsigned bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (unsigned)(v[i] == x) << i;
    return bits;
#endif
}

static unsigned lanes_with(const struct level *l, uint32_t entry)
{
    return (lanes_of(l->a, entry) | lanes_of(l->b, entry)) & l->live;
}

static void keep_step(struct level *l, const struct level *inner, uint32_t entry,
                      int channels)
{
    const unsigned high = lanes_of(l->b, entry) & inner->live,
                   low = lanes_of(l->a, entry) & inner->live;
    l->found |= inner->found & inner->live;
    for (int k = 0; k < channels; k++) {
        const struct float8 c = f8_load(inner->c[k]);
        f8_store(l->high[k], f8_select(high, c, f8_load(l->high[k])));
        f8_store(l->low[k], f8_select(low, c, f8_load(l->low[k])));
    }
}

static void blend_step(struct level *l, int channels)
{
    const struct real8 f = r8_load(l->f);
    unsigned same = 0;
    for (int i = 0; i < 8; i++)
        same |= (unsigned)(l->a[i] == l->b[i]) << i;
    const unsigned alone = same & m8_bits(r8_eq(f, r8_set(0)));
    for (int k = 0; k < channels; k++) {
        const struct float8 b = f8_load(l->high[k]);
        f8_store(l->c[k], f8_select(alone, b, blend8(f8_load(l->low[k]), b, f)));
    }
}

static void sum_step(struct level *l, const struct level *inner, float w, int channels)
{
    const struct float8 weight = f8_set(w);
    l->found |= inner->found;
    for (int k = 0; k < channels; k++)
        f8_store(l->high[k],
                 f8_add(f8_load(l->high[k]), f8_mul(weight, f8_load(inner->c[k]))));
}

static void even_step(const struct rgbft *c, int channels, float out[5][8])
{
    const float v[5] = {c->r, c->g, c->b, c->filter, c->transmit};
    for (int k = 0; k < channels; k++)
        f8_store(out[k], f8_set(v[k]));
}

static void uv_step(const struct pattern_packet *packet, double to[3][8])
{
    for (int i = 0; i < 8; i++)
        set_lane(to, i,
                 packet->uv ? vec3(packet->uv[0][i], packet->uv[1][i], 0)
                            : vec3(0, 0, 0));
}

static unsigned colors(const struct pigment_tape *t, const struct pattern_packet *packet,
                       const double place[3][8], unsigned live, float out[5][8])
{
    struct level level[PIGMENT_LEVELS + 1];
    const int channels = t->channels;
    memcpy(level[0].p, place, sizeof level[0].p);
    level[1].live = live;
    for (uint32_t i = 0; i < t->count;) {
        const struct pigment_step *s = &t->step[i++];
        struct level *l = &level[s->level], *inner = l + 1;
        const points8 from = (points8)level[s->from].p;
        switch (s->op) {
        case PIGMENT_MOVE:
            v8_store(l->p, v8_inverse_point(s->transform, v8_load(from)));
            break;
        case PIGMENT_TURBULENCE: turbulence_step(s->turbulence, from, l->p); break;
        case PIGMENT_WARP: warp_step(s->warp, from, l->p); break;
        case PIGMENT_FAR: far_step(from, l->p); break;
        case PIGMENT_UV_POINT: uv_step(packet, l->p); break;
        case PIGMENT_VALUE: values(s->pattern, packet, from, l->live, l->v); break;
        case PIGMENT_COLOR:
            even_step(s->color, channels, l->c);
            l->found = l->live;
            break;
        case PIGMENT_RAMP:
            ramp_step(s->ramp, channels, l->live, l->v, l->c);
            l->found = l->live;
            break;
        case PIGMENT_TEXEL: texel_step(s->image, l, from); break;
        case PIGMENT_FIND: find_step(s->keys, l); break;
        case PIGMENT_ENTRY:
            inner->live = lanes_with(l, s->entry);
            if (!inner->live)
                i = s->next;
            break;
        case PIGMENT_KEEP: keep_step(l, inner, s->entry, channels); break;
        case PIGMENT_BLEND: blend_step(l, channels); break;
        case PIGMENT_SUM_BEGIN:
            even_step(&(struct rgbft){0}, channels, l->high);
            l->found = 0;
            inner->live = l->live;
            break;
        case PIGMENT_SUM_ADD: sum_step(l, inner, s->weight, channels); break;
        case PIGMENT_SUM_END:
            for (int k = 0; k < channels; k++)
                f8_store(l->c[k], f8_div(f8_load(l->high[k]), f8_set(s->weight)));
            break;
        }
    }
    for (int k = 0; k < channels; k++)
        memcpy(out[k], level[1].c[k], sizeof out[k]);
    return level[1].found & live;
}

// ---- normals --------------------------------------------------------------------------

// pattern_normal_in.
static void normal_in8(const struct pattern *p, bool keep_length, double v[3][8])
{
    struct vec8 n = v8_load((points8)v);
    if (!keep_length)
        n = v8_normalize(n);
    bool moved = false;
    for (const struct warp *w = p->warps; w; w = w->next)
        if (w->kind == WARP_TRANSFORM) {
            n = v8_inverse_normal(&w->transform, n);
            moved = true;
        }
    v8_store(v, moved && !keep_length ? v8_normalize(n) : n);
}

static void normal_back8(const struct warp *w, double v[3][8])
{
    if (!w)
        return;
    normal_back8(w->next, v);
    if (w->kind == WARP_TRANSFORM)
        v8_store(v, v8_normal(&w->transform, v8_load((points8)v)));
}

static void normal_out8(const struct pattern *p, bool keep_length, double v[3][8])
{
    if (!keep_length)
        v8_store(v, v8_normalize(v8_load((points8)v)));
    normal_back8(p->warps, v);
    if (!keep_length)
        v8_store(v, v8_normalize(v8_load((points8)v)));
}

static void by_differences(const struct normal *n, const struct pattern_packet *packet,
                           points8 q, unsigned live, double v[3][8])
{
    const double scale = normal_difference_scale(n);
    const struct vec8 at = v8_load(q);
    struct vec8 sum = v8_load((points8)v);
    for (int k = 0; k < 4; k++) {
        const struct vec8 side = V8_SET(normal_sides[k]);
        double s[3][8], h[8];
        v8_store(s, v8_mad(at, r8_set(n->delta), side));
        values(&n->pattern, packet, (points8)s, live, h);
        for (int i = 0; i < 8 && n->kind == NORMAL_SLOPES; i++)
            h[i] = normal_slope_height(n->slopes, h[i]);
        sum = v8_mad(sum, r8_mul(r8_load(h), r8_set(scale)), side);
    }
    v8_store(v, sum);
}

static void bent(const struct normal *n, const struct pattern_packet *packet,
                 const double place[3][8], unsigned live, bool keep, double v[3][8]);

static void by_map(const struct normal *n, const struct pattern_packet *packet, points8 q,
                   unsigned live, bool keep, double v[3][8])
{
    const struct normal_map *m = n->map;
    double value[8], f[8], high[3][8], low[3][8];
    uint32_t a[8], b[8];
    values(&n->pattern, packet, q, live, value);
    unsigned between = 0;
    for (int i = 0; i < 8; i++) {
        map_find(m->key, m->count, value[i], &a[i], &b[i], &f[i]);
        between |= (unsigned)(a[i] != b[i]) << i;
    }
    memcpy(high, v, sizeof high);
    memcpy(low, v, sizeof low);
    for (uint32_t k = 0; k < m->count; k++) {
        unsigned above = 0, below = 0;
        for (int i = 0; i < 8; i++) {
            above |= (unsigned)(b[i] == k) << i;
            below |= (unsigned)(a[i] == k) << i;
        }
        if (!((above | below) & live))
            continue;
        double one[3][8];
        memcpy(one, v, sizeof one);
        bent(m->entry[k], packet, q, (above | below) & live, keep, one);
        const struct vec8 x = v8_load((points8)one);
        v8_store(high, v8_select(m8_of(above), x, v8_load((points8)high)));
        v8_store(low, v8_select(m8_of(below), x, v8_load((points8)low)));
    }
    const struct real8 part = r8_load(f), rest = r8_sub(r8_set(1), part);
    const struct vec8 lo = v8_load((points8)low), hi = v8_load((points8)high);
    const struct vec8 start = {r8_mul(rest, lo.x), r8_mul(rest, lo.y),
                               r8_mul(rest, lo.z)};
    v8_store(v, v8_select(m8_of(between), v8_mad(start, part, hi), hi));
}

static void by_average(const struct normal *n, const struct pattern_packet *packet,
                       points8 q, unsigned live, bool keep, double v[3][8])
{
    const struct normal_map *m = n->map;
    struct vec8 sum = {r8_set(0), r8_set(0), r8_set(0)};
    double total = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        double one[3][8];
        memcpy(one, v, sizeof one);
        bent(m->entry[i], packet, q, live, keep, one);
        sum = v8_mad(sum, r8_set(m->key[i]), v8_load((points8)one));
        total += m->key[i];
    }
    const struct real8 share = r8_set(1 / total);
    v8_store(v, (struct vec8){r8_mul(share, sum.x), r8_mul(share, sum.y),
                              r8_mul(share, sum.z)});
}

// perturb of scene/patterns/quilted.c.
static void quilt(const struct normal *n, points8 q, double v[3][8])
{
    struct real8 b;
    const struct vec8 w = plain_cushion(&n->pattern, v8_load(q), &b);
    v8_store(v, v8_mad(v8_load((points8)v), r8_mul(r8_set(n->amount), b), w));
}

// The pattern's own rule, or differences.
static void by_pattern(const struct normal *n, const struct pattern_packet *packet,
                       points8 q, unsigned live, double v[3][8])
{
    const struct pattern *p = &n->pattern;
    const struct pattern_ops *ops = p->ops;
    if (!ops)
        return;
    if (ops->perturbs)
        ops->perturbs(p, NOISE, n->amount, q, v);
    else if (ops->plain == PLAIN_QUILTED)
        quilt(n, q, v);
    else if (ops->perturb)
        for (; live; live &= live - 1) {
            const int i = __builtin_ctz(live);
            set_lane(v, i,
                     ops->perturb(p, n->amount, lane_of((points8)v, i), lane_of(q, i)));
        }
    else
        by_differences(n, packet, q, live, v);
}

// perturb() of scene/normal.c.
static void bent(const struct normal *n, const struct pattern_packet *packet,
                 const double place[3][8], unsigned live, bool keep, double v[3][8])
{
    double q[3][8];
    keep |= n->no_bump_scale;
    if (n->kind == NORMAL_UV) {
        uv_step(packet, q);
        bent(n->map->entry[0], packet, (points8)q, live, keep, v);
        v8_store(v, v8_normalize(v8_load((points8)v)));
        return;
    }
    memcpy(q, place, sizeof q);
    warp(&n->pattern, q);
    normal_in8(&n->pattern, keep, v);
    switch (n->kind) {
    case NORMAL_MAP: by_map(n, packet, (points8)q, live, keep, v); break;
    case NORMAL_AVERAGE: by_average(n, packet, (points8)q, live, keep, v); break;
    case NORMAL_PATTERN:
    case NORMAL_SLOPES: by_pattern(n, packet, (points8)q, live, v); break;
    case NORMAL_BUMP_MAP:
        for (; live && n->image; live &= live - 1) {
            const int i = __builtin_ctz(live);
            set_lane(v, i,
                     image_map_bump(n->image, n->amount, lane_of((points8)v, i),
                                    lane_of((points8)q, i)));
        }
        break;
    case NORMAL_UV: break;
    }
    normal_out8(&n->pattern, keep, v);
}

static void perturb(const struct normal *n, const struct pattern_packet *packet,
                    const double place[3][8], unsigned live, double v[3][8])
{
    bent(n, packet, place, live, false, v);
}

static void normal_in(const struct pattern *p, double v[3][8])
{
    normal_in8(p, false, v);
}

static void normal_out(const struct pattern *p, double v[3][8])
{
    normal_out8(p, false, v);
}

const struct surface_kernels OF_ISA(surface_kernels_) = {
    ISA_TEXT, NOISE, warp, values, colors, perturb, normal_in, normal_out};
