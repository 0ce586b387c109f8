// PNG files through libpng. No time stamp: equal pictures give equal bytes.
#include "image/codec.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

static const int usual_level = 3;

// libpng reports through longjmp; what must survive it lives here.
struct png_job {
    struct quantizer *quantizer;
    struct codec_error error;
    struct byte_buffer *out;
    const uint8_t *in;
    size_t in_size, in_at;
    uint16_t *samples;
    png_bytep row;
    png_bytepp rows;
    struct image *image;
};

static void on_error(png_structp png, png_const_charp text)
{
    struct png_job *job = png_get_error_ptr(png);
    codec_fail(job->error, "%s", text);
    longjmp(png_jmpbuf(png), 1);
}

static void on_warning(png_structp png, png_const_charp text) { (void)png, (void)text; }

static void on_write(png_structp png, png_bytep data, size_t n)
{
    struct png_job *job = png_get_io_ptr(png);
    byte_buffer_append(job->out, data, n);
    if (job->out->failed)
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
        png_set_compression_level(png, o->compression);
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

static void write_rows(png_structp png, const struct image *im,
                       const struct image_write_options *o, struct png_job *job)
{
    size_t n = (size_t)im->width * (size_t)quantize_channels(o);
    bool wide = o->bits > 8;
    int shift = (wide ? 16 : 8) - o->bits;
    for (int y = 0; y < im->height; y++) {
        quantize_row(job->quantizer, im, y, o, job->samples);
        for (size_t i = 0; i < n; i++) {
            unsigned v = (unsigned)job->samples[i] << shift;
            if (wide) {
                job->row[2 * i] = (png_byte)(v >> 8);
                job->row[2 * i + 1] = (png_byte)v;
            } else {
                job->row[i] = (png_byte)v;
            }
        }
        png_write_row(png, job->row);
    }
}

bool png_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e)
{
    struct png_job job = {.error = e, .out = out};
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    size_t n = (size_t)im->width * 4;
    job.quantizer = quantizer_new(o, im->width);
    job.samples = malloc(n * sizeof *job.samples);
    job.row = malloc(n * 2);
    volatile bool ok = false;
    if (!info || !job.quantizer || !job.samples || !job.row) {
        codec_fail(e, "out of memory");
    } else if (!setjmp(png_jmpbuf(png))) {
        png_set_write_fn(png, &job, on_write, on_flush);
        write_header(png, info, im, o);
        write_rows(png, im, o, &job);
        png_write_end(png, info);
        ok = true;
    }
    png_destroy_write_struct(&png, &info);
    quantizer_free(job.quantizer);
    free(job.samples);
    free(job.row);
    return ok;
}

static void on_read(png_structp png, png_bytep data, size_t n)
{
    struct png_job *job = png_get_io_ptr(png);
    if (n > job->in_size - job->in_at)
        png_error(png, "the file ends too early");
    memcpy(data, job->in + job->in_at, n);
    job->in_at += n;
}

static float decode_sample(const png_byte *p, size_t i, bool wide)
{
    if (wide)
        return (float)((p[2 * i] << 8 | p[2 * i + 1]) / 65535.0);
    return (float)(p[i] / 255.0);
}

// Colours in a file are plain; pictures in memory are premultiplied.
static void decode_row(const png_byte *row, float *out, int width, int channels,
                       bool wide, struct transfer t)
{
    for (int x = 0; x < width; x++) {
        const size_t at = (size_t)x * (size_t)channels;
        float alpha = channels == 4 ? decode_sample(row, at + 3, wide) : 1;
        for (int k = 0; k < 3; k++) {
            float v = decode_sample(row, at + (size_t)k, wide);
            out[at + (size_t)k] = (float)transfer_decode(t, (double)v) * alpha;
        }
        if (channels == 4)
            out[at + 3] = alpha;
    }
}

static void read_rows(png_structp png, png_infop info, struct png_job *job,
                      struct transfer t)
{
    int width = (int)png_get_image_width(png, info);
    int height = (int)png_get_image_height(png, info);
    int channels = png_get_channels(png, info);
    bool wide = png_get_bit_depth(png, info) == 16;
    if (!image_init(job->image, width, height, channels))
        png_error(png, "out of memory");
    size_t stride = png_get_rowbytes(png, info);
    job->row = malloc(stride * (size_t)height);
    job->rows = malloc((size_t)height * sizeof *job->rows);
    if (!job->row || !job->rows)
        png_error(png, "out of memory");
    for (int y = 0; y < height; y++)
        job->rows[y] = job->row + stride * (size_t)y;
    png_read_image(png, job->rows);
    for (int y = 0; y < height; y++)
        decode_row(job->rows[y], image_at(job->image, 0, y), width, channels, wide, t);
}

bool png_decode(struct image *im, const uint8_t *data, size_t size, struct transfer t,
                struct codec_error e)
{
    struct png_job job = {.error = e, .in = data, .in_size = size, .image = im};
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    volatile bool ok = false;
    *im = (struct image){0};
    if (!info) {
        codec_fail(e, "out of memory");
    } else if (!setjmp(png_jmpbuf(png))) {
        png_set_read_fn(png, &job, on_read);
        png_read_info(png, info);
        png_set_expand(png); // palettes, 1-4 bit grey, tRNS
        png_set_gray_to_rgb(png);
        png_set_interlace_handling(png);
        png_read_update_info(png, info);
        read_rows(png, info, &job, t);
        ok = true;
    }
    png_destroy_read_struct(&png, &info, NULL);
    free(job.row);
    free(job.rows);
    if (!ok)
        image_free(im);
    return ok;
}
