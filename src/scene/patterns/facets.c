// facets: a normal that is constant on random cells (spec/textures 11.3)

#include "scene/pattern_formula.h"
#include "scene/patterns/cellular.h"

static void init(struct pattern *p)
{
    p->value[0] = 0.1f; // size
    p->metric = 2;
}

// Facets exist as a normal only.
static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)at;
    (void)c;
    return 0;
}

static double distance_sum(struct vec3 e, double metric)
{
    if (metric == 2)
        return e.x * e.x + e.y * e.y + e.z * e.z;
    if (metric == 1)
        return e.x + e.y + e.z; // without absolute values, as the reference
    return det_pow(fabs(e.x), metric) + det_pow(fabs(e.y), metric) +
           det_pow(fabs(e.z), metric);
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    (void)amount;
    const double coords = p->value[1];
    const double scale = p->value[0] < 1e-6f ? 1e6 : 1 / (double)p->value[0];
    n = vec3_normalize(n);
    const struct vec3 t = vec3_scale(scale, coords != 0 ? at : n);
    struct vec3 nearest = t;
    double least = DBL_MAX;
    const int r = CELLULAR_REACH;
    for (int i = -r; i <= r; i++)
        for (int j = -r; j <= r; j++)
            for (int k = -r; k <= r; k++) {
                if (!cellular_counts(i, j, k))
                    continue;
                struct vec3 q = noise_cell_point(floor(t.x + i - PATTERN_EDGE),
                                                 floor(t.y + j - PATTERN_EDGE),
                                                 floor(t.z + k - PATTERN_EDGE));
                double sum = distance_sum(vec3_sub(q, t), p->metric);
                if (sum < least) {
                    least = sum;
                    nearest = q;
                }
            }
    if (coords == 0)
        return nearest;
    struct vec3 d = noise_vector(nearest);
    d = vec3_mad(d, -vec3_dot(d, n), n);
    return vec3_mad(n, coords, d);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    (void)at;
    return formula_constant(f, 0);
}

const struct pattern_ops facets_pattern_ops = {.keyword = "facets",
                                               .frequency = 1,
                                               .init = init,
                                               .value = value,
                                               .formula = formula,
                                               .perturb = perturb};
