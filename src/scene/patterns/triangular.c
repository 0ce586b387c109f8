// triangular: six kinds of triangles around each corner, spec/textures 5.5

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    double x = fold(at.x, 3), z = fold(at.z, PATTERN_ROOT3);
    const int a = (int)floor(x);
    x -= a;
    const bool upper = z >= PATTERN_ROOT3 / 2;
    if (upper)
        z = PATTERN_ROOT3 - z;
    const double k = 1 - x;
    int r = 1;
    if (x != 0 && k != 0) {
        const bool left = z / x < PATTERN_ROOT3, right = z / k < PATTERN_ROOT3;
        r = left && right ? 0 : right ? 1 : left ? 3 : 1;
    }
    r = r % 2 == 1 ? (r + 2 * a) % 6 : (6 + r - 2 * a) % 6;
    return upper ? 5 - r : r;
}

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_unknown(f, 0, 5, at);
}

const struct pattern_ops triangular_pattern_ops = {.keyword = "triangular",
                                                   .frequency = 0,
                                                   .list = 6,
                                                   .value = value,
                                                   .plain = PLAIN_TRIANGULAR,
                                                   .formula = formula};
