// Tapes at eight points and over eight boxes (tape_kernel.h): the operations that isosurfaces
// are mostly made of in lanes, the others lane by lane. ISA names the instruction set.
#include "scene/tape_kernel.h"

#include <string.h>

#include "math/lanes.h"
#include "math/quick_lanes.h"
#include "scene/noise_kernel.h"
#include "scene/tape_steps.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)

struct range {
    struct real8 lo, hi;
};

struct reg {
    struct range v, d[3];
};

LANES_INLINE struct range range_of(struct real8 lo, struct real8 hi)
{
    return (struct range){lo, hi};
}

LANES_INLINE struct range whole_unless(struct mask8 good, struct range r)
{
    return range_of(r8_select(good, r.lo, r8_set(-INFINITY)),
                    r8_select(good, r.hi, r8_set(INFINITY)));
}

// As interval_widened.
LANES_INLINE struct range widen(struct range r)
{
    const struct real8 e = r8_set(INTERVAL_ROUNDING);
    r.lo = r8_sub(r.lo, r8_mul(r8_abs(r.lo), e));
    r.hi = r8_add(r.hi, r8_mul(r8_abs(r.hi), e));
    return whole_unless(r8_le(r.lo, r.hi), r);
}

LANES_INLINE struct range add(struct range a, struct range b)
{
    return widen(range_of(r8_add(a.lo, b.lo), r8_add(a.hi, b.hi)));
}

LANES_INLINE struct range negate(struct range a)
{
    return range_of(r8_neg(a.hi), r8_neg(a.lo));
}

// Ends among four products; a 0 * infinity, or infinities of both signs, are the whole.
LANES_INLINE struct range ends(struct real8 p, struct real8 q, struct real8 r,
                               struct real8 s)
{
    const struct real8 sum = r8_add(r8_add(p, q), r8_add(r, s));
    const struct range out = widen(
        range_of(r8_min(r8_min(p, q), r8_min(r, s)), r8_max(r8_max(p, q), r8_max(r, s))));
    return whole_unless(r8_eq(sum, sum), out);
}

LANES_INLINE struct range multiply(struct range a, struct range b)
{
    return ends(r8_mul(a.lo, b.lo), r8_mul(a.lo, b.hi), r8_mul(a.hi, b.lo),
                r8_mul(a.hi, b.hi));
}

LANES_INLINE struct mask8 never_zero(struct range a)
{
    return m8_or(r8_lt(r8_set(0), a.lo), r8_lt(a.hi, r8_set(0)));
}

LANES_INLINE struct mask8 not_whole(struct range a)
{
    return m8_or(r8_lt(r8_set(-INFINITY), a.lo), r8_lt(a.hi, r8_set(INFINITY)));
}

LANES_INLINE struct range divide(struct range a, struct range b)
{
    return whole_unless(never_zero(b), ends(r8_div(a.lo, b.lo), r8_div(a.lo, b.hi),
                                            r8_div(a.hi, b.lo), r8_div(a.hi, b.hi)));
}

LANES_INLINE struct range square(struct range a)
{
    const struct real8 p = r8_mul(a.lo, a.lo), q = r8_mul(a.hi, a.hi);
    const struct real8 lo = r8_select(never_zero(a), r8_min(p, q), r8_set(0));
    return whole_unless(not_whole(a), widen(range_of(lo, r8_max(p, q))));
}

LANES_INLINE struct range absolute(struct range a)
{
    const struct real8 p = r8_abs(a.lo), q = r8_abs(a.hi);
    const struct real8 lo = r8_select(never_zero(a), r8_min(p, q), r8_set(0));
    return whole_unless(not_whole(a), range_of(lo, r8_max(p, q)));
}

LANES_INLINE struct range root(struct range a)
{
    const struct real8 zero = r8_set(0);
    const struct range r =
        range_of(r8_sqrt(r8_max(a.lo, zero)), r8_sqrt(r8_max(a.hi, zero)));
    return whole_unless(r8_le(zero, a.lo), widen(r));
}

LANES_INLINE struct real8 size_of(struct range a)
{
    return r8_max(r8_abs(a.lo), r8_abs(a.hi));
}

// ---- waves ----------------------------------------------------------------------------

// Beyond this the lanes go one by one. quick_sincos8 is off by less than WAVE_ERROR.
#define WAVE_MAX   1e5
#define WAVE_ERROR 0x1p-48
#define PI_2       1.57079632679489661923

// Where `a` may reach a quarter turn q = first (mod 4), as reaches_quarter of interval.c.
LANES_INLINE struct mask8 reaches_quarter(struct real8 from, struct real8 to, int first)
{
    const struct real8 slack = r8_set(1e-13), four = r8_set(4), q = r8_set(first);
    const struct real8 low = r8_sub(r8_sub(from, r8_mul(r8_abs(from), slack)), slack);
    const struct real8 high = r8_add(r8_add(to, r8_mul(r8_abs(to), slack)), slack);
    const struct real8 n = r8_neg(r8_floor(r8_mul(r8_sub(q, low), r8_set(0.25))));
    return r8_le(r8_add(r8_mul(four, n), q), high);
}

LANES_INLINE struct range wave_between(struct real8 p, struct real8 q, struct mask8 rises,
                                       struct mask8 falls)
{
    const struct real8 e = r8_set(WAVE_ERROR), one = r8_set(1), less = r8_set(-1);
    const struct real8 lo = r8_max(r8_sub(r8_min(p, q), e), less);
    const struct real8 hi = r8_min(r8_add(r8_max(p, q), e), one);
    return range_of(r8_select(falls, less, lo), r8_select(rises, one, hi));
}

// Both waves of a.
LANES_INLINE void waves(struct range a, struct range *sine, struct range *cosine)
{
    struct real8 s0, c0, s1, c1;
    quick_sincos8(a.lo, &s0, &c0);
    quick_sincos8(a.hi, &s1, &c1);
    const struct real8 turn = r8_set(1 / PI_2);
    const struct real8 from = r8_mul(a.lo, turn), to = r8_mul(a.hi, turn);
    *sine =
        wave_between(s0, s1, reaches_quarter(from, to, 1), reaches_quarter(from, to, 3));
    *cosine =
        wave_between(c0, c1, reaches_quarter(from, to, 0), reaches_quarter(from, to, 2));
}

LANES_INLINE unsigned large_lanes(struct range a)
{
    return 255 & ~m8_bits(r8_lt(size_of(a), r8_set(WAVE_MAX)));
}

// ---- slopes ---------------------------------------------------------------------------

// N: how many partial derivatives are carried along; `moving`: which of them may be other
// than zero.
LANES_INLINE void scale(struct range by, const struct range *d, unsigned moving, int n,
                        struct range *out)
{
    for (int i = 0; i < n; i++)
        if (moving >> i & 1)
            out[i] = multiply(by, d[i]);
}

LANES_INLINE void scale_twice(struct range by_a, const struct reg *a, unsigned moving_a,
                              struct range by_b, const struct reg *b, unsigned moving_b,
                              int n, struct range *out)
{
    for (int i = 0; i < n; i++) {
        const unsigned x = moving_a >> i & 1, y = moving_b >> i & 1;
        if (x && y)
            out[i] = add(multiply(by_a, a->d[i]), multiply(by_b, b->d[i]));
        else if (x)
            out[i] = multiply(by_a, a->d[i]);
        else if (y)
            out[i] = multiply(by_b, b->d[i]);
    }
}

// No length grows faster than its sides.
LANES_INLINE void limit(const struct reg *a, const struct reg *b, const struct reg *c,
                        int n, struct range *d)
{
    for (int i = 0; i < n; i++) {
        struct real8 most = r8_add(size_of(a->d[i]), size_of(b->d[i]));
        if (c)
            most = r8_add(most, size_of(c->d[i]));
        most = r8_add(most, r8_mul(most, r8_set(8 * INTERVAL_ROUNDING)));
        d[i].lo = r8_max(d[i].lo, r8_neg(most));
        d[i].hi = r8_min(d[i].hi, most);
    }
}

// The smaller (larger) of two, and the slopes of both where it is not certain which.
LANES_INLINE void extreme(bool max, const struct reg *a, const struct reg *b, int n,
                          struct reg *out)
{
    const struct mask8 good = m8_and(not_whole(a->v), not_whole(b->v));
    const struct mask8 first =
        m8_and(good, max ? r8_lt(b->v.hi, a->v.lo) : r8_lt(a->v.hi, b->v.lo));
    const struct mask8 second =
        m8_and(good, max ? r8_lt(a->v.hi, b->v.lo) : r8_lt(b->v.hi, a->v.lo));
    for (int i = 0; i < n; i++) {
        struct range r =
            range_of(r8_min(a->d[i].lo, b->d[i].lo), r8_max(a->d[i].hi, b->d[i].hi));
        r.lo = r8_select(first, a->d[i].lo, r.lo);
        r.hi = r8_select(first, a->d[i].hi, r.hi);
        out->d[i].lo = r8_select(second, b->d[i].lo, r.lo);
        out->d[i].hi = r8_select(second, b->d[i].hi, r.hi);
    }
    out->v = whole_unless(
        good, max ? range_of(r8_max(a->v.lo, b->v.lo), r8_max(a->v.hi, b->v.hi))
                  : range_of(r8_min(a->v.lo, b->v.lo), r8_min(a->v.hi, b->v.hi)));
}

// ---- lane by lane -------------------------------------------------------------------

static void get(const struct reg *r, int n, struct tape_slope out[8])
{
    double at[8];
#define TAKE(from, to)                                                                   \
    do {                                                                                 \
        r8_store(at, from);                                                              \
        for (int l = 0; l < 8; l++)                                                      \
            out[l].to = at[l];                                                           \
    } while (0)
    TAKE(r->v.lo, v.lo);
    TAKE(r->v.hi, v.hi);
    for (int i = 0; i < n; i++) {
        TAKE(r->d[i].lo, d[i].lo);
        TAKE(r->d[i].hi, d[i].hi);
    }
#undef TAKE
}

static void set(struct reg *r, int n, const struct tape_slope in[8])
{
    double at[8];
#define GIVE(from, to)                                                                   \
    do {                                                                                 \
        for (int l = 0; l < 8; l++)                                                      \
            at[l] = in[l].from;                                                          \
        to = r8_load(at);                                                                \
    } while (0)
    GIVE(v.lo, r->v.lo);
    GIVE(v.hi, r->v.hi);
    for (int i = 0; i < n; i++) {
        GIVE(d[i].lo, r->d[i].lo);
        GIVE(d[i].hi, r->d[i].hi);
    }
#undef GIVE
}

static bool is_call(const struct tape_step *s)
{
    return s->op == TAPE_EXTERN || s->op == TAPE_CALL || s->op == TAPE_SUM ||
           s->op == TAPE_PRODUCT;
}

static int width_of(const struct tape_step *s)
{
    return s->op == TAPE_EXTERN ? ((const struct tape_extern *)s->callee)->width : 1;
}

// Into `lanes` of *to, which may be one of the operands: a lane must not depend on the
// others.
static void operation_by_lanes(const struct tape_step *s, const struct reg *r, int n,
                               int moving, unsigned lanes, struct reg *to)
{
    struct tape_slope in[4][8], out[8];
    const uint16_t operand[4] = {s->a, s->b, s->c, s->d};
    const int count = s->op == TAPE_SELECT || s->op == TAPE_LENGTH ? 4 : 2;
    for (int i = 0; i < count; i++)
        get(&r[operand[i]], n, in[i]);
    memset(out, 0, sizeof out);
    if (lanes != 255)
        get(to, n, out);
    for (int l = 0; l < 8; l++)
        if (lanes >> l & 1)
            tape_bounds_step((enum tape_op)s->op, &in[0][l], &in[1][l], &in[count - 2][l],
                             &in[count - 1][l], moving, &out[l]);
    set(to, n, out);
}

static bool call_in_lanes(const struct tape *t, const struct tape_step *s, struct reg *r,
                          int n)
{
    const struct tape_extern *f = s->op == TAPE_EXTERN ? s->callee : NULL;
    if (!f || !f->bounds8)
        return false;
    struct tape_range8 in[TAPE_EXTERN_ARGUMENTS], out[TAPE_WIDTH_MAX],
        partial[TAPE_WIDTH_MAX * TAPE_EXTERN_ARGUMENTS];
    for (uint32_t i = 0; i < s->count; i++) {
        const struct reg *a = &r[t->list[s->list + i]];
        if (m8_bits(r8_lt(size_of(a->v), r8_set(INFINITY))) != 255)
            return false;
        r8_store(in[i].lo, a->v.lo);
        r8_store(in[i].hi, a->v.hi);
    }
    if (!f->bounds8(&PASTE(noise_kernels_, ISA), s->data, in, out, partial))
        return false;
    struct reg v[TAPE_WIDTH_MAX];
    for (int i = 0; i < f->width; i++) {
        v[i].v = range_of(r8_load(out[i].lo), r8_load(out[i].hi));
        for (int k = 0; k < n; k++) {
            v[i].d[k] = range_of(r8_set(0), r8_set(0));
            for (uint32_t j = 0; j < s->count; j++) {
                const struct range d = r[t->list[s->list + j]].d[k];
                const struct tape_range8 *by = &partial[(uint32_t)i * s->count + j];
                const struct range p = range_of(r8_load(by->lo), r8_load(by->hi));
                const struct mask8 still =
                    m8_and(r8_eq(d.lo, r8_set(0)), r8_eq(d.hi, r8_set(0)));
                struct range m = multiply(p, d);
                m.lo = r8_select(still, r8_set(0), m.lo);
                m.hi = r8_select(still, r8_set(0), m.hi);
                v[i].d[k] = add(v[i].d[k], m);
            }
        }
    }
    for (int i = 0; i < f->width; i++) {
        r[s->to + i].v = v[i].v;
        for (int k = 0; k < n; k++)
            r[s->to + i].d[k] = v[i].d[k];
    }
    return true;
}

static void call_by_lanes(const struct tape *t, const struct tape_step *s, struct reg *r,
                          int n, int moving)
{
    struct tape_slope in[TAPE_LIST_MAX][8], out[TAPE_WIDTH_MAX][8];
    memset(out, 0, sizeof out);
    for (uint32_t i = 0; i < s->count; i++)
        get(&r[t->list[s->list + i]], n, in[i]);
    for (int l = 0; l < 8; l++) {
        struct tape_slope one[TAPE_LIST_MAX], result[TAPE_WIDTH_MAX] = {0};
        for (uint32_t i = 0; i < s->count; i++)
            one[i] = in[i][l];
        tape_bounds_call(s, one, moving, result);
        for (int i = 0; i < width_of(s); i++)
            out[i][l] = result[i];
    }
    for (int i = 0; i < width_of(s); i++)
        set(&r[s->to + i], n, out[i]);
}

static unsigned moving_of(const struct tape *t, const struct tape_step *s,
                          const uint8_t *moving)
{
    unsigned m = 0;
    if (s->op == TAPE_SELECT)
        m = moving[s->c] | moving[s->d];
    for (uint32_t i = 0; i < s->count; i++)
        m |= moving[t->list[s->list + i]];
    return m | moving[s->a] | moving[s->b];
}

// ---- bounds ---------------------------------------------------------------------------

LANES_INLINE void bounds_step(const struct tape *t, const struct tape_step *s,
                              struct reg *r, const uint8_t *moving, unsigned all, int n)
{
    const struct reg *a = &r[s->a], *b = &r[s->b];
    const unsigned ma = moving[s->a], mb = moving[s->b];
    const struct real8 zero = r8_set(0);
    const struct range half = {r8_set(0.5), r8_set(0.5)};
    struct reg v;
    for (int i = 0; i < n; i++)
        v.d[i] = range_of(zero, zero);
    struct range by, other;
    switch ((enum tape_op)s->op) {
    case TAPE_NEGATE:
        v.v = negate(a->v);
        for (int i = 0; i < n; i++)
            v.d[i] = negate(a->d[i]);
        break;
    case TAPE_SQUARE:
        v.v = square(a->v);
        scale(range_of(r8_add(a->v.lo, a->v.lo), r8_add(a->v.hi, a->v.hi)), a->d, ma, n,
              v.d);
        break;
    case TAPE_ABS:
        v.v = absolute(a->v);
        by = range_of(r8_select(r8_lt(zero, a->v.lo), r8_set(1), r8_set(-1)),
                      r8_select(r8_lt(a->v.hi, zero), r8_set(-1), r8_set(1)));
        scale(by, a->d, ma, n, v.d);
        break;
    case TAPE_SQRT:
    case TAPE_LENGTH:
        v.v = root(a->v);
        if (ma)
            scale(divide(half, v.v), a->d, ma, n, v.d);
        if (s->op == TAPE_LENGTH)
            limit(b, &r[s->c], s->b == s->d ? NULL : &r[s->d], n, v.d);
        break;
    case TAPE_SIN:
    case TAPE_COS:
        waves(a->v, &by, &other);
        v.v = s->op == TAPE_SIN ? by : other;
        scale(s->op == TAPE_SIN ? other : negate(by), a->d, ma, n, v.d);
        break;
    case TAPE_ADD:
        v.v = add(a->v, b->v);
        for (int i = 0; i < n; i++)
            v.d[i] = ma & mb & 1u << i ? add(a->d[i], b->d[i])
                     : ma >> i & 1     ? a->d[i]
                                       : b->d[i];
        break;
    case TAPE_SUBTRACT:
        v.v = add(a->v, negate(b->v));
        for (int i = 0; i < n; i++)
            v.d[i] = ma & mb & 1u << i ? add(a->d[i], negate(b->d[i]))
                     : ma >> i & 1     ? a->d[i]
                                       : negate(b->d[i]);
        break;
    case TAPE_MULTIPLY:
        v.v = multiply(a->v, b->v);
        scale_twice(b->v, a, ma, a->v, b, mb, n, v.d);
        break;
    case TAPE_DIVIDE:
        v.v = divide(a->v, b->v);
        if (ma | mb) {
            by = divide(range_of(r8_set(1), r8_set(1)), b->v);
            other = negate(divide(v.v, b->v));
            scale_twice(by, a, ma, other, b, mb, n, v.d);
        }
        break;
    case TAPE_MIN: extreme(false, a, b, n, &v); break;
    case TAPE_MAX: extreme(true, a, b, n, &v); break;
    default:
        if (is_call(s) && call_in_lanes(t, s, r, n))
            return;
        if (is_call(s))
            call_by_lanes(t, s, r, n, all ? n : 0);
        else
            operation_by_lanes(s, r, n, all ? n : 0, 255, &r[s->to]);
        return;
    }
    const bool wave = s->op == TAPE_SIN || s->op == TAPE_COS;
    const unsigned large = wave ? large_lanes(a->v) : 0;
    if (large)
        operation_by_lanes(s, r, n, all ? n : 0, large, &v);
    struct reg *to = &r[s->to];
    to->v = v.v;
    for (int i = 0; i < n; i++)
        to->d[i] = v.d[i];
}

// Along `d` with n = 1, by x, y and z with n = 3.
LANES_INLINE void run_bounds(const struct tape *t, const struct tape_boxes *in,
                             const double (*d)[8], int n, struct tape_slopes *out)
{
    struct reg r[TAPE_LANE_REGISTERS_MAX];
    uint8_t moving[TAPE_LANE_REGISTERS_MAX];
    const struct real8 zero = r8_set(0), one = r8_set(1);
    for (uint32_t i = 0; i < t->constant_count; i++) {
        r[i].v.lo = r[i].v.hi = r8_set(t->constant[i]);
        for (int k = 0; k < n; k++)
            r[i].d[k] = range_of(zero, zero);
        moving[i] = 0;
    }
    for (int i = 0; i < t->arguments; i++) {
        struct reg *to = &r[t->constant_count + (uint32_t)i];
        to->v = range_of(r8_load(in->lo[i]), r8_load(in->hi[i]));
        for (int k = 0; k < n; k++)
            to->d[k] = range_of(k == i ? one : zero, k == i ? one : zero);
        if (d)
            to->d[0].lo = to->d[0].hi = r8_load(d[i]);
        moving[t->constant_count + (uint32_t)i] = (uint8_t)(d ? 1 : n ? 1u << i : 0);
    }
    for (uint32_t i = 0; i < t->step_count; i++) {
        const struct tape_step *s = &t->step[i];
        const unsigned m = moving_of(t, s, moving);
        bounds_step(t, s, r, moving, m, n);
        for (int k = 0; k < width_of(s); k++)
            moving[s->to + k] = (uint8_t)m;
    }
    const struct reg *v = &r[t->result[0]];
    r8_store(out->lo, v->v.lo);
    r8_store(out->hi, v->v.hi);
    for (int i = 0; i < n; i++) {
        r8_store(out->slope_lo[i], v->d[i].lo);
        r8_store(out->slope_hi[i], v->d[i].hi);
    }
}

static void bounds(const struct tape *t, const struct tape_boxes *in, bool slopes,
                   struct tape_slopes *out)
{
    if (slopes)
        run_bounds(t, in, NULL, 3, out);
    else
        run_bounds(t, in, NULL, 0, out);
}

static void along(const struct tape *t, const struct tape_boxes *in, const double d[3][8],
                  struct tape_slopes *out)
{
    run_bounds(t, in, d, 1, out);
}

// ---- values ---------------------------------------------------------------------------

static void values_call(const struct tape *t, const struct tape_step *s, struct real8 *r)
{
    double in[TAPE_LIST_MAX][8], out[TAPE_WIDTH_MAX][8];
    for (uint32_t i = 0; i < s->count; i++)
        r8_store(in[i], r[t->list[s->list + i]]);
    tape_call_packet(&PASTE(noise_kernels_, ISA), s, (const double(*)[8])in, out);
    for (int i = 0; i < width_of(s); i++)
        r[s->to + i] = r8_load(out[i]);
}

static struct real8 value_by_lanes(enum tape_op op, struct real8 x, struct real8 y)
{
    double a8[8], b8[8], v[8];
    r8_store(a8, x);
    r8_store(b8, y);
    switch (op) {
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        for (int l = 0; l < 8; l++) {                                                    \
            const double a = a8[l], b = b8[l];                                           \
            (void)b;                                                                     \
            v[l] = value;                                                                \
        }                                                                                \
        break;
#define BINARY(name, value, by_a, by_b) UNARY(name, value, 0)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    default: return x;
    }
    return r8_load(v);
}

LANES_INLINE struct real8 wave_value(enum tape_op op, struct real8 a)
{
    struct real8 sine, cosine;
    quick_sincos8(a, &sine, &cosine);
    const struct real8 v = op == TAPE_SIN ? sine : cosine;
    const struct mask8 small = r8_lt(r8_abs(a), r8_set(WAVE_MAX));
    return m8_bits(small) == 255 ? v : r8_select(small, v, value_by_lanes(op, a, a));
}

LANES_INLINE struct real8 chosen(struct real8 a, struct real8 b, struct real8 c,
                                 struct real8 d)
{
    const struct real8 zero = r8_set(0);
    return r8_select(r8_lt(a, zero), b, r8_select(r8_eq(a, zero), c, d));
}

static void values(const struct tape *t, const double at[3][8], double out[8])
{
    struct real8 r[TAPE_LANE_REGISTERS_MAX];
    for (uint32_t i = 0; i < t->constant_count; i++)
        r[i] = r8_set(t->constant[i]);
    for (int i = 0; i < t->arguments; i++)
        r[t->constant_count + (uint32_t)i] = r8_load(at[i]);
    for (const struct tape_step *s = t->step, *end = s + t->step_count; s < end; s++) {
        const struct real8 a = r[s->a], b = r[s->b];
        switch ((enum tape_op)s->op) {
        case TAPE_NEGATE: r[s->to] = r8_neg(a); break;
        case TAPE_SQUARE: r[s->to] = r8_mul(a, a); break;
        case TAPE_ABS: r[s->to] = r8_abs(a); break;
        case TAPE_LENGTH:
        case TAPE_SQRT: r[s->to] = r8_sqrt(a); break;
        case TAPE_SIN:
        case TAPE_COS: r[s->to] = wave_value((enum tape_op)s->op, a); break;
        case TAPE_ADD: r[s->to] = r8_add(a, b); break;
        case TAPE_SUBTRACT: r[s->to] = r8_sub(a, b); break;
        case TAPE_MULTIPLY: r[s->to] = r8_mul(a, b); break;
        case TAPE_DIVIDE: r[s->to] = r8_div(a, b); break;
        case TAPE_MIN: r[s->to] = r8_min(b, a); break;
        case TAPE_MAX: r[s->to] = r8_max(b, a); break;
        case TAPE_SELECT: r[s->to] = chosen(a, b, r[s->c], r[s->d]); break;
        case TAPE_EXTERN:
        case TAPE_CALL:
        case TAPE_SUM:
        case TAPE_PRODUCT: values_call(t, s, r); break;
        default: r[s->to] = value_by_lanes((enum tape_op)s->op, a, b);
        }
    }
    r8_store(out, r[t->result[0]]);
}

const struct tape_kernels PASTE(tape_kernels_, ISA) = {values, bounds, along};
