// cylindrical: 1 on the y axis, 0 from radius 1 on

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fade_out(sqrt(at.x * at.x + at.z * at.z));
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_fade_out(f, formula_length(f, at[0], at[2]));
}

const struct pattern_ops cylindrical_pattern_ops = {.keyword = "cylindrical",
                                                    .frequency = 1,
                                                    .value = value,
                                                    .formula = formula,
                                                    .plain = PLAIN_CYLINDRICAL};
