// PNG files through libpng, by default with their pixels packed by libdeflate. No time
// stamp: equal pictures give equal bytes.
#include <libdeflate.h>
#include <stdlib.h>
#include <string.h>

#include "image/png_error.h"

// libdeflate's fastest level with rows as differences to the row above: a third of the time
// of zlib's level 3 for files about as large. Rows mostly of one colour after the other are
// left as they are: that takes it half the time of as many zeros, and no more bytes.
static const int usual_level = 1;
static const uint8_t filter_none = 0, filter_up = 2;
static const size_t chunk_most = 1 << 30; // a chunk has fewer than 2^31 bytes

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
    if (o->compression)
        png_set_compression_level(png, o->compression < 9 ? o->compression : 9);
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

static int shift_of(const struct image_write_options *o)
{
    return (o->bits > 8 ? 16 : 8) - o->bits;
}

// Whether four fifths of the bytes are those of the pixel before.
static bool is_flat(const uint8_t *row, size_t size, size_t pixel)
{
    enum { BLOCK = 64 }; // whose count is of one byte, so that many are counted at once
    size_t same = 0;
    for (size_t at = pixel; at < size; at += BLOCK) {
        const size_t n = size - at < BLOCK ? size - at : BLOCK;
        uint8_t count = 0;
        for (size_t i = at; i < at + n; i++)
            count = (uint8_t)(count + (row[i] == row[i - pixel]));
        same += count;
    }
    return same * 5 >= size * 4;
}

// All rows, each after the byte that tells its filter.
static void filter_rows(struct sample_rows *rows, int height, size_t row, uint8_t *to)
{
    const size_t pixel = row / (size_t)rows->im->width;
    for (int y = 0; y < height; y++) {
        uint8_t *at = to + (size_t)y * (row + 1);
        memcpy(at + 1, sample_rows_bytes(rows, y, shift_of(&rows->o)), row);
        *at = is_flat(at + 1, row, pixel) ? filter_none : filter_up;
    }
    for (int y = height - 1; y > 0; y--) {
        uint8_t *at = to + (size_t)y * (row + 1);
        const uint8_t *above = at - (row + 1);
        if (*at == filter_none)
            continue;
        for (size_t i = 1; i <= row; i++)
            at[i] = (uint8_t)(at[i] - above[i]);
    }
}

struct packed {
    uint8_t *data;
    size_t size; // 0: out of memory
};

static struct packed pack(const uint8_t *data, size_t size)
{
    struct packed p = {0};
    struct libdeflate_compressor *c = libdeflate_alloc_compressor(usual_level);
    if (c) {
        const size_t most = libdeflate_zlib_compress_bound(c, size);
        p.data = malloc(most);
        if (p.data)
            p.size = libdeflate_zlib_compress(c, data, size, p.data, most);
        libdeflate_free_compressor(c);
    }
    return p;
}

static struct packed pack_rows(struct sample_rows *rows, const struct image *im)
{
    const size_t row = rows->count * (rows->o.bits > 8 ? 2 : 1);
    const size_t size = (row + 1) * (size_t)im->height;
    struct packed p = {0};
    uint8_t *filtered = malloc(size);
    if (filtered) {
        filter_rows(rows, im->height, row, filtered);
        p = pack(filtered, size);
    }
    free(filtered);
    return p;
}

// What png_write_row and png_write_end do for pixels that libpng is to pack.
static void write_packed(png_structp png, const struct packed *p)
{
    for (size_t at = 0, n; at < p->size; at += n) {
        n = p->size - at < chunk_most ? p->size - at : chunk_most;
        png_write_chunk(png, (png_const_bytep) "IDAT", p->data + at, n);
    }
    png_write_chunk(png, (png_const_bytep) "IEND", NULL, 0);
}

static void write_rows(png_structp png, struct sample_rows *rows, int height)
{
    for (int y = 0; y < height; y++)
        png_write_row(png, sample_rows_bytes(rows, y, shift_of(&rows->o)));
    png_write_end(png, NULL);
}

bool png_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e)
{
    struct sample_rows rows;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &e, png_error_jump,
                                              png_no_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    const bool begun = sample_rows_begin(&rows, im, o) && info;
    const struct packed packed =
        begun && !o->compression ? pack_rows(&rows, im) : (struct packed){0};
    volatile bool ok = false;
    if (!begun || (!o->compression && !packed.size)) {
        codec_fail(e, "out of memory");
    } else if (!setjmp(png_jmpbuf(png))) {
        png_set_write_fn(png, out, on_write, on_flush);
        write_header(png, info, im, o);
        if (packed.size)
            write_packed(png, &packed);
        else
            write_rows(png, &rows, im->height);
        ok = true;
    }
    png_destroy_write_struct(&png, &info);
    sample_rows_end(&rows);
    free(packed.data);
    return ok;
}
