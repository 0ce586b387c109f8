// quilted: cushions in unit cubes, shaped by control0 and control1

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static void init(struct pattern *p) { p->value[0] = p->value[1] = 1; }

// Within a cell, -0.5..0.5. A whole negative number falls to the cell below.
static double centred(double v)
{
    const double down = v >= 0 ? floor(v) : -floor(-v) - 1;
    return v - down - 0.5;
}

// The vector from the middle of the cell; *height is the cushion's profile there.
static struct vec3 cushion(const struct pattern *p, struct vec3 at, double *height)
{
    const struct vec3 w = vec3(centred(at.x), centred(at.y), centred(at.z));
    const double t = vec3_length(w), s = 1 - t;
    *height = (t * t * t + 3 * t * s * s * p->value[0] + 3 * t * t * s * p->value[1]) *
              PATTERN_CUSHION;
    return w;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    double b;
    const struct vec3 w = cushion(p, at, &b);
    return (fabs(b * w.x) + fabs(b * w.y) + fabs(b * w.z)) / 3;
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    double b;
    const struct vec3 w = cushion(p, at, &b);
    return vec3_mad(n, amount * b, w);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    uint32_t w[3]; // distances from the middle of the cell: half less half a sawtooth
    for (int i = 0; i < 3; i++)
        w[i] = formula_offset(f, formula_scale(f, formula_triangle(f, at[i]), -0.5), 0.5);
    const uint32_t t = formula_length3(f, w);
    const uint32_t s = formula_subtract(f, formula_constant(f, 1), t);
    const uint32_t tt = tape_unary(f->b, TAPE_SQUARE, t),
                   ss = tape_unary(f->b, TAPE_SQUARE, s);
    uint32_t b = formula_multiply(f, tt, t);
    b = formula_add(f, b, formula_scale(f, formula_multiply(f, t, ss), 3 * p->value[0]));
    b = formula_add(f, b, formula_scale(f, formula_multiply(f, tt, s), 3 * p->value[1]));
    const uint32_t sum = formula_add(f, formula_add(f, w[0], w[1]), w[2]);
    return formula_scale(f, formula_multiply(f, formula_abs(f, b), sum),
                         PATTERN_CUSHION / 3);
}

const struct pattern_ops quilted_pattern_ops = {.keyword = "quilted",
                                                .frequency = 0,
                                                .init = init,
                                                .value = value,
                                                .plain = PLAIN_QUILTED,
                                                .formula = formula,
                                                .perturb = perturb};
