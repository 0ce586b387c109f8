// The internal functions made of noise. f_ridged_mf keeps no table from its first
// call: other parameters later give their own value.

#include "eval/internal_math.h"
#include "scene/noise.h"

#define WRITTEN(name)                                                                    \
    double internal_##name(struct vec3 at, const double *p,                              \
                           const struct pattern_defaults *d)

// Octaves past this change nothing that fits a double, whatever the parameters.
enum { OCTAVES_MAX = 1000 };

static double noise(struct vec3 at, double generator)
{
    return noise_value(at, generator > -2e9 && generator < 2e9 ? (int)generator & 3 : 0);
}

static double octaves(double n) { return smaller(larger(n, 0), OCTAVES_MAX); }
static struct vec3 scaled(struct vec3 v, double k) { return vec3_scale(k, v); }

WRITTEN(noise3d)
{
    (void)p;
    return noise_value(at, d ? d->noise_generator : NOISE_RANGE_CORRECTED);
}

WRITTEN(noise_generator)
{
    (void)d;
    return noise(at, p[0]);
}

static double whole_power(double v, double exponent)
{
    double r = 1;
    for (int i = 1; i <= octaves(exponent); i++)
        r *= v;
    return r;
}

// H, lacunarity, octaves, offset, T, generator
WRITTEN(hetero_mf)
{
    (void)d;
    const double step = power(p[1], -p[0]), n = octaves(p[2]), part = n - (int)n;
    double s = 2 * noise(at, p[5]) - 1 + p[3], weight = step;
    at = scaled(at, p[1]);
    for (int i = 1; i < n; i++) {
        double more = (2 * noise(at, p[5]) - 1 + p[3]) * weight;
        s += more * whole_power(s, p[4]);
        at = scaled(at, p[1]);
        weight *= step;
    }
    if (part != 0)
        s += part * ((2 * noise(at, p[5]) - 1 + p[3]) * weight) * s;
    return s;
}

// lambda, octaves, omega, offset, ridge, generator
WRITTEN(ridge)
{
    (void)d;
    const double k = 1 / larger(p[4], 1 - p[4]), scale = 1 / larger(p[3], 1 - p[3]);
    const double n = octaves(p[1]), part = n - (int)n;
    double length = 1, weight = 1, sum = 0, total = 0;
    for (int i = 1; i <= larger(n, 1) + 1; i++) {
        double share = i <= (int)n || i == 1 ? 1 : part;
        if (share == 0)
            break;
        double v = k * fabs(noise(scaled(at, length), p[5]) - p[4]) - p[3];
        sum += share * weight * v;
        total += share * weight;
        length *= p[0];
        weight *= p[2];
    }
    return sum * scale / total;
}

// H, lacunarity, octaves, offset, gain, generator
WRITTEN(ridged_mf)
{
    (void)d;
    double s = square(p[3] - fabs(2 * noise(at, p[5]) - 1)), sum = s, frequency = 1;
    for (int i = 1; i < octaves(p[2]); i++) {
        at = scaled(at, p[1]);
        frequency *= p[1];
        double weight = smaller(1, larger(0, s * p[4]));
        s = square(p[3] - fabs(2 * noise(at, p[5]) - 1)) * weight;
        sum += s * power(frequency, -p[0]);
    }
    return sum;
}
