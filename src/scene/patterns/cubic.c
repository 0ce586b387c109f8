// cubic: the six sectors around the axes, 0..5

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    const double ax = fabs(at.x), ay = fabs(at.y), az = fabs(at.z);
    if (at.x >= 0 && at.x >= ay && at.x >= az)
        return 0;
    if (at.y >= 0 && at.y >= ax && at.y >= az)
        return 1;
    if (at.z >= 0 && at.z >= ax && at.z >= ay)
        return 2;
    if (at.x < 0 && at.x <= -ay && at.x <= -az)
        return 3;
    return at.y < 0 && at.y <= -ax && at.y <= -az ? 4 : 5;
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    uint32_t sector = formula_constant(f, 5);
    for (int i = 4; i >= 0; i--) {
        const uint32_t v = i < 3 ? at[i] : tape_unary(f->b, TAPE_NEGATE, at[i - 3]);
        const uint32_t one = formula_abs(f, at[(i + 1) % 3]),
                       two = formula_abs(f, at[(i + 2) % 3]);
        const uint32_t here =
            formula_both(f, tape_binary(f->b, TAPE_GREATER_EQUAL, v, one),
                         tape_binary(f->b, TAPE_GREATER_EQUAL, v, two));
        sector = formula_where(f, here, formula_constant(f, i), sector);
    }
    return sector;
}

const struct pattern_ops cubic_pattern_ops = {.keyword = "cubic",
                                              .frequency = 0,
                                              .list = 6,
                                              .value = value,
                                              .plain = PLAIN_CUBIC,
                                              .formula = formula};
