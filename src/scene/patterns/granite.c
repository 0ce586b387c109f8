// granite: six octaves of folded noise

#include "scene/pattern_math.h"

enum { GRANITE_OCTAVES = 6 };

static inline double folded(double n, int generator)
{
    if (generator != NOISE_RANGE_CORRECTED && generator != NOISE_PERLIN)
        return fabs(0.5 - n);
    n = fabs(1 - 2 * n);
    return n > 0.5 ? 0.5 : n;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const int generator = pattern_noise_generator(p);
    double sum = 0, scale = 1;
    at = vec3_scale(4, at);
    for (int i = 0; i < GRANITE_OCTAVES; i++, scale *= 2) {
        const double n = noise_value(vec3_scale(scale, at), generator);
        sum += folded(n, generator) / scale;
    }
    return sum;
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const int generator = pattern_noise_generator(p);
    // 4 and the scales are powers of two: their product with a coordinate is the same.
    double n[8], scale = 1;
    for (int i = 0; i < 8; i++)
        out[i] = 0;
    for (int octave = 0; octave < GRANITE_OCTAVES; octave++, scale *= 2) {
        k->value(at, 4 * scale, generator, n);
        for (int i = 0; i < 8; i++)
            out[i] += folded(n[i], generator) * (1 / scale);
    }
}

const struct pattern_ops granite_pattern_ops = {
    .keyword = "granite", .frequency = 1, .value = value, .values = values};
