// waves: rings around number_of_waves points, each of its own width

#include "scene/pattern_formula.h"
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

static void bounds(const void *data, const struct interval *in, struct interval *out,
                   struct interval *partial)
{
    const struct noise_rings r = rings_of(data, true);
    rings_bounds(&r, in, out, partial);
}

static const struct tape_extern waves_bounds = {
    .name = "waves", .arguments = 3, .width = 1, .bounds = bounds};

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    const uint32_t mean = formula_extern(f, &waves_bounds, p, at);
    return formula_scale(f, formula_offset(f, mean, 2.5), 0.2);
}

const struct pattern_ops waves_pattern_ops = {.keyword = "waves",
                                              .frequency = 1,
                                              .value = value,
                                              .formula = formula,
                                              .values = values,
                                              .perturb = perturb,
                                              .perturbs = perturbs};
