// OpenEXR files through the C core: one part, scan lines, ZIP, R G B (A), half or
// float. Chunks are written in order by one thread: equal pictures, equal bytes.
#include "image/exr_file.h"

#include <float.h>
#include <stdlib.h>
#include <string.h>

enum { HALF_MOST = 65504 }; // the largest number that has 16 bits

// All of the file lies in memory; the library writes through these.
struct memory_file {
    struct byte_buffer *out;
};

static int64_t on_write(exr_const_context_t f, void *user, const void *data, uint64_t n,
                        uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    struct memory_file *m = user;
    byte_buffer_write(m->out, offset, data, n);
    if (!m->out->failed)
        return (int64_t)n;
    fail(f, EXR_ERR_OUT_OF_MEMORY, "out of memory");
    return -1;
}

static exr_context_initializer_t context_initializer(struct memory_file *m)
{
    exr_context_initializer_t i = EXR_DEFAULT_CONTEXT_INITIALIZER;
    i.user_data = m;
    i.error_handler_fn = exr_file_error;
    i.write_fn = on_write;
    return i;
}

// Of a file that is written: R, G, B and A in this order.
static int channel_index(const char *name)
{
    return (int)(strchr("RGBA", name[0]) - "RGBA");
}

static void bind_encoder(exr_coding_channel_info_t *c, int count, const struct image *im,
                         int y)
{
    for (int i = 0; i < count; i++) {
        c[i].user_bytes_per_element = 4;
        c[i].user_data_type = EXR_PIXEL_FLOAT;
        c[i].user_pixel_stride = im->channels * 4;
        c[i].user_line_stride = im->width * im->channels * 4;
        c[i].encode_from_ptr =
            (const uint8_t *)(image_at(im, 0, y) + channel_index(c[i].channel_name));
    }
}

static exr_result_t write_header(const struct exr_file *f, int *part,
                                 const struct image *im,
                                 const struct image_write_options *o)
{
    // Alphabetical, as the format wants.
    static const char *const channels[] = {"A", "B", "G", "R"};
    exr_pixel_type_t type = o->bits > 16 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
    exr_result_t r = f->lib.exr_add_part(f->context, NULL, EXR_STORAGE_SCANLINE, part);
    if (!r)
        r = f->lib.exr_initialize_required_attr_simple(f->context, *part, im->width,
                                                       im->height, EXR_COMPRESSION_ZIP);
    for (int i = o->alpha ? 0 : 1; i < 4 && !r; i++)
        r = f->lib.exr_add_channel(f->context, *part, channels[i], type,
                                   EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
    for (size_t i = 0; i < o->metadata.count && !r; i++)
        r = f->lib.exr_attr_set_string(f->context, *part, o->metadata.key[i],
                                       o->metadata.text[i]);
    return r ? r : f->lib.exr_write_header(f->context);
}

struct compressor {
    exr_result_t (*run)(exr_encode_pipeline_t *e);
};

// A chunk as long as its plain data is plain data to every reader. The library (3.1.5)
// packs it all the same when packing saves nothing, and readers see wrong numbers.
static exr_result_t compress(exr_encode_pipeline_t *e)
{
    const struct compressor *c = e->encoding_user_data;
    exr_result_t r = c->run(e);
    if (!r && e->compressed_bytes == e->packed_bytes)
        memcpy(e->compressed_buffer, e->packed_buffer, e->packed_bytes);
    return r;
}

static exr_result_t write_chunks(const struct exr_file *f, int part,
                                 const struct image *im)
{
    exr_encode_pipeline_t e = EXR_ENCODE_PIPELINE_INITIALIZER;
    struct compressor compressor = {NULL};
    int lines = 1;
    exr_result_t r = f->lib.exr_get_scanlines_per_chunk(f->context, part, &lines);
    for (int y = 0; y < im->height && !r; y += lines) {
        exr_chunk_info_t chunk;
        r = f->lib.exr_write_scanline_chunk_info(f->context, part, y, &chunk);
        if (!r)
            r = y ? f->lib.exr_encoding_update(f->context, part, &chunk, &e)
                  : f->lib.exr_encoding_initialize(f->context, part, &chunk, &e);
        if (r)
            break;
        bind_encoder(e.channels, e.channel_count, im, y);
        if (!y) {
            r = f->lib.exr_encoding_choose_default_routines(f->context, part, &e);
            compressor.run = e.compress_fn;
            if (e.compress_fn)
                e.compress_fn = compress;
            e.encoding_user_data = &compressor;
        }
        if (!r)
            r = f->lib.exr_encoding_run(f->context, part, &e);
    }
    f->lib.exr_encoding_destroy(f->context, &e);
    return r;
}

bool exr_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e)
{
    struct exr_file f;
    if (!load(&f.lib, e.text, e.size))
        return false;
    struct image linear;
    if (!image_linear(&linear, im, o, o->alpha ? 4 : 3,
                      o->bits > 16 ? FLT_MAX : HALF_MOST))
        return codec_fail(e, "out of memory");
    struct memory_file m = {.out = out};
    exr_context_initializer_t init = context_initializer(&m);
    int part = 0;
    exr_result_t r =
        f.lib.exr_start_write(&f.context, "picture", EXR_WRITE_FILE_DIRECTLY, &init);
    if (!r) {
        r = write_header(&f, &part, &linear, o);
        if (!r)
            r = write_chunks(&f, part, &linear);
        exr_result_t end = f.lib.exr_finish(&f.context);
        r = r ? r : end;
    }
    image_free(&linear);
    return !r || codec_fail(e, "%s", f.lib.exr_get_error_code_as_string(r));
}
