// ripples: rings around number_of_waves points, all of the same width

#include "scene/pattern_math.h"

static double source_distance(struct vec3 at, int i, struct vec3 *from)
{
    *from = vec3_sub(at, noise_wave_source(i));
    const double length = vec3_length(*from);
    return length == 0 ? 1 : length;
}

static double value(const struct pattern *p, struct vec3 at,
                    const struct pattern_context *c)
{
    (void)c;
    const int waves = pattern_wave_count(p);
    double sum = 0;
    struct vec3 from;
    for (int i = 0; i < waves; i++)
        sum += cycloidal(source_distance(at, i, &from) * p->frequency + p->phase);
    return 0.5 * (1 + sum / waves);
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    const int waves = pattern_wave_count(p);
    for (int i = 0; i < waves; i++) {
        struct vec3 from;
        const double length = source_distance(at, i, &from);
        const double s = cycloidal(length * p->frequency + p->phase);
        n = vec3_mad(n, s * amount / (length * waves), from);
    }
    return n;
}

const struct pattern_ops ripples_pattern_ops = {
    .keyword = "ripples", .frequency = 1, .value = value, .perturb = perturb};
