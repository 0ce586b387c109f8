// cubic: the six sectors around the axes, 0..5

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    const double ax = fabs(at.x), ay = fabs(at.y), az = fabs(at.z);
    if (at.x >= 0 && at.x >= ay && at.x >= az)
        return 0;
    if (at.y >= 0 && at.y >= ax && at.y >= az)
        return 1;
    if (at.z >= 0 && at.z >= ax && at.z >= ay)
        return 2;
    if (at.x < 0 && at.x <= -ay && at.x <= -az)
        return 3;
    return at.y < 0 && at.y <= -ax && at.y <= -az ? 4 : 5;
}

const struct pattern_ops cubic_pattern_ops = {
    .keyword = "cubic", .frequency = 0, .list = 6, .value = value};
