// The internal functions made of noise, and f_polytubes, whose steps depend on a
// parameter: they are written as steps of the tape where that parameter is a constant.
// f_ridged_mf keeps no table from its first call: other parameters later give their own
// value.

#include "eval/internal.h"

#include <string.h>

#include "math/elementary.h"
#include "scene/noise.h"
#include "scene/noise_kernel.h"

enum {
    OCTAVES_MAX = 1000,  // more change nothing that fits a double
    OCTAVES_UNROLL = 24, // written as steps
    TUBES_MAX = 100000,  // they overlap long before
    TUBES_UNROLL = 64,
};

static double square(double v) { return v * v; }

static int generator_of(double v) { return v > -2e9 && v < 2e9 ? (int)v & 3 : 0; }

static double octaves(double n) { return n > 0 ? fmin(n, OCTAVES_MAX) : 0; }

// ---- plain noise --------------------------------------------------------------------

static double noise_in(struct vec3 at, double generator)
{
    return noise_value(at, generator_of(generator));
}

static int default_generator(const void *data)
{
    const struct pattern_defaults *d = data;
    return d ? d->noise_generator : NOISE_RANGE_CORRECTED;
}

static void noise3d(const void *data, const double *in, double *out)
{
    out[0] = noise_value(vec3(in[0], in[1], in[2]), default_generator(data));
}

static void plain_bounds(int generator, const struct interval *in, struct interval *out,
                         struct interval *partial)
{
    struct interval slope[3];
    noise_bounds(in, generator, out, slope);
    for (int i = 0; partial && i < 3; i++)
        partial[i] = slope[i];
}

static void noise3d_bounds(const void *data, const struct interval *in,
                           struct interval *out, struct interval *partial)
{
    plain_bounds(default_generator(data), in, out, partial);
}

static void noise3d_8(const struct noise_kernels *kernels, const void *data,
                      const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES])
{
    kernels->value(in, 1, default_generator(data), *out);
}

static void plain_bounds8(const struct noise_kernels *kernels, int generator,
                          const struct tape_range8 *in, struct tape_range8 *out,
                          struct tape_range8 *partial)
{
    double lo[3][TAPE_LANES], hi[3][TAPE_LANES];
    struct noise_bounds8 b;
    for (int i = 0; i < 3; i++) {
        memcpy(lo[i], in[i].lo, sizeof *lo);
        memcpy(hi[i], in[i].hi, sizeof *hi);
    }
    kernels->bounds((const double(*)[TAPE_LANES])lo, (const double(*)[TAPE_LANES])hi,
                    generator, &b);
    memcpy(out->lo, b.lo, sizeof b.lo);
    memcpy(out->hi, b.hi, sizeof b.hi);
    for (int i = 0; partial && i < 3; i++) {
        memcpy(partial[i].lo, b.slope_lo[i], sizeof *b.slope_lo);
        memcpy(partial[i].hi, b.slope_hi[i], sizeof *b.slope_hi);
    }
}

static bool noise3d_bounds8(const struct noise_kernels *kernels, const void *data,
                            const struct tape_range8 *in, struct tape_range8 *out,
                            struct tape_range8 *partial)
{
    plain_bounds8(kernels, default_generator(data), in, out, partial);
    return true;
}

const struct tape_extern internal_noise3d = {.name = "noise3d",
                                             .arguments = 3,
                                             .width = 1,
                                             .value = noise3d,
                                             .values = noise3d_8,
                                             .bounds = noise3d_bounds,
                                             .bounds8 = noise3d_bounds8};

static void noise_generator(const void *data, const double *in, double *out)
{
    (void)data;
    out[0] = noise_in(vec3(in[0], in[1], in[2]), in[3]);
}

static void noise_generator_bounds(const void *data, const struct interval *in,
                                   struct interval *out, struct interval *partial)
{
    (void)data;
    if (partial)
        partial[3] = interval_whole();
    if (interval_is_point(in[3])) {
        plain_bounds(generator_of(in[3].lo), in, out, partial);
        return;
    }
    out[0] = interval(0, 1);
    for (int i = 0; partial && i < 3; i++)
        partial[i] = interval_whole();
}

// Whether all lanes have one value.
static bool is_one(const double *v)
{
    for (int l = 1; l < TAPE_LANES; l++)
        if (v[l] != v[0])
            return false;
    return true;
}

static void noise_generator8(const struct noise_kernels *kernels, const void *data,
                             const double (*in)[TAPE_LANES], double (*out)[TAPE_LANES])
{
    (void)data;
    if (is_one(in[3])) {
        kernels->value(in, 1, generator_of(in[3][0]), *out);
        return;
    }
    for (int l = 0; l < TAPE_LANES; l++)
        out[0][l] = noise_in(vec3(in[0][l], in[1][l], in[2][l]), in[3][l]);
}

static bool noise_generator_bounds8(const struct noise_kernels *kernels, const void *data,
                                    const struct tape_range8 *in, struct tape_range8 *out,
                                    struct tape_range8 *partial)
{
    (void)data;
    if (!is_one(in[3].lo) || !is_one(in[3].hi) || in[3].lo[0] != in[3].hi[0])
        return false;
    plain_bounds8(kernels, generator_of(in[3].lo[0]), in, out, partial);
    for (int l = 0; partial && l < TAPE_LANES; l++) {
        partial[3].lo[l] = -INFINITY;
        partial[3].hi[l] = INFINITY;
    }
    return true;
}

const struct tape_extern internal_noise_generator = {.name = "noise_generator",
                                                     .arguments = 4,
                                                     .width = 1,
                                                     .value = noise_generator,
                                                     .values = noise_generator8,
                                                     .bounds = noise_generator_bounds,
                                                     .bounds8 = noise_generator_bounds8};

// ---- steps --------------------------------------------------------------------------

struct steps {
    struct tape_builder *b;
    uint32_t at[3];
    const uint32_t *p;
};

static uint32_t k(struct steps *s, double v) { return tape_constant(s->b, v); }
static uint32_t op(struct steps *s, enum tape_op o, uint32_t x, uint32_t y)
{
    return tape_binary(s->b, o, x, y);
}
static uint32_t add(struct steps *s, uint32_t x, uint32_t y)
{
    return op(s, TAPE_ADD, x, y);
}
static uint32_t times(struct steps *s, uint32_t x, uint32_t y)
{
    return op(s, TAPE_MULTIPLY, x, y);
}
static uint32_t less(struct steps *s, uint32_t x, uint32_t y)
{
    return op(s, TAPE_SUBTRACT, x, y);
}
static uint32_t absolute(struct steps *s, uint32_t x)
{
    return tape_unary(s->b, TAPE_ABS, x);
}

static uint32_t noise_step(struct steps *s, uint32_t generator)
{
    uint32_t out, in[4] = {s->at[0], s->at[1], s->at[2], generator};
    tape_call_extern(s->b, &internal_noise_generator, NULL, in, &out);
    return out;
}

static uint32_t signed_noise(struct steps *s, uint32_t generator) // 2 noise - 1
{
    return less(s, times(s, k(s, 2), noise_step(s, generator)), k(s, 1));
}

static void scale(struct steps *s, uint32_t by)
{
    for (int i = 0; i < 3; i++)
        s->at[i] = times(s, s->at[i], by);
}

static struct steps steps(struct tape_builder *b, const uint32_t *in)
{
    return (struct steps){.b = b, .at = {in[0], in[1], in[2]}, .p = in + 3};
}

static bool few(struct tape_builder *b, uint32_t x, double *n)
{
    if (!tape_is_constant(b, x, n))
        return false;
    *n = octaves(*n);
    return *n <= OCTAVES_UNROLL;
}

// ---- f_hetero_mf: H, lacunarity, octaves, offset, T, generator ----------------------

static double whole_power(double v, double exponent)
{
    double r = 1;
    for (int i = 1; i <= octaves(exponent); i++)
        r *= v;
    return r;
}

static void hetero_mf(const void *data, const double *in, double *out)
{
    (void)data;
    const double *p = in + 3;
    struct vec3 at = vec3(in[0], in[1], in[2]);
    const double step = det_pow(p[1], -p[0]), n = octaves(p[2]), part = n - (int)n;
    double s = 2 * noise_in(at, p[5]) - 1 + p[3], weight = step;
    at = vec3_scale(p[1], at);
    for (int i = 1; i < n; i++) {
        double more = (2 * noise_in(at, p[5]) - 1 + p[3]) * weight;
        s += more * whole_power(s, p[4]);
        at = vec3_scale(p[1], at);
        weight *= step;
    }
    if (part != 0)
        s += part * ((2 * noise_in(at, p[5]) - 1 + p[3]) * weight) * s;
    out[0] = s;
}

static bool hetero_mf_expand(struct tape_builder *b, const void *data, const uint32_t *in,
                             uint32_t *out)
{
    (void)data;
    struct steps s = steps(b, in);
    double n, exponent;
    if (!few(b, s.p[2], &n) || !few(b, s.p[4], &exponent))
        return false;
    const uint32_t step = op(&s, TAPE_POW, s.p[1], tape_unary(b, TAPE_NEGATE, s.p[0]));
    uint32_t v = add(&s, signed_noise(&s, s.p[5]), s.p[3]), weight = step;
    scale(&s, s.p[1]);
    for (int i = 1; i < n; i++) {
        uint32_t more = times(&s, add(&s, signed_noise(&s, s.p[5]), s.p[3]), weight);
        v = add(&s, v, times(&s, more, op(&s, TAPE_POW, v, k(&s, floor(exponent)))));
        scale(&s, s.p[1]);
        weight = times(&s, weight, step);
    }
    if (n - (int)n != 0) {
        uint32_t more = times(&s, add(&s, signed_noise(&s, s.p[5]), s.p[3]), weight);
        v = add(&s, v, times(&s, times(&s, k(&s, n - (int)n), more), v));
    }
    *out = v;
    return true;
}

const struct tape_extern internal_hetero_mf = {.name = "hetero_mf",
                                               .arguments = 9,
                                               .width = 1,
                                               .value = hetero_mf,
                                               .expand = hetero_mf_expand};

// ---- f_ridge: lambda, octaves, omega, offset, ridge, generator ----------------------

static void ridge(const void *data, const double *in, double *out)
{
    (void)data;
    const double *p = in + 3;
    const struct vec3 at = vec3(in[0], in[1], in[2]);
    const double sharp = 1 / fmax(p[4], 1 - p[4]), scale_by = 1 / fmax(p[3], 1 - p[3]);
    const double n = octaves(p[1]), part = n - (int)n;
    double length = 1, weight = 1, sum = 0, total = 0;
    for (int i = 1; i <= fmax(n, 1) + 1; i++) {
        double share = i <= (int)n || i == 1 ? 1 : part;
        if (share == 0)
            break;
        double v = sharp * fabs(noise_in(vec3_scale(length, at), p[5]) - p[4]) - p[3];
        sum += share * weight * v;
        total += share * weight;
        length *= p[0];
        weight *= p[2];
    }
    out[0] = sum * scale_by / total;
}

// 1 / max(x, 1 - x)
static uint32_t larger_part(struct steps *s, uint32_t x)
{
    const uint32_t most = op(s, TAPE_MAX, x, less(s, k(s, 1), x));
    return tape_quotient(s->b, k(s, 1), most);
}

static bool ridge_expand(struct tape_builder *b, const void *data, const uint32_t *in,
                         uint32_t *out)
{
    (void)data;
    struct steps s = steps(b, in);
    double n;
    if (!few(b, s.p[1], &n))
        return false;
    const uint32_t sharp = larger_part(&s, s.p[4]);
    uint32_t weight = k(&s, 1), sum = k(&s, 0), total = k(&s, 0), length = k(&s, 1);
    for (int i = 1; i <= fmax(n, 1) + 1; i++) {
        const double share = i <= (int)n || i == 1 ? 1 : n - (int)n;
        if (share == 0)
            break;
        struct steps place = s;
        scale(&place, length);
        const uint32_t off = absolute(&s, less(&s, noise_step(&place, s.p[5]), s.p[4]));
        const uint32_t v = less(&s, times(&s, sharp, off), s.p[3]);
        const uint32_t w = times(&s, k(&s, share), weight);
        sum = add(&s, sum, times(&s, w, v));
        total = add(&s, total, w);
        length = times(&s, length, s.p[0]);
        weight = times(&s, weight, s.p[2]);
    }
    *out = tape_quotient(b, times(&s, sum, larger_part(&s, s.p[3])), total);
    return true;
}

const struct tape_extern internal_ridge = {
    .name = "ridge", .arguments = 9, .width = 1, .value = ridge, .expand = ridge_expand};

// ---- f_ridged_mf: H, lacunarity, octaves, offset, gain, generator -------------------

static void ridged_mf(const void *data, const double *in, double *out)
{
    (void)data;
    const double *p = in + 3;
    struct vec3 at = vec3(in[0], in[1], in[2]);
    double s = square(p[3] - fabs(2 * noise_in(at, p[5]) - 1)), sum = s, frequency = 1;
    for (int i = 1; i < octaves(p[2]); i++) {
        at = vec3_scale(p[1], at);
        frequency *= p[1];
        double weight = s * p[4] > 0 ? fmin(1, s * p[4]) : 0;
        s = square(p[3] - fabs(2 * noise_in(at, p[5]) - 1)) * weight;
        sum += s * det_pow(frequency, -p[0]);
    }
    out[0] = sum;
}

static uint32_t ridged(struct steps *s)
{
    return tape_unary(s->b, TAPE_SQUARE,
                      less(s, s->p[3], absolute(s, signed_noise(s, s->p[5]))));
}

static bool ridged_mf_expand(struct tape_builder *b, const void *data, const uint32_t *in,
                             uint32_t *out)
{
    (void)data;
    struct steps s = steps(b, in);
    double n;
    if (!few(b, s.p[2], &n))
        return false;
    const uint32_t fall = tape_unary(b, TAPE_NEGATE, s.p[0]);
    uint32_t v = ridged(&s), sum = v, frequency = k(&s, 1);
    for (int i = 1; i < n; i++) {
        scale(&s, s.p[1]);
        frequency = times(&s, frequency, s.p[1]);
        const uint32_t weight =
            op(&s, TAPE_MIN, op(&s, TAPE_MAX, times(&s, v, s.p[4]), k(&s, 0)), k(&s, 1));
        v = times(&s, ridged(&s), weight);
        sum = add(&s, sum, times(&s, v, op(&s, TAPE_POW, frequency, fall)));
    }
    *out = sum;
    return true;
}

const struct tape_extern internal_ridged_mf = {.name = "ridged_mf",
                                               .arguments = 9,
                                               .width = 1,
                                               .value = ridged_mf,
                                               .expand = ridged_mf_expand};

// ---- f_polytubes: the distance to tubes in a circle ---------------------------------

#define TURN 6.28318530717958647692

static void tubes(const void *data, const double *in, double *out)
{
    (void)data;
    out[0] = 10000;
    for (int i = 0; i + 1 <= in[2] && i < TUBES_MAX; i++) {
        const double t = TURN * i / in[2];
        const double d =
            sqrt(square(in[0] - in[3] * det_sin(t)) + square(in[1] - in[3] * det_cos(t)));
        if (d < out[0])
            out[0] = d;
    }
}

static bool tubes_expand(struct tape_builder *b, const void *data, const uint32_t *in,
                         uint32_t *out)
{
    (void)data;
    struct steps s = {.b = b};
    double n;
    if (!tape_is_constant(b, in[2], &n) || !(n <= TUBES_UNROLL))
        return false;
    *out = k(&s, 10000);
    for (int i = 0; i + 1 <= n; i++) {
        const double t = TURN * i / n;
        const uint32_t x = less(&s, in[0], times(&s, in[3], k(&s, det_sin(t))));
        const uint32_t z = less(&s, in[1], times(&s, in[3], k(&s, det_cos(t))));
        const uint32_t d = add(&s, times(&s, x, x), times(&s, z, z));
        *out = op(&s, TAPE_MIN, *out, tape_unary(b, TAPE_SQRT, d));
    }
    return true;
}

const struct tape_extern internal_tubes = {
    .name = "tubes", .arguments = 4, .width = 1, .value = tubes, .expand = tubes_expand};
