// Tapes at eight points and over eight boxes (tape_kernel.h): the operations that isosurfaces
// are mostly made of in lanes, the others lane by lane. ISA names the instruction set.
#include "scene/tape_kernel.h"

#include <string.h>

#include "math/isa.h"
#include "math/lanes.h"
#include "math/power_lanes.h"
#include "math/trig_lanes.h"
#include "scene/noise_kernel.h"
#include "scene/tape_slope_lanes.h"
#include "scene/tape_steps.h"

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

// Of eight boxes one by one.
static void extern_bounds_each(const struct tape_extern *f, const void *data,
                               const struct tape_range8 *in, struct tape_range8 *out,
                               struct tape_range8 *partial)
{
    const int partials = partial ? f->width * f->arguments : 0;
    for (int l = 0; l < 8; l++) {
        struct interval at[TAPE_EXTERN_ARGUMENTS], v[TAPE_WIDTH_MAX],
            by[TAPE_WIDTH_MAX * TAPE_EXTERN_ARGUMENTS];
        for (int i = 0; i < f->arguments; i++)
            at[i] = interval(in[i].lo[l], in[i].hi[l]);
        f->bounds(data, at, v, partial ? by : NULL);
        for (int i = 0; i < f->width; i++) {
            out[i].lo[l] = v[i].lo;
            out[i].hi[l] = v[i].hi;
        }
        for (int i = 0; i < partials; i++) {
            partial[i].lo[l] = by[i].lo;
            partial[i].hi[l] = by[i].hi;
        }
    }
}

static bool call_in_lanes(const struct tape *t, const struct tape_step *s, struct reg *r,
                          int n)
{
    const struct tape_extern *f = s->op == TAPE_EXTERN ? s->callee : NULL;
    if (!f || !f->bounds)
        return false;
    struct tape_range8 in[TAPE_EXTERN_ARGUMENTS], out[TAPE_WIDTH_MAX],
        partial[TAPE_WIDTH_MAX * TAPE_EXTERN_ARGUMENTS];
    for (uint32_t i = 0; i < s->count; i++) {
        const struct reg *a = &r[t->list[s->list + i]];
        if (!f->anywhere && m8_bits(r8_lt(size_of(a->v), r8_set(INFINITY))) != 255)
            return false;
        r8_store(in[i].lo, a->v.lo);
        r8_store(in[i].hi, a->v.hi);
    }
    if (!f->bounds8 ||
        !f->bounds8(&OF_ISA(noise_kernels_), s->data, in, out, n ? partial : NULL))
        extern_bounds_each(f, s->data, in, out, n ? partial : NULL);
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

// Whether it is a power that lanes know.
static bool is_power(const struct tape *t, const struct tape_step *s)
{
    if (s->op != TAPE_POW || s->b >= t->constant_count)
        return false;
    return fabs(t->constant[s->b]) < INFINITY;
}

// Returns the lanes that are left to do.
LANES_INLINE unsigned power_step(const struct reg *a, unsigned moving, double y, int n,
                                 struct reg *v)
{
    const struct range none = {r8_set(0), r8_set(0)};
    struct range by;
    const unsigned left = power_of(a->v, y, &v->v, &by);
    scale(by, a->d, moving, n, v->d);
    for (int i = 0; i < n; i++) // 0 times the whole
        if (moving >> i & 1)
            v->d[i] = either(is_zero(a->d[i]), none, v->d[i]);
    return left;
}

// Of a comparison or a logical operation.
LANES_INLINE struct range compared(enum tape_op op, struct range a, struct range b)
{
    switch (op) {
    case TAPE_LESS: return is_less(a, b);
    case TAPE_GREATER: return is_less(b, a);
    case TAPE_LESS_EQUAL: return is_less_equal(a, b);
    case TAPE_GREATER_EQUAL: return is_less_equal(b, a);
    case TAPE_EQUAL: return is_equal(a, b);
    case TAPE_NOT_EQUAL: return negated(is_equal(a, b));
    case TAPE_AND: return both(a, b);
    default: return one_of(a, b);
    }
}

// Of a + b, or of a - b; what does not move has slopes of zero, which are not added.
LANES_INLINE void add_slopes(const struct reg *a, unsigned ma, const struct reg *b,
                             unsigned mb, bool subtract, int n, struct range *out)
{
    for (int i = 0; i < n; i++) {
        const struct range d = subtract ? negate(b->d[i]) : b->d[i];
        out[i] = ma & mb & 1u << i ? add(a->d[i], d) : ma >> i & 1 ? a->d[i] : d;
    }
}

LANES_INLINE void bounds_step(const struct tape *t, const struct tape_step *s,
                              struct reg *r, const uint8_t *moving, unsigned all, int n)
{
    const enum tape_op op = (enum tape_op)s->op;
    const struct reg *a = &r[s->a], *b = &r[s->b];
    const unsigned ma = moving[s->a], mb = moving[s->b];
    const struct real8 zero = r8_set(0);
    const struct range half = {r8_set(0.5), r8_set(0.5)};
    struct reg v;
    for (int i = 0; i < n; i++)
        v.d[i] = range_of(zero, zero);
    struct range by, other;
    unsigned left = 0;
    if (op == TAPE_POW && !is_power(t, s)) {
        operation_by_lanes(s, r, n, all ? n : 0, 255, &r[s->to]);
        return;
    }
    switch (op) {
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
        if (op == TAPE_LENGTH)
            limit(b, &r[s->c], s->b == s->d ? NULL : &r[s->d], n, v.d);
        break;
    case TAPE_SIN:
    case TAPE_COS:
        waves(a->v, &by, &other);
        v.v = op == TAPE_SIN ? by : other;
        scale(op == TAPE_SIN ? other : negate(by), a->d, ma, n, v.d);
        left = large_lanes(a->v);
        break;
    case TAPE_POW: left = power_step(a, ma, t->constant[s->b], n, &v); break;
    case TAPE_ADD:
        v.v = add(a->v, b->v);
        add_slopes(a, ma, b, mb, false, n, v.d);
        break;
    case TAPE_SUBTRACT:
        v.v = add(a->v, negate(b->v));
        add_slopes(a, ma, b, mb, true, n, v.d);
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
    case TAPE_ATAN2:
        v.v = angle(a->v, b->v);
        angle_slopes(a, ma, b, mb, n, &v);
        break;
    case TAPE_MOD:
        v.v = modulo(a->v, b->v);
        modulo_slopes(a, ma, b, mb, n, &v);
        break;
    case TAPE_FLOOR:
        v.v = range_of(r8_floor(a->v.lo), r8_floor(a->v.hi));
        flat(v.v, a->d, ma, n, v.d);
        break;
    case TAPE_LESS:
    case TAPE_GREATER:
    case TAPE_LESS_EQUAL:
    case TAPE_GREATER_EQUAL:
    case TAPE_EQUAL:
    case TAPE_NOT_EQUAL:
    case TAPE_AND:
    case TAPE_OR:
        v.v = compared(op, a->v, b->v);
        flat_of_two(a, ma, b, mb, n, &v);
        break;
    case TAPE_SELECT: choose(a, b, &r[s->c], &r[s->d], ma, n, &v); break;
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
    if (left)
        operation_by_lanes(s, r, n, all ? n : 0, left, &v);
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
    for (int k = 0; k < t->width; k++, out++) {
        const struct reg *v = &r[t->result[k]];
        r8_store(out->lo, v->v.lo);
        r8_store(out->hi, v->v.hi);
        for (int i = 0; i < n; i++) {
            r8_store(out->slope_lo[i], v->d[i].lo);
            r8_store(out->slope_hi[i], v->d[i].hi);
        }
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
    tape_call_packet(&OF_ISA(noise_kernels_), s, (const double(*)[8])in, out);
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

LANES_INLINE struct real8 one_where(struct mask8 m)
{
    return r8_select(m, r8_set(1), r8_set(0));
}

LANES_INLINE struct real8 chosen(struct real8 a, struct real8 b, struct real8 c,
                                 struct real8 d)
{
    const struct real8 zero = r8_set(0);
    return r8_select(r8_lt(a, zero), b, r8_select(r8_eq(a, zero), c, d));
}

// exact: the bits of tape_run.
LANES_INLINE void run_values(const struct tape *t, bool exact, const double at[3][8],
                             double out[8])
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
        case TAPE_SIN: r[s->to] = exact ? det_sin8(a) : wave_value(TAPE_SIN, a); break;
        case TAPE_COS: r[s->to] = exact ? det_cos8(a) : wave_value(TAPE_COS, a); break;
        case TAPE_ADD: r[s->to] = r8_add(a, b); break;
        case TAPE_SUBTRACT: r[s->to] = r8_sub(a, b); break;
        case TAPE_MULTIPLY: r[s->to] = r8_mul(a, b); break;
        case TAPE_DIVIDE: r[s->to] = r8_div(a, b); break;
        case TAPE_ATAN2:
            r[s->to] = exact ? value_by_lanes(TAPE_ATAN2, a, b) : quick_atan2_8(a, b);
            break;
        case TAPE_MOD: r[s->to] = quick_fmod8(a, b); break;
        case TAPE_EXP: r[s->to] = det_exp8(a); break;
        case TAPE_LOG: r[s->to] = det_log8(a); break;
        case TAPE_POW: r[s->to] = det_pow8(a, b); break;
        case TAPE_FLOOR: r[s->to] = r8_floor(a); break;
        case TAPE_LESS: r[s->to] = one_where(r8_lt(a, b)); break;
        case TAPE_GREATER: r[s->to] = one_where(r8_lt(b, a)); break;
        case TAPE_LESS_EQUAL: r[s->to] = one_where(r8_le(a, b)); break;
        case TAPE_GREATER_EQUAL: r[s->to] = one_where(r8_le(b, a)); break;
        case TAPE_EQUAL: r[s->to] = one_where(r8_eq(a, b)); break;
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

static void values(const struct tape *t, const double at[3][8], double out[8])
{
    run_values(t, false, at, out);
}

static void exact(const struct tape *t, const double at[3][8], double out[8])
{
    run_values(t, true, at, out);
}

const struct tape_kernels OF_ISA(tape_kernels_) = {values, exact, bounds, along,
                                                   &OF_ISA(noise_kernels_)};
