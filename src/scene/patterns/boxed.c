// boxed: 1 at the centre, 0 from the surface of the cube +-1 on

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fade_out(vec3_max_abs(at));
}

const struct pattern_ops boxed_pattern_ops = {
    .keyword = "boxed", .frequency = 1, .value = value};
