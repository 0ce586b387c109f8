// PNG files through libpng. No time stamp: equal pictures give equal bytes.
#include <stdlib.h>
#include <string.h>

#include "image/png_error.h"

static const int usual_level = 3;

static void on_write(png_structp png, png_bytep data, size_t n)
{
    struct byte_buffer *out = png_get_io_ptr(png);
    byte_buffer_append(out, data, n);
    if (out->failed)
        png_error(png, "out of memory");
}

static void on_flush(png_structp png) { (void)png; }

static void write_text(png_structp png, png_infop info, const struct image_metadata *m)
{
    for (size_t i = 0; i < m->count; i++) {
        png_text t = {.compression = PNG_TEXT_COMPRESSION_NONE};
        // libpng's own structure is not const; it copies the strings.
        t.key = (char *)(uintptr_t)m->key[i];
        t.text = (char *)(uintptr_t)m->text[i];
        t.text_length = strlen(m->text[i]);
        png_set_text(png, info, &t, 1);
    }
}

static void write_color_space(png_structp png, png_infop info,
                              const struct image_write_options *o)
{
    if (o->unmanaged)
        return; // nobody knows what the numbers mean
    if (o->transfer.kind == TRANSFER_SRGB)
        png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_RELATIVE);
    else
        png_set_gAMA(png, info,
                     o->transfer.kind == TRANSFER_POWER ? 1 / o->transfer.gamma : 1);
}

// Bits that fill no 8 or 16 bit sample are moved up, with sBIT saying how many count.
static void write_header(png_structp png, png_infop info, const struct image *im,
                         const struct image_write_options *o)
{
    int type = (o->grey ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB) |
               (o->alpha ? PNG_COLOR_MASK_ALPHA : 0);
    int depth = o->bits <= 8 ? 8 : 16;
    if (o->compression) {
        png_set_compression_level(png, o->compression < 9 ? o->compression : 9);
    } else {
        // The usual: half the time of libpng's choice for files about as large.
        png_set_compression_level(png, usual_level);
        png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    }
    png_set_IHDR(png, info, (png_uint_32)im->width, (png_uint_32)im->height, depth, type,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (o->bits != depth) {
        png_byte n = (png_byte)o->bits;
        png_color_8 significant = {n, n, n, n, n};
        png_set_sBIT(png, info, &significant);
    }
    write_color_space(png, info, o);
    write_text(png, info, &o->metadata);
    png_write_info(png, info);
}

bool png_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e)
{
    struct sample_rows rows;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &e, png_error_jump,
                                              png_no_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    volatile bool ok = false;
    if (!sample_rows_begin(&rows, im, o) || !info) {
        codec_fail(e, "out of memory");
    } else if (!setjmp(png_jmpbuf(png))) {
        png_set_write_fn(png, out, on_write, on_flush);
        write_header(png, info, im, o);
        for (int y = 0; y < im->height; y++)
            png_write_row(png,
                          sample_rows_bytes(&rows, y, (o->bits > 8 ? 16 : 8) - o->bits));
        png_write_end(png, info);
        ok = true;
    }
    png_destroy_write_struct(&png, &info);
    sample_rows_end(&rows);
    return ok;
}
