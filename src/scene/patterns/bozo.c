// bozo: noise

#include "scene/patterns/plain_noise.h"

const struct pattern_ops bozo_pattern_ops = {.keyword = "bozo",
                                             .frequency = 1,
                                             .value = plain_noise_value,
                                             .formula = formula_noise,
                                             .values = plain_noise_values};
