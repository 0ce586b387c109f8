// image_pattern { }: the grey or alpha of an image (spec/textures 9.7); image_map and
// bump_map stand on it too, for their warps
#include "scene/image_map.h"
#include "scene/pattern.h"
#include "scene/pattern_formula.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->image ? image_map_value(p->image, at) : 0;
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    if (!p->image)
        return formula_constant(f, 0);
    return formula_unknown(f, -INFINITY, INFINITY, at);
}

const struct pattern_ops image_pattern_pattern_ops = {
    .keyword = "image_pattern", .frequency = 0, .value = value, .formula = formula};
