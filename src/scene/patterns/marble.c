// marble: bands along x, moved by turbulence

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->turbulence ? at.x + p->turbulence->amount.x * pattern_turbulence(p, at)
                         : at.x;
}

const struct pattern_ops marble_pattern_ops = {.keyword = "marble",
                                               .wave = WAVE_TRIANGLE,
                                               .frequency = 1,
                                               .own_turbulence = true,
                                               .value = value};
