// JPEG files through libjpeg-turbo. A file that ends too early is an error, as for the
// other types; libjpeg itself would fill in grey.
#include <string.h>

#include "image/jpeg_job.h"

// Level -1: the data is damaged.
static void on_message(j_common_ptr c, int level)
{
    if (level < 0)
        jpeg_job_fail(c);
}

// Cyan, magenta, yellow and black as light, without a colour profile. Adobe's files have
// the light that passes the ink instead of the ink.
static void from_inks(const uint8_t *ink, uint32_t width, bool light, uint8_t *row)
{
    for (uint32_t x = 0; x < width; x++, ink += 4)
        for (int k = 0; k < 3; k++) {
            const unsigned c = light ? ink[k] : 255u - ink[k];
            const unsigned black = light ? ink[3] : 255u - ink[3];
            row[3 * x + (uint32_t)k] = (uint8_t)((c * black + 127) / 255);
        }
}

static bool read_all(const struct libjpeg *lib, struct jpeg_decompress_struct *c,
                     struct texels *t, const uint8_t *data, size_t size,
                     struct codec_error e)
{
    lib->jpeg_mem_src(c, data, (unsigned long)size);
    lib->jpeg_read_header(c, TRUE);
    const bool grey = c->jpeg_color_space == JCS_GRAYSCALE;
    const bool inks = c->num_components == 4;
    if (c->num_components != 1 && c->num_components != 3 && !inks)
        return codec_fail(e, "JPEG files of %d colour channels cannot be read",
                          c->num_components);
    c->out_color_space = grey ? JCS_GRAYSCALE : inks ? JCS_CMYK : JCS_RGB;
    // A block of 64 texels takes a bit at least, in the first scan; a block of the
    // coarsest sampling covers 16 times as many.
    if (!texels_allocate(t, c->image_width, c->image_height, grey ? 1 : 3, TEXEL_U8, size,
                         64 * 8 * 16, e))
        return false;
    lib->jpeg_start_decompress(c);
    JSAMPARRAY line = NULL; // freed with c
    if (inks)
        line = c->mem->alloc_sarray((j_common_ptr)c, JPOOL_IMAGE, 4 * c->output_width, 1);
    while (c->output_scanline < c->output_height) {
        JSAMPROW row = texels_row8(t, (int)c->output_scanline);
        lib->jpeg_read_scanlines(c, inks ? line : &row, 1);
        if (inks)
            from_inks(line[0], c->output_width, c->saw_Adobe_marker, row);
    }
    lib->jpeg_finish_decompress(c);
    return true;
}

bool jpeg_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct jpeg_decompress_struct c;
    struct jpeg_job job = {.error = e};
    struct libjpeg lib;
    if (!load(&lib, e.text, e.size))
        return false;
    memset(&c, 0, sizeof c);
    c.err = lib.jpeg_std_error(&job.manager);
    job.manager.error_exit = jpeg_job_fail;
    job.manager.emit_message = on_message;
    volatile bool ok = false;
    if (!setjmp(job.back)) {
        lib.jpeg_CreateDecompress(&c, JPEG_LIB_VERSION, sizeof c);
        ok = read_all(&lib, &c, t, data, size, e);
    }
    lib.jpeg_destroy_decompress(&c);
    return ok;
}
