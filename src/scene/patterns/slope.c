// slope: how steep the surface is, mixed with height (spec/textures 5.7)

#include "math/pi.h"
#include "scene/pattern_formula.h"
#include "scene/pattern_math.h"

static double into_range(double v, double low, double high)
{
    return high != low ? (v - low) / (high - low) : v;
}

static double wrapped(double v)
{
    v = fmod(v, 1);
    return v < 0 ? v + 1 : v;
}

static double steepness(const struct pattern *p, const struct pattern_context *c)
{
    struct vec3 up = p->vector;
    if (p->point_at)
        up = vec3_sub(up, c->p_world);
    double s = vec3_dot(c->normal, vec3_normalize(up));
    s = s < -1 ? -1 : s > 1 ? 1 : s;
    return into_range((det_asin(s) * 2 / PI + 1) * 0.5, p->low, p->high);
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    if (c->normal.x == 0 && c->normal.y == 0 && c->normal.z == 0)
        return 0;
    const double s = steepness(p, c);
    const double altitude = vec3_length(p->vector2);
    if (p->point_at || altitude == 0)
        return s == 1 ? 1 - PATTERN_EDGE : wrapped(s);
    const double h =
        into_range(vec3_dot(at, vec3_normalize(p->vector2)), p->low2, p->high2);
    const double length = vec3_length(p->vector);
    const double share = length / (float)(length + altitude);
    const double v = share * s + (1 - share) * h;
    return v >= 1 && v < 1 + PATTERN_EDGE ? v - PATTERN_EDGE : wrapped(v);
}

// No surface is there.
static uint32_t formula(struct formula *f, const struct pattern *p, const uint32_t at[3])
{
    (void)p;
    (void)at;
    return formula_constant(f, 0);
}

const struct pattern_ops slope_pattern_ops = {
    .keyword = "slope", .frequency = 1, .value = value, .formula = formula};
