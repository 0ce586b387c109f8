// spiral2 N: N arms crossed with rings

#include "scene/pattern_formula.h"
#include "scene/patterns/spiral.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    double radius, v = spiral_value(p, at, &radius);
    return triangle_wave(radius) + triangle_wave(v);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    double radius[8];
    spiral_values(p, k, at, out, radius);
    for (int i = 0; i < 8; i++)
        out[i] = triangle_wave(radius[i]) + triangle_wave(out[i]);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    uint32_t radius;
    const uint32_t v = spiral_formula(f, p, at, &radius);
    return formula_add(f, formula_triangle(f, radius), formula_triangle(f, v));
}

const struct pattern_ops spiral2_pattern_ops = {.keyword = "spiral2",
                                                .wave = WAVE_TRIANGLE,
                                                .frequency = 1,
                                                .value = value,
                                                .values = values,
                                                .formula = formula};
