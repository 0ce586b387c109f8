// wrinkles: ten octaves of noise; as a normal, of folded vector noise

#include "scene/pattern_math.h"

enum { WRINKLES_OCTAVES = 10 };

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const int generator = pattern_noise_generator(p);
    double sum = 0, scale = 1;
    for (int i = 0; i < WRINKLES_OCTAVES; i++, scale *= 2) {
        const double n = noise_value(vec3_scale(scale, at), generator);
        const bool folded =
            generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN;
        sum += (folded ? clamp01(2 * n - 0.5) : n) / scale;
    }
    return sum / 2;
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    (void)p;
    struct vec3 sum = {0, 0, 0};
    double scale = 1;
    for (int i = 0; i < WRINKLES_OCTAVES; i++, scale *= 2) {
        const struct vec3 v = noise_vector(vec3_scale(scale, at));
        sum =
            vec3_add(sum, vec3(fabs(v.x) / scale, fabs(v.y) / scale, fabs(v.z) / scale));
    }
    return vec3_mad(n, amount, sum);
}

const struct pattern_ops wrinkles_pattern_ops = {
    .keyword = "wrinkles", .frequency = 1, .value = value, .perturb = perturb};
