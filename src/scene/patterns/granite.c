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

// 4 and the scales are powers of two: products with them are exact.
static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    static const struct noise_octaves o = {4, 2, 1, 0.5, GRANITE_OCTAVES, OCTAVES_FOLDED};
    k->values(at, &o, pattern_noise_generator(p), out);
}

const struct pattern_ops granite_pattern_ops = {
    .keyword = "granite", .frequency = 1, .value = value, .values = values};
