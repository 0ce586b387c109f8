// granite: six octaves of folded noise

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const int generator = pattern_noise_generator(p);
    double sum = 0, scale = 1;
    at = vec3_scale(4, at);
    for (int i = 0; i < 6; i++, scale *= 2) {
        double n = noise_value(vec3_scale(scale, at), generator);
        if (generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN) {
            n = fabs(1 - 2 * n);
            n = n > 0.5 ? 0.5 : n;
        } else {
            n = fabs(0.5 - n);
        }
        sum += n / scale;
    }
    return sum;
}

const struct pattern_ops granite_pattern_ops = {
    .keyword = "granite", .frequency = 1, .value = value};
