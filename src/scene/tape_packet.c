// Bounds over eight boxes at once (tape.h): the operations that isosurfaces are mostly made
// of in vectors of eight, the others lane by lane. Compiled for three instruction sets with
// the same results.
#include <string.h>

#include "scene/tape_steps.h"

// Vectors of the compiler: as many registers as the instruction set needs.
typedef double real8 __attribute__((vector_size(64)));
typedef int64_t mask8 __attribute__((vector_size(64)));

#define INLINE static inline __attribute__((always_inline))

struct range {
    real8 lo, hi;
};

struct reg {
    struct range v, d[3];
};

enum { PACKET_REGISTERS_MAX = 256 }; // larger tapes go lane by lane

INLINE void select(const mask8 *where, const real8 *x, const real8 *y, real8 *out)
{
    const mask8 m = *where;
    *out = (real8)(((mask8)*x & m) | ((mask8)*y & ~m));
}

INLINE void least(const real8 *x, const real8 *y, real8 *out)
{
    select((const mask8[]){*x < *y}, x, y, out);
}

INLINE void greatest(const real8 *x, const real8 *y, real8 *out)
{
    select((const mask8[]){*x > *y}, x, y, out);
}

INLINE void absolute(const real8 *x, real8 *out)
{
    *out = (real8)((mask8)*x & INT64_MAX);
}

INLINE void whole_unless(const mask8 *where, struct range *r)
{
    const mask8 good = *where;
    const real8 zero = {0}, most = zero + INFINITY, low = zero - INFINITY;
    select(&good, &r->lo, &low, &r->lo);
    select(&good, &r->hi, &most, &r->hi);
}

// As interval_widened.
INLINE void widen(struct range *r)
{
    real8 a, b;
    absolute(&r->lo, &a);
    absolute(&r->hi, &b);
    r->lo -= a * INTERVAL_ROUNDING;
    r->hi += b * INTERVAL_ROUNDING;
    whole_unless((const mask8[]){r->lo <= r->hi}, r);
}

INLINE void add(const struct range *a, const struct range *b, struct range *out)
{
    out->lo = a->lo + b->lo;
    out->hi = a->hi + b->hi;
    widen(out);
}

INLINE void negate(const struct range *a, struct range *out)
{
    const real8 lo = -a->hi;
    out->hi = -a->lo;
    out->lo = lo;
}

// Ends among four products; a 0 * infinity, or infinities of both signs, are the whole.
INLINE void ends(const real8 p[4], struct range *out)
{
    const real8 sum = p[0] + p[1] + p[2] + p[3];
    real8 a, b, c, d;
    least(&p[0], &p[1], &a);
    least(&p[2], &p[3], &b);
    greatest(&p[0], &p[1], &c);
    greatest(&p[2], &p[3], &d);
    least(&a, &b, &out->lo);
    greatest(&c, &d, &out->hi);
    widen(out);
    whole_unless((const mask8[]){sum == sum}, out);
}

INLINE void multiply(const struct range *a, const struct range *b, struct range *out)
{
    const real8 p[4] = {a->lo * b->lo, a->lo * b->hi, a->hi * b->lo, a->hi * b->hi};
    ends(p, out);
}

INLINE void divide(const struct range *a, const struct range *b, struct range *out)
{
    const real8 zero = {0};
    const mask8 good = (b->lo > zero) | (b->hi < zero);
    const real8 p[4] = {a->lo / b->lo, a->lo / b->hi, a->hi / b->lo, a->hi / b->hi};
    ends(p, out);
    whole_unless(&good, out);
}

INLINE void square(const struct range *a, struct range *out)
{
    const real8 zero = {0}, p = a->lo * a->lo, q = a->hi * a->hi;
    real8 lo, hi;
    least(&p, &q, &lo);
    greatest(&p, &q, &hi);
    const mask8 good = (a->lo > zero - INFINITY) | (a->hi < zero + INFINITY);
    select((const mask8[]){(a->lo > zero) | (a->hi < zero)}, &lo, &zero, &lo);
    out->lo = lo;
    out->hi = hi;
    widen(out);
    whole_unless(&good, out);
}

INLINE void absolute_value(const struct range *a, struct range *out)
{
    const real8 zero = {0};
    const mask8 good = (a->lo > zero - INFINITY) | (a->hi < zero + INFINITY);
    real8 p, q, lo;
    absolute(&a->lo, &p);
    absolute(&a->hi, &q);
    least(&p, &q, &lo);
    select((const mask8[]){(a->lo > zero) | (a->hi < zero)}, &lo, &zero, &lo);
    greatest(&p, &q, &out->hi);
    out->lo = lo;
    whole_unless(&good, out);
}

INLINE void root(const struct range *a, struct range *out)
{
    const real8 zero = {0};
    const mask8 good = a->lo >= zero;
    for (int l = 0; l < TAPE_LANES; l++) {
        out->lo[l] = sqrt(a->lo[l] > 0 ? a->lo[l] : 0);
        out->hi[l] = sqrt(a->hi[l] > 0 ? a->hi[l] : 0);
    }
    widen(out);
    whole_unless(&good, out);
}

INLINE void scale(const struct range *by, const struct range *d, unsigned moving,
                  struct range *out)
{
    for (int i = 0; i < 3; i++)
        if (moving >> i & 1)
            multiply(by, &d[i], &out[i]);
}

INLINE void scale_twice(const struct range *by_a, const struct reg *a, unsigned moving_a,
                        const struct range *by_b, const struct reg *b, unsigned moving_b,
                        struct range *out)
{
    for (int i = 0; i < 3; i++) {
        struct range p, q;
        const unsigned x = moving_a >> i & 1, y = moving_b >> i & 1;
        if (x)
            multiply(by_a, &a->d[i], &p);
        if (y)
            multiply(by_b, &b->d[i], &q);
        if (x && y)
            add(&p, &q, &out[i]);
        else if (x)
            out[i] = p;
        else if (y)
            out[i] = q;
    }
}

INLINE void size_of(const struct range *a, real8 *out)
{
    real8 p, q;
    absolute(&a->lo, &p);
    absolute(&a->hi, &q);
    greatest(&p, &q, out);
}

// No length grows faster than its sides.
INLINE void limit(const struct reg *a, const struct reg *b, const struct reg *c,
                  struct range *d)
{
    for (int i = 0; i < 3; i++) {
        real8 p, q, most;
        size_of(&a->d[i], &p);
        size_of(&b->d[i], &q);
        most = p + q;
        if (c) {
            size_of(&c->d[i], &p);
            most += p;
        }
        most += most * (8 * INTERVAL_ROUNDING);
        const real8 least_slope = -most;
        greatest(&d[i].lo, &least_slope, &d[i].lo);
        least(&d[i].hi, &most, &d[i].hi);
    }
}

// The smaller (larger) of two, and the slopes of both where it is not certain which.
INLINE void extreme(bool max, const struct reg *a, const struct reg *b, struct reg *out)
{
    const real8 zero = {0}, most = zero + INFINITY;
    const mask8 whole_a = (a->v.lo == -most) & (a->v.hi == most);
    const mask8 whole_b = (b->v.lo == -most) & (b->v.hi == most);
    const mask8 good = ~(whole_a | whole_b);
    const mask8 first = good & (max ? a->v.lo > b->v.hi : a->v.hi < b->v.lo);
    const mask8 second = good & (max ? b->v.lo > a->v.hi : b->v.hi < a->v.lo);
    for (int i = 0; i < 3; i++) {
        struct range r;
        least(&a->d[i].lo, &b->d[i].lo, &r.lo);
        greatest(&a->d[i].hi, &b->d[i].hi, &r.hi);
        select(&first, &a->d[i].lo, &r.lo, &r.lo);
        select(&first, &a->d[i].hi, &r.hi, &r.hi);
        select(&second, &b->d[i].lo, &r.lo, &out->d[i].lo);
        select(&second, &b->d[i].hi, &r.hi, &out->d[i].hi);
    }
    struct range v;
    if (max) {
        greatest(&a->v.lo, &b->v.lo, &v.lo);
        greatest(&a->v.hi, &b->v.hi, &v.hi);
    } else {
        least(&a->v.lo, &b->v.lo, &v.lo);
        least(&a->v.hi, &b->v.hi, &v.hi);
    }
    whole_unless(&good, &v);
    out->v = v;
}

// ---- lane by lane -------------------------------------------------------------------

static void get(const struct reg *r, int l, struct tape_slope *out)
{
    out->v = interval(r->v.lo[l], r->v.hi[l]);
    for (int i = 0; i < 3; i++)
        out->d[i] = interval(r->d[i].lo[l], r->d[i].hi[l]);
}

static void set(struct reg *r, int l, const struct tape_slope *v)
{
    r->v.lo[l] = v->v.lo;
    r->v.hi[l] = v->v.hi;
    for (int i = 0; i < 3; i++) {
        r->d[i].lo[l] = v->d[i].lo;
        r->d[i].hi[l] = v->d[i].hi;
    }
}

static void by_lanes(const struct tape *t, const struct tape_step *s, struct reg *r,
                     int n)
{
    struct tape_slope in[TAPE_LIST_MAX], out[TAPE_WIDTH_MAX] = {0};
    const bool call = s->op == TAPE_EXTERN || s->op == TAPE_CALL || s->op == TAPE_SUM ||
                      s->op == TAPE_PRODUCT;
    const int width =
        s->op == TAPE_EXTERN ? ((const struct tape_extern *)s->callee)->width : 1;
    const uint16_t operand[4] = {s->a, s->b, s->c, s->d};
    for (int l = 0; l < TAPE_LANES; l++) {
        for (uint32_t i = 0; i < (call ? s->count : 4); i++)
            get(&r[call ? t->list[s->list + i] : operand[i]], l, &in[i]);
        if (call)
            tape_bounds_call(s, in, n, out);
        else
            tape_bounds_step((enum tape_op)s->op, &in[0], &in[1], &in[2], &in[3], n, out);
        for (int i = 0; i < width; i++)
            set(&r[s->to + i], l, &out[i]);
    }
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

// ---- the tape -----------------------------------------------------------------------

INLINE void step(const struct tape *t, const struct tape_step *s, struct reg *r,
                 const uint8_t *moving)
{
    const struct reg *a = &r[s->a], *b = &r[s->b];
    const unsigned m = moving[s->a], n = moving[s->b];
    struct reg v = {0};
    struct range by, other;
    switch ((enum tape_op)s->op) {
    case TAPE_NEGATE:
        negate(&a->v, &v.v);
        for (int i = 0; i < 3; i++)
            negate(&a->d[i], &v.d[i]);
        break;
    case TAPE_SQUARE:
        square(&a->v, &v.v);
        by.lo = 2 * a->v.lo;
        by.hi = 2 * a->v.hi;
        scale(&by, a->d, m, v.d);
        break;
    case TAPE_ABS: {
        const real8 zero = {0}, one = zero + 1, less = zero - 1;
        absolute_value(&a->v, &v.v);
        select((const mask8[]){a->v.lo > zero}, &one, &less, &by.lo);
        select((const mask8[]){a->v.hi < zero}, &less, &one, &by.hi);
        scale(&by, a->d, m, v.d);
        break;
    }
    case TAPE_SQRT: {
        const real8 zero = {0};
        const struct range half = {zero + 0.5, zero + 0.5};
        root(&a->v, &v.v);
        divide(&half, &v.v, &by);
        scale(&by, a->d, m, v.d);
        break;
    }
    case TAPE_LENGTH: {
        const real8 zero = {0};
        const struct range half = {zero + 0.5, zero + 0.5};
        root(&a->v, &v.v);
        divide(&half, &v.v, &by);
        scale(&by, a->d, m, v.d);
        limit(b, &r[s->c], s->b == s->d ? NULL : &r[s->d], v.d);
        break;
    }
    case TAPE_ADD:
        add(&a->v, &b->v, &v.v);
        for (int i = 0; i < 3; i++)
            if (m & n & 1u << i)
                add(&a->d[i], &b->d[i], &v.d[i]);
            else
                v.d[i] = m >> i & 1 ? a->d[i] : b->d[i];
        break;
    case TAPE_SUBTRACT:
        negate(&b->v, &other);
        add(&a->v, &other, &v.v);
        for (int i = 0; i < 3; i++) {
            negate(&b->d[i], &other);
            if (m & n & 1u << i)
                add(&a->d[i], &other, &v.d[i]);
            else
                v.d[i] = m >> i & 1 ? a->d[i] : other;
        }
        break;
    case TAPE_MULTIPLY:
        multiply(&a->v, &b->v, &v.v);
        scale_twice(&b->v, a, m, &a->v, b, n, v.d);
        break;
    case TAPE_DIVIDE: {
        const real8 zero = {0};
        const struct range one = {zero + 1, zero + 1};
        divide(&a->v, &b->v, &v.v);
        divide(&one, &b->v, &by);
        divide(&v.v, &b->v, &other);
        negate(&other, &other);
        scale_twice(&by, a, m, &other, b, n, v.d);
        break;
    }
    case TAPE_MIN: extreme(false, a, b, &v); break;
    case TAPE_MAX: extreme(true, a, b, &v); break;
    default: by_lanes(t, s, r, moving_of(t, s, moving) ? 3 : 0); return;
    }
    r[s->to] = v;
}

INLINE void run(const struct tape *t, const struct tape_boxes *in, bool slopes,
                struct tape_slopes *out)
{
    struct reg r[PACKET_REGISTERS_MAX];
    uint8_t moving[PACKET_REGISTERS_MAX];
    const real8 zero = {0};
    memset(r, 0, t->constant_count * sizeof *r);
    for (uint32_t i = 0; i < t->constant_count; i++) {
        r[i].v.lo = r[i].v.hi = zero + t->constant[i];
        moving[i] = 0;
    }
    for (int i = 0; i < 3 && i < t->arguments; i++) {
        struct reg *to = &r[t->constant_count + (uint32_t)i];
        *to = (struct reg){0};
        memcpy(&to->v.lo, in->lo[i], sizeof to->v.lo);
        memcpy(&to->v.hi, in->hi[i], sizeof to->v.hi);
        to->d[i].lo = to->d[i].hi = zero + (slopes ? 1 : 0);
        moving[t->constant_count + (uint32_t)i] = slopes ? (uint8_t)(1u << i) : 0;
    }
    for (uint32_t i = 0; i < t->step_count; i++) {
        const struct tape_step *s = &t->step[i];
        const unsigned m = moving_of(t, s, moving);
        step(t, s, r, moving);
        const uint32_t width =
            s->op == TAPE_EXTERN
                ? (uint32_t)((const struct tape_extern *)s->callee)->width
                : 1;
        for (uint32_t k = 0; k < width; k++)
            moving[s->to + k] = (uint8_t)m;
    }
    const struct reg *v = &r[t->result[0]];
    memcpy(out->lo, &v->v.lo, sizeof out->lo);
    memcpy(out->hi, &v->v.hi, sizeof out->hi);
    for (int i = 0; i < 3; i++) {
        memcpy(out->slope_lo[i], &v->d[i].lo, sizeof out->slope_lo[i]);
        memcpy(out->slope_hi[i], &v->d[i].hi, sizeof out->slope_hi[i]);
    }
}

static void run_base(const struct tape *t, const struct tape_boxes *in, bool slopes,
                     struct tape_slopes *out)
{
    run(t, in, slopes, out);
}

#if defined(__x86_64__) && defined(__GNUC__)
__attribute__((target("avx2"))) static void run_avx2(const struct tape *t,
                                                     const struct tape_boxes *in,
                                                     bool slopes, struct tape_slopes *out)
{
    run(t, in, slopes, out);
}

__attribute__((target("avx512f,avx512dq,avx512vl,prefer-vector-width=512"))) static void
run_avx512(const struct tape *t, const struct tape_boxes *in, bool slopes,
           struct tape_slopes *out)
{
    run(t, in, slopes, out);
}
#endif

static void one_by_one(const struct tape *t, const struct tape_boxes *in, bool slopes,
                       struct tape_slopes *out)
{
    for (int l = 0; l < TAPE_LANES; l++) {
        struct tape_slope arg[3];
        for (int i = 0; i < 3; i++) {
            arg[i].v = interval(in->lo[i][l], in->hi[i][l]);
            for (int k = 0; k < 3; k++)
                arg[i].d[k] = interval_point(slopes && i == k);
        }
        const struct tape_slope r = tape_bounds_slope(t, arg, 3);
        out->lo[l] = r.v.lo;
        out->hi[l] = r.v.hi;
        for (int i = 0; i < 3; i++) {
            out->slope_lo[i][l] = r.d[i].lo;
            out->slope_hi[i][l] = r.d[i].hi;
        }
    }
}

void tape_bounds_packet(const struct tape *t, const struct tape_boxes *in, bool slopes,
                        struct tape_slopes *out)
{
    if (t->register_count > PACKET_REGISTERS_MAX || t->arguments > 3) {
        one_by_one(t, in, slopes, out);
        return;
    }
#if defined(__x86_64__) && defined(__GNUC__)
    if (__builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl")) {
        run_avx512(t, in, slopes, out);
        return;
    }
    if (__builtin_cpu_supports("avx2")) {
        run_avx2(t, in, slopes, out);
        return;
    }
#endif
    run_base(t, in, slopes, out);
}
