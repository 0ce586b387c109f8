// leopard: spots where three sines meet

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

const struct pattern_ops leopard_pattern_ops = {
    .keyword = "leopard", .frequency = 1, .value = value, .values = values};
