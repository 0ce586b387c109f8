// spiral1 N: N arms around the z axis

#include "scene/pattern_formula.h"
#include "scene/patterns/spiral.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    double radius;
    return spiral_value(p, at, &radius);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    double radius[8];
    spiral_values(p, k, at, out, radius);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    uint32_t radius;
    return spiral_formula(f, p, at, &radius);
}

const struct pattern_ops spiral1_pattern_ops = {.keyword = "spiral1",
                                                .wave = WAVE_TRIANGLE,
                                                .frequency = 1,
                                                .value = value,
                                                .values = values,
                                                .formula = formula};
