// PNG files through libpng: samples and palette indices as stored.
#include <stdlib.h>
#include <string.h>

#include "image/png_error.h"

// libpng reports through longjmp; what must survive it lives here.
struct job {
    struct codec_error error;
    struct byte_reader in;
    struct texels *t;
    png_bytepp rows;
};

static void on_read(png_structp png, png_bytep data, size_t n)
{
    struct job *job = png_get_io_ptr(png);
    if (n > (size_t)(job->in.end - job->in.at))
        png_error(png, "it ends too early");
    memcpy(data, job->in.at, n);
    job->in.at += n;
}

static void read_encoding(png_structp png, png_infop info, struct texels *t)
{
    int intent;
    double gamma;
    if (png_get_sRGB(png, info, &intent)) {
        t->has_encoding = true;
        t->encoding = (struct transfer){TRANSFER_SRGB, 0};
    } else if (png_get_gAMA(png, info, &gamma) && gamma > 0) {
        t->has_encoding = true;
        t->encoding = (struct transfer){TRANSFER_POWER, 1 / gamma};
    }
}

static bool read_palette(png_structp png, png_infop info, struct job *job)
{
    png_colorp color = NULL;
    png_bytep alpha = NULL;
    int count = 0, alphas = 0;
    if (!png_get_PLTE(png, info, &color, &count) || count < 1)
        return codec_fail(job->error, "it has no palette");
    if (!texels_palette(job->t, count, job->error))
        return false;
    if (png_get_tRNS(png, info, &alpha, &alphas, NULL))
        job->t->palette_alpha = true;
    for (int i = 0; i < count; i++) {
        uint8_t *p = job->t->palette[i];
        p[0] = color[i].red;
        p[1] = color[i].green;
        p[2] = color[i].blue;
        p[3] = alpha && i < alphas ? alpha[i] : 255;
    }
    return true;
}

static bool little_endian(void)
{
    const uint16_t one = 1;
    return *(const uint8_t *)&one;
}

static bool read_rows(png_structp png, png_infop info, struct job *job)
{
    struct texels *t = job->t;
    int color = png_get_color_type(png, info), depth = png_get_bit_depth(png, info);
    bool indexed = color == PNG_COLOR_TYPE_PALETTE;
    if (depth < 8 && color == PNG_COLOR_TYPE_GRAY)
        png_set_expand_gray_1_2_4_to_8(png);
    if (indexed)
        png_set_packing(png);
    else if (png_get_valid(png, info, PNG_INFO_tRNS))
        png_set_tRNS_to_alpha(png);
    if (depth == 16 && little_endian())
        png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    // Deflate makes at most 1032 bytes of one; a texel may be a single bit.
    if (!texels_allocate(t, png_get_image_width(png, info),
                         png_get_image_height(png, info), png_get_channels(png, info),
                         depth == 16 ? TEXEL_U16 : TEXEL_U8,
                         (size_t)(job->in.end - job->in.at), 1032 * 8, job->error))
        return false;
    job->rows = malloc((size_t)t->height * sizeof *job->rows);
    if (!job->rows)
        return codec_fail(job->error, "out of memory");
    for (int y = 0; y < t->height; y++)
        job->rows[y] = depth == 16 ? (png_bytep)texels_row16(t, y) : texels_row8(t, y);
    png_read_image(png, job->rows);
    png_read_end(png, NULL);
    return !indexed || read_palette(png, info, job);
}

bool png_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct job job = {.error = e, .in = {data, data + size, false}, .t = t};
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &job.error,
                                             png_error_jump, png_no_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    volatile bool ok = false;
    if (!info) {
        codec_fail(e, "out of memory");
    } else if (!setjmp(png_jmpbuf(png))) {
        png_set_read_fn(png, &job, on_read);
        png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
        png_read_info(png, info);
        read_encoding(png, info, t);
        ok = read_rows(png, info, &job);
    }
    png_destroy_read_struct(&png, &info, NULL);
    free(job.rows);
    return ok;
}
