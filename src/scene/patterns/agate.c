// agate: banded by a cycloid of turbulence (spec/textures 5.1)

#include "scene/pattern_math.h"

static void init(struct pattern *p) { p->value[0] = 1; } // agate_turb

static const struct turbulence usual = {{0, 0, 0}, 6, 2, 0.5f};

static inline double band(const struct pattern *p, double turbulence, double z)
{
    const double s = 1.3 * (p->value[0] * turbulence) + 1.1 * z;
    const double v = 0.5 * (cycloidal(s) + 1);
    return v < DBL_MIN ? 0 : quick_pow(v > 1 ? 1 : v, 0.77);
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct turbulence *t = p->turbulence ? p->turbulence : &usual;
    return band(
        p,
        noise_turbulence(at, t->lambda, t->omega, t->octaves, pattern_noise_generator(p)),
        at.z);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const struct turbulence *t = p->turbulence ? p->turbulence : &usual;
    noise_turbulence8(k, at, t->lambda, t->omega, t->octaves, pattern_noise_generator(p),
                      out);
    double v[8];
    for (int i = 0; i < 8; i++)
        v[i] = 1.3 * (p->value[0] * out[i]) + 1.1 * at[2][i];
    k->cycloidal(v, out);
    for (int i = 0; i < 8; i++) {
        out[i] = 0.5 * (out[i] + 1);
        v[i] = out[i] < DBL_MIN || out[i] > 1 ? 1 : out[i];
    }
    double powers[8];
    k->power(v, 0.77, powers);
    for (int i = 0; i < 8; i++)
        out[i] = out[i] < DBL_MIN ? 0 : powers[i];
}

const struct pattern_ops agate_pattern_ops = {
    .keyword = "agate", .frequency = 1, .init = init, .value = value, .values = values};
