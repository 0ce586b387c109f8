// image_pattern { }: the grey or alpha of an image (spec/textures 9.7); image_map and
// bump_map stand on it too, for their warps
#include "scene/image_map.h"
#include "scene/pattern.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->image ? image_map_value(p->image, at) : 0;
}

const struct pattern_ops image_pattern_pattern_ops = {
    .keyword = "image_pattern", .frequency = 0, .value = value};
