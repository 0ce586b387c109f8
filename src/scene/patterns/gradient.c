// gradient V: distance along V, repeating

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return wrap_above_one(vec3_dot(at, vec3_normalize(p->vector)));
}

const struct pattern_ops gradient_pattern_ops = {
    .keyword = "gradient", .frequency = 1, .value = value};
