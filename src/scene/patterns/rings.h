#ifndef SCENE_PATTERNS_RINGS_H
#define SCENE_PATTERNS_RINGS_H

// What waves and ripples share: rings around number_of_waves points.
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

// The sum of some sines, each divided by a hundredth at the least, is rounded by less.
#define RINGS_SLACK 1e-12

static inline struct noise_rings rings_of(const struct pattern *p, bool own_widths)
{
    return (struct noise_rings){pattern_wave_count(p), (double)p->frequency,
                                (double)p->phase, own_widths};
}

// The sine of ring i, and the way from its middle, its length (not 0) and the frequency.
struct ring {
    struct vec3 from;
    double length, frequency, sine;
};

static inline struct ring ring_at(const struct noise_rings *r, int i, struct vec3 at)
{
    struct ring x = {.from = vec3_sub(at, noise_wave_source(i)),
                     .frequency = r->own_widths ? noise_wave_frequency(i) : 1};
    const double length = vec3_length(x.from);
    x.length = length == 0 ? 1 : length;
    x.sine = cycloidal(x.length * r->frequency * x.frequency + r->phase);
    return x;
}

// The mean of all rings.
static inline double rings_mean(const struct noise_rings *r, struct vec3 at)
{
    double sum = 0;
    for (int i = 0; i < r->count; i++) {
        const struct ring x = ring_at(r, i, at);
        sum += x.sine / x.frequency;
    }
    return sum / r->count;
}

// Bounds of the mean and, if wanted, of its slopes.
static inline void rings_bounds(const struct noise_rings *r, const struct interval in[3],
                                struct interval *out, struct interval *partial)
{
    struct interval v = interval_point(0), d[3] = {v, v, v};
    const double turn = 2 * PATTERN_PI;
    for (int i = 0; i < r->count; i++) {
        const struct vec3 source = noise_wave_source(i);
        const double frequency = r->own_widths ? noise_wave_frequency(i) : 1;
        struct interval e[3], sum = interval_point(0);
        for (int k = 0; k < 3; k++) {
            e[k] = interval_subtract(in[k], interval_point(vec3_axis(source, k)));
            sum = interval_add(sum, interval_square(e[k]));
        }
        const struct interval length = interval_sqrt(sum);
        const struct interval angle = interval_multiply(
            interval_add(
                interval_multiply(length, interval_point(r->frequency * frequency)),
                interval_point(r->phase)),
            interval_point(turn));
        const double share = 1 / (frequency * r->count);
        v = interval_add(v,
                         interval_multiply(interval_sin(angle), interval_point(share)));
        const struct interval slope = interval_multiply(
            interval_cos(angle), interval_point(turn * r->frequency / r->count));
        for (int k = 0; partial && k < 3; k++) {
            const struct interval side = interval_divide(e[k], length);
            const struct interval unit = interval(fmax(side.lo, -1), fmin(side.hi, 1));
            d[k] = interval_add(d[k], interval_multiply(slope, unit));
        }
    }
    out[0] = interval(v.lo - RINGS_SLACK, v.hi + RINGS_SLACK);
    for (int k = 0; partial && k < 3; k++)
        partial[k] = d[k];
}

static inline struct vec3 rings_perturb(const struct noise_rings *r, float amount,
                                        struct vec3 n, struct vec3 at)
{
    for (int i = 0; i < r->count; i++) {
        const struct ring x = ring_at(r, i, at);
        n = vec3_mad(n, x.sine * (amount / x.frequency) / (x.length * r->count), x.from);
    }
    return n;
}

#endif
