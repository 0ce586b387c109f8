// cylindrical: 1 on the y axis, 0 from radius 1 on

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fade_out(sqrt(at.x * at.x + at.z * at.z));
}

const struct pattern_ops cylindrical_pattern_ops = {
    .keyword = "cylindrical", .frequency = 1, .value = value};
