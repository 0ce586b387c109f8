// leopard: spots where three sines meet

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    const double v = (pattern_sine(at.x) + pattern_sine(at.y) + pattern_sine(at.z)) / 3;
    return v * v;
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    double s[3][8];
    (void)p;
    for (int a = 0; a < 3; a++)
        k->sine(at[a], s[a]);
    for (int i = 0; i < 8; i++) {
        const double v = (s[0][i] + s[1][i] + s[2][i]) / 3;
        out[i] = v * v;
    }
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    uint32_t sum = tape_unary(f->b, TAPE_SIN, at[0]);
    for (int i = 1; i < 3; i++)
        sum = formula_add(f, sum, tape_unary(f->b, TAPE_SIN, at[i]));
    return tape_unary(f->b, TAPE_SQUARE, formula_scale(f, sum, 1.0 / 3));
}

const struct pattern_ops leopard_pattern_ops = {.keyword = "leopard",
                                                .frequency = 1,
                                                .value = value,
                                                .formula = formula,
                                                .values = values};
