// Bounds of the scalar noise over a box (noise.h). In one lattice cell the noise is a blend
// of eight linear functions, one of each corner, with the smooth step of each coordinate
// as weights; its partial derivatives follow, and the mean value form makes the bounds of
// a small box tight to second order.
#include <stdint.h>

#include "math/interval.h"
#include "scene/noise.h"
#include "scene/noise_tables.h"

struct corners {
    double k[2][2][2], slope[2][2][2][3];
};

static double smooth(double u) { return u * u * (3 - 2 * u); }

static unsigned cell_of(double whole)
{
    return (unsigned)((int64_t)whole + 10000) & 4095;
}

static struct corners value_corners(const double cell[3])
{
    struct corners c;
    const unsigned x = cell_of(cell[0]), y = cell_of(cell[1]), z = cell_of(cell[2]);
    for (unsigned i = 0; i < 8; i++) {
        const unsigned a = i & 1, b = i >> 1 & 1, d = i >> 2;
        const unsigned h = noise_hash_table[noise_hash_table[x + a] ^ (y + b)];
        const double *t = noise_value_table + (noise_hash_table[h ^ (z + d)] & 255);
        c.k[a][b][d] = 0.5 * t[0];
        for (int k = 0; k < 3; k++)
            c.slope[a][b][d][k] = t[k + 1];
    }
    return c;
}

static struct corners gradient_corners(const double cell[3])
{
    struct corners c;
    unsigned at[3][2];
    for (int k = 0; k < 3; k++)
        for (unsigned i = 0; i < 2; i++)
            at[k][i] = ((unsigned)(int64_t)cell[k] + i) & (NOISE_GRADIENT_PERIOD - 1);
    for (unsigned i = 0; i < 8; i++) {
        const unsigned a = i & 1, b = i >> 1 & 1, d = i >> 2;
        const uint16_t *q = noise_permutation;
        const double *g = noise_gradient[q[q[at[0][a]] + at[1][b]] + at[2][d]];
        c.k[a][b][d] = 0;
        for (int k = 0; k < 3; k++)
            c.slope[a][b][d][k] = g[k];
    }
    return c;
}

// k + sum of slope * (place - corner), the place in the unit cell.
static struct interval linear(double k, const double slope[3], const struct interval *at,
                              unsigned a, unsigned b, unsigned d)
{
    const double corner[3] = {a, b, d};
    struct interval v = interval_point(k);
    for (int i = 0; i < 3; i++) {
        const double p = slope[i] * (at[i].lo - corner[i]),
                     q = slope[i] * (at[i].hi - corner[i]);
        v.lo += p < q ? p : q;
        v.hi += p < q ? q : p;
    }
    return v;
}

static double between(double s, double a, double b) { return a + s * (b - a); }

// a + s (b - a) for s anywhere in its interval.
static struct interval blend(struct interval s, struct interval a, struct interval b)
{
    const double p = between(s.lo, a.lo, b.lo), q = between(s.hi, a.lo, b.lo);
    const double r = between(s.lo, a.hi, b.hi), t = between(s.hi, a.hi, b.hi);
    return interval(p < q ? p : q, r > t ? r : t);
}

struct cell {
    struct corners c;
    struct interval at[3], s[3];
};

static struct interval value_in(const struct cell *l)
{
    struct interval z[2];
    for (unsigned d = 0; d < 2; d++) {
        struct interval y[2];
        for (unsigned b = 0; b < 2; b++)
            y[b] = blend(l->s[0],
                         linear(l->c.k[0][b][d], l->c.slope[0][b][d], l->at, 0, b, d),
                         linear(l->c.k[1][b][d], l->c.slope[1][b][d], l->at, 1, b, d));
        z[d] = blend(l->s[1], y[0], y[1]);
    }
    return blend(l->s[2], z[0], z[1]);
}

// Seen along axis k: [side of k][side of the next axis][side of the one after].
static void turned(const struct cell *l, int k, unsigned a, unsigned b, unsigned d,
                   double *constant, double slope[3])
{
    unsigned i[3];
    i[k] = a;
    i[(k + 1) % 3] = b;
    i[(k + 2) % 3] = d;
    *constant = l->c.k[i[0]][i[1]][i[2]];
    for (int n = 0; n < 3; n++) {
        slope[n] = l->c.slope[i[0]][i[1]][i[2]][n];
        *constant -= slope[n] * i[n];
    }
}

// What lies between the two sides of axis k: the rise of the step times the difference of
// the sides, and the blend of the corners' own slopes.
static struct interval slope_in(const struct cell *l, int k)
{
    struct interval rise[2], own[2];
    for (unsigned d = 0; d < 2; d++) {
        struct interval r[2], o[2];
        for (unsigned b = 0; b < 2; b++) {
            double k0, k1, s0[3], s1[3], difference[3];
            turned(l, k, 0, b, d, &k0, s0);
            turned(l, k, 1, b, d, &k1, s1);
            for (int n = 0; n < 3; n++)
                difference[n] = s1[n] - s0[n];
            r[b] = linear(k1 - k0, difference, l->at, 0, 0, 0);
            o[b] = blend(l->s[k], interval_point(s0[k]), interval_point(s1[k]));
        }
        rise[d] = blend(l->s[(k + 1) % 3], r[0], r[1]);
        own[d] = blend(l->s[(k + 1) % 3], o[0], o[1]);
    }
    const struct interval u = l->at[k];
    // 6 u (1 - u) has its top at one half.
    const double p = 6 * u.lo * (1 - u.lo), q = 6 * u.hi * (1 - u.hi);
    const struct interval step = interval(p < q ? p : q, interval_has(u, 0.5) ? 1.5
                                                         : p > q              ? p
                                                                              : q);
    const int last = (k + 2) % 3;
    return interval_add(interval_multiply(step, blend(l->s[last], rise[0], rise[1])),
                        blend(l->s[last], own[0], own[1]));
}

static void set_place(struct cell *l, int k, double lo, double hi)
{
    l->at[k] = interval(lo, hi);
    l->s[k] = interval(smooth(lo), smooth(hi));
}

// Of the blend over the part of the box in one cell, before scaling.
static void cell_bounds(const struct interval box[3], const double cell[3], bool gradient,
                        struct interval *v, struct interval slope[3])
{
    struct cell l = {.c = gradient ? gradient_corners(cell) : value_corners(cell)};
    for (int k = 0; k < 3; k++)
        set_place(&l, k, fmin(fmax(box[k].lo - cell[k], 0), 1),
                  fmin(fmax(box[k].hi - cell[k], 0), 1));
    struct interval off = interval_point(0);
    for (int k = 0; k < 3; k++) {
        slope[k] = slope_in(&l, k);
        const double half = 0.5 * interval_width(l.at[k]);
        off = interval_add(off, interval_multiply(slope[k], interval(-half, half)));
    }
    *v = value_in(&l);
    struct cell middle = l;
    for (int k = 0; k < 3; k++) {
        const double m = interval_middle(l.at[k]);
        set_place(&middle, k, m, m);
    }
    const struct interval mean = interval_add(value_in(&middle), off);
    *v = interval(fmax(v->lo, mean.lo), fmin(v->hi, mean.hi));
}

static void whole_range(int generator, struct interval *v, struct interval slope[3])
{
    const double most = noise_slope_max(generator);
    *v = interval(0, 1);
    for (int k = 0; k < 3; k++)
        slope[k] = interval(-most, most);
}

void noise_bounds(const struct interval box[3], int generator, struct interval *v,
                  struct interval slope[3])
{
    const bool gradient = generator == NOISE_PERLIN;
    struct interval at[3];
    double cells = 1;
    bool small = true;
    for (int k = 0; k < 3; k++) {
        at[k] = box[k];
        if (gradient)
            at[k] =
                interval(box[k].lo + 10000000.023157213, box[k].hi + 10000000.023157213);
        const double across = floor(at[k].hi) - floor(at[k].lo) + 1;
        cells *= across;
        small &= across <= NOISE_BOUNDS_ACROSS && interval_size(at[k]) < 0x1p40;
    }
    if (!small || cells > NOISE_BOUNDS_CELLS) {
        whole_range(generator, v, slope);
        return;
    }
    bool first = true;
    double c[3];
    for (c[0] = floor(at[0].lo); c[0] <= at[0].hi; c[0]++)
        for (c[1] = floor(at[1].lo); c[1] <= at[1].hi; c[1]++)
            for (c[2] = floor(at[2].lo); c[2] <= at[2].hi; c[2]++) {
                struct interval w, s[3];
                cell_bounds(at, c, gradient, &w, s);
                *v = first ? w : interval_hull(*v, w);
                for (int k = 0; k < 3; k++)
                    slope[k] = first ? s[k] : interval_hull(slope[k], s[k]);
                first = false;
            }
    const struct noise_range range = noise_range_of(generator);
    *v = interval(v->lo * range.scale + range.add - NOISE_VALUE_SLACK,
                  v->hi * range.scale + range.add + NOISE_VALUE_SLACK);
    const bool cut = v->lo < 0 || v->hi > 1;
    const double most = noise_slope_max(generator);
    for (int k = 0; k < 3; k++) {
        slope[k] = interval(fmax(slope[k].lo * range.scale - NOISE_SLOPE_SLACK, -most),
                            fmin(slope[k].hi * range.scale + NOISE_SLOPE_SLACK, most));
        if (cut)
            slope[k] = interval_hull(slope[k], interval_point(0));
    }
    *v = interval(fmin(fmax(v->lo, 0), 1), fmin(fmax(v->hi, 0), 1));
}
