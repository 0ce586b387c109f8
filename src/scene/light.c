#include "scene/light.h"

const struct light light_default = {
    .kind = LIGHT_POINT,
    .color = {1, 1, 1},
    .point_at = {0, 0, 1},
    .axis = {0, 0, 1},
    .adaptive = 100, // more levels than any grid has: always the whole grid
    .size1 = 1,
    .size2 = 1,
    .media_interaction = true,
};
