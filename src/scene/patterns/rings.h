#ifndef SCENE_PATTERNS_RINGS_H
#define SCENE_PATTERNS_RINGS_H

// What waves and ripples share: rings around number_of_waves points.
#include "scene/pattern_math.h"

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
