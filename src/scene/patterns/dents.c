// dents: noise cubed; as a normal, vector noise of that strength

#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const double n = pattern_noise(p, at);
    return n * n * n;
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    return vec3_mad(n, amount * value(p, at, NULL), noise_vector(at));
}

const struct pattern_ops dents_pattern_ops = {
    .keyword = "dents", .frequency = 1, .value = value, .perturb = perturb};
