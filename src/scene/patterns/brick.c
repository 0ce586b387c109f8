// brick: courses of bricks (1) in mortar (0), spec/textures 5.2

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static void init(struct pattern *p)
{
    p->vector = vec3(8, 3, 4.5); // brick_size
    p->value[0] = 0.5f;          // mortar
}

static double fraction(double t)
{
    t -= trunc(t);
    return t < 0 ? t + 1 : t;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const float m = (float)(p->value[0] - 2 * PATTERN_EDGE);
    const struct vec3 s = p->vector;
    const double move = PATTERN_EDGE + m;
    const double x = (at.x + move) / s.x, y = (at.y + move) / s.y,
                 z = (at.z + move) / s.z;
    if (fraction(y) <= m / s.y)
        return 0;
    if (fraction(0.5 * y) <= 0.5)
        return fraction(x) > m / s.x && fraction(z + 0.5) > m / s.z;
    return fraction(x + 0.5) > m / s.x && fraction(z) > m / s.z;
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    const float m = (float)(p->value[0] - 2 * PATTERN_EDGE);
    const double move = PATTERN_EDGE + m;
    uint32_t v[3], inner[3], shifted[3]; // in the brick along each axis
    for (int i = 0; i < 3; i++) {
        const double size = vec3_axis(p->vector, i);
        const uint32_t joint = formula_constant(f, m / size);
        v[i] = tape_quotient(f->b, formula_offset(f, at[i], move),
                             formula_constant(f, size));
        inner[i] = formula_less(f, joint, formula_fraction(f, v[i]));
        shifted[i] =
            formula_less(f, joint, formula_fraction(f, formula_offset(f, v[i], 0.5)));
    }
    const uint32_t half = formula_fraction(f, formula_scale(f, v[1], 0.5));
    const uint32_t even =
        tape_binary(f->b, TAPE_LESS_EQUAL, half, formula_constant(f, 0.5));
    const uint32_t row = formula_where(f, even, formula_both(f, inner[0], shifted[2]),
                                       formula_both(f, shifted[0], inner[2]));
    return formula_both(f, inner[1], row);
}

const struct pattern_ops brick_pattern_ops = {.keyword = "brick",
                                              .frequency = 0,
                                              .list = 2,
                                              .init = init,
                                              .value = value,
                                              .formula = formula,
                                              .plain = PLAIN_BRICK};
