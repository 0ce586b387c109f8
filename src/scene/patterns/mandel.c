// mandel N: steps until z^e + c escapes, c the point

#include "scene/patterns/fractal.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct complex_number z = {at.x, at.y};
    return fractal_value(p, z, z);
}

const struct pattern_ops mandel_pattern_ops = {
    .keyword = "mandel", .frequency = 1, .init = fractal_init, .value = value};
