// onion: shells around the origin

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return fmod(vec3_length(at), 1);
}

const struct pattern_ops onion_pattern_ops = {
    .keyword = "onion", .frequency = 1, .value = value};
