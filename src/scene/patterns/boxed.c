// boxed: 1 at the centre, 0 from the surface of the cube +-1 on

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fade_out(vec3_max_abs(at));
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    const uint32_t two =
        tape_binary(f->b, TAPE_MAX, formula_abs(f, at[0]), formula_abs(f, at[1]));
    return formula_fade_out(f, tape_binary(f->b, TAPE_MAX, two, formula_abs(f, at[2])));
}

const struct pattern_ops boxed_pattern_ops = {.keyword = "boxed",
                                              .frequency = 1,
                                              .value = value,
                                              .formula = formula,
                                              .plain = PLAIN_BOXED};
