// object { O }: 1 inside the object, else 0

#include "scene/object.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->object && object_inside(p->object, at);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_unknown(f, 0, 1, at);
}

const struct pattern_ops object_pattern_ops = {
    .keyword = "object", .frequency = 0, .list = 2, .value = value, .formula = formula};
