// wood: rings around the z axis, moved by turbulence

#include <string.h>

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static inline double ring(const struct turbulence *t, double x, double y, double dx,
                          double dy)
{
    x += cycloidal((x + dx) * t->amount.x);
    y += cycloidal((y + dy) * t->amount.y);
    return sqrt(x * x + y * y);
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const struct turbulence *t = p->turbulence;
    if (!t)
        return sqrt(at.x * at.x + at.y * at.y);
    const struct vec3 d = noise_dturbulence(at, t->lambda, t->omega, t->octaves);
    return ring(t, at.x, at.y, d.x, d.y);
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const struct turbulence *t = p->turbulence;
    double x[2][8], d[3][8], move[8];
    memcpy(x, at, sizeof x);
    if (t) {
        const double amount[2] = {t->amount.x, t->amount.y};
        noise_dturbulence8(k, at, t->lambda, t->omega, t->octaves, d);
        for (int a = 0; a < 2; a++) {
            for (int i = 0; i < 8; i++)
                d[a][i] = (x[a][i] + d[a][i]) * amount[a];
            k->cycloidal(d[a], move);
            for (int i = 0; i < 8; i++)
                x[a][i] += move[i];
        }
    }
    for (int i = 0; i < 8; i++)
        out[i] = sqrt(x[0][i] * x[0][i] + x[1][i] * x[1][i]);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return p->turbulence ? formula_octaves(f, at) : formula_length(f, at[0], at[1]);
}

const struct pattern_ops wood_pattern_ops = {.keyword = "wood",
                                             .wave = WAVE_TRIANGLE,
                                             .frequency = 1,
                                             .own_turbulence = true,
                                             .value = value,
                                             .formula = formula,
                                             .values = values};
