// Running a tape over boxes of arguments (tape.h).
#include <string.h>

#include "math/pi.h"
#include "scene/tape_steps.h"

#define ZERO interval_point(0)

// ---- values -------------------------------------------------------------------------

static struct interval truth(bool never, bool always)
{
    return interval(always ? 1 : 0, never ? 0 : 1);
}

static struct interval integer(struct interval a)
{
    if (!(a.lo > -2147483649.0 && a.hi < 2147483648.0))
        return interval(-2147483648.0, 2147483647.0);
    return interval(trunc(a.lo), trunc(a.hi));
}

static bool never_zero(struct interval a) { return a.lo > 0 || a.hi < 0; }

static struct interval value_of(enum tape_op op, struct interval a, struct interval b)
{
    switch (op) {
    case TAPE_NEGATE: return interval_negate(a);
    case TAPE_SQUARE: return interval_square(a);
    case TAPE_ABS: return interval_abs(a);
    case TAPE_FLOOR: return interval_floor(a);
    case TAPE_CEIL: return interval_ceil(a);
    case TAPE_INTEGER: return integer(a);
    case TAPE_SQRT: return interval_sqrt(a);
    case TAPE_EXP: return interval_exp(a);
    case TAPE_LOG: return interval_log(a);
    case TAPE_LOG10: return interval_log10(a);
    case TAPE_SIN: return interval_sin(a);
    case TAPE_COS: return interval_cos(a);
    case TAPE_TAN: return interval_tan(a);
    case TAPE_ASIN: return interval_asin(a);
    case TAPE_ACOS: return interval_acos(a);
    case TAPE_ATAN: return interval_atan(a);
    case TAPE_SINH: return interval_sinh(a);
    case TAPE_COSH: return interval_cosh(a);
    case TAPE_TANH: return interval_tanh(a);
    case TAPE_ASINH: return interval_asinh(a);
    case TAPE_ACOSH: return interval_acosh(a);
    case TAPE_ATANH: return interval_atanh(a);
    case TAPE_ADD: return interval_add(a, b);
    case TAPE_SUBTRACT: return interval_subtract(a, b);
    case TAPE_MULTIPLY: return interval_multiply(a, b);
    case TAPE_DIVIDE: return interval_divide(a, b);
    case TAPE_MIN: return interval_min(a, b);
    case TAPE_MAX: return interval_max(a, b);
    case TAPE_MOD: return interval_mod(a, b);
    case TAPE_ATAN2: return interval_atan2(a, b);
    case TAPE_POW: return interval_pow(a, b);
    case TAPE_LESS: return truth(a.lo >= b.hi, a.hi < b.lo);
    case TAPE_GREATER: return truth(a.hi <= b.lo, a.lo > b.hi);
    case TAPE_LESS_EQUAL: return truth(a.lo > b.hi, a.hi <= b.lo);
    case TAPE_GREATER_EQUAL: return truth(a.hi < b.lo, a.lo >= b.hi);
    case TAPE_EQUAL:
        return truth(a.lo > b.hi || a.hi < b.lo,
                     interval_is_point(a) && a.lo == b.lo && a.hi == b.hi);
    case TAPE_NOT_EQUAL:
        return truth(interval_is_point(a) && a.lo == b.lo && a.hi == b.hi,
                     a.lo > b.hi || a.hi < b.lo);
    case TAPE_AND:
        return truth(interval_is_zero(a) || interval_is_zero(b),
                     never_zero(a) && never_zero(b));
    case TAPE_OR:
        return truth(interval_is_zero(a) && interval_is_zero(b),
                     never_zero(a) || never_zero(b));
    default: return interval_whole();
    }
}

// ---- slopes -------------------------------------------------------------------------

static struct interval reciprocal(struct interval a)
{
    return interval_divide(interval_point(1), a);
}

static struct interval one_plus(struct interval a)
{
    return interval_add(interval_point(1), a);
}

static struct interval one_minus(struct interval a)
{
    return interval_subtract(interval_point(1), a);
}

static struct interval half_over(struct interval a)
{
    return interval_divide(interval_point(0.5), a);
}

// A step function has slope 0 between its steps.
static struct interval flat(struct interval v)
{
    return interval_is_point(v) ? ZERO : interval_whole();
}

// The derivative of a unary operation, or of a binary one by its first operand.
static struct interval by_first(enum tape_op op, struct interval a, struct interval b,
                                struct interval v)
{
    switch (op) {
    case TAPE_NEGATE: return interval_point(-1);
    case TAPE_SQUARE: return interval(2 * a.lo, 2 * a.hi);
    case TAPE_ABS: return interval(a.lo > 0 ? 1 : -1, a.hi < 0 ? -1 : 1);
    case TAPE_SQRT: return half_over(v);
    case TAPE_EXP: return v;
    case TAPE_LOG: return reciprocal(a);
    case TAPE_LOG10:
        return interval_multiply(interval_point(TAPE_LOG10_E), reciprocal(a));
    case TAPE_SIN: return interval_cos(a);
    case TAPE_COS: return interval_negate(interval_sin(a));
    case TAPE_TAN: return one_plus(interval_square(v));
    case TAPE_ASIN: return reciprocal(interval_sqrt(one_minus(interval_square(a))));
    case TAPE_ACOS:
        return interval_negate(reciprocal(interval_sqrt(one_minus(interval_square(a)))));
    case TAPE_ATAN: return reciprocal(one_plus(interval_square(a)));
    case TAPE_SINH: return interval_cosh(a);
    case TAPE_COSH: return interval_sinh(a);
    case TAPE_TANH: return one_minus(interval_square(v));
    case TAPE_ASINH: return reciprocal(interval_sqrt(one_plus(interval_square(a))));
    case TAPE_ACOSH:
        return reciprocal(
            interval_sqrt(interval_subtract(interval_square(a), interval_point(1))));
    case TAPE_ATANH: return reciprocal(one_minus(interval_square(a)));
    case TAPE_ADD:
    case TAPE_SUBTRACT: return interval_point(1);
    case TAPE_MULTIPLY: return b;
    case TAPE_DIVIDE: return reciprocal(b);
    case TAPE_ATAN2:
        if (a.lo <= 0 && a.hi >= 0 && b.lo <= 0)
            return interval_whole();
        return interval_divide(b, interval_add(interval_square(a), interval_square(b)));
    case TAPE_POW:
        return interval_is_zero(b)
                   ? ZERO
                   : interval_multiply(
                         b, interval_pow(a, interval_subtract(b, interval_point(1))));
    default: return flat(v);
    }
}

static struct interval by_second(enum tape_op op, struct interval a, struct interval b,
                                 struct interval v)
{
    switch (op) {
    case TAPE_ADD: return interval_point(1);
    case TAPE_SUBTRACT: return interval_point(-1);
    case TAPE_MULTIPLY: return a;
    case TAPE_DIVIDE: return interval_negate(interval_divide(v, b));
    case TAPE_ATAN2:
        if (a.lo <= 0 && a.hi >= 0 && b.lo <= 0)
            return interval_whole();
        return interval_negate(
            interval_divide(a, interval_add(interval_square(a), interval_square(b))));
    case TAPE_POW: return interval_multiply(v, interval_log(a));
    default: return flat(v);
    }
}

static struct interval times(struct interval by, struct interval d)
{
    return interval_is_zero(d) ? ZERO : interval_multiply(by, d);
}

static struct interval plus(struct interval a, struct interval b)
{
    return interval_is_zero(a) ? b : interval_is_zero(b) ? a : interval_add(a, b);
}

// fmod in one branch: its slope is 1 by the first operand.
static bool in_one_branch(struct interval a, struct interval b, struct interval v)
{
    const double slack = INTERVAL_ROUNDING * 4 * interval_size(a);
    return interval_is_point(b) && interval_width(v) <= interval_width(a) + slack &&
           trunc(a.lo / b.lo) == trunc(a.hi / b.lo);
}

static bool is_moving(const struct tape_slope *x, int n)
{
    for (int i = 0; i < n; i++)
        if (!interval_is_zero(x->d[i]))
            return true;
    return false;
}

static void join(struct tape_slope *to, const struct tape_slope *x, int n)
{
    to->v = interval_hull(to->v, x->v);
    for (int i = 0; i < n; i++)
        to->d[i] = interval_hull(to->d[i], x->d[i]);
}

static struct tape_slope least(enum tape_op op, const struct tape_slope *x,
                               const struct tape_slope *y, int n)
{
    const bool min = op == TAPE_MIN;
    if (!interval_is_whole(x->v) && !interval_is_whole(y->v)) {
        if (min ? x->v.hi < y->v.lo : x->v.lo > y->v.hi)
            return *x;
        if (min ? y->v.hi < x->v.lo : y->v.lo > x->v.hi)
            return *y;
    }
    struct tape_slope r = *x;
    join(&r, y, n);
    r.v = value_of(op, x->v, y->v);
    return r;
}

// A choice whose condition is not settled jumps.
static struct tape_slope chosen(const struct tape_slope *a, const struct tape_slope *b,
                                const struct tape_slope *c, const struct tape_slope *d,
                                int n)
{
    if (a->v.hi < 0)
        return *b;
    if (a->v.lo > 0)
        return *d;
    if (interval_is_zero(a->v))
        return *c;
    struct tape_slope r = *d;
    if (a->v.lo < 0)
        join(&r, b, n);
    if (interval_has(a->v, 0))
        join(&r, c, n);
    for (int i = 0; i < n; i++)
        if (!interval_is_zero(a->d[i]) || !interval_is_zero(r.d[i]))
            r.d[i] = interval_whole();
    return r;
}

// ---- calls --------------------------------------------------------------------------

static struct tape_slope run(const struct tape *t, const struct tape_slope *argument,
                             int n)
{
    struct tape_slope out[TAPE_WIDTH_MAX];
    tape_bounds_all(t, argument, n, out);
    return out[0];
}

enum { TURNS_MAX = 1000 }; // of a loop whose bounds are taken turn by turn

static struct tape_slope nothing_known(int n)
{
    struct tape_slope r = {.v = interval_whole()};
    for (int i = 0; i < n; i++)
        r.d[i] = interval_whole();
    return r;
}

static struct tape_slope combined(bool product, const struct tape_slope *x,
                                  const struct tape_slope *y, int n)
{
    struct tape_slope r;
    r.v = product ? interval_multiply(x->v, y->v) : interval_add(x->v, y->v);
    for (int i = 0; i < n; i++)
        r.d[i] = product ? plus(times(y->v, x->d[i]), times(x->v, y->d[i]))
                         : plus(x->d[i], y->d[i]);
    return r;
}

static struct tape_slope looped(const struct tape *body, bool product,
                                const struct tape_slope *in, uint32_t count, int n)
{
    struct tape_slope args[TAPE_LIST_MAX], total = {.v = interval_point(product)};
    const struct interval from = in[0].v, to = in[1].v;
    if (!interval_is_point(from) || floor(to.lo - from.lo) != floor(to.hi - from.lo) ||
        !(tape_turns(from.lo, to.hi) <= TURNS_MAX))
        return nothing_known(n);
    memcpy(args + 1, in + 2, (count - 2) * sizeof *args);
    for (double k = from.lo; k <= to.lo; k++) {
        args[0] = in[0];
        args[0].v = interval_point(k);
        const struct tape_slope term = run(body, args, n);
        total = combined(product, &total, &term, n);
    }
    return total;
}

static void extern_bounds(const struct tape_step *s, const struct tape_slope *in,
                          struct tape_slope *r, int n)
{
    const struct tape_extern *f = s->callee;
    struct interval at[TAPE_EXTERN_ARGUMENTS], out[TAPE_WIDTH_MAX],
        partial[TAPE_WIDTH_MAX * TAPE_EXTERN_ARGUMENTS];
    bool known = f->bounds != NULL;
    for (uint32_t i = 0; i < s->count; i++) {
        at[i] = in[i].v;
        known &= interval_size(at[i]) < INFINITY || f->anywhere;
    }
    for (int i = 0; i < f->width; i++)
        r[i] = nothing_known(n);
    if (!known)
        return;
    f->bounds(s->data, at, out, n ? partial : NULL);
    for (int i = 0; i < f->width; i++) {
        r[i].v = out[i];
        for (int k = 0; k < n; k++) {
            r[i].d[k] = ZERO;
            for (uint32_t j = 0; j < s->count; j++)
                r[i].d[k] = plus(r[i].d[k],
                                 times(partial[(uint32_t)i * s->count + j], in[j].d[k]));
        }
    }
}

void tape_bounds_call(const struct tape_step *s, const struct tape_slope *in, int n,
                      struct tape_slope *to)
{
    if (s->op == TAPE_EXTERN)
        extern_bounds(s, in, to, n);
    else if (s->op == TAPE_CALL)
        *to = run(s->callee, in, n);
    else
        *to = looped(s->callee, s->op == TAPE_PRODUCT, in, s->count, n);
}

static void called(const struct tape *t, const struct tape_step *s, struct tape_slope *r,
                   int n)
{
    struct tape_slope in[TAPE_LIST_MAX];
    for (uint32_t i = 0; i < s->count; i++)
        in[i] = r[t->list[s->list + i]];
    tape_bounds_call(s, in, n, r + s->to);
}

// ---- the tape -----------------------------------------------------------------------

static struct tape_slope unary(enum tape_op op, const struct tape_slope *x, int n)
{
    struct tape_slope r = {.v = value_of(op, x->v, x->v)};
    if (!n)
        return r;
    const struct interval by = is_moving(x, n) ? by_first(op, x->v, x->v, r.v) : ZERO;
    for (int i = 0; i < n; i++)
        r.d[i] = times(by, x->d[i]);
    return r;
}

static struct tape_slope binary(enum tape_op op, const struct tape_slope *x,
                                const struct tape_slope *y, int n)
{
    struct tape_slope r = {.v = value_of(op, x->v, y->v)};
    if (!n)
        return r;
    if (op == TAPE_MOD) {
        const bool one = in_one_branch(x->v, y->v, r.v);
        const struct interval turns = interval_point(-trunc(x->v.lo / y->v.lo));
        for (int i = 0; i < n; i++)
            r.d[i] = plus(times(one ? interval_point(1) : interval_whole(), x->d[i]),
                          times(one ? turns : interval_whole(), y->d[i]));
        return r;
    }
    const struct interval by_x = is_moving(x, n) ? by_first(op, x->v, y->v, r.v) : ZERO;
    const struct interval by_y = is_moving(y, n) ? by_second(op, x->v, y->v, r.v) : ZERO;
    for (int i = 0; i < n; i++)
        r.d[i] = plus(times(by_x, x->d[i]), times(by_y, y->d[i]));
    return r;
}

static void step(const struct tape *t, const struct tape_step *s, struct tape_slope *r,
                 int n)
{
    if (s->op == TAPE_EXTERN || s->op == TAPE_CALL || s->op == TAPE_SUM ||
        s->op == TAPE_PRODUCT)
        called(t, s, r, n);
    else
        tape_bounds_step((enum tape_op)s->op, &r[s->a], &r[s->b], &r[s->c], &r[s->d], n,
                         &r[s->to]);
}

static double largest(const struct tape_slope *x, int i)
{
    return interval_size(x->d[i]);
}

// By the derivative of the root, and by the sides: no length grows faster than they do.
static struct tape_slope length(const struct tape_slope *a, const struct tape_slope *b,
                                const struct tape_slope *c, const struct tape_slope *d,
                                int n)
{
    struct tape_slope r = unary(TAPE_SQRT, a, n);
    for (int i = 0; i < n; i++) {
        const double third = b == d ? 0 : largest(d, i);
        const double most =
            (largest(b, i) + largest(c, i) + third) * (1 + 8 * INTERVAL_ROUNDING);
        r.d[i] = interval(fmax(r.d[i].lo, -most), fmin(r.d[i].hi, most));
    }
    return r;
}

void tape_bounds_step(enum tape_op op, const struct tape_slope *a,
                      const struct tape_slope *b, const struct tape_slope *c,
                      const struct tape_slope *d, int n, struct tape_slope *to)
{
    switch (op) {
    case TAPE_MIN:
    case TAPE_MAX: *to = least(op, a, b, n); break;
    case TAPE_SELECT: *to = chosen(a, b, c, d, n); break;
    case TAPE_LENGTH: *to = length(a, b, c, d, n); break;
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        *to = unary(op, a, n);                                                           \
        break;
#define BINARY(name, value, by_a, by_b)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    default: *to = binary(op, a, b, n);
    }
}

void tape_bounds_all(const struct tape *t, const struct tape_slope *argument, int n,
                     struct tape_slope *out)
{
    struct tape_slope r[TAPE_REGISTERS_MAX];
    for (uint32_t i = 0; i < t->constant_count; i++)
        r[i] = (struct tape_slope){.v = interval_point(t->constant[i])};
    memcpy(r + t->constant_count, argument, (size_t)t->arguments * sizeof *r);
    for (uint32_t i = 0; i < t->step_count; i++)
        step(t, &t->step[i], r, n);
    for (int i = 0; i < t->width; i++)
        out[i] = r[t->result[i]];
}

static struct interval chosen_value(struct interval a, struct interval b,
                                    struct interval c, struct interval d)
{
    const struct tape_slope s[4] = {{.v = a}, {.v = b}, {.v = c}, {.v = d}};
    return chosen(&s[0], &s[1], &s[2], &s[3], 0).v;
}

static void called_values(const struct tape *t, const struct tape_step *s,
                          struct interval *r)
{
    struct tape_slope in[TAPE_LIST_MAX], out[TAPE_WIDTH_MAX] = {0};
    const int width =
        s->op == TAPE_EXTERN ? ((const struct tape_extern *)s->callee)->width : 1;
    for (uint32_t i = 0; i < s->count; i++)
        in[i] = (struct tape_slope){.v = r[t->list[s->list + i]]};
    tape_bounds_call(s, in, 0, out);
    for (int i = 0; i < width; i++)
        r[s->to + i] = out[i].v;
}

// The two ways past a jump: what the step gives on either side of it. An angle that jumps
// is often taken modulo its period, and a sawtooth squared, so that nothing jumps in the
// end; but the whole range between the two sides would hide that.
static bool splits(const struct tape_step *s, const struct interval *r,
                   struct interval side[2])
{
    const struct interval a = r[s->a], b = r[s->b];
    if (s->op == TAPE_SELECT && a.lo < 0 && a.hi >= 0) {
        side[0] = b;
        side[1] = interval_hull(r[s->c], r[s->d]);
        return side[0].hi < side[1].lo || side[1].hi < side[0].lo;
    }
    if (s->op == TAPE_ATAN2 && a.lo < 0 && a.hi >= 0 && b.hi < 0 &&
        interval_size(a) < INFINITY) {
        side[0] = interval_widened(det_atan2(a.hi, b.hi), PI, INTERVAL_ELEMENTARY);
        side[1] = interval_widened(-PI, det_atan2(a.lo, b.hi), INTERVAL_ELEMENTARY);
        return true;
    }
    if (s->op == TAPE_MOD && interval_is_point(b) && (a.lo >= 0 || a.hi <= 0)) {
        const double m = fabs(b.lo), p = fmod(a.lo, m), q = fmod(a.hi, m);
        if (!(a.hi - a.lo < 0.75 * m) || !(q < p))
            return false;
        side[0] = interval(p, a.lo >= 0 ? m : 0);
        side[1] = interval(a.lo >= 0 ? 0 : -m, q);
        return true;
    }
    return false;
}

static struct interval values(const struct tape *t, struct interval *r, uint32_t first,
                              int splits_left)
{
    for (const struct tape_step *s = t->step + first, *end = t->step + t->step_count;
         s < end; s++) {
        const struct interval a = r[s->a], b = r[s->b];
        struct interval side[2];
        if (splits_left > 0 && splits(s, r, side)) {
            struct interval other[TAPE_REGISTERS_MAX];
            const uint32_t next = (uint32_t)(s - t->step) + 1;
            memcpy(other, r, t->register_count * sizeof *r);
            other[s->to] = side[0];
            r[s->to] = side[1];
            return interval_hull(values(t, other, next, splits_left - 1),
                                 values(t, r, next, splits_left - 1));
        }
        switch ((enum tape_op)s->op) {
        case TAPE_ADD: r[s->to] = interval_add(a, b); break;
        case TAPE_SUBTRACT: r[s->to] = interval_subtract(a, b); break;
        case TAPE_MULTIPLY: r[s->to] = interval_multiply(a, b); break;
        case TAPE_SQUARE: r[s->to] = interval_square(a); break;
        case TAPE_LENGTH: r[s->to] = interval_sqrt(a); break;
        case TAPE_SELECT: r[s->to] = chosen_value(a, b, r[s->c], r[s->d]); break;
        case TAPE_EXTERN:
        case TAPE_CALL:
        case TAPE_SUM:
        case TAPE_PRODUCT: called_values(t, s, r); break;
        default: r[s->to] = value_of((enum tape_op)s->op, a, b);
        }
    }
    return r[t->result[0]];
}

enum { SPLITS_MAX = 3 }; // one inside the other

struct interval tape_bounds(const struct tape *t, const struct interval *argument)
{
    struct interval r[TAPE_REGISTERS_MAX];
    for (uint32_t i = 0; i < t->constant_count; i++)
        r[i] = interval_point(t->constant[i]);
    memcpy(r + t->constant_count, argument, (size_t)t->arguments * sizeof *r);
    return values(t, r, 0, SPLITS_MAX);
}

struct tape_slope tape_bounds_slope(const struct tape *t,
                                    const struct tape_slope *argument, int directions)
{
    struct tape_slope r = run(t, argument, directions);
    bool jumps = false;
    for (int i = 0; i < directions; i++)
        jumps |= interval_is_whole(r.d[i]);
    if (jumps) { // look at either side
        struct interval box[TAPE_ARGUMENTS_MAX];
        for (int i = 0; i < t->arguments; i++)
            box[i] = argument[i].v;
        const struct interval v = tape_bounds(t, box);
        r.v = interval(fmax(r.v.lo, v.lo), fmin(r.v.hi, v.hi));
    }
    return r;
}
