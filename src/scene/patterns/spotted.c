// spotted: noise

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return pattern_noise(p, at);
}

const struct pattern_ops spotted_pattern_ops = {
    .keyword = "spotted", .frequency = 1, .value = value};
