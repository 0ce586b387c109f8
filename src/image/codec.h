#ifndef IMAGE_CODEC_H
#define IMAGE_CODEC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/image.h"
#include "image/texels.h"

// What the file formats share, those of pictures and (src/api) of meshes.

// A file being made in memory, so that a file on disk is written in one go.
struct byte_buffer {
    uint8_t *data;
    size_t size, capacity;
    bool failed; // out of memory; later writes do nothing
};
void byte_buffer_write(struct byte_buffer *b, size_t offset, const void *data, size_t n);
void byte_buffer_append(struct byte_buffer *b, const void *data, size_t n);

struct codec_error {
    char *text;
    size_t size;
};
// Always false, so that `return codec_fail(...)` reads well.
bool codec_fail(struct codec_error e, const char *fmt, ...)
    __attribute__((format(printf, 2, 3)));

// The samples of row y as integers of options->bits bits, in file order: grey or
// red, green, blue, then alpha when written (spec/lighting.md 3.4, 3.5).
int quantize_channels(const struct image_write_options *o);
struct quantizer; // the codes of one set of options; NULL: out of memory
struct quantizer *quantizer_new(const struct image_write_options *o, int width);
void quantizer_free(struct quantizer *q);
void quantize_row(const struct quantizer *q, const struct image *im, int y,
                  const struct image_write_options *o, uint16_t *out);

// The rows of an integer file, quantized one after the other from the top (dithering
// hands errors on).
struct sample_rows {
    const struct image *im;
    struct image_write_options o;
    struct quantizer *quantizer;
    size_t count; // samples in a row
    uint16_t *samples;
    uint8_t *bytes;
};
bool sample_rows_begin(struct sample_rows *r, const struct image *im,
                       const struct image_write_options *o); // false: out of memory
void sample_rows_end(struct sample_rows *r);
// Row y as bytes, two a sample, high byte first, when it has more than 8 bits; samples
// are moved up by `shift` bits.
const uint8_t *sample_rows_bytes(struct sample_rows *r, int y, int shift);
// The same with blue first, for 8 bits.
const uint8_t *sample_rows_bgr(struct sample_rows *r, int y);

// The picture as linear light of three or four channels, to be freed; false: no memory. What is
// no number becomes 0, and what lies beyond +-most becomes that.
bool image_linear(struct image *to, const struct image *im,
                  const struct image_write_options *o, int channels, float most);

// One writer per file type (writers.def).
typedef bool image_encoder(const struct image *im, const struct image_write_options *o,
                           struct byte_buffer *out, struct codec_error e);
image_encoder png_encode, ppm_encode, exr_encode, jpeg_encode, tga_encode, bmp_encode,
    hdr_encode;

enum image_type image_type_of_bytes(const uint8_t *data, size_t size);
// The whole file, to be freed.
bool file_bytes(const char *path, struct byte_buffer *b, struct codec_error e);
// Writes all of it; an older file stays whole when this fails. "-" is standard output.
bool file_write(const char *path, const struct byte_buffer *b, struct codec_error e);

// One reader per file type (read_NAME.c). On failure what was allocated stays in *t and
// is freed by the caller.
typedef bool texels_reader(struct texels *t, const uint8_t *data, size_t size,
                           struct codec_error e);
texels_reader png_texels, jpeg_texels, tiff_texels, gif_texels, tga_texels, pnm_texels,
    bmp_texels, iff_texels, hdr_texels, exr_texels;

// Fills in the sizes and allocates zeroed texels, unless the file cannot hold so many:
// a byte of it gives at most `most` texels (0: the format sets no bound). The memory is
// touched only as it is filled, so a header that lies costs little.
bool texels_allocate(struct texels *t, uint64_t width, uint64_t height, int channels,
                     enum texel_format format, size_t file_size, double most,
                     struct codec_error e);
bool texels_palette(struct texels *t, int count, struct codec_error e); // opaque black
static inline uint8_t *texels_row8(const struct texels *t, int y)
{
    return (uint8_t *)t->data + (size_t)y * (size_t)t->width * (size_t)t->channels;
}
static inline uint16_t *texels_row16(const struct texels *t, int y)
{
    return (uint16_t *)t->data + (size_t)y * (size_t)t->width * (size_t)t->channels;
}

// Reads on from a place in memory; past the end it gives zeros and remembers.
struct byte_reader {
    const uint8_t *at, *end;
    bool ended;
};
static inline unsigned read_u8(struct byte_reader *r)
{
    if (r->at < r->end)
        return *r->at++;
    r->ended = true;
    return 0;
}
static inline unsigned read_le16(struct byte_reader *r)
{
    unsigned v = read_u8(r);
    return v | read_u8(r) << 8;
}
static inline uint32_t read_le32(struct byte_reader *r)
{
    uint32_t v = read_le16(r);
    return v | (uint32_t)read_le16(r) << 16;
}
static inline unsigned read_be16(struct byte_reader *r)
{
    unsigned v = read_u8(r) << 8;
    return v | read_u8(r);
}
static inline uint32_t read_be32(struct byte_reader *r)
{
    uint32_t v = (uint32_t)read_be16(r) << 16;
    return v | read_be16(r);
}
static inline void read_skip(struct byte_reader *r, size_t n)
{
    if (n > (size_t)(r->end - r->at)) {
        r->ended = true;
        n = (size_t)(r->end - r->at);
    }
    r->at += n;
}

#endif
