// Targa files of 8, 24 or 32 bits from the top, plain or in runs.
#include "image/codec.h"

#include <string.h>

enum { GREY = 3, COLORS = 2, PACKED = 8, FROM_TOP = 0x20, RUN_MAX = 128 };

static void write_header(struct byte_buffer *out, const struct image *im,
                         const struct image_write_options *o, int channels)
{
    uint8_t h[18] = {0};
    h[2] = (uint8_t)((o->grey ? GREY : COLORS) + (o->compression ? PACKED : 0));
    h[12] = (uint8_t)im->width, h[13] = (uint8_t)(im->width >> 8);
    h[14] = (uint8_t)im->height, h[15] = (uint8_t)(im->height >> 8);
    h[16] = (uint8_t)(8 * channels);
    h[17] = (uint8_t)(FROM_TOP | (o->alpha ? 8 : 0));
    byte_buffer_append(out, h, sizeof h);
}

// How many pixels from `p` on are the same, or differ each from the next.
static int stretch(const uint8_t *p, int left, int size, bool same)
{
    int n = 1;
    left = left < RUN_MAX ? left : RUN_MAX;
    while (n < left &&
           (memcmp(p + (n - 1) * size, p + n * size, (size_t)size) == 0) == same)
        n++;
    // The first pixel of a run that follows belongs to that run.
    return same || n == left ? n : n - 1;
}

static void write_packed(struct byte_buffer *out, const uint8_t *row, int width, int size)
{
    for (int x = 0; x < width;) {
        const uint8_t *p = row + (size_t)x * (size_t)size;
        const int same = stretch(p, width - x, size, true);
        const bool run = same > 1;
        const int n = run ? same : stretch(p, width - x, size, false);
        const uint8_t head = (uint8_t)((n - 1) | (run ? 0x80 : 0));
        byte_buffer_append(out, &head, 1);
        byte_buffer_append(out, p, (size_t)(run ? 1 : n) * (size_t)size);
        x += n;
    }
}

bool tga_encode(const struct image *im, const struct image_write_options *options,
                struct byte_buffer *out, struct codec_error e)
{
    struct image_write_options o = *options;
    struct sample_rows rows;
    o.bits = 8;
    o.alpha = o.alpha && !o.grey;
    if (im->width > 0xffff || im->height > 0xffff)
        return codec_fail(e, "a TGA file has at most 65535 columns and rows");
    const int channels = quantize_channels(&o);
    const bool ok = sample_rows_begin(&rows, im, &o);
    write_header(out, im, &o, channels);
    for (int y = 0; ok && y < im->height; y++) {
        const uint8_t *row = sample_rows_bgr(&rows, y);
        if (o.compression)
            write_packed(out, row, im->width, channels);
        else
            byte_buffer_append(out, row, rows.count);
    }
    sample_rows_end(&rows);
    return (ok && !out->failed) || codec_fail(e, "out of memory");
}
