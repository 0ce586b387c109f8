// brick: courses of bricks (1) in mortar (0), spec/textures 5.2

#include "scene/pattern_math.h"

static void init(struct pattern *p)
{
    p->vector = vec3(8, 3, 4.5); // brick_size
    p->value[0] = 0.5f;          // mortar
}

static double fraction(double t)
{
    t -= trunc(t);
    return t < 0 ? t + 1 : t;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const float m = (float)(p->value[0] - 2 * PATTERN_EDGE);
    const struct vec3 s = p->vector;
    const double move = PATTERN_EDGE + m;
    const double x = (at.x + move) / s.x, y = (at.y + move) / s.y,
                 z = (at.z + move) / s.z;
    if (fraction(y) <= m / s.y)
        return 0;
    if (fraction(0.5 * y) <= 0.5)
        return fraction(x) > m / s.x && fraction(z + 0.5) > m / s.z;
    return fraction(x + 0.5) > m / s.x && fraction(z) > m / s.z;
}

const struct pattern_ops brick_pattern_ops = {
    .keyword = "brick", .frequency = 0, .list = 2, .init = init, .value = value};
