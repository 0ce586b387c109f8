#include "plain_textures.h"

static const struct pigment grey = {.kind = PIGMENT_SOLID, .color = {.r = .5f}};
static const struct pigment clear = {.kind = PIGMENT_SOLID, .color = {.transmit = .5f}};
static const struct finish matt = {.diffuse = .6f, .old_ior = -1};
static const struct texture_layer grey_layer = {.pigment = &grey, .finish = &matt};
static const struct texture_layer clear_layer = {.pigment = &clear, .finish = &matt};
const struct texture grey_texture = {.layer = &grey_layer, .layer_count = 1};
const struct texture clear_texture = {.layer = &clear_layer, .layer_count = 1};
