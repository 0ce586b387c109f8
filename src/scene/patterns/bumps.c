// bumps: noise; as a normal, vector noise

#include "scene/pattern_math.h"
#include "scene/patterns/plain_noise.h"

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    (void)p;
    return vec3_mad(n, amount, noise_vector(at));
}

static void perturbs(const struct pattern *p, const struct noise_kernels *k, float amount,
                     const double at[3][8], double n[3][8])
{
    (void)p;
    double v[3][8];
    k->vector(at, 1, v);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 8; i++)
            n[a][i] += amount * v[a][i];
}

const struct pattern_ops bumps_pattern_ops = {.keyword = "bumps",
                                              .frequency = 1,
                                              .value = plain_noise_value,
                                              .formula = formula_noise,
                                              .values = plain_noise_values,
                                              .perturb = perturb,
                                              .perturbs = perturbs};
