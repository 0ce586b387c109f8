// spotted: noise

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return pattern_noise(p, at);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    k->value(at, 1, pattern_noise_generator(p), out);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return formula_noise(f, p, at);
}

const struct pattern_ops spotted_pattern_ops = {.keyword = "spotted",
                                                .frequency = 1,
                                                .value = value,
                                                .formula = formula,
                                                .values = values};
