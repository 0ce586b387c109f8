// object { O }: 1 inside the object, else 0

#include "scene/object.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    return p->object && object_inside(p->object, at);
}

const struct pattern_ops object_pattern_ops = {
    .keyword = "object", .frequency = 0, .list = 2, .value = value};
