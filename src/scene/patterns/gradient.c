// gradient V: distance along V (stored as a unit vector), repeating

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return wrap_above_one(vec3_dot(at, p->vector));
}

const struct pattern_ops gradient_pattern_ops = {
    .keyword = "gradient", .frequency = 1, .value = value};
