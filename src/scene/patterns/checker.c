// checker: unit cubes of two kinds in turn

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    // Whole numbers up to 3e17 fit the integer.
    const int64_t cell =
        (int64_t)(floor(at.x + PATTERN_EDGE) + floor(at.y + PATTERN_EDGE) +
                  floor(at.z + PATTERN_EDGE));
    return (double)(cell & 1);
}

const struct pattern_ops checker_pattern_ops = {
    .keyword = "checker", .frequency = 0, .list = 2, .value = value};
