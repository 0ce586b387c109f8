// leopard: spots where three sines meet

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    const double v = (det_sin(at.x) + det_sin(at.y) + det_sin(at.z)) / 3;
    return v * v;
}

const struct pattern_ops leopard_pattern_ops = {
    .keyword = "leopard", .frequency = 1, .value = value};
