// Weights of eight samples at a time, compiled once per instruction set. Each expression is
// that of cache_weight, in the same order: the bits are the same.
#include "irradiance/store_kernel.h"

#include <float.h>

#include "math/isa.h"
#include "math/lanes.h"
#include "math/lanes_vec.h"

static unsigned hashes_of(const struct store *s, const int32_t place[3], int size,
                          uint32_t depth, uint32_t count, uint32_t hash[STORE_SIZES])
{
    unsigned pass = 0;
    for (int i = 0; i < STORE_SIZES; i++) {
        const int32_t larger[3] = {place[0] >> i, place[1] >> i, place[2] >> i};
        hash[i] = cache_cell_hash(larger, size + i, depth);
    }
    for (uint32_t i = 0; i < count; i++)
        pass |= (unsigned)filter_passes(s, hash[i]) << i;
    return pass;
}

// What is asked for, in every lane.
struct asked {
    struct vec8 p, n;
    struct real8 bound, bound2, per_bound;
    bool smooth;
};

static void rows_of(const struct cache_sample *sample, const uint32_t *k, uint32_t count,
                    const double *row[8])
{
    for (uint32_t i = 0; i < 8; i++)
        row[i] = sample[k[i < count ? i : 0]].row;
}

// Which samples are not too far to count, and which of them are not turned too much.
LANES_INLINE struct mask8 near_enough(const struct asked *a, const struct real8 r[4])
{
    const struct vec8 d = v8_sub(a->p, (struct vec8){r[0], r[1], r[2]});
    const struct real8 limit = r8_mul(r[3], a->bound);
    return r8_lt(v8_dot(d, d), r8_mul(limit, limit));
}

LANES_INLINE struct mask8 even_enough(const struct asked *a, const struct real8 q[4])
{
    const struct real8 turned =
        r8_abs(r8_sub(r8_set(1), v8_dot(a->n, (struct vec8){q[0], q[1], q[2]})));
    return r8_lt(r8_mul(r8_set(4), turned), a->bound2);
}

LANES_INLINE struct real8 falloff8(struct real8 error, const struct asked *a)
{
    const struct real8 one = r8_set(1), half = r8_set(0.5), two = r8_set(2);
    const struct real8 x = r8_mul(error, a->per_bound);
    if (!a->smooth)
        return r8_sub(one, x);
    const struct mask8 low = r8_lt(x, half);
    const struct real8 y = r8_select(low, r8_mul(two, x), r8_mul(two, r8_sub(one, x)));
    const struct real8 part = r8_mul(r8_mul(y, y), half);
    return r8_select(low, r8_sub(one, part), part);
}

// What of the weight of lanes is left that lie behind the sample; they stay on unless they lie
// too far behind.
LANES_INLINE struct real8 behind8(struct real8 ahead, struct real8 distance,
                                  struct vec8 middle, struct mask8 *on)
{
    const struct real8 least = r8_set(cache_behind);
    const struct real8 length = r8_sqrt(v8_dot(middle, middle));
    const struct real8 front = r8_div(ahead, r8_mul(distance, length));
    *on = m8_and(*on, r8_lt(least, front));
    return r8_sub(r8_set(1), r8_div(front, least));
}

// cache_weight of the samples whose rows are r, q and s.
LANES_INLINE struct real8 weights(const struct asked *a, const struct real8 r[4],
                                  const struct real8 q[4], const struct real8 s[4])
{
    const struct real8 nought = r8_set(0), one = r8_set(1), two = r8_set(2);
    const struct vec8 n = {q[0], q[1], q[2]}, to = {s[0], s[1], s[2]};
    const struct vec8 d = v8_sub(a->p, (struct vec8){r[0], r[1], r[2]});
    const struct real8 turned = r8_abs(r8_sub(one, v8_dot(a->n, n)));
    struct mask8 on = r8_lt(r8_mul(r8_set(4), turned), a->bound2);
    const struct real8 distance = r8_sqrt(v8_dot(d, d));
    on = m8_and(on, r8_lt(distance, r8_mul(r[3], a->bound)));
    const struct mask8 apart = r8_lt(r8_set(cache_same_place), distance);
    const struct real8 nearing = r8_mul(v8_dot(to, d), r8_div(one, distance));
    const struct real8 nearer =
        r8_add(r8_mul(nearing, q[3]), r8_mul(r8_sub(one, nearing), r[3]));
    const struct real8 radius =
        r8_select(m8_and(apart, r8_lt(nought, nearing)), nearer, r[3]);
    on = m8_and(on, r8_lt(distance, r8_mul(radius, a->bound)));
    const struct real8 error =
        r8_add(r8_div(distance, radius), r8_mul(two, r8_sqrt(turned)));
    on = m8_and(on, r8_lt(error, a->bound));
    const struct vec8 middle = {r8_add(a->n.x, n.x), r8_add(a->n.y, n.y),
                                r8_add(a->n.z, n.z)};
    const struct real8 ahead = v8_dot(d, middle);
    const struct mask8 behind = m8_and(m8_and(on, apart), r8_lt(ahead, nought));
    struct real8 weight = falloff8(error, a);
    if (m8_bits(behind)) {
        struct mask8 still = behind;
        const struct real8 left = behind8(ahead, distance, middle, &still);
        on = m8_of((m8_bits(on) & ~m8_bits(behind)) | m8_bits(still));
        weight = r8_select(behind, r8_mul(weight, left), weight);
    }
    on = m8_and(on, r8_lt(r8_set(cache_least_weight), weight));
    return r8_select(on, r8_mul(weight, s[3]), nought);
}

// Adds at most eight samples in their order; false: that is enough.
static bool add(const struct cache_sample *sample, const uint32_t *k, uint32_t count,
                const struct asked *a, double enough, struct cache_mean *mean)
{
    const double *row[8];
    double weight[8];
    struct real8 r[4], q[4], x[4];
    rows_of(sample, k, count, row);
    r8_load_rows(row, 0, r);
    r8_load_rows(row, 4, q);
    r8_load_rows(row, 8, x);
    r8_store(weight, weights(a, r, q, x));
    for (uint32_t i = 0; i < count; i++) {
        const double w = weight[i];
        const struct rgb *light = &sample[k[i]].light;
        if (!(w > 0))
            continue;
        mean->weight += w;
        mean->light[0] += w * (double)light->r;
        mean->light[1] += w * (double)light->g;
        mean->light[2] += w * (double)light->b;
        if (mean->weight >= enough)
            return false;
    }
    return true;
}

// What most samples fail already in floats, with room for what these lose.
struct glance {
    struct float8 p[3], n[3], bound, slack, turned;
};

static const float glance_rounding = 0x1p-20f;

LANES_INLINE struct glance glance_of(const struct cache_point *at)
{
    const double p[3] = {at->p.x, at->p.y, at->p.z}, n[3] = {at->n.x, at->n.y, at->n.z};
    const float bound = (float)at->error_bound;
    float slack = FLT_MIN;
    struct glance g = {.bound = f8_set(bound * (1 + glance_rounding)),
                       .turned = f8_set(bound * bound / 4 + 4 * glance_rounding)};
    for (int a = 0; a < 3; a++) {
        g.p[a] = f8_set((float)p[a]);
        g.n[a] = f8_set((float)n[a]);
        slack += glance_rounding * fabsf((float)p[a]);
    }
    g.slack = f8_set(slack);
    return g;
}

// Which of eight samples may count.
LANES_INLINE unsigned glance_at(const struct glance *g, const float *const spot[8])
{
    struct float8 r[4], n[4];
    f8_gather_rows(spot, 0, r);
    const struct float8 x = f8_sub(g->p[0], r[0]), y = f8_sub(g->p[1], r[1]),
                        z = f8_sub(g->p[2], r[2]);
    const struct float8 d2 = f8_add(f8_add(f8_mul(x, x), f8_mul(y, y)), f8_mul(z, z));
    const struct float8 limit = f8_add(f8_mul(r[3], g->bound), g->slack);
    const unsigned near = f8_le(d2, f8_add(f8_mul(limit, limit), f8_set(FLT_MIN)));
    if (!near)
        return 0;
    f8_gather_rows(spot, 4, n);
    const struct float8 cosine = f8_add(
        f8_add(f8_mul(g->n[0], n[0]), f8_mul(g->n[1], n[1])), f8_mul(g->n[2], n[2]));
    return near & f8_le(f8_sub(f8_set(1), g->turned), cosine);
}

// What is known of a query on its way through the samples.
struct scan {
    const struct store *s;
    const struct cache_point *at;
    struct cache_mean *mean;
    struct asked asked;
    struct glance glance;
    uint32_t some[16], waiting; // those that may count, not added yet
};

// Looks at samples in their order, and adds those that may count as soon as they are eight.
LANES_INLINE bool look(struct scan *scan, const uint32_t *listed, uint32_t count)
{
    const struct store *s = scan->s;
    for (uint32_t begin = 0; begin < count; begin += 8) {
        const float *spot[8];
        const uint32_t *k = listed + begin, n = count - begin < 8 ? count - begin : 8;
        for (uint32_t i = 0; i < 8; i++)
            spot[i] = s->spot[k[i < n ? i : 0]].p;
        unsigned good = glance_at(&scan->glance, spot) & ((1u << n) - 1);
        for (; good; good &= good - 1) {
            const uint32_t sample = k[__builtin_ctz(good)];
            const char *lines = (const char *)&s->sample[sample];
            __builtin_prefetch(lines);
            __builtin_prefetch(lines + 64);
            scan->some[scan->waiting++] = sample;
        }
        if (scan->waiting < 8)
            continue;
        if (!add(s->sample, scan->some, 8, &scan->asked, scan->at->enough, scan->mean))
            return false;
        scan->waiting -= 8;
        for (uint32_t i = 0; i < scan->waiting; i++)
            scan->some[i] = scan->some[8 + i];
    }
    return true;
}

// Samples of a cell next to each other whose normals may count, from the last on.
struct sides_run {
    int side; // the one before which it begins
    uint32_t begin, end;
};

static inline bool next_run(const uint32_t ends[CACHE_SIDES], unsigned sides,
                            struct sides_run *r)
{
    while (r->side > 0) {
        if (!(sides >> --r->side & 1))
            continue;
        r->end = ends[r->side];
        while (r->side > 0 && sides >> (r->side - 1) & 1)
            r->side--;
        r->begin = r->side ? ends[r->side - 1] : 0;
        if (r->begin < r->end)
            return true;
    }
    return false;
}

static bool mean_of(const struct store *s, const struct cache_cell *const *cell,
                    uint32_t count, const struct cache_point *at, struct cache_mean *mean)
{
    enum { LISTED = 64 };
    const double bound = at->error_bound;
    const unsigned sides = cache_sides(at->n, bound);
    struct scan scan;
    scan.s = s;
    scan.at = at;
    scan.mean = mean;
    scan.asked = (struct asked){V8_SET(at->p),         V8_SET(at->n),     r8_set(bound),
                                r8_set(bound * bound), r8_set(1 / bound), at->smooth};
    scan.glance = glance_of(at);
    scan.waiting = 0;
    uint32_t listed[LISTED], n = 0;
    for (uint32_t c = 0; c < count; c++) {
        struct sides_run run = {.side = CACHE_SIDES};
        while (next_run(cell_ends(s, cell[c]), sides, &run)) {
            for (uint32_t i = run.end; i-- > run.begin;) {
                listed[n++] = s->filed[cell[c]->first + i];
                __builtin_prefetch(&s->spot[listed[n - 1]]);
                if (n < LISTED)
                    continue;
                if (!look(&scan, listed, n))
                    return false;
                n = 0;
            }
        }
    }
    return look(&scan, listed, n) &&
           (!scan.waiting ||
            add(s->sample, scan.some, scan.waiting, &scan.asked, at->enough, mean));
}

LANES_INLINE void set_row(const double *row, struct real8 r[4])
{
    for (int i = 0; i < 4; i++)
        r[i] = r8_set(row[i]);
}

// cache_sides of some lanes together; all sides where a cell lists too few to spare any.
LANES_INLINE unsigned sides_of(const struct cache_cell *cell, const struct asked *a,
                               unsigned lanes)
{
    enum { FEW = 16, ALL = (1 << CACHE_SIDES) - 1 };
    if (cell->count < FEW)
        return ALL;
    const struct real8 room = r8_sqrt(r8_add(a->bound2, r8_set(cache_not_unit)));
    const struct real8 n[3] = {a->n.x, a->n.y, a->n.z};
    unsigned sides = 0;
    for (int k = 0; k < 3; k++) {
        const struct real8 others =
            r8_max(r8_abs(n[(k + 1) % 3]), r8_abs(n[(k + 2) % 3]));
        const struct real8 least = r8_sub(others, room);
        sides |= (m8_bits(r8_le(least, n[k])) & lanes ? 1u : 0) << 2 * k;
        sides |= (m8_bits(r8_le(least, r8_neg(n[k]))) & lanes ? 2u : 0) << 2 * k;
    }
    return sides;
}

static unsigned means_of(const struct store *s, const struct cache_cell *cell,
                         const struct cache_points *at, unsigned lanes,
                         struct cache_means *mean)
{
    const struct real8 bound = r8_load(at->error_bound), nought = r8_set(0);
    const struct asked a = {v8_load(at->p),       v8_load(at->n),           bound,
                            r8_mul(bound, bound), r8_div(r8_set(1), bound), at->smooth};
    const unsigned sides = sides_of(cell, &a, lanes);
    const bool ends = at->enough < INFINITY;
    const uint32_t *filed = s->filed + cell->first;
    const struct cache_sample *sample = s->sample;
    struct real8 weight = r8_load(mean->weight);
    struct vec8 light = v8_load((const double(*)[8])mean->light);
    struct sides_run run = {.side = CACHE_SIDES};
    while (lanes && next_run(cell_ends(s, cell), sides, &run)) {
        for (uint32_t i = run.end; lanes && i-- > run.begin;) {
            const struct cache_sample *x = &sample[filed[i]];
            struct real8 r[4], q[4], rest[4];
            set_row(x->row, r);
            const unsigned near = m8_bits(near_enough(&a, r)) & lanes;
            if (!near)
                continue;
            set_row(x->row + 4, q);
            if (!(m8_bits(even_enough(&a, q)) & near))
                continue;
            set_row(x->row + 8, rest);
            const struct real8 w = weights(&a, r, q, rest);
            const struct mask8 on = m8_and(m8_of(lanes), r8_lt(nought, w));
            const struct real8 c[3] = {r8_set((double)x->light.r),
                                       r8_set((double)x->light.g),
                                       r8_set((double)x->light.b)};
            weight = r8_select(on, r8_add(weight, w), weight);
            light.x = r8_select(on, r8_add(light.x, r8_mul(w, c[0])), light.x);
            light.y = r8_select(on, r8_add(light.y, r8_mul(w, c[1])), light.y);
            light.z = r8_select(on, r8_add(light.z, r8_mul(w, c[2])), light.z);
            if (ends)
                lanes &= m8_bits(r8_lt(weight, r8_set(at->enough)));
        }
    }
    r8_store(mean->weight, weight);
    r8_store(mean->light[0], light.x);
    r8_store(mean->light[1], light.y);
    r8_store(mean->light[2], light.z);
    return lanes;
}

const struct store_kernels OF_ISA(store_kernels_) = {ISA_TEXT, hashes_of, mean_of,
                                                     means_of};
