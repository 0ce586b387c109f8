// planar: 1 on the xz plane, 0 from distance 1 on

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fade_out(fabs(at.y));
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_fade_out(f, formula_abs(f, at[1]));
}

const struct pattern_ops planar_pattern_ops = {.keyword = "planar",
                                               .frequency = 1,
                                               .value = value,
                                               .formula = formula,
                                               .plain = PLAIN_PLANAR};
