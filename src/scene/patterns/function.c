// function { F }: what the scene wrote

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->function ? wrap_above_one(p->function(p->function_data, at)) : 0;
}

const struct pattern_ops function_pattern_ops = {
    .keyword = "function", .frequency = 1, .value = value};
