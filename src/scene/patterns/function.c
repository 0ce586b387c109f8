// function { F }: what the scene wrote

#include "scene/noise_kernel.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"
#include "scene/tape_kernel.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->function ? wrap_above_one(p->function(p->function_data, at)) : 0;
}

static void values(const struct pattern *p, const struct noise_kernels *k,
                   const double at[3][8], double out[8])
{
    const struct tape *t = p->function == tape_at ? p->function_data : NULL;
    if (t && tape_is_flat(t)) {
        k->tapes->exact(t, at, out);
        for (int i = 0; i < 8; i++)
            out[i] = wrap_above_one(out[i]);
    } else {
        for (int i = 0; i < 8; i++)
            out[i] = value(p, vec3(at[0][i], at[1][i], at[2][i]), NULL);
    }
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    uint32_t v;
    if (p->function == tape_at) {
        tape_call(f->b, p->function_data, at, &v);
        return formula_wrap(f, v);
    }
    return p->function ? formula_unknown(f, -INFINITY, INFINITY, at)
                       : formula_constant(f, 0);
}

const struct pattern_ops function_pattern_ops = {.keyword = "function",
                                                 .frequency = 1,
                                                 .value = value,
                                                 .formula = formula,
                                                 .values = values};
