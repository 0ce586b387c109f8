// hexagon: three kinds of hexagons in the xz plane, spec/textures 5.5

#include "scene/pattern_math.h"

#define HALF_ROOT3  0.866025404
#define THREE_ROOT3 5.196152424

static double floor_down(double v) { return v >= 0 ? floor(v) : -floor(-v) - 1; }

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    static const double left[6] = {0, 1, 1, 2, 2, 0}, middle[6] = {2, 2, 0, 0, 1, 1};
    static const double below[6] = {0, 2, 1, 0, 2, 1}, above[6] = {2, 1, 0, 2, 1, 0};
    const double u = fold(fabs(at.x) / 0.5, 6);
    const double z = at.z >= 0 ? at.z : THREE_ROOT3 - fabs(at.z);
    const double w = fold(z / HALF_ROOT3, 6);
    const int i = (int)floor_down(u) % 6, row = (int)floor_down(w);
    const int j = (row % 6 + 6) % 6;
    if (i == 0 || i == 5)
        return left[j];
    if (i == 2 || i == 3)
        return middle[j];
    double a = u - i, b = w - row;
    if ((i + j) % 2 == 1)
        a = 1 - a;
    if (a == 0)
        a = 0.0001;
    return b / a < 1 ? below[j] : above[j];
}

const struct pattern_ops hexagon_pattern_ops = {
    .keyword = "hexagon", .frequency = 0, .list = 3, .value = value};
