// radial: the angle around the y axis

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    if (fabs(at.x) < 0.001 && fabs(at.z) < 0.001)
        return 0.25;
    return 0.25 + (det_atan2(at.x, at.z) + PATTERN_PI) / (2 * PATTERN_PI);
}

const struct pattern_ops radial_pattern_ops = {
    .keyword = "radial", .frequency = 1, .value = value};
