// spotted: noise

#include "scene/patterns/plain_noise.h"

const struct pattern_ops spotted_pattern_ops = {.keyword = "spotted",
                                                .frequency = 1,
                                                .value = plain_noise_value,
                                                .formula = formula_noise,
                                                .values = plain_noise_values};
