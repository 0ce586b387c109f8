// marble: bands along x, moved by turbulence

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->turbulence ? at.x + p->turbulence->amount.x * pattern_turbulence(p, at)
                         : at.x;
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const struct turbulence *t = p->turbulence;
    if (t)
        noise_turbulence8(k, at, t->lambda, t->omega, t->octaves,
                          pattern_noise_generator(p), out);
    for (int i = 0; i < 8; i++)
        out[i] = t ? at[0][i] + t->amount.x * out[i] : at[0][i];
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return p->turbulence ? formula_octaves(f, at) : at[0];
}

const struct pattern_ops marble_pattern_ops = {.keyword = "marble",
                                               .wave = WAVE_TRIANGLE,
                                               .frequency = 1,
                                               .own_turbulence = true,
                                               .value = value,
                                               .formula = formula,
                                               .values = values};
