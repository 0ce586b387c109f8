// waves: rings around number_of_waves points, each of its own width

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
    for (int i = 0; i < waves; i++) {
        const double f = noise_wave_frequency(i);
        sum += cycloidal(source_distance(at, i, &from) * p->frequency * f + p->phase) / f;
    }
    return 0.2 * (2.5 + sum / waves);
}

static struct vec3 perturb(const struct pattern *p, float amount, struct vec3 n,
                           struct vec3 at)
{
    const int waves = pattern_wave_count(p);
    for (int i = 0; i < waves; i++) {
        struct vec3 from;
        const double f = noise_wave_frequency(i), length = source_distance(at, i, &from);
        const double s = cycloidal(length * p->frequency * f + p->phase);
        n = vec3_mad(n, s * (amount / f) / (length * waves), from);
    }
    return n;
}

const struct pattern_ops waves_pattern_ops = {
    .keyword = "waves", .frequency = 1, .value = value, .perturb = perturb};
