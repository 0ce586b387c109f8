#ifndef TEST_PLAIN_TEXTURES_H
#define TEST_PLAIN_TEXTURES_H

#include "scene/texture.h"

// What objects of the tests look like where it does not matter, and where light goes through.
extern const struct texture grey_texture, clear_texture;

#endif
