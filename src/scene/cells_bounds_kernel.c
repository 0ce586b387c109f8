// Bounds of crackle over eight boxes (scene/patterns/crackle_bounds.c says how), compiled once
// per instruction set: ISA names it.
#include <float.h>
#include <stdint.h>

#include "math/isa.h"
#include "math/lanes_vec.h"
#include "math/quick_lanes.h"
#include "scene/noise_kernel.h"
#include "scene/noise_tables.h"
#include "scene/patterns/crackle.h"

// Powers of smaller numbers count as none.
#define TINY 0x1p-100

// A point as seen from the boxes, and the sums of its powers.
struct point8 {
    struct real8 lo[3], hi[3], least, most;
};

struct search8 {
    const struct noise_cells_form *form;
    struct real8 lo[3], hi[3], slack;          // the parts of the boxes in the base cell
    struct real8 least[3], most[3], middle[3]; // the smallest of all points, ascending
    unsigned lanes;
    int count;
    struct point8 found[CRACKLE_CELLS];
};

// ---- powers -----------------------------------------------------------------------------

static struct real8 general_power(struct real8 x, double y)
{
    const struct real8 tiny = r8_set(TINY);
    double in[8], out[8];
    r8_store(in, r8_max(x, tiny));
    quick_pow8(in, y, out);
    return r8_select(r8_lt(x, tiny), r8_set(0), r8_load(out));
}

// x^y; twice: 2 y, or 0 where that is no whole number.
LANES_INLINE struct real8 power8(struct real8 x, double y, int twice)
{
    if (!twice)
        return general_power(x, y);
    struct real8 r = twice & 1 ? r8_sqrt(x) : r8_set(1);
    for (int n = twice >> 1; n; n >>= 1) {
        if (n & 1)
            r = r8_mul(r, x);
        x = r8_mul(x, x);
    }
    return r;
}

LANES_INLINE struct real8 raised8(const struct noise_cells_form *f, struct real8 x)
{
    if (f->twice == 4)
        return r8_mul(x, x);
    return f->twice == 2 ? x : power8(x, f->metric, f->twice);
}

static struct real8 distance8(const struct noise_cells_form *f, struct real8 sum)
{
    if (f->twice == 4)
        return r8_sqrt(r8_add(sum, r8_set(f->offset * f->offset)));
    if (f->twice == 2)
        return r8_add(sum, r8_set(f->offset));
    if (f->offset != 0)
        sum = r8_add(sum, raised8(f, r8_set(f->offset)));
    return general_power(sum, 1 / f->metric);
}

LANES_INLINE struct real8 slack_of(const struct noise_cells_form *f, struct real8 d)
{
    return r8_mul(r8_set(0x1p-42), r8_add(r8_abs(d), r8_set(4 + fabs(f->offset))));
}

LANES_INLINE struct real8 distance_below(const struct noise_cells_form *f, struct real8 s)
{
    const struct real8 d = distance8(f, s);
    return r8_sub(d, slack_of(f, d));
}

LANES_INLINE struct real8 distance_above(const struct noise_cells_form *f, struct real8 s)
{
    const struct real8 d = distance8(f, s);
    return r8_add(d, slack_of(f, d));
}

// ---- the search ---------------------------------------------------------------------------

LANES_INLINE void keep8(struct real8 d[3], struct real8 v)
{
    const struct real8 second = r8_max(d[0], v), third = r8_max(d[1], second);
    d[0] = r8_min(d[0], v);
    d[1] = r8_min(d[1], second);
    d[2] = r8_min(d[2], third);
}

LANES_INLINE void look_at8(struct search8 *s, const double q[3])
{
    const struct real8 zero = r8_set(0), half = r8_set(0.5);
    struct point8 *p = &s->found[s->count++];
    struct real8 middle = zero;
    p->least = p->most = zero;
    for (int k = 0; k < 3; k++) {
        const struct real8 v = r8_set(q[k]);
        p->lo[k] = r8_sub(r8_sub(v, s->hi[k]), s->slack);
        p->hi[k] = r8_add(r8_sub(v, s->lo[k]), s->slack);
        const struct real8 near = r8_max(r8_max(p->lo[k], r8_neg(p->hi[k])), zero);
        const struct real8 far = r8_max(r8_neg(p->lo[k]), p->hi[k]);
        const struct real8 m = r8_abs(r8_mul(half, r8_add(p->lo[k], p->hi[k])));
        p->least = r8_add(p->least, raised8(s->form, near));
        p->most = r8_add(p->most, raised8(s->form, far));
        middle = r8_add(middle, raised8(s->form, m));
    }
    keep8(s->least, p->least);
    keep8(s->most, p->most);
    keep8(s->middle, middle);
}

static inline unsigned wrapped(double v) { return (unsigned)(int64_t)v & 4095; }

static void find8(struct search8 *s, const double base[3])
{
    struct real8 gap[3][5];
    unsigned xy[5][5], z[5];
    for (int i = 0; i < 5; i++) {
        const unsigned x = noise_hash_table[wrapped(base[0] + i - 2)];
        for (int j = 0; j < 5; j++)
            xy[i][j] = noise_hash_table[x ^ wrapped(base[1] + j - 2)];
        z[i] = wrapped(base[2] + i - 2);
        for (int k = 0; k < 3; k++) {
            const double low = base[k] + i - 2;
            const struct real8 d =
                r8_max(r8_sub(r8_set(low), s->hi[k]), r8_sub(s->lo[k], r8_set(low + 1)));
            gap[k][i] = raised8(s->form, r8_max(r8_sub(d, s->slack), r8_set(0)));
        }
    }
    for (int i = 0; i < 3; i++)
        s->least[i] = s->most[i] = s->middle[i] = r8_set(DBL_MAX);
    s->count = 0;
    for (int i = 0; i < CRACKLE_CELLS; i++) {
        const int a = crackle_cells[i].x + 2, b = crackle_cells[i].y + 2,
                  c = crackle_cells[i].z + 2;
        const struct real8 least = r8_add(r8_add(gap[0][a], gap[1][b]), gap[2][c]);
        if (!(m8_bits(r8_le(least, s->most[s->form->wanted - 1])) & s->lanes))
            continue;
        const uint32_t *r = noise_random_table + noise_hash_table[xy[a][b] ^ z[c]];
        const double q[3] = {base[0] + (a - 2) + r[0] * 0x1p-32,
                             base[1] + (b - 2) + r[1] * 0x1p-32,
                             base[2] + (c - 2) + r[2] * 0x1p-32};
        look_at8(s, q);
    }
}

// ---- slopes -------------------------------------------------------------------------------

// Of a distance between `near` and `far` along an axis where the point is lo..hi away.
LANES_INLINE void slope8(const struct noise_cells_form *f, struct real8 lo,
                         struct real8 hi, struct real8 near, struct real8 far,
                         struct real8 *down, struct real8 *up)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    struct real8 a = one, b = one;
    if (f->twice != 2) {
        const struct real8 least = r8_max(r8_max(lo, r8_neg(hi)), zero);
        a = r8_min(r8_div(least, far), one);
        b = r8_min(r8_div(r8_max(r8_neg(lo), hi), r8_max(near, zero)), one);
        if (f->twice != 4) {
            a = power8(a, f->metric - 1, f->twice ? f->twice - 2 : 0);
            b = power8(b, f->metric - 1, f->twice ? f->twice - 2 : 0);
        }
        const struct real8 slack = r8_set(0x1p-40);
        a = r8_sub(a, slack);
        b = r8_add(b, slack);
    }
    *down = r8_select(r8_lt(zero, hi), r8_neg(b), a);
    *up = r8_select(r8_lt(lo, zero), b, r8_neg(a));
}

// The hull of the slopes of all points that may be the i-th nearest.
static void slopes8(const struct search8 *s, int i, struct real8 lo[3],
                    struct real8 hi[3])
{
    for (int k = 0; k < 3; k++) {
        lo[k] = r8_set(INFINITY);
        hi[k] = r8_set(-INFINITY);
    }
    for (int j = 0; j < s->count; j++) {
        const struct point8 *p = &s->found[j];
        const struct mask8 here =
            m8_and(m8_of(s->lanes),
                   m8_and(r8_le(p->least, s->most[i]), r8_le(s->least[i], p->most)));
        if (!m8_bits(here))
            continue;
        const struct real8 near = distance_below(s->form, p->least),
                           far = distance_above(s->form, p->most);
        for (int k = 0; k < 3; k++) {
            struct real8 a, b;
            slope8(s->form, p->lo[k], p->hi[k], near, far, &a, &b);
            lo[k] = r8_select(here, r8_min(lo[k], a), lo[k]);
            hi[k] = r8_select(here, r8_max(hi[k], b), hi[k]);
        }
    }
}

// ---- the value ----------------------------------------------------------------------------

struct result8 {
    struct real8 lo, hi, down[3], up[3];
};

LANES_INLINE void plus_times(struct real8 *lo, struct real8 *hi, double f, struct real8 a,
                             struct real8 b)
{
    const struct real8 by = r8_set(f);
    *lo = r8_add(*lo, r8_mul(by, f > 0 ? a : b));
    *hi = r8_add(*hi, r8_mul(by, f > 0 ? b : a));
}

static void clamp8(struct result8 *r, bool slopes)
{
    const struct real8 zero = r8_set(0), one = r8_set(1), slack = r8_set(0x1p-46);
    r->lo = r8_sub(r->lo, slack);
    r->hi = r8_add(r->hi, slack);
    const struct mask8 cut = m8_or(r8_lt(r->lo, zero), r8_lt(one, r->hi));
    const struct mask8 out = m8_or(r8_lt(r->hi, zero), r8_lt(one, r->lo));
    for (int k = 0; slopes && k < 3; k++) {
        r->down[k] = r8_select(cut, r8_min(r->down[k], zero), r->down[k]);
        r->up[k] = r8_select(cut, r8_max(r->up[k], zero), r->up[k]);
        r->down[k] = r8_select(out, zero, r->down[k]);
        r->up[k] = r8_select(out, zero, r->up[k]);
    }
    r->lo = r8_min(r8_max(r->lo, zero), one);
    r->hi = r8_min(r8_max(r->hi, zero), one);
}

static void form8(const struct search8 *s, bool slopes, struct result8 *r)
{
    const struct noise_cells_form *f = s->form;
    const struct real8 zero = r8_set(0), half = r8_set(0.5);
    struct real8 low = zero, high = zero; // in the middle
    r->lo = r->hi = zero;
    for (int k = 0; k < 3; k++)
        r->down[k] = r->up[k] = zero;
    for (int i = 0; i < 3; i++) {
        if (f->form[i] == 0)
            continue;
        plus_times(&r->lo, &r->hi, f->form[i], distance_below(f, s->least[i]),
                   distance_above(f, s->most[i]));
        if (!slopes)
            continue;
        plus_times(&low, &high, f->form[i], distance_below(f, s->middle[i]),
                   distance_above(f, s->middle[i]));
        struct real8 down[3], up[3];
        slopes8(s, i, down, up);
        for (int k = 0; k < 3; k++)
            plus_times(&r->down[k], &r->up[k], f->form[i], down[k], up[k]);
    }
    if (slopes) {
        struct real8 way = zero;
        for (int k = 0; k < 3; k++) {
            const struct real8 reach =
                r8_add(r8_mul(half, r8_sub(s->hi[k], s->lo[k])), s->slack);
            const struct real8 most = r8_max(r8_neg(r->down[k]), r->up[k]);
            way = r8_add(way, r8_mul(reach, most));
        }
        r->lo = r8_max(r->lo, r8_sub(low, way));
        r->hi = r8_min(r->hi, r8_add(high, way));
    }
    clamp8(r, slopes);
}

// ---- boxes --------------------------------------------------------------------------------

struct boxes8 {
    const double (*lo)[8], (*hi)[8];
    double first[3][8], last[3][8];
    unsigned good; // small enough to be looked at
};

enum { BASES_MAX = 27 };

static void set_up(struct boxes8 *b)
{
    b->good = 0;
    for (int l = 0; l < 8; l++) {
        double count = 1, size = 0;
        for (int k = 0; k < 3; k++) {
            size = fmax(size, fmax(fabs(b->lo[k][l]), fabs(b->hi[k][l])));
            b->first[k][l] = floor(b->lo[k][l] - PATTERN_EDGE);
            b->last[k][l] = floor(b->hi[k][l] - PATTERN_EDGE);
            count *= b->last[k][l] - b->first[k][l] + 1;
        }
        b->good |= (unsigned)(count <= BASES_MAX && size < 0x1p40) << l;
    }
}

static bool has(const struct boxes8 *b, int lane, const double c[3])
{
    for (int k = 0; k < 3; k++)
        if (c[k] < b->first[k][lane] || c[k] > b->last[k][lane])
            return false;
    return true;
}

static void join8(struct noise_bounds8 *out, const struct result8 *r, unsigned lanes,
                  bool slopes)
{
    const struct mask8 m = m8_of(lanes);
#define JOIN(to, op, v) r8_store(to, r8_select(m, op(r8_load(to), v), r8_load(to)))
    JOIN(out->lo, r8_min, r->lo);
    JOIN(out->hi, r8_max, r->hi);
    for (int k = 0; slopes && k < 3; k++) {
        JOIN(out->slope_lo[k], r8_min, r->down[k]);
        JOIN(out->slope_hi[k], r8_max, r->up[k]);
    }
#undef JOIN
}

// The boxes that reach into a cell; returns those in which a distance may jump at its faces.
static unsigned one_base(struct search8 *s, const struct boxes8 *b, const double c[3],
                         bool slopes, struct noise_bounds8 *out)
{
    double far = 4;
    for (int k = 0; k < 3; k++) {
        s->lo[k] = r8_max(r8_load(b->lo[k]), r8_set(c[k]));
        s->hi[k] = r8_min(r8_load(b->hi[k]), r8_set(c[k] + 1 + 2 * PATTERN_EDGE));
        far = fmax(far, 4 + fabs(c[k]));
    }
    s->slack = r8_set(4 * DBL_EPSILON * far);
    find8(s, c);
    struct result8 r;
    form8(s, slopes, &r);
    join8(out, &r, s->lanes, slopes);
    const struct real8 shared = r8_set(2 - 1e-6);
    return s->lanes & ~m8_bits(r8_lt(s->most[s->form->wanted - 1], shared));
}

void OF_ISA(noise_cells_bounds_)(const struct noise_cells_form *f, const double lo[3][8],
                                 const double hi[3][8], bool slopes,
                                 struct noise_bounds8 *out)
{
    struct boxes8 b;
    struct search8 s; // most of it is not used: nothing is cleared
    b.lo = lo, b.hi = hi;
    s.form = f;
    unsigned jumps = 0, several = 0;
    set_up(&b);
    for (int l = 0; l < 8; l++) {
        const bool good = b.good >> l & 1;
        out->lo[l] = good ? 1 : 0;
        out->hi[l] = good ? 0 : 1;
        for (int k = 0; k < 3; k++) {
            out->slope_lo[k][l] = good ? INFINITY : -INFINITY;
            out->slope_hi[k][l] = good ? -INFINITY : INFINITY;
            several |= (unsigned)(b.first[k][l] < b.last[k][l]) << l;
        }
    }
    for (int l = 0; l < 8; l++) {
        double c[3];
        if (!(b.good >> l & 1))
            continue;
        for (c[0] = b.first[0][l]; c[0] <= b.last[0][l]; c[0]++)
            for (c[1] = b.first[1][l]; c[1] <= b.last[1][l]; c[1]++)
                for (c[2] = b.first[2][l]; c[2] <= b.last[2][l]; c[2]++) {
                    s.lanes = 0;
                    for (int i = 0; i < 8; i++)
                        s.lanes |= (unsigned)(b.good >> i & 1 && has(&b, i, c)) << i;
                    if (!(s.lanes & ((1u << l) - 1))) // else an earlier lane's turn
                        jumps |= one_base(&s, &b, c, slopes, out);
                }
    }
    for (unsigned m = jumps & several; slopes && m; m &= m - 1)
        for (int k = 0; k < 3; k++) {
            out->slope_lo[k][__builtin_ctz(m)] = -INFINITY;
            out->slope_hi[k][__builtin_ctz(m)] = INFINITY;
        }
}
