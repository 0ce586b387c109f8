// dents: noise cubed; as a normal, vector noise of that strength

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const double n = pattern_noise(p, at);
    return n * n * n;
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    k->value(at, 1, pattern_noise_generator(p), out);
    for (int i = 0; i < 8; i++)
        out[i] = out[i] * out[i] * out[i];
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    return vec3_mad(n, amount * value(p, at, NULL), noise_vector(at));
}

static void perturbs(const struct pattern *p, const struct noise_kernels *k, float amount,
                     const double at[3][8], double n[3][8])
{
    double strength[8], v[3][8];
    values(p, k, at, strength);
    k->vector(at, 1, v);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < 8; i++)
            n[a][i] += amount * strength[i] * v[a][i];
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    const uint32_t n = formula_noise(f, p, at);
    return formula_multiply(f, tape_unary(f->b, TAPE_SQUARE, n), n);
}

const struct pattern_ops dents_pattern_ops = {.keyword = "dents",
                                              .frequency = 1,
                                              .value = value,
                                              .formula = formula,
                                              .values = values,
                                              .perturb = perturb,
                                              .perturbs = perturbs};
