// agate: banded by a cycloid of turbulence (spec/textures 5.1)

#include "scene/pattern_math.h"

static void init(struct pattern *p) { p->value[0] = 1; } // agate_turb

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    static const struct turbulence usual = {{0, 0, 0}, 6, 2, 0.5f};
    const struct turbulence *t = p->turbulence ? p->turbulence : &usual;
    double turbulence =
        p->value[0] *
        noise_turbulence(at, t->lambda, t->omega, t->octaves, pattern_noise_generator(p));
    double v = 0.5 * (cycloidal(1.3 * turbulence + 1.1 * at.z) + 1);
    (void)c;
    return v < 0 ? 0 : det_pow(v > 1 ? 1 : v, 0.77);
}

const struct pattern_ops agate_pattern_ops = {
    .keyword = "agate", .frequency = 1, .init = init, .value = value};
