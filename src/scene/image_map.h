#ifndef SCENE_IMAGE_MAP_H
#define SCENE_IMAGE_MAP_H

#include "image/texels.h"
#include "math/color.h"
#include "math/vec.h"

struct arena;

// An image laid on a surface (spec/textures 9): image_map, bump_map, image_pattern,
// material_map. The texels are as in the file; what a colour needs beyond them stands in
// tables made once.
enum image_projection {
    IMAGE_PLANAR = 0,
    IMAGE_SPHERICAL = 1,
    IMAGE_CYLINDRICAL = 2,
    IMAGE_TOROIDAL = 5,
};
enum image_interpolation {
    IMAGE_NEAREST = 0,
    IMAGE_BILINEAR = 2,
    IMAGE_BICUBIC = 3,
    IMAGE_DISTANCE = 4, // weights by the distance to four texels
};

struct image_map {
    const struct texels *texels;
    int projection, interpolation;
    bool once, use_index, use_alpha;
    struct vec2 repeat, offset;      // 1,1 and 0,0
    float filter_all, transmit_all;  // added to every texel; indexed: in the palette
    bool premultiplied;              // as the colours are kept here
    bool opaque;                     // and covers everything
    const struct rgbft *palette;     // indexed images
    const float *decoded;            // by integer sample; NULL: floats
    struct transfer decode, working; // of floats
};

// What stands for a colour of the file: decode by `decode`, then encode by `working`;
// tables go into the arena (4 bytes per integer up to the largest sample).
void image_map_prepare(struct arena *a, struct image_map *m);

// What a point sees, as a pigment: not premultiplied. False outside (spec/textures 9.4).
bool image_map_color(const struct image_map *m, struct vec3 p, struct rgbft *out);
// As a pattern, 0..1; 0 outside.
double image_map_value(const struct image_map *m, struct vec3 p);
// As a normal (spec/textures 9.8): n turned by the slopes of `amount` times the grey.
struct vec3 image_map_bump(const struct image_map *m, float amount, struct vec3 n,
                           struct vec3 p);
// Which of `count` entries a material_map shows.
uint32_t image_map_entry(const struct image_map *m, struct vec3 p, uint32_t count);

#endif
