#include "scene/patterns/plain_noise.h"

#include "scene/pattern_math.h"

double plain_noise_value(const struct pattern *p, struct vec3 at,
                         const struct pattern_context *c)
{
    (void)c;
    return pattern_noise(p, at);
}

void plain_noise_values(const struct pattern *p, const struct noise_kernels *k,
                        const double at[3][8], double out[8])
{
    k->value(at, 1, pattern_noise_generator(p), out);
}
