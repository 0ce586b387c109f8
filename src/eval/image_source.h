#ifndef EVAL_IMAGE_SOURCE_H
#define EVAL_IMAGE_SOURCE_H

#include "eval/build.h"
#include "image/image.h"

struct image_map;
struct texels;

// Where the images of a scene come from: files and functions (spec/language 4.9,
// spec/textures 9.1, 9.5).

// What stands before the modifiers of an image.
struct image_source {
    const struct texels *texels;
    bool has_gamma, premultiplied;
    struct transfer gamma; // as written
};

// False: there was an error, which was reported.
bool image_source_read(struct args *a, struct image_source *s);
// How the colours of the source become light, and then what the scene computes with.
void image_source_decode(struct args *a, const struct image_source *s,
                         struct image_map *m);

#endif
