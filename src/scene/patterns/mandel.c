// mandel N: steps until z^e + c escapes, c the point

#include "scene/noise_kernel.h"
#include "scene/patterns/fractal.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct complex_number z = {at.x, at.y};
    return fractal_value(p, z, z);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    k->fractal(p, FRACTAL_MANDEL, at, out);
}

const struct pattern_ops mandel_pattern_ops = {.keyword = "mandel",
                                               .frequency = 1,
                                               .init = fractal_init,
                                               .value = value,
                                               .values = values};
