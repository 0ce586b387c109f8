// Running a tape at one point, at eight, and with derivatives (tape.h).
#include <string.h>

#include "scene/tape_kernel.h"
#include "scene/tape_steps.h"

int tape_arguments(const struct tape *t) { return t->arguments; }
int tape_width(const struct tape *t) { return t->width; }
bool tape_is_opaque(const struct tape *t) { return t->opaque; }
uint32_t tape_length(const struct tape *t) { return t->step_count; }

// ---- one point ----------------------------------------------------------------------

// Beyond 2^53 adding 1 changes nothing.
double tape_turns(double from, double to)
{
    if (!(from <= to))
        return 0;
    return from >= -0x1p53 && to <= 0x1p53 ? floor(to - from) + 1 : INFINITY;
}

// `left`: the turns that loops may still take; false: not enough, and no number comes of it.
static bool run(const struct tape *t, const double *argument, double *out, double *left);

static bool looped(const struct tape *body, bool product, const double *in,
                   uint32_t count, double *left, double *out)
{
    double args[TAPE_LIST_MAX], total = product, term;
    *left -= tape_turns(in[0], in[1]);
    bool whole = *left >= 0;
    memcpy(args + 1, in + 2, (count - 2) * sizeof *args);
    for (double k = in[0]; whole && k <= in[1]; k++) {
        args[0] = k;
        whole = run(body, args, &term, left);
        total = product ? total * term : total + term;
    }
    *out = whole ? total : NAN;
    return whole;
}

static bool called(const struct tape *t, const struct tape_step *s, double *r,
                   double *left)
{
    double in[TAPE_LIST_MAX], out[TAPE_WIDTH_MAX];
    for (uint32_t i = 0; i < s->count; i++)
        in[i] = r[t->list[s->list + i]];
    if (s->op == TAPE_EXTERN) {
        const struct tape_extern *f = s->callee;
        f->value(s->data, in, out);
        memcpy(r + s->to, out, (size_t)f->width * sizeof *r);
        return true;
    }
    if (s->op == TAPE_CALL)
        return run(s->callee, in, r + s->to, left);
    return looped(s->callee, s->op == TAPE_PRODUCT, in, s->count, left, r + s->to);
}

static bool run(const struct tape *t, const double *argument, double *out, double *left)
{
    double r[TAPE_REGISTERS_MAX];
    bool whole = true;
    for (uint32_t i = 0; i < t->constant_count; i++)
        r[i] = t->constant[i];
    for (int i = 0; i < t->arguments; i++)
        r[t->constant_count + (uint32_t)i] = argument[i];
    for (const struct tape_step *s = t->step, *end = s + t->step_count; s < end; s++) {
        const double a = r[s->a], b = r[s->b];
        switch ((enum tape_op)s->op) {
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        r[s->to] = value;                                                                \
        break;
#define BINARY(name, value, by_a, by_b) UNARY(name, value, 0)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
        case TAPE_LENGTH: r[s->to] = sqrt(a); break;
        case TAPE_SELECT: r[s->to] = a < 0 ? b : a == 0 ? r[s->c] : r[s->d]; break;
        default: whole &= called(t, s, r, left);
        }
    }
    for (int i = 0; i < t->width; i++)
        out[i] = r[t->result[i]];
    return whole;
}

bool tape_run(const struct tape *t, const double *argument, double *out)
{
    double left = TAPE_TURNS_MAX;
    return run(t, argument, out, &left);
}

double tape_at(const void *tape, struct vec3 p)
{
    double out[TAPE_WIDTH_MAX];
    tape_run(tape, (const double[]){p.x, p.y, p.z}, out);
    return out[0];
}

// ---- eight points -------------------------------------------------------------------

typedef double lanes[TAPE_LANES];

void tape_call_packet(const struct noise_kernels *k, const struct tape_step *s,
                      const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES])
{
    const struct tape_extern *f = s->op == TAPE_EXTERN ? s->callee : NULL;
    if (f && f->values && k) {
        f->values(k, s->data, in, out);
        return;
    }
    for (int l = 0; l < TAPE_LANES; l++) {
        double one[TAPE_LIST_MAX], v[TAPE_WIDTH_MAX];
        for (uint32_t i = 0; i < s->count; i++)
            one[i] = in[i][l];
        if (f) {
            f->value(s->data, one, v);
        } else if (s->op == TAPE_CALL) {
            tape_run(s->callee, one, v);
        } else {
            double left = TAPE_TURNS_MAX;
            looped(s->callee, s->op == TAPE_PRODUCT, one, s->count, &left, v);
        }
        for (int i = 0; i < (f ? f->width : 1); i++)
            out[i][l] = v[i];
    }
}

static void called_packet(const struct tape *t, const struct tape_step *s, lanes *r)
{
    double in[TAPE_LIST_MAX][TAPE_LANES], out[TAPE_WIDTH_MAX][TAPE_LANES];
    const int width =
        s->op == TAPE_EXTERN ? ((const struct tape_extern *)s->callee)->width : 1;
    for (uint32_t i = 0; i < s->count; i++)
        memcpy(in[i], r[t->list[s->list + i]], sizeof *in);
    tape_call_packet(tape_kernels_best()->noise, s, (const double(*)[TAPE_LANES])in, out);
    for (int i = 0; i < width; i++)
        memcpy(r[s->to + i], out[i], sizeof *r);
}

static void step_packet(const struct tape *t, const struct tape_step *s, lanes *r)
{
    double *to = r[s->to];
    const double *x = r[s->a], *y = r[s->b], *z = r[s->c], *w = r[s->d];
    lanes v;
    switch ((enum tape_op)s->op) {
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        for (int l = 0; l < TAPE_LANES; l++) {                                           \
            const double a = x[l], b = y[l];                                             \
            (void)b;                                                                     \
            v[l] = value;                                                                \
        }                                                                                \
        memcpy(to, v, sizeof v);                                                         \
        break;
#define BINARY(name, value, by_a, by_b) UNARY(name, value, 0)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    case TAPE_LENGTH:
        for (int l = 0; l < TAPE_LANES; l++)
            v[l] = sqrt(x[l]);
        memcpy(to, v, sizeof v);
        break;
    case TAPE_SELECT:
        for (int l = 0; l < TAPE_LANES; l++)
            v[l] = x[l] < 0 ? y[l] : x[l] == 0 ? z[l] : w[l];
        memcpy(to, v, sizeof v);
        break;
    default: called_packet(t, s, r);
    }
}

void tape_run_packet(const struct tape *t, const double (*argument)[TAPE_LANES],
                     double (*out)[TAPE_LANES])
{
    lanes r[TAPE_REGISTERS_MAX];
    for (uint32_t i = 0; i < t->constant_count; i++)
        for (int l = 0; l < TAPE_LANES; l++)
            r[i][l] = t->constant[i];
    for (int i = 0; i < t->arguments; i++)
        memcpy(r[t->constant_count + (uint32_t)i], argument[i], sizeof *r);
    for (uint32_t i = 0; i < t->step_count; i++)
        step_packet(t, &t->step[i], r);
    for (int i = 0; i < t->width; i++)
        memcpy(out[i], r[t->result[i]], sizeof *out);
}

// ---- with derivatives ---------------------------------------------------------------

struct dual {
    double v, d[TAPE_PARTIALS];
};

static struct dual run_dual(const struct tape *t, const struct dual *argument);

static struct dual chained(double v, double by_a, struct dual a, double by_b,
                           struct dual b)
{
    struct dual r = {.v = v};
    for (int i = 0; i < TAPE_PARTIALS; i++)
        r.d[i] = (a.d[i] == 0 ? 0 : by_a * a.d[i]) + (b.d[i] == 0 ? 0 : by_b * b.d[i]);
    return r;
}

// From the bounds at the point.
static bool known_slopes(const struct tape_step *s, const struct dual *in, struct dual *r)
{
    const struct tape_extern *f = s->callee;
    struct interval at[TAPE_EXTERN_ARGUMENTS], out[TAPE_WIDTH_MAX],
        partial[TAPE_WIDTH_MAX * TAPE_EXTERN_ARGUMENTS];
    for (uint32_t i = 0; i < s->count; i++)
        at[i] = interval_point(in[i].v);
    f->bounds(s->data, at, out, partial);
    for (int i = 0; i < f->width; i++)
        for (int k = 0; k < TAPE_PARTIALS; k++) {
            r[i].d[k] = 0;
            for (uint32_t j = 0; j < s->count; j++)
                if (in[j].d[k] != 0)
                    r[i].d[k] +=
                        in[j].d[k] * interval_middle(partial[(uint32_t)i * s->count + j]);
            if (!isfinite(r[i].d[k]))
                return false;
        }
    return true;
}

// By differences where the extern says nothing of its slopes.
static void extern_dual(const struct tape_step *s, const struct dual *in, struct dual *r)
{
    const struct tape_extern *f = s->callee;
    double at[TAPE_EXTERN_ARGUMENTS], out[TAPE_WIDTH_MAX], below[TAPE_WIDTH_MAX],
        above[TAPE_WIDTH_MAX];
    for (uint32_t i = 0; i < s->count; i++)
        at[i] = in[i].v;
    f->value(s->data, at, out);
    for (int i = 0; i < f->width; i++)
        r[i] = (struct dual){.v = out[i]};
    if (f->bounds && known_slopes(s, in, r))
        return;
    for (int k = 0; k < TAPE_PARTIALS; k++) {
        double size = 0, place = 0;
        for (uint32_t i = 0; i < s->count; i++) {
            size = fmax(size, fabs(in[i].d[k]));
            place = fmax(place, in[i].d[k] == 0 ? 0 : fabs(in[i].v));
        }
        if (!(size > 0))
            continue;
        // The cube root of the rounding balances it against the third derivative.
        const double h = (0.1 + place) * 0x1p-18 / size;
        for (uint32_t i = 0; i < s->count; i++)
            at[i] = in[i].v - h * in[i].d[k];
        f->value(s->data, at, below);
        for (uint32_t i = 0; i < s->count; i++)
            at[i] = in[i].v + h * in[i].d[k];
        f->value(s->data, at, above);
        for (int i = 0; i < f->width; i++)
            r[i].d[k] = (above[i] - below[i]) / (2 * h);
    }
}

static struct dual looped_dual(const struct tape *body, bool product,
                               const struct dual *in, uint32_t count)
{
    struct dual args[TAPE_LIST_MAX], total = {.v = product};
    if (!(tape_turns(in[0].v, in[1].v) <= TAPE_TURNS_MAX))
        return (struct dual){.v = NAN};
    memcpy(args + 1, in + 2, (count - 2) * sizeof *args);
    for (double k = in[0].v; k <= in[1].v; k++) {
        args[0] = in[0];
        args[0].v = k;
        const struct dual term = run_dual(body, args);
        total = product ? chained(total.v * term.v, term.v, total, total.v, term)
                        : chained(total.v + term.v, 1, total, 1, term);
    }
    return total;
}

static void called_dual(const struct tape *t, const struct tape_step *s, struct dual *r)
{
    struct dual in[TAPE_LIST_MAX];
    for (uint32_t i = 0; i < s->count; i++)
        in[i] = r[t->list[s->list + i]];
    if (s->op == TAPE_EXTERN)
        extern_dual(s, in, r + s->to);
    else if (s->op == TAPE_CALL)
        r[s->to] = run_dual(s->callee, in);
    else
        r[s->to] = looped_dual(s->callee, s->op == TAPE_PRODUCT, in, s->count);
}

static void step_dual(const struct tape *t, const struct tape_step *s, struct dual *r)
{
    const struct dual x = r[s->a], y = r[s->b];
    const double a = x.v, b = y.v;
    double v;
    (void)b;
    switch ((enum tape_op)s->op) {
#define UNARY(name, value, derivative)                                                   \
    case TAPE_##name:                                                                    \
        v = value;                                                                       \
        r[s->to] = chained(v, derivative, x, 0, (struct dual){0});                       \
        break;
#define BINARY(name, value, by_a, by_b)                                                  \
    case TAPE_##name:                                                                    \
        v = value;                                                                       \
        r[s->to] = chained(v, by_a, x, by_b, y);                                         \
        break;
#include "scene/tape.def"
#undef UNARY
#undef BINARY
    case TAPE_LENGTH:
        v = sqrt(a);
        r[s->to] = chained(v, 0.5 / v, x, 0, (struct dual){0});
        break;
    case TAPE_SELECT: r[s->to] = a < 0 ? y : a == 0 ? r[s->c] : r[s->d]; break;
    default: called_dual(t, s, r);
    }
}

static struct dual run_dual(const struct tape *t, const struct dual *argument)
{
    struct dual r[TAPE_REGISTERS_MAX];
    for (uint32_t i = 0; i < t->constant_count; i++)
        r[i] = (struct dual){.v = t->constant[i]};
    memcpy(r + t->constant_count, argument, (size_t)t->arguments * sizeof *r);
    for (uint32_t i = 0; i < t->step_count; i++)
        step_dual(t, &t->step[i], r);
    return r[t->result[0]];
}

double tape_gradient(const struct tape *t, const double *argument, int partials,
                     double *gradient)
{
    struct dual in[TAPE_ARGUMENTS_MAX];
    for (int i = 0; i < t->arguments; i++) {
        in[i] = (struct dual){.v = argument[i]};
        if (i < partials)
            in[i].d[i] = 1;
    }
    const struct dual r = run_dual(t, in);
    memcpy(gradient, r.d, (size_t)partials * sizeof *gradient);
    return r.v;
}
