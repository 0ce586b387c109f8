// A pattern's value at a point (spec/textures 3).

#include "scene/pattern.h"

#include <string.h>

#include "scene/pattern_math.h"

const struct pattern_ops *const pattern_table[] = {
#define PATTERN(name) &name##_pattern_ops,
#include "scene/patterns.def"
#undef PATTERN
};
const size_t pattern_count = sizeof pattern_table / sizeof pattern_table[0];

const struct pattern_ops *pattern_find(const char *keyword, size_t len)
{
    for (size_t i = 0; i < pattern_count; i++) {
        const char *k = pattern_table[i]->keyword;
        if (strlen(k) == len && !memcmp(k, keyword, len))
            return pattern_table[i];
    }
    return NULL;
}

static void forget_parameters(struct pattern *p)
{
    p->vector = p->vector2 = vec3(0, 0, 0);
    p->low = p->high = p->low2 = p->high2 = 0;
    p->point_at = p->solid = false;
    memset(p->value, 0, sizeof p->value);
    memset(p->integer, 0, sizeof p->integer);
    p->metric = p->offset = 0;
    p->exterior_type = p->interior_type = p->fractal_exponent = 0;
    p->exterior_factor = p->interior_factor = 0;
    p->object = NULL;
    p->pigment = NULL;
    p->tape = NULL;
    p->image = NULL;
    p->density = NULL;
    p->function = NULL;
    p->function_data = NULL;
}

void pattern_set_kind(struct pattern *p, const struct pattern_ops *ops)
{
    if (!p->ops) {
        p->frequency = 1;
        p->exponent = 1;
    }
    forget_parameters(p);
    p->ops = ops;
    if (ops->wave != WAVE_RAMP)
        p->wave = ops->wave;
    if (ops->frequency == 0)
        p->frequency = 0;
    if (ops->init)
        ops->init(p);
}

double pattern_wave(const struct pattern *p, double v)
{
    switch (p->wave) {
    case WAVE_RAMP: return v;
    case WAVE_TRIANGLE: return triangle_wave(v);
    case WAVE_SINE: return (1 + cycloidal(v)) * 0.5;
    case WAVE_SCALLOP: return fabs(cycloidal(v * 0.5));
    case WAVE_CUBIC: return v * v * (3 - 2 * v);
    case WAVE_POLY: return det_pow(v, p->exponent);
    }
    return v;
}

static inline double finished(const struct pattern *p, double v)
{
    if (p->frequency != 0) {
        v = v * p->frequency + p->phase;
        if (fabs(v) >= PATTERN_MODULUS)
            v = fmod(v, PATTERN_MODULUS);
    }
    if (v < 0)
        v -= floor(v);
    return pattern_wave(p, v);
}

double pattern_value_at(const struct pattern *p, struct vec3 q,
                        const struct pattern_context *c)
{
    return finished(p, p->ops->value(p, q, c));
}

double pattern_value(const struct pattern *p, struct vec3 at,
                     const struct pattern_context *c)
{
    return pattern_value_at(p, pattern_warp(p, at), c);
}
