// onion: shells around the origin

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fmod(vec3_length(at), 1);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return tape_binary(f->b, TAPE_MOD, formula_length3(f, at), formula_constant(f, 1));
}

const struct pattern_ops onion_pattern_ops = {.keyword = "onion",
                                              .frequency = 1,
                                              .value = value,
                                              .formula = formula,
                                              .plain = PLAIN_ONION};
