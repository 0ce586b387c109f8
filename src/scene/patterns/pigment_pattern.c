// pigment_pattern { P }: the grey of a pigment

#include "math/color.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"
#include "scene/texture.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    const struct texture_point inner = {.p = at,
                                        .uv = c->uv,
                                        .ray_d = c->ray_d,
                                        .p_world = c->p_world,
                                        .normal_seen = c->normal};
    struct rgbft color;
    if (!p->pigment || !pigment_color(p->pigment, &inner, &color))
        return 0;
    return (float)luminance((double)color.r, (double)color.g, (double)color.b);
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    return p->pigment ? formula_grey(f, p->pigment, at) : formula_constant(f, 0);
}

const struct pattern_ops pigment_pattern_pattern_ops = {
    .keyword = "pigment_pattern", .frequency = 1, .value = value, .formula = formula};
