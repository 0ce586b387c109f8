// square: four kinds of unit squares in the xz plane

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    const bool x_odd = fmod(floor(at.x), 2) != 0, z_odd = fmod(floor(at.z), 2) != 0;
    return x_odd ? (z_odd ? 2 : 3) : z_odd ? 1 : 0;
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    const uint32_t x = formula_odd(f, formula_floor(f, at[0]));
    const uint32_t z = formula_odd(f, formula_floor(f, at[2]));
    return formula_where(f, x, formula_subtract(f, formula_constant(f, 3), z), z);
}

const struct pattern_ops square_pattern_ops = {.keyword = "square",
                                               .frequency = 0,
                                               .list = 4,
                                               .value = value,
                                               .plain = PLAIN_SQUARE,
                                               .formula = formula};
