// Bounds of the noise over eight boxes (noise_bounds.c says how), compiled once per
// instruction set: ISA names it.
#include <stdint.h>

#include "math/interval.h"
#include "math/isa.h"
#include "math/lanes.h"
#include "scene/noise.h"
#include "scene/noise_kernel.h"
#include "scene/noise_tables.h"

struct range8 {
    struct real8 lo, hi;
};

// The parts of eight boxes in one cell of the lattice each. Corner c is at the far side of
// axis i where bit i of c is set; its function is k + slope . place.
struct cell8 {
    struct real8 k[8], slope[8][3];
    struct range8 at[3], step[3];
};

LANES_INLINE unsigned cell_of(double whole)
{
    return (unsigned)((int64_t)whole + 10000) & 4095;
}

LANES_INLINE void load_corners(const double cell[3][8], struct cell8 *out)
{
    const double *row[8][8];
    for (int l = 0; l < 8; l++) {
        const unsigned x = cell_of(cell[0][l]), y = cell_of(cell[1][l]),
                       z = cell_of(cell[2][l]);
        for (unsigned c = 0; c < 4; c++) {
            const unsigned h = noise_hash_table[x + (c & 1)];
            const unsigned xy = noise_hash_table[h ^ (y + (c >> 1))];
            row[c][l] = noise_value_table + (noise_hash_table[xy ^ z] & 255);
            row[c + 4][l] = noise_value_table + (noise_hash_table[xy ^ (z + 1)] & 255);
        }
    }
    for (int c = 0; c < 8; c++) {
        struct real8 t[4];
        r8_load_rows(row[c], 0, t);
        struct real8 k = r8_mul(r8_set(0.5), t[0]);
        for (int i = 0; i < 3; i++) {
            out->slope[c][i] = t[i + 1];
            if (c >> i & 1)
                k = r8_sub(k, t[i + 1]);
        }
        out->k[c] = k;
    }
}

LANES_INLINE struct range8 plus_product(struct range8 v, struct real8 slope,
                                        struct range8 at)
{
    const struct real8 p = r8_mul(slope, at.lo), q = r8_mul(slope, at.hi);
    return (struct range8){r8_add(v.lo, r8_min(p, q)), r8_add(v.hi, r8_max(p, q))};
}

LANES_INLINE struct real8 between(struct real8 s, struct real8 a, struct real8 b)
{
    return r8_add(a, r8_mul(s, r8_sub(b, a)));
}

LANES_INLINE struct range8 blend(struct range8 s, struct range8 a, struct range8 b)
{
    return (struct range8){r8_min(between(s.lo, a.lo, b.lo), between(s.hi, a.lo, b.lo)),
                           r8_max(between(s.lo, a.hi, b.hi), between(s.hi, a.hi, b.hi))};
}

LANES_INLINE struct real8 smooth(struct real8 u)
{
    return r8_mul(r8_mul(u, u), r8_sub(r8_set(3), r8_mul(r8_set(2), u)));
}

LANES_INLINE struct range8 value_in(const struct cell8 *l)
{
    struct range8 v[8];
#pragma GCC unroll 8
    for (int c = 0; c < 8; c++) {
        v[c] = (struct range8){l->k[c], l->k[c]};
        for (int i = 0; i < 3; i++)
            v[c] = plus_product(v[c], l->slope[c][i], l->at[i]);
    }
    for (int c = 0; c < 8; c += 2)
        v[c] = blend(l->step[0], v[c], v[c + 1]);
    v[0] = blend(l->step[1], v[0], v[2]);
    v[4] = blend(l->step[1], v[4], v[6]);
    return blend(l->step[2], v[0], v[4]);
}

LANES_INLINE struct real8 value_at(const struct cell8 *l, const struct real8 at[3])
{
    struct real8 v[8];
#pragma GCC unroll 8
    for (int c = 0; c < 8; c++) {
        v[c] = l->k[c];
        for (int i = 0; i < 3; i++)
            v[c] = r8_add(v[c], r8_mul(l->slope[c][i], at[i]));
    }
    const struct real8 x = smooth(at[0]), y = smooth(at[1]), z = smooth(at[2]);
    for (int c = 0; c < 8; c += 2)
        v[c] = between(x, v[c], v[c + 1]);
    return between(z, between(y, v[0], v[2]), between(y, v[4], v[6]));
}

// The rise of the step times the difference of the two sides of axis k, and the blend of
// the corners' own slopes.
LANES_INLINE struct range8 slope_in(const struct cell8 *l, int k)
{
    const int j = (k + 1) % 3, m = (k + 2) % 3;
    struct range8 rise[4], own[4];
#pragma GCC unroll 4
    for (int n = 0; n < 4; n++) {
        const int c = (n & 1) << j | (n >> 1) << m, far = c | 1 << k;
        const struct real8 d = r8_sub(l->k[far], l->k[c]);
        rise[n] = (struct range8){d, d};
        for (int i = 0; i < 3; i++)
            rise[n] =
                plus_product(rise[n], r8_sub(l->slope[far][i], l->slope[c][i]), l->at[i]);
        const struct real8 a = l->slope[c][k], b = l->slope[far][k];
        own[n] = blend(l->step[k], (struct range8){a, a}, (struct range8){b, b});
    }
    const struct range8 r = blend(l->step[m], blend(l->step[j], rise[0], rise[1]),
                                  blend(l->step[j], rise[2], rise[3]));
    const struct range8 o = blend(l->step[m], blend(l->step[j], own[0], own[1]),
                                  blend(l->step[j], own[2], own[3]));
    // 6 u (1 - u) has its top at one half.
    const struct real8 six = r8_set(6), one = r8_set(1), half = r8_set(0.5);
    const struct range8 u = l->at[k];
    const struct real8 p = r8_mul(r8_mul(six, u.lo), r8_sub(one, u.lo));
    const struct real8 q = r8_mul(r8_mul(six, u.hi), r8_sub(one, u.hi));
    const struct mask8 top = m8_and(r8_le(u.lo, half), r8_le(half, u.hi));
    const struct real8 low = r8_min(p, q),
                       high = r8_select(top, r8_set(1.5), r8_max(p, q));
    const struct real8 a = r8_mul(low, r.lo), b = r8_mul(high, r.lo);
    const struct real8 c = r8_mul(low, r.hi), d = r8_mul(high, r.hi);
    return (struct range8){r8_add(r8_min(a, b), o.lo), r8_add(r8_max(c, d), o.hi)};
}

LANES_INLINE struct real8 to_unit(struct real8 v)
{
    return r8_min(r8_max(v, r8_set(0)), r8_set(1));
}

LANES_INLINE void cell_bounds(const struct range8 box[3], const double cell[3][8],
                              struct range8 *v, struct range8 slope[3])
{
    struct cell8 l;
    struct real8 middle[3], off = r8_set(0);
    load_corners(cell, &l);
    for (int i = 0; i < 3; i++) {
        const struct real8 c = r8_load(cell[i]);
        l.at[i] =
            (struct range8){to_unit(r8_sub(box[i].lo, c)), to_unit(r8_sub(box[i].hi, c))};
        l.step[i] = (struct range8){smooth(l.at[i].lo), smooth(l.at[i].hi)};
        middle[i] = r8_mul(r8_set(0.5), r8_add(l.at[i].lo, l.at[i].hi));
    }
#pragma GCC unroll 3
    for (int i = 0; i < 3; i++) {
        slope[i] = slope_in(&l, i);
        const struct real8 size = r8_max(r8_abs(slope[i].lo), r8_abs(slope[i].hi));
        off = r8_add(off,
                     r8_mul(size, r8_mul(r8_set(0.5), r8_sub(l.at[i].hi, l.at[i].lo))));
    }
    const struct range8 all = value_in(&l);
    const struct real8 mean = value_at(&l, middle);
    v->lo = r8_max(all.lo, r8_sub(mean, off));
    v->hi = r8_min(all.hi, r8_add(mean, off));
}

LANES_INLINE void join(struct mask8 m, struct range8 *to, struct range8 v)
{
    to->lo = r8_select(m, r8_min(to->lo, v.lo), to->lo);
    to->hi = r8_select(m, r8_max(to->hi, v.hi), to->hi);
}

// How many cells the largest box has along an axis, of those that are asked.
LANES_INLINE int most_cells(struct mask8 asked, struct real8 more)
{
    const unsigned lanes = m8_bits(asked);
    int n = 1;
    while (n < NOISE_BOUNDS_ACROSS && (m8_bits(r8_le(r8_set(n), more)) & lanes))
        n++;
    return n;
}

// Boxes of few cells; returns which they are.
static struct mask8 small_boxes(const struct range8 box[3], struct range8 *v,
                                struct range8 slope[3])
{
    struct real8 first[3], more[3], cells = r8_set(1);
    struct mask8 small = m8_of(255);
    const struct range8 nothing = {r8_set(INFINITY), r8_set(-INFINITY)};
    int count[3];
    for (int i = 0; i < 3; i++) {
        first[i] = r8_floor(box[i].lo);
        more[i] = r8_sub(r8_floor(box[i].hi), first[i]);
        cells = r8_mul(cells, r8_add(more[i], r8_set(1)));
        small = m8_and(small, r8_lt(more[i], r8_set(NOISE_BOUNDS_ACROSS)));
        small = m8_and(
            small, r8_lt(r8_max(r8_abs(box[i].lo), r8_abs(box[i].hi)), r8_set(0x1p40)));
        slope[i] = nothing;
    }
    small = m8_and(small, r8_le(cells, r8_set(NOISE_BOUNDS_CELLS)));
    for (int i = 0; i < 3; i++)
        count[i] = most_cells(small, more[i]);
    *v = nothing;
    for (int c = 0; c < count[0] * count[1] * count[2]; c++) {
        const int at[3] = {c % count[0], c / count[0] % count[1],
                           c / count[0] / count[1]};
        struct mask8 here = small;
        double cell[3][8];
        for (int i = 0; i < 3; i++) {
            here = m8_and(here, r8_le(r8_set(at[i]), more[i]));
            r8_store(cell[i],
                     r8_select(small, r8_add(first[i], r8_set(at[i])), r8_set(0)));
        }
        if (!m8_bits(here))
            continue;
        struct range8 w, s[3];
        cell_bounds(box, (const double(*)[8])cell, &w, s);
        join(here, v, w);
        for (int i = 0; i < 3; i++)
            join(here, &slope[i], s[i]);
    }
    return small;
}

static void one_box(const double lo[3][8], const double hi[3][8], int generator, int lane,
                    struct noise_bounds8 *out)
{
    struct interval box[3], v, slope[3];
    for (int i = 0; i < 3; i++)
        box[i] = interval(lo[i][lane], hi[i][lane]);
    noise_bounds(box, generator, &v, slope);
    out->lo[lane] = v.lo;
    out->hi[lane] = v.hi;
    for (int i = 0; i < 3; i++) {
        out->slope_lo[i][lane] = slope[i].lo;
        out->slope_hi[i][lane] = slope[i].hi;
    }
}

void OF_ISA(noise_bounds_)(const double lo[3][8], const double hi[3][8], int generator,
                           struct noise_bounds8 *out)
{
    if (generator == NOISE_PERLIN) {
        for (int lane = 0; lane < 8; lane++)
            one_box(lo, hi, generator, lane, out);
        return;
    }
    struct range8 box[3], v, slope[3];
    for (int i = 0; i < 3; i++)
        box[i] = (struct range8){r8_load(lo[i]), r8_load(hi[i])};
    const struct mask8 small = small_boxes(box, &v, slope);
    const struct noise_range range = noise_range_of(generator);
    const struct real8 scale = r8_set(range.scale), add = r8_set(range.add);
    const struct real8 slack = r8_set(NOISE_VALUE_SLACK), zero = r8_set(0),
                       one = r8_set(1);
    v.lo = r8_sub(r8_add(r8_mul(v.lo, scale), add), slack);
    v.hi = r8_add(r8_add(r8_mul(v.hi, scale), add), slack);
    const struct mask8 cut = m8_or(r8_lt(v.lo, zero), r8_lt(one, v.hi));
    const struct real8 slope_slack = r8_set(NOISE_SLOPE_SLACK),
                       most = r8_set(noise_slope_max(generator)), least = r8_neg(most);
    for (int i = 0; i < 3; i++) {
        const struct real8 low =
            r8_max(r8_sub(r8_mul(slope[i].lo, scale), slope_slack), least);
        const struct real8 high =
            r8_min(r8_add(r8_mul(slope[i].hi, scale), slope_slack), most);
        r8_store(out->slope_lo[i],
                 r8_select(small, r8_select(cut, r8_min(low, zero), low), least));
        r8_store(out->slope_hi[i],
                 r8_select(small, r8_select(cut, r8_max(high, zero), high), most));
    }
    r8_store(out->lo, r8_select(small, to_unit(v.lo), zero));
    r8_store(out->hi, r8_select(small, to_unit(v.hi), one));
}
