#ifndef SCENE_PATTERNS_SPIRAL_H
#define SCENE_PATTERNS_SPIRAL_H

#include "math/pi.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

// The value of spiral1; *radius is the distance from the z axis.
static inline double spiral_value(const struct pattern *p, struct vec3 at, double *radius)
{
    const double r = sqrt(at.x * at.x + at.y * at.y);
    double angle = 0;
    if (r != 0) {
        angle = quick_atan2(at.y, fabs(at.x));
        angle = at.x < 0 ? 3 * PI / 2 - angle : PI / 2 + angle;
    }
    double v = at.z + r + p->integer[0] * angle / (2 * PI);
    if (p->turbulence)
        v += p->turbulence->amount.x * pattern_turbulence(p, at);
    *radius = r;
    return v;
}

// The same at eight points.
static inline void spiral_values(const struct pattern *p, const struct noise_kernels *k,
                                 const double at[3][8], double out[8], double radius[8])
{
    double across[8], angle[8], moved[8] = {0};
    const struct turbulence *t = p->turbulence;
    for (int i = 0; i < 8; i++)
        across[i] = fabs(at[0][i]);
    k->atan2(at[1], across, angle);
    if (t)
        noise_turbulence8(k, at, t->lambda, t->omega, t->octaves,
                          pattern_noise_generator(p), moved);
    for (int i = 0; i < 8; i++) {
        const double r = sqrt(at[0][i] * at[0][i] + at[1][i] * at[1][i]);
        double a = at[0][i] < 0 ? 3 * PI / 2 - angle[i] : PI / 2 + angle[i];
        a = r != 0 ? a : 0;
        double v = at[2][i] + r + p->integer[0] * a / (2 * PI);
        if (t)
            v += t->amount.x * moved[i];
        radius[i] = r;
        out[i] = v;
    }
}

static inline uint32_t spiral_formula(struct formula *f, const struct pattern *p,
                                      const uint32_t at[3], uint32_t *radius)
{
    const double half = PI / 2;
    const uint32_t r = formula_length(f, at[0], at[1]), zero = formula_constant(f, 0);
    const uint32_t a = tape_binary(f->b, TAPE_ATAN2, at[1], formula_abs(f, at[0]));
    const uint32_t left = formula_subtract(f, formula_constant(f, 3 * half), a);
    uint32_t angle =
        formula_where(f, formula_less(f, at[0], zero), left, formula_offset(f, a, half));
    angle = formula_where(f, formula_less(f, zero, r), angle, zero);
    uint32_t v = formula_add(f, formula_add(f, at[2], r),
                             formula_scale(f, angle, p->integer[0] / (2 * PI)));
    if (p->turbulence)
        v = formula_octaves(f, at);
    *radius = r;
    return v;
}

#endif
