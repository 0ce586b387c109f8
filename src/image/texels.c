// The store of pictures that scenes read, and the choice of a reader.
#include "image/texels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

#include "image/codec.h"
#include "math/color.h"

static size_t sample_size(enum texel_format f)
{
    return f == TEXEL_U8 ? 1 : f == TEXEL_U16 ? 2 : sizeof(float);
}

size_t texels_size(const struct texels *t)
{
    return (size_t)t->width * (size_t)t->height * (size_t)t->channels *
               sample_size(t->format) +
           4 * (size_t)t->palette_count;
}

void texels_free(struct texels *t)
{
    free(t->data);
    free(t->palette);
    *t = (struct texels){.type = IMAGE_UNKNOWN};
}

bool texels_allocate(struct texels *t, uint64_t width, uint64_t height, int channels,
                     enum texel_format format, size_t file_size, double most,
                     struct codec_error e)
{
    if (!width || !height)
        return codec_fail(e, "it has no pixels");
    if (width > INT32_MAX || height > INT32_MAX || width * height > INT32_MAX ||
        (most > 0 && (double)(width * height) > most * (double)file_size))
        return codec_fail(e, "it claims %llu x %llu pixels in %zu bytes",
                          (unsigned long long)width, (unsigned long long)height,
                          file_size);
    t->width = (int)width;
    t->height = (int)height;
    t->channels = channels;
    t->format = format;
    t->max = format == TEXEL_U8 ? 255 : format == TEXEL_U16 ? 65535 : 1;
    t->data = calloc((size_t)(width * height), (size_t)channels * sample_size(format));
    return t->data ||
           codec_fail(e, "out of memory for %d x %d pixels", t->width, t->height);
}

bool texels_palette(struct texels *t, int count, struct codec_error e)
{
    t->palette = calloc((size_t)count, sizeof *t->palette);
    if (!t->palette)
        return codec_fail(e, "out of memory");
    for (int i = 0; i < count; i++)
        t->palette[i][3] = 255;
    t->palette_count = count;
    t->indexed = true;
    return true;
}

// Every use of an index looks the palette up, so none may point outside it.
static bool check_indices(const struct texels *t, struct codec_error e)
{
    const uint8_t *p = t->data;
    size_t n = (size_t)t->width * (size_t)t->height;
    for (size_t i = 0; i < n; i++)
        if (p[i] >= t->palette_count)
            return codec_fail(e, "it uses colour %d of a palette of %d", p[i],
                              t->palette_count);
    return true;
}

static texels_reader *const readers[] = {
    [IMAGE_PNG] = png_texels,   [IMAGE_EXR] = exr_texels,   [IMAGE_PPM] = pnm_texels,
    [IMAGE_JPEG] = jpeg_texels, [IMAGE_TIFF] = tiff_texels, [IMAGE_GIF] = gif_texels,
    [IMAGE_TGA] = tga_texels,   [IMAGE_BMP] = bmp_texels,   [IMAGE_IFF] = iff_texels,
    [IMAGE_HDR] = hdr_texels,
};

bool texels_decode(struct texels *t, const uint8_t *data, size_t size,
                   enum image_type assume, char *error, size_t error_size)
{
    struct codec_error e = {error, error_size};
    enum image_type type = image_type_of_bytes(data, size);
    if (type == IMAGE_UNKNOWN && assume == IMAGE_TGA)
        type = IMAGE_TGA;
    *t = (struct texels){.type = type};
    bool ok = type == IMAGE_UNKNOWN ? codec_fail(e, "it is no image of a known type")
                                    : readers[type](t, data, size, e) &&
                                          (!t->indexed || check_indices(t, e));
    if (!ok)
        texels_free(t);
    return ok;
}

bool texels_read(struct texels *t, const char *path, enum image_type assume, char *error,
                 size_t error_size)
{
    struct codec_error e = {error, error_size};
    struct byte_buffer b = {0};
    *t = (struct texels){.type = IMAGE_UNKNOWN};
    if (assume == IMAGE_UNKNOWN)
        assume = texels_type_of(path);
    struct stat st; // devices and pipes may never end
    bool regular = stat(path, &st) != 0 || S_ISREG(st.st_mode) ||
                   codec_fail(e, "it is no regular file");
    bool ok = regular && file_bytes(path, &b, e) &&
              texels_decode(t, b.data, b.size, assume, error, error_size);
    free(b.data);
    return ok;
}

enum image_type texels_type_of(const char *path)
{
    static const struct {
        const char *extension;
        enum image_type type;
    } types[] = {
        {".png", IMAGE_PNG},   {".exr", IMAGE_EXR},   {".ppm", IMAGE_PPM},
        {".pgm", IMAGE_PPM},   {".pnm", IMAGE_PPM},   {".pbm", IMAGE_PPM},
        {".jpg", IMAGE_JPEG},  {".jpeg", IMAGE_JPEG}, {".tif", IMAGE_TIFF},
        {".tiff", IMAGE_TIFF}, {".gif", IMAGE_GIF},   {".tga", IMAGE_TGA},
        {".bmp", IMAGE_BMP},   {".iff", IMAGE_IFF},   {".hdr", IMAGE_HDR},
    };
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof types / sizeof types[0]; i++)
        if (strcasecmp(dot, types[i].extension) == 0)
            return types[i].type;
    return IMAGE_UNKNOWN;
}

float texels_sample(const struct texels *t, int x, int y, int k, struct transfer decode)
{
    float v = (float)texels_raw(t, x, y, k) / t->max;
    if (decode.kind != TRANSFER_NONE && k < (t->channels < 3 ? 1 : 3))
        v = (float)transfer_decode(decode, (double)v);
    return texels_grey_is_coarse(t) ? texels_coarse_grey(v) : v;
}

double texels_height(const struct texels *t, int x, int y, struct transfer decode)
{
    if (t->indexed)
        return 256.0 * texels_index(t, x, y);
    const double r = (double)texels_sample(t, x, y, 0, decode);
    if (t->channels < 3)
        return trunc((double)((float)r * 65535));
    const double g = (double)texels_sample(t, x, y, 1, decode);
    if (t->format != TEXEL_U16)
        return fmod(trunc((256 * r + g) * 255), 65536); // what 16 bits keep
    const double b = (double)texels_sample(t, x, y, 2, decode);
    return trunc(65535 * luminance(r, g, b));
}

bool texels_join_halves(struct texels *t)
{
    const int width = t->width / 2;
    if (!t->indexed || width < 1)
        return false;
    struct texels joined = {.type = t->type, .has_encoding = false};
    struct codec_error none = {(char[1]){0}, 1};
    if (!texels_allocate(&joined, (uint64_t)width, (uint64_t)t->height, 1, TEXEL_U16, 0,
                         0, none))
        return false;
    for (int y = 0; y < t->height; y++)
        for (int x = 0; x < width; x++)
            texels_row16(&joined, y)[x] =
                (uint16_t)(texels_index(t, x, y) << 8 | texels_index(t, x + width, y));
    texels_free(t);
    *t = joined;
    return true;
}
