// aoi: the angle between ray and perturbed normal, over pi

#include "math/pi.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)at;
    const struct vec3 n = vec3_normalize(c->normal), d = vec3_normalize(c->ray_d);
    if (vec3_dot(n, n) == 0 || vec3_dot(d, d) == 0)
        return 0;
    const double s = vec3_dot(n, d);
    return det_acos(s < -1 ? -1 : s > 1 ? 1 : s) / PI;
}

// No surface is there.
static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    (void)at;
    return formula_constant(f, 0);
}

const struct pattern_ops aoi_pattern_ops = {
    .keyword = "aoi", .frequency = 1, .value = value, .formula = formula};
