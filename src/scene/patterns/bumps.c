// bumps: noise; as a normal, vector noise

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return pattern_noise(p, at);
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    (void)p;
    return vec3_mad(n, amount, noise_vector(at));
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    k->value(at, 1, pattern_noise_generator(p), out);
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

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return formula_noise(f, p, at);
}

const struct pattern_ops bumps_pattern_ops = {.keyword = "bumps",
                                              .frequency = 1,
                                              .value = value,
                                              .formula = formula,
                                              .values = values,
                                              .perturb = perturb,
                                              .perturbs = perturbs};
