// finish { } as it is before anything is written (spec/textures 12.6).

#include "scene/texture.h"

const struct finish finish_default = {
    .ambient = {0.1f, 0.1f, 0.1f},
    .diffuse = 0.6f,
    .matt = 0.6f,
    .brilliance = 1,
    .phong_size = 40,
    .roughness = 20,
    .reflection_falloff = 1,
    .reflection_exponent = 1,
    .old_ior = -1,
    .old_caustics = -1,
    .old_refraction = -1,
};
