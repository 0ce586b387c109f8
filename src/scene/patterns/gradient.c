// gradient V: distance along V (stored as a unit vector), repeating

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return wrap_above_one(vec3_dot(at, p->vector));
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    uint32_t sum = formula_constant(f, 0);
    for (int i = 0; i < 3; i++)
        sum = formula_add(f, sum, formula_scale(f, at[i], vec3_axis(p->vector, i)));
    return formula_wrap(f, sum);
}

const struct pattern_ops gradient_pattern_ops = {.keyword = "gradient",
                                                 .frequency = 1,
                                                 .value = value,
                                                 .formula = formula,
                                                 .plain = PLAIN_GRADIENT};
