// hexagon: three kinds of hexagons in the xz plane, spec/textures 5.5

#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double floor_down(double v) { return v >= 0 ? floor(v) : -floor(-v) - 1; }

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)p;
    (void)c;
    static const double left[6] = {0, 1, 1, 2, 2, 0}, middle[6] = {2, 2, 0, 0, 1, 1};
    static const double below[6] = {0, 2, 1, 0, 2, 1}, above[6] = {2, 1, 0, 2, 1, 0};
    const double u = fold(fabs(at.x) / 0.5, 6);
    const double z = at.z >= 0 ? at.z : PATTERN_THREE_ROOT3 - fabs(at.z);
    const double w = fold(z / PATTERN_HALF_ROOT3, 6);
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

// Within one triangle of one cell of the lattice, by its corners; else anything.
static bool is_settled(const struct interval in[3])
{
    const struct interval x = interval_abs(in[0]);
    if (in[2].lo < 0 && in[2].hi >= 0)
        return false;
    const struct interval z = in[2].lo >= 0 ? in[2]
                                            : interval(PATTERN_THREE_ROOT3 + in[2].lo,
                                                       PATTERN_THREE_ROOT3 + in[2].hi);
    const double slack = 1e-9 * (1 + interval_size(x) + interval_size(in[2]));
    const double u0 = fmax(x.lo / 0.5 - slack, 0), u1 = x.hi / 0.5 + slack;
    const double w0 = z.lo / PATTERN_HALF_ROOT3 - slack,
                 w1 = z.hi / PATTERN_HALF_ROOT3 + slack;
    if (floor(u0) != floor(u1) || floor(w0) != floor(w1))
        return false;
    const int i = (int)fold(floor(u0), 6), j = (int)fold(floor(w0), 6);
    if (i != 1 && i != 4)
        return true;
    const bool falls = (i + j) % 2 == 1;
    const double a0 = falls ? 1 - (u1 - floor(u0)) : u0 - floor(u0);
    const double a1 = falls ? 1 - (u0 - floor(u0)) : u1 - floor(u0);
    return w1 - floor(w0) < a0 || w0 - floor(w0) > a1;
}

static void bounds(const void *data, const struct interval *in, struct interval *out,
                   struct interval *partial)
{
    (void)data;
    const bool settled = is_settled(in);
    const double v =
        value(NULL, vec3(interval_middle(in[0]), 0, interval_middle(in[2])), NULL);
    out[0] = settled ? interval_point(v) : interval(0, 2);
    for (int i = 0; partial && i < 3; i++)
        partial[i] = settled ? interval_point(0) : interval_whole();
}

static const struct tape_extern hexagon = {
    .name = "hexagon", .arguments = 3, .width = 1, .bounds = bounds};

static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    return formula_extern(f, &hexagon, NULL, at);
}

const struct pattern_ops hexagon_pattern_ops = {.keyword = "hexagon",
                                                .frequency = 0,
                                                .list = 3,
                                                .value = value,
                                                .plain = PLAIN_HEXAGON,
                                                .formula = formula};
