// wood: rings around the z axis, moved by turbulence

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct turbulence *t = p->turbulence;
    if (!t)
        return sqrt(at.x * at.x + at.y * at.y);
    const struct vec3 d = noise_dturbulence(at, t->lambda, t->omega, t->octaves);
    const double x = at.x + cycloidal((at.x + d.x) * t->amount.x);
    const double y = at.y + cycloidal((at.y + d.y) * t->amount.y);
    return sqrt(x * x + y * y);
}

const struct pattern_ops wood_pattern_ops = {.keyword = "wood",
                                             .wave = WAVE_TRIANGLE,
                                             .frequency = 1,
                                             .own_turbulence = true,
                                             .value = value};
