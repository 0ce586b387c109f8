// quilted: cushions in unit cubes, shaped by control0 and control1

#include "scene/pattern_math.h"

static void init(struct pattern *p) { p->value[0] = p->value[1] = 1; }

// Within a cell, -0.5..0.5. A whole negative number falls to the cell below.
static double centred(double v)
{
    const double down = v >= 0 ? floor(v) : -floor(-v) - 1;
    return v - down - 0.5;
}

// The vector from the middle of the cell; *height is the cushion's profile there.
static struct vec3 cushion(const struct pattern *p, struct vec3 at, double *height)
{
    const struct vec3 w = vec3(centred(at.x), centred(at.y), centred(at.z));
    const double t = vec3_length(w), s = 1 - t;
    *height = (t * t * t + 3 * t * s * s * p->value[0] + 3 * t * t * s * p->value[1]) *
              1.154700538;
    return w;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    double b;
    const struct vec3 w = cushion(p, at, &b);
    return (fabs(b * w.x) + fabs(b * w.y) + fabs(b * w.z)) / 3;
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    double b;
    const struct vec3 w = cushion(p, at, &b);
    return vec3_mad(n, amount * b, w);
}

const struct pattern_ops quilted_pattern_ops = {.keyword = "quilted",
                                                .frequency = 1,
                                                .init = init,
                                                .value = value,
                                                .perturb = perturb};
