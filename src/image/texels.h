#ifndef IMAGE_TEXELS_H
#define IMAGE_TEXELS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/image.h"
#include "math/color.h"

// Pictures that scenes read: the numbers as the file has them, so that a height is a
// height and a palette index an index; colours are made from them where they are used.
// Memory is what the numbers take (width * height * channels * bytes of the format),
// plus 4 bytes per palette entry.
enum texel_format { TEXEL_U8, TEXEL_U16, TEXEL_F32 };

struct texels {
    enum image_type type;
    int width, height; // rows from the top
    int channels;      // 1 grey or palette index, 2 grey and alpha, 3 rgb, 4 rgba
    enum texel_format format;
    float max;    // the integer that means 1: 255, 65535 or the file's own; floats: 1
    bool indexed; // channel 0 is an index into the palette
    int palette_count;        // 1..256
    uint8_t (*palette)[4];    // red, green, blue, alpha (255: opaque), not premultiplied
    bool palette_alpha;       // the file gives its palette alpha
    bool premultiplied;       // as files of this type are
    bool has_encoding;        // the file says how its numbers are encoded:
    struct transfer encoding; // (PNG: sRGB, gAMA)
    void *data;
};

// Reads a file of any type (by its first bytes; TGA, which has no mark, by the name or
// when `assume` says so). False: error says why, and *t is empty.
bool texels_read(struct texels *t, const char *path, enum image_type assume, char *error,
                 size_t error_size);
// The same from memory.
bool texels_decode(struct texels *t, const uint8_t *data, size_t size,
                   enum image_type assume, char *error, size_t error_size);
void texels_free(struct texels *t);
size_t texels_size(const struct texels *t); // bytes of memory
// The type that a file name's extension names, of all that can be read.
enum image_type texels_type_of(const char *path);

// Sample k of texel (x, y) as the file has it: 0..255, 0..65535 or the float.
static inline double texels_raw(const struct texels *t, int x, int y, int k)
{
    const size_t at =
        ((size_t)y * (size_t)t->width + (size_t)x) * (size_t)t->channels + (size_t)k;
    switch (t->format) {
    case TEXEL_U8: return ((const uint8_t *)t->data)[at];
    case TEXEL_U16: return ((const uint16_t *)t->data)[at];
    case TEXEL_F32: break;
    }
    return (double)((const float *)t->data)[at];
}
static inline int texels_index(const struct texels *t, int x, int y)
{
    return ((const uint8_t *)t->data)[(size_t)y * (size_t)t->width + (size_t)x];
}
// The sample as a float of 0..1 (floats as they are), decoded; palette indices have none.
float texels_sample(const struct texels *t, int x, int y, int k, struct transfer decode);
// Grey of 8 bits in PNG files loses a little in the language's own store, which the
// scenes' pictures show (spec/textures 9.6): some levels drop by one. v is decoded.
static inline bool texels_grey_is_coarse(const struct texels *t)
{
    return t->type == IMAGE_PNG && t->channels == 1 && t->format == TEXEL_U8 &&
           !t->indexed;
}
static inline float texels_coarse_grey(float v)
{
    const float g = rgb_luminance(rgb_even(v));
    return (float)(int)(g * 255) / 255;
}
// Heights of GIF files in the way of Fractint: the left half holds the high bytes, the
// right half the low ones (the type `pot`). False: the image is not of that kind.
bool texels_join_halves(struct texels *t);
// The height that a height_field takes from a texel, 0..65535 for integer files
// (spec/shapes 4.21). `decode` is what the scene's `gamma` asks for (TRANSFER_NONE: the
// file's own numbers).
double texels_height(const struct texels *t, int x, int y, struct transfer decode);

#endif
