// waves: rings around number_of_waves points, each of its own width

#include "scene/patterns/rings.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct noise_rings r = rings_of(p, true);
    return 0.2 * (2.5 + rings_mean(&r, at));
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const struct noise_rings r = rings_of(p, true);
    k->rings(at, &r, out);
    for (int i = 0; i < 8; i++)
        out[i] = 0.2 * (2.5 + out[i]);
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    const struct noise_rings r = rings_of(p, true);
    return rings_perturb(&r, amount, n, at);
}

static void perturbs(const struct pattern *p, const struct noise_kernels *k, float amount,
                     const double at[3][8], double n[3][8])
{
    const struct noise_rings r = rings_of(p, true);
    k->ring_slopes(at, &r, amount, n);
}

const struct pattern_ops waves_pattern_ops = {.keyword = "waves",
                                              .frequency = 1,
                                              .value = value,
                                              .values = values,
                                              .perturb = perturb,
                                              .perturbs = perturbs};
