// Windows bitmaps from the bottom: 24 bits, 32 with masks (header version 4), which tell
// that there is alpha, or 8 with a palette of greys.
#include "image/codec.h"

enum {
    FILE_HEADER = 14,
    INFO_HEADER = 40,
    VERSION_4 = 108,
    FIELDS = 3,
    SRGB = 0x73524742,
    GREYS = 256,
};

static void put(struct byte_buffer *out, uint32_t v, int bytes)
{
    uint8_t b[4];
    for (int i = 0; i < bytes; i++)
        b[i] = (uint8_t)(v >> 8 * i);
    byte_buffer_append(out, b, (size_t)bytes);
}

// The size of what stands before the pixels.
static uint32_t header_size(const struct image_write_options *o)
{
    return FILE_HEADER + (o->grey    ? INFO_HEADER + 4 * GREYS
                          : o->alpha ? VERSION_4
                                     : INFO_HEADER);
}

static void write_header(struct byte_buffer *out, const struct image *im,
                         const struct image_write_options *o, uint32_t pixels)
{
    byte_buffer_append(out, "BM", 2);
    put(out, header_size(o) + pixels, 4);
    put(out, 0, 4);
    put(out, header_size(o), 4);
    put(out, o->alpha ? VERSION_4 : INFO_HEADER, 4);
    put(out, (uint32_t)im->width, 4);
    put(out, (uint32_t)im->height, 4);
    put(out, 1, 2); // planes
    put(out, (uint32_t)(8 * quantize_channels(o)), 2);
    put(out, o->alpha ? FIELDS : 0, 4);
    put(out, pixels, 4);
    for (int i = 0; i < 4; i++)
        put(out, 0, 4); // resolution, colours of the palette: all
    for (uint32_t i = 0; o->grey && i < GREYS; i++)
        put(out, i * 0x10101, 4);
    static const uint32_t masks[] = {0xff0000, 0xff00, 0xff, 0xff000000, SRGB};
    for (int i = 0; o->alpha && i < 5; i++)
        put(out, masks[i], 4);
    for (int i = 0; o->alpha && i < 12; i++)
        put(out, 0, 4); // end points and gammas: for other colour spaces
}

bool bmp_encode(const struct image *im, const struct image_write_options *options,
                struct byte_buffer *out, struct codec_error e)
{
    static const uint8_t zeros[4] = {0};
    struct image_write_options o = *options;
    struct sample_rows rows;
    o.bits = 8;
    o.alpha = o.alpha && !o.grey;
    const size_t used = (size_t)im->width * (size_t)quantize_channels(&o);
    const size_t stride = (used + 3) & ~(size_t)3, start = header_size(&o);
    if (stride > (INT32_MAX - start) / (size_t)im->height)
        return codec_fail(e, "a BMP file has at most 2^31 bytes");
    const bool ok = sample_rows_begin(&rows, im, &o);
    write_header(out, im, &o, (uint32_t)(stride * (size_t)im->height));
    for (int y = 0; ok && y < im->height; y++) {
        const size_t at = start + stride * (size_t)(im->height - 1 - y);
        byte_buffer_write(out, at, sample_rows_bgr(&rows, y), used);
        byte_buffer_write(out, at + used, zeros, stride - used);
    }
    sample_rows_end(&rows);
    return (ok && !out->failed) || codec_fail(e, "out of memory");
}
