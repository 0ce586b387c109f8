// JPEG files through libjpeg-turbo, with its integer transform, so that equal pictures give
// equal bytes. There is no alpha.
#include <stdlib.h>
#include <string.h>

#include "image/jpeg_job.h"

static const int usual_quality = 95;

static void write_all(const struct libjpeg *lib, struct jpeg_compress_struct *c,
                      struct sample_rows *rows)
{
    const struct image_write_options *o = &rows->o;
    c->image_width = (JDIMENSION)rows->im->width;
    c->image_height = (JDIMENSION)rows->im->height;
    c->input_components = quantize_channels(o);
    c->in_color_space = o->grey ? JCS_GRAYSCALE : JCS_RGB;
    lib->jpeg_set_defaults(c);
    lib->jpeg_set_quality(c, o->compression > 1 ? o->compression : usual_quality, TRUE);
    // Colours at full resolution: what is rendered has sharp coloured edges.
    c->comp_info[0].h_samp_factor = c->comp_info[0].v_samp_factor = 1;
    c->dct_method = JDCT_ISLOW;
    lib->jpeg_start_compress(c, TRUE);
    for (size_t i = 0; i < o->metadata.count; i++)
        lib->jpeg_write_marker(c, JPEG_COM, (const JOCTET *)o->metadata.text[i],
                               (unsigned)strlen(o->metadata.text[i]));
    for (int y = 0; y < rows->im->height; y++) {
        // The library's rows are not const; it only reads them.
        JSAMPROW row = (JSAMPROW)(uintptr_t)sample_rows_bytes(rows, y, 0);
        lib->jpeg_write_scanlines(c, &row, 1);
    }
    lib->jpeg_finish_compress(c);
}

bool jpeg_encode(const struct image *im, const struct image_write_options *options,
                 struct byte_buffer *out, struct codec_error e)
{
    struct image_write_options o = *options;
    struct sample_rows rows;
    struct jpeg_job job = {.error = e};
    struct libjpeg lib;
    if (!load(&lib, e.text, e.size))
        return false;
    struct jpeg_compress_struct c = {.err = lib.jpeg_std_error(&job.manager)};
    unsigned char *bytes = NULL;
    unsigned long size = 0;
    volatile bool ok = false;
    o.bits = 8;
    o.alpha = false;
    job.manager.error_exit = jpeg_job_fail;
    if (!sample_rows_begin(&rows, im, &o)) {
        codec_fail(e, "out of memory");
    } else if (!setjmp(job.back)) {
        lib.jpeg_CreateCompress(&c, JPEG_LIB_VERSION, sizeof c);
        lib.jpeg_mem_dest(&c, &bytes, &size);
        write_all(&lib, &c, &rows);
        ok = true;
    }
    if (ok)
        byte_buffer_append(out, bytes, size);
    lib.jpeg_destroy_compress(&c);
    free(bytes);
    sample_rows_end(&rows);
    return ok && (!out->failed || codec_fail(e, "out of memory"));
}
