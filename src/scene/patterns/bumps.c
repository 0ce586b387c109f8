// bumps: noise; as a normal, vector noise

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return pattern_noise(p, at);
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    (void)p;
    return vec3_mad(n, amount, noise_vector(at));
}

const struct pattern_ops bumps_pattern_ops = {
    .keyword = "bumps", .frequency = 1, .value = value, .perturb = perturb};
