// wrinkles: ten octaves of noise; as a normal, of folded vector noise

#include "scene/pattern_math.h"

enum { WRINKLES_OCTAVES = 10 };

static inline double stretched(double n, int generator)
{
    const bool clamped = generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN;
    return clamped ? clamp01(2 * n - 0.5) : n;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const int generator = pattern_noise_generator(p);
    double sum = 0, scale = 1;
    for (int i = 0; i < WRINKLES_OCTAVES; i++, scale *= 2) {
        const double n = noise_value(vec3_scale(scale, at), generator);
        sum += stretched(n, generator) / scale;
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

// Divisions by powers of two are products here: the same bits.
static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    static const struct noise_octaves o = {
        1, 2, 1, 0.5, WRINKLES_OCTAVES, OCTAVES_STRETCHED};
    k->values(at, &o, pattern_noise_generator(p), out);
    for (int i = 0; i < 8; i++)
        out[i] /= 2;
}

static void perturbs(const struct pattern *p, const struct noise_kernels *k, float amount,
                     const double at[3][8], double n[3][8])
{
    static const struct noise_octaves o = {
        1, 2, 1, 0.5, WRINKLES_OCTAVES, OCTAVES_FOLDED};
    (void)p;
    double sum[3][8];
    k->vectors(at, &o, sum);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 8; i++)
            n[a][i] += amount * sum[a][i];
}

const struct pattern_ops wrinkles_pattern_ops = {.keyword = "wrinkles",
                                                 .frequency = 1,
                                                 .value = value,
                                                 .values = values,
                                                 .perturb = perturb,
                                                 .perturbs = perturbs};
