// julia <a, b>, N: steps until z^e + c escapes, z the point

#include "scene/noise_kernel.h"
#include "scene/patterns/fractal.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return fractal_value(p, (struct complex_number){at.x, at.y},
                         (struct complex_number){p->vector.x, p->vector.y});
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    k->fractal(p, FRACTAL_JULIA, at, out);
}

const struct pattern_ops julia_pattern_ops = {.keyword = "julia",
                                              .frequency = 1,
                                              .init = fractal_init,
                                              .value = value,
                                              .values = values};
