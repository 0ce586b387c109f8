#ifndef SCENE_PATTERNS_PLAIN_NOISE_H
#define SCENE_PATTERNS_PLAIN_NOISE_H

// The pattern that is noise and nothing else, of several names.
#include "scene/pattern_formula.h"

double plain_noise_value(const struct pattern *p, struct vec3 at,
                         const struct pattern_context *c);
void plain_noise_values(const struct pattern *p, const struct noise_kernels *k,
                        const double at[3][8], double out[8]);

#endif
