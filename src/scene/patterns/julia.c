// julia <a, b>, N: steps until z^e + c escapes, z the point

#include "scene/patterns/fractal.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return fractal_value(p, (struct complex_number){at.x, at.y},
                         (struct complex_number){p->vector.x, p->vector.y});
}

const struct pattern_ops julia_pattern_ops = {
    .keyword = "julia", .frequency = 1, .init = fractal_init, .value = value};
