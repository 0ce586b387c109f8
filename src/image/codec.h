#ifndef IMAGE_CODEC_H
#define IMAGE_CODEC_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "image/image.h"

// What the file formats share. Only src/image includes it.

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
struct quantizer *quantizer_new(const struct image_write_options *o);
void quantizer_free(struct quantizer *q);
void quantize_row(const struct quantizer *q, const struct image *im, int y,
                  const struct image_write_options *o, uint16_t *out);

bool png_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e);
bool ppm_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e);
bool exr_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e);

bool png_decode(struct image *im, const uint8_t *data, size_t size, struct transfer t,
                struct codec_error e);
bool ppm_decode(struct image *im, const uint8_t *data, size_t size, struct transfer t,
                struct codec_error e);
bool exr_decode(struct image *im, const uint8_t *data, size_t size, struct codec_error e);

#endif
