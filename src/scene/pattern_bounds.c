// The externs that formulas of patterns are made of (pattern_formula.h): their bounds over
// boxes of arguments.
#include <string.h>

#include "base/arena.h"
#include "math/pi.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

#define TURN (2 * PI)

// Sines, powers and sums of a few terms are rounded by less.
#define VALUE_SLACK 0x1p-46
// A colour is rounded to single precision, and so is the difference of two.
#define SINGLE_ROUNDING 0x1p-24

uint32_t formula_extern(struct formula *f, const struct tape_extern *e, const void *data,
                        const uint32_t at[3])
{
    uint32_t out;
    tape_call_extern(f->b, e, data, at, &out);
    return out;
}

static struct interval around(struct interval v, double slack)
{
    return interval(v.lo - slack, v.hi + slack);
}

// ---- nothing known ------------------------------------------------------------------

static void unknown_bounds(const void *data, const struct interval *in,
                           struct interval *out, struct interval *partial)
{
    (void)in;
    out[0] = *(const struct interval *)data;
    for (int i = 0; partial && i < 3; i++)
        partial[i] = interval_whole();
}

static bool always(const void *data)
{
    (void)data;
    return true;
}

static const struct tape_extern unknown = {.name = "unknown",
                                           .arguments = 3,
                                           .width = 1,
                                           .bounds = unknown_bounds,
                                           .opaque = always};

uint32_t formula_unknown(struct formula *f, double lo, double hi, const uint32_t at[3])
{
    struct interval *range = arena_new_struct(f->arena, struct interval);
    *range = interval(lo, hi);
    return formula_extern(f, &unknown, range, at);
}

// ---- noise ------------------------------------------------------------------------------

static void set_lane(struct tape_range8 *to, int lane, struct interval v)
{
    to->lo[lane] = v.lo;
    to->hi[lane] = v.hi;
}

static void noise_extern_bounds(const void *data, const struct interval *in,
                                struct interval *out, struct interval *partial)
{
    struct interval slope[3];
    noise_bounds(in, pattern_noise_generator(data), out, slope);
    if (partial)
        memcpy(partial, slope, sizeof slope);
}

static bool noise_extern_bounds8(const struct noise_kernels *k, const void *data,
                                 const struct tape_range8 *in, struct tape_range8 *out,
                                 struct tape_range8 *partial)
{
    double lo[3][TAPE_LANES], hi[3][TAPE_LANES];
    struct noise_bounds8 b;
    for (int a = 0; a < 3; a++) {
        memcpy(lo[a], in[a].lo, sizeof lo[a]);
        memcpy(hi[a], in[a].hi, sizeof hi[a]);
    }
    k->bounds((const double(*)[TAPE_LANES])lo, (const double(*)[TAPE_LANES])hi,
              pattern_noise_generator(data), &b);
    memcpy(out->lo, b.lo, sizeof b.lo);
    memcpy(out->hi, b.hi, sizeof b.hi);
    for (int a = 0; partial && a < 3; a++)
        for (int l = 0; l < TAPE_LANES; l++)
            set_lane(&partial[a], l, interval(b.slope_lo[a][l], b.slope_hi[a][l]));
    return true;
}

static const struct tape_extern noise_extern = {.name = "noise",
                                                .arguments = 3,
                                                .width = 1,
                                                .bounds = noise_extern_bounds,
                                                .bounds8 = noise_extern_bounds8};

uint32_t formula_noise(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return formula_extern(f, &noise_extern, p, at);
}

// ---- waves ------------------------------------------------------------------------------

static struct interval triangle(struct interval v, struct interval *by)
{
    const double half = floor(2 * v.lo);
    const double a = triangle_wave(v.lo), b = triangle_wave(v.hi);
    struct interval r = interval(fmin(a, b), fmax(a, b));
    const bool even = fmod(half, 2) == 0;
    *by = interval_point(even ? 2 : -2);
    if (2 * v.hi > half + 1) { // past the next turn
        *by = interval(-2, 2);
        r = even ? interval(r.lo, 1) : interval(0, r.hi);
        if (2 * v.hi > half + 2)
            r = interval(0, 1);
    }
    return around(r, VALUE_SLACK * (1 + interval_size(v)));
}

static struct interval power_of(struct interval v, double e, struct interval *by)
{
    const struct interval a = interval(fmax(v.lo, 0), fmax(v.hi, 0));
    *by = interval_whole();
    if (!(e > 0))
        return e == 0 ? interval_point(1) : interval_whole();
    if (e >= 1 || a.lo > 0)
        *by =
            interval_multiply(interval_point(e), interval_pow(a, interval_point(e - 1)));
    return interval_widened(det_pow(a.lo, e), det_pow(a.hi, e), VALUE_SLACK);
}

// Of a value that is not below 0.
static struct interval wave_of(const struct pattern *p, struct interval v,
                               struct interval *by)
{
    struct interval s, turned = interval_multiply(v, interval_point(TURN));
    switch (p->wave) {
    case WAVE_RAMP: break;
    case WAVE_TRIANGLE: return triangle(v, by);
    case WAVE_SINE:
        s = interval_sin(turned);
        *by = interval_multiply(interval_point(PI), interval_cos(turned));
        return around(interval(0.5 * s.lo + 0.5, 0.5 * s.hi + 0.5), VALUE_SLACK);
    case WAVE_SCALLOP:
        turned = interval_multiply(v, interval_point(PI));
        s = interval_sin(turned);
        *by = interval_multiply(interval_point(PI), interval_cos(turned));
        if (s.lo < 0)
            *by = s.hi <= 0 ? interval_negate(*by)
                            : interval_hull(*by, interval_negate(*by));
        return around(interval_abs(s), VALUE_SLACK);
    case WAVE_CUBIC:
        *by = interval_multiply(interval_multiply(interval_point(6), v),
                                interval_subtract(interval_point(1), v));
        // Rises to 1 and falls after it.
        if (v.hi <= 1)
            return interval_widened(v.lo * v.lo * (3 - 2 * v.lo),
                                    v.hi * v.hi * (3 - 2 * v.hi), VALUE_SLACK);
        return interval_multiply(
            interval_square(v),
            interval_subtract(interval_point(3), interval(2 * v.lo, 2 * v.hi)));
    case WAVE_POLY: return power_of(v, p->exponent, by);
    }
    *by = interval_point(1);
    return v;
}

struct pieces {
    struct interval v, by;
    bool any;
};

static void add_piece(const struct pattern *p, struct interval v, struct pieces *all)
{
    struct interval by;
    const struct interval w = wave_of(p, v, &by);
    all->v = all->any ? interval_hull(all->v, w) : w;
    all->by = all->any ? interval_hull(all->by, by) : by;
    all->any = true;
}

// Below 0 the value is counted from the whole number below.
static void add_signed(const struct pattern *p, struct interval v, struct pieces *all,
                       bool *jumps)
{
    if (v.lo >= 0) {
        add_piece(p, v, all);
        return;
    }
    const bool periodic =
        p->wave == WAVE_TRIANGLE || p->wave == WAVE_SINE || p->wave == WAVE_SCALLOP;
    const double first = floor(v.lo), last = v.hi < 0 ? floor(v.hi) : -1;
    if (last > first + 1) { // all there is
        add_piece(p, interval(0, 1), all);
        *jumps |= !periodic;
    } else {
        for (double c = first; c <= last; c++)
            add_piece(p, interval(fmax(v.lo - c, 0), fmin(v.hi - c, 1)), all);
        *jumps |= !periodic && last > first;
    }
    if (v.hi >= 0) {
        add_piece(p, interval(0, v.hi), all);
        *jumps |= !periodic;
    }
}

static void finished_bounds(const void *data, const struct interval *in,
                            struct interval *out, struct interval *partial)
{
    const struct pattern *p = data;
    struct interval v = in[0];
    struct pieces all = {0};
    bool jumps = false;
    const double m = PATTERN_MODULUS;
    if (p->frequency != 0) {
        v = interval_add(interval_multiply(v, interval_point(p->frequency)),
                         interval_point(p->phase));
        const double first = trunc(v.lo / m), last = trunc(v.hi / m);
        if (first == last) { // 0 holds both signs
            v = interval(v.lo - first * m, v.hi - first * m);
            if (first != 0)
                v = around(v, 4 * DBL_EPSILON * fabs(first * m));
            add_signed(p, v, &all, &jumps);
        } else if (last == first + 1) {
            const double slack = 4 * DBL_EPSILON * m * (fabs(first) + 2);
            const double low = v.lo - first * m - slack, high = v.hi - last * m + slack;
            jumps = true;
            // Towards 0 where the number is negative: multiples belong to the part below.
            add_signed(p, interval(low, v.hi > 0 ? m : 0), &all, &jumps);
            add_signed(p, interval(v.lo < 0 ? -m : 0, high), &all, &jumps);
        } else {
            jumps = true;
            add_signed(p, interval(v.lo < 0 ? -m : 0, v.hi > 0 ? m : 0), &all, &jumps);
        }
    } else {
        add_signed(p, v, &all, &jumps);
    }
    out[0] = all.v;
    if (partial)
        partial[0] = jumps ? interval_whole()
                     : p->frequency != 0
                         ? interval_multiply(all.by, interval_point(p->frequency))
                         : all.by;
}

static const struct tape_extern finished = {
    .name = "wave", .arguments = 1, .width = 1, .bounds = finished_bounds};

uint32_t formula_finished(struct formula *f, const struct pattern *p, uint32_t v)
{
    uint32_t out;
    tape_call_extern(f->b, &finished, p, &v, &out);
    return out;
}

static void triangle_bounds(const void *data, const struct interval *in,
                            struct interval *out, struct interval *partial)
{
    (void)data;
    struct interval by;
    out[0] = triangle(in[0], &by);
    if (partial)
        partial[0] = by;
}

static const struct tape_extern triangle_extern = {
    .name = "triangle", .arguments = 1, .width = 1, .bounds = triangle_bounds};

uint32_t formula_triangle(struct formula *f, uint32_t v)
{
    uint32_t out;
    tape_call_extern(f->b, &triangle_extern, NULL, &v, &out);
    return out;
}

// ---- colours ----------------------------------------------------------------------------

static float channel(const struct rgbft *c, int i)
{
    return i == 0   ? c->r
           : i == 1 ? c->g
           : i == 2 ? c->b
           : i == 3 ? c->filter
                    : c->transmit;
}

static bool ascends(const struct color_map *m)
{
    for (uint32_t i = 1; i < m->count; i++)
        if (!(m->key[i] >= m->key[i - 1]))
            return false;
    return true;
}

// Where a value is in a map: between the entries a and b.
struct map_place {
    uint32_t a, b;
    double f;
};

static struct map_place place_of(const struct color_map *m, double v)
{
    struct map_place p;
    map_find(m->key, m->count, v, &p.a, &p.b, &p.f);
    return p;
}

static double channel_at(const struct color_map *m, int c, const struct map_place *p)
{
    const double from = channel(&m->color[p->a], c), to = channel(&m->color[p->b], c);
    return p->a == p->b || from == to ? to : from + p->f * (to - from);
}

// Whether two channels are the same in all entries.
static bool are_same(const struct color_map *m, int c, int other)
{
    for (uint32_t i = 0; i < m->count; i++)
        if (channel(&m->color[i], c) != channel(&m->color[i], other))
            return false;
    return true;
}

// What blends of the entries a..last are rounded by.
static double blend_slack(const struct color_map *m, int c, uint32_t a, uint32_t last)
{
    double most = 0;
    for (uint32_t i = a + 1; i <= last; i++) {
        const double from = channel(&m->color[i - 1], c), to = channel(&m->color[i], c);
        if (from != to)
            most = fmax(most, 2 * fabs(to - from) + fmax(fabs(from), fabs(to)));
    }
    return SINGLE_ROUNDING * most;
}

static struct interval joined(struct interval all, struct interval one, bool *any)
{
    const struct interval r = *any ? interval_hull(all, one) : one;
    *any = true;
    return r;
}

// Slopes of a channel where the value is in v, the entries a..last around it.
static struct interval channel_slopes(const struct color_map *m, int c, struct interval v,
                                      uint32_t a, uint32_t last)
{
    struct interval d = interval_point(0);
    bool any = m->key[0] >= v.lo || m->key[m->count - 1] <= v.hi; // level beyond
    for (uint32_t i = a + 1; i <= last; i++) {
        const double from = channel(&m->color[i - 1], c), to = channel(&m->color[i], c);
        const double width = (double)m->key[i] - m->key[i - 1];
        if (from == to)
            d = joined(d, interval_point(0), &any);
        else if (width > 0)
            d = joined(d, interval_point((to - from) / width), &any);
        else
            return interval_whole();
    }
    return interval_widened(d.lo, d.hi, 4 * DBL_EPSILON);
}

static void colors_bounds(const void *data, const struct interval *in,
                          struct interval *out, struct interval *partial)
{
    const struct color_map *m = data;
    const struct interval v = in[0];
    const bool known = ascends(m);
    uint32_t a = 0, last = m->count - 1;
    struct map_place low, high;
    if (known) {
        low = place_of(m, v.lo);
        high = place_of(m, v.hi);
        a = low.a, last = high.b;
        for (; a > 0 && m->key[a] >= v.lo; a--)
            ;
        for (; last + 1 < m->count && m->key[last] <= v.hi; last++)
            ;
    }
    for (int c = 0; c < 5; c++) {
        if (c > 0 && are_same(m, c, c - 1)) { // greys, or nothing passes
            out[c] = out[c - 1];
            if (partial)
                partial[c] = partial[c - 1];
            continue;
        }
        struct interval r = interval_point(channel(&m->color[0], c));
        if (known) {
            const double x = channel_at(m, c, &low), y = channel_at(m, c, &high);
            r = interval(fmin(x, y), fmax(x, y));
        }
        for (uint32_t i = a; i <= last; i++)
            if (!known || (m->key[i] >= v.lo && m->key[i] <= v.hi))
                r = interval_hull(r, interval_point(channel(&m->color[i], c)));
        out[c] = around(r, blend_slack(m, c, a, last));
        if (partial)
            partial[c] = known ? channel_slopes(m, c, v, a, last) : interval_whole();
    }
}

static const struct tape_extern colors_extern = {.name = "colour_map",
                                                 .arguments = 1,
                                                 .width = 5,
                                                 .bounds = colors_bounds,
                                                 .anywhere = true};

void formula_colors(struct formula *f, const struct color_map *m, uint32_t v,
                    uint32_t out[5])
{
    tape_call_extern(f->b, &colors_extern, m, &v, out);
}

static void single_bounds(const void *data, const struct interval *in,
                          struct interval *out, struct interval *partial)
{
    out[0] = around(in[0], *(const double *)data);
    if (partial)
        partial[0] = interval_point(1);
}

static const struct tape_extern single = {
    .name = "single", .arguments = 1, .width = 1, .bounds = single_bounds};

uint32_t formula_single(struct formula *f, double size, uint32_t v)
{
    double *slack = arena_new_struct(f->arena, double);
    uint32_t out;
    *slack = SINGLE_ROUNDING * size;
    tape_call_extern(f->b, &single, slack, &v, &out);
    return out;
}
