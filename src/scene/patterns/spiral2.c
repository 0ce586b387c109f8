// spiral2 N: N arms crossed with rings

#include "scene/patterns/spiral.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    double radius, v = spiral_value(p, at, &radius);
    return triangle_wave(radius) + triangle_wave(v);
}

const struct pattern_ops spiral2_pattern_ops = {
    .keyword = "spiral2", .wave = WAVE_TRIANGLE, .frequency = 1, .value = value};
