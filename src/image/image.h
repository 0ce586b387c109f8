#ifndef IMAGE_IMAGE_H
#define IMAGE_IMAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// Pixels as rows from the top, `channels` floats each (3 rgb or 4 premultiplied
// rgba), linear unless said.
struct image {
    int width, height, channels;
    float *pixel;
};

bool image_init(struct image *im, int width, int height, int channels); // zeroed
void image_free(struct image *im);
static inline float *image_at(const struct image *im, int x, int y)
{
    return im->pixel + ((size_t)y * (size_t)im->width + (size_t)x) * (size_t)im->channels;
}

// How numbers are encoded in integer files (spec/lighting.md 3.4).
enum transfer_kind { TRANSFER_NONE, TRANSFER_POWER, TRANSFER_SRGB };
struct transfer {
    enum transfer_kind kind;
    double gamma; // TRANSFER_POWER
};
double transfer_encode(struct transfer t, double linear);
double transfer_decode(struct transfer t, double encoded);
bool transfer_equal(struct transfer a, struct transfer b);

// image/writers.def tells which can be written; image/texels.h reads all.
enum image_type {
    IMAGE_PNG,
    IMAGE_EXR,
    IMAGE_PPM,
    IMAGE_JPEG,
    IMAGE_TIFF,
    IMAGE_GIF,
    IMAGE_TGA,
    IMAGE_BMP,
    IMAGE_IFF,
    IMAGE_HDR,
    IMAGE_UNKNOWN
};
enum image_type image_type_of(const char *path); // by extension, if it can be written
enum image_type image_type_of_word(const char *word); // "png", "jpg", ... or UNKNOWN
const char *image_type_word_of_letter(char letter); // POV-Ray's; NULL: none, in any case
bool image_type_is_light(enum image_type type);     // its files hold linear light

struct image_metadata {
    const char *const *key;
    const char *const *text;
    size_t count;
};

enum dither_method {
    DITHER_NONE,
    DITHER_BAYER_2,
    DITHER_BAYER_3,
    DITHER_BAYER_4,
    DITHER_NEXT,
    DITHER_HALVES,
    DITHER_FLOYD_STEINBERG
};

struct image_write_options {
    enum dither_method dither; // of integer samples
    enum image_type type;
    int bits;   // PNG, PPM: 5 to 16; EXR: 16 half or 32 float; other types have theirs
    bool alpha; // write the fourth channel, where the type has one
    bool grey;
    // PNG: 1..9; JPEG: quality 2..100; TGA: not 0 packs runs. 0: the usual
    int compression;
    struct transfer transfer; // of integer files
    // How the picture's own numbers are encoded; NONE: they are linear light. When it
    // equals `transfer`, integer files get the numbers unchanged.
    struct transfer working;
    // The picture has no gamma of its own (spec/lighting.md 3.3): integer files get
    // its numbers unchanged, EXR gets them decoded by `transfer`.
    bool unmanaged;
    struct image_metadata metadata;
};

// Writes to a temporary file beside `path` and renames it: an older good file is
// never left half overwritten. Same pixels and options give the same bytes. "-" is
// standard output. False: `error` says why.
bool image_write(const struct image *im, const char *path,
                 const struct image_write_options *options, char *error,
                 size_t error_size);
// Reads a file of any type to floats: colours of integer files decoded by `transfer` and,
// where there is alpha, premultiplied.
bool image_read(struct image *im, const char *path, struct transfer transfer, char *error,
                size_t error_size);
enum image_type image_type_of_file(const char *path); // by its first bytes

#endif
