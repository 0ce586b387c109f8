// spherical: 1 at the origin, 0 from radius 1 on

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fade_out(vec3_length(at));
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_fade_out(f, formula_length3(f, at));
}

const struct pattern_ops spherical_pattern_ops = {.keyword = "spherical",
                                                  .frequency = 1,
                                                  .value = value,
                                                  .formula = formula,
                                                  .plain = PLAIN_SPHERICAL};
