// radial: the angle around the y axis

#include "math/pi.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double turned(double angle) { return 0.25 + (angle + PI) / (2 * PI); }

static bool is_axis(double x, double z) { return fabs(x) < 0.001 && fabs(z) < 0.001; }

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    return is_axis(at.x, at.z) ? 0.25 : turned(quick_atan2(at.x, at.z));
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    (void)p;
    k->atan2(at[0], at[2], out);
    for (int i = 0; i < 8; i++)
        out[i] = is_axis(at[0][i], at[2][i]) ? 0.25 : turned(out[i]);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    const uint32_t near = formula_constant(f, 0.001);
    const uint32_t angle = tape_binary(f->b, TAPE_ATAN2, at[0], at[2]);
    const uint32_t v = formula_offset(f, formula_scale(f, angle, 1 / (2 * PI)), 0.75);
    const uint32_t axis = formula_both(f, formula_less(f, formula_abs(f, at[0]), near),
                                       formula_less(f, formula_abs(f, at[2]), near));
    return formula_where(f, axis, formula_constant(f, 0.25), v);
}

const struct pattern_ops radial_pattern_ops = {.keyword = "radial",
                                               .frequency = 1,
                                               .value = value,
                                               .formula = formula,
                                               .values = values};
