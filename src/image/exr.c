// OpenEXR files through the C core: one part, scan lines, ZIP, R G B (A), half or
// float. Chunks are written in order by one thread: equal pictures, equal bytes.
#include "image/codec.h"

#include <openexr.h>
#include <stdlib.h>
#include <string.h>

// All of the file lies in memory; the library reads and writes through these.
struct memory_file {
    struct byte_buffer *out;
    const uint8_t *in;
    size_t in_size;
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

static int64_t on_read(exr_const_context_t f, void *user, void *data, uint64_t n,
                       uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    (void)f, (void)fail;
    struct memory_file *m = user;
    if (offset >= m->in_size)
        return 0;
    if (n > m->in_size - offset)
        n = m->in_size - offset;
    memcpy(data, m->in + offset, n);
    return (int64_t)n;
}

static int64_t on_size(exr_const_context_t f, void *user)
{
    (void)f;
    return (int64_t)((struct memory_file *)user)->in_size;
}

static void on_error(exr_const_context_t f, exr_result_t code, const char *text)
{
    (void)f, (void)code, (void)text; // the code is returned too
}

static exr_context_initializer_t context_initializer(struct memory_file *m)
{
    exr_context_initializer_t i = EXR_DEFAULT_CONTEXT_INITIALIZER;
    i.user_data = m;
    i.error_handler_fn = on_error;
    i.read_fn = on_read;
    i.write_fn = on_write;
    i.size_fn = on_size;
    return i;
}

static int channel_index(const char *name)
{
    if (name[0] == 'Y' && !name[1])
        return 0;
    const char *at = strchr("RGBA", name[0]);
    return name[0] && !name[1] && at ? (int)(at - "RGBA") : -1;
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

// Into one plane per channel: the library's short cut for three interleaved channels
// (3.1.5) stores them in the wrong order. All other channels share one more plane, since
// some short cuts write even to those that have none.
static void bind_decoder(exr_coding_channel_info_t *c, int count, float *planes,
                         int channels, int width, int height, int y)
{
    for (int i = 0; i < count; i++) {
        int k = channel_index(c[i].channel_name);
        if (k < 0 || k >= channels)
            k = channels; // not wanted: into a plane that is thrown away
        size_t at = ((size_t)k * (size_t)height + (size_t)y) * (size_t)width;
        c[i].user_bytes_per_element = 4;
        c[i].user_data_type = EXR_PIXEL_FLOAT;
        c[i].user_pixel_stride = 4;
        c[i].user_line_stride = width * 4;
        c[i].decode_to_ptr = (uint8_t *)(planes + at);
    }
}

static exr_result_t write_header(exr_context_t f, int *part, const struct image *im,
                                 const struct image_write_options *o)
{
    // Alphabetical, as the format wants.
    static const char *const channels[] = {"A", "B", "G", "R"};
    exr_pixel_type_t type = o->bits > 16 ? EXR_PIXEL_FLOAT : EXR_PIXEL_HALF;
    exr_result_t r = exr_add_part(f, NULL, EXR_STORAGE_SCANLINE, part);
    if (!r)
        r = exr_initialize_required_attr_simple(f, *part, im->width, im->height,
                                                EXR_COMPRESSION_ZIP);
    for (int i = o->alpha ? 0 : 1; i < 4 && !r; i++)
        r = exr_add_channel(f, *part, channels[i], type, EXR_PERCEPTUALLY_LOGARITHMIC, 1,
                            1);
    for (size_t i = 0; i < o->metadata.count && !r; i++)
        r = exr_attr_set_string(f, *part, o->metadata.key[i], o->metadata.text[i]);
    return r ? r : exr_write_header(f);
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

static exr_result_t write_chunks(exr_context_t f, int part, const struct image *im)
{
    exr_encode_pipeline_t e = EXR_ENCODE_PIPELINE_INITIALIZER;
    struct compressor compressor = {NULL};
    int lines = 1;
    exr_result_t r = exr_get_scanlines_per_chunk(f, part, &lines);
    for (int y = 0; y < im->height && !r; y += lines) {
        exr_chunk_info_t chunk;
        r = exr_write_scanline_chunk_info(f, part, y, &chunk);
        if (!r)
            r = y ? exr_encoding_update(f, part, &chunk, &e)
                  : exr_encoding_initialize(f, part, &chunk, &e);
        if (r)
            break;
        bind_encoder(e.channels, e.channel_count, im, y);
        if (!y) {
            r = exr_encoding_choose_default_routines(f, part, &e);
            compressor.run = e.compress_fn;
            if (e.compress_fn)
                e.compress_fn = compress;
            e.encoding_user_data = &compressor;
        }
        if (!r)
            r = exr_encoding_run(f, part, &e);
    }
    exr_encoding_destroy(f, &e);
    return r;
}

// The picture as linear light, with as many channels as are written.
static bool linear_copy(struct image *to, const struct image *im,
                        const struct image_write_options *o)
{
    struct transfer t = o->unmanaged ? o->transfer : o->working;
    if (!image_init(to, im->width, im->height, o->alpha ? 4 : 3))
        return false;
    for (int y = 0; y < im->height; y++) {
        for (int x = 0; x < im->width; x++) {
            const float *from = image_at(im, x, y);
            float *p = image_at(to, x, y);
            for (int k = 0; k < 3; k++) {
                float v = from[im->channels >= 3 ? k : 0];
                p[k] = t.kind == TRANSFER_NONE ? v : (float)transfer_decode(t, (double)v);
            }
            if (o->alpha)
                p[3] = im->channels == 4 ? from[3] : 1;
        }
    }
    return true;
}

bool exr_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e)
{
    struct image linear;
    if (!linear_copy(&linear, im, o))
        return codec_fail(e, "out of memory");
    struct memory_file m = {.out = out};
    exr_context_initializer_t init = context_initializer(&m);
    exr_context_t f;
    int part = 0;
    exr_result_t r = exr_start_write(&f, "picture", EXR_WRITE_FILE_DIRECTLY, &init);
    if (!r) {
        r = write_header(f, &part, &linear, o);
        if (!r)
            r = write_chunks(f, part, &linear);
        exr_result_t end = exr_finish(&f);
        r = r ? r : end;
    }
    image_free(&linear);
    return !r || codec_fail(e, "%s", exr_get_error_code_as_string(r));
}

static exr_result_t read_chunks(exr_context_t f, const struct image *im, float *planes,
                                int first)
{
    exr_decode_pipeline_t d = EXR_DECODE_PIPELINE_INITIALIZER;
    int lines = 1;
    exr_result_t r = exr_get_scanlines_per_chunk(f, 0, &lines);
    for (int y = 0; y < im->height && !r; y += lines) {
        exr_chunk_info_t chunk;
        r = exr_read_scanline_chunk_info(f, 0, first + y, &chunk);
        if (!r)
            r = y ? exr_decoding_update(f, 0, &chunk, &d)
                  : exr_decoding_initialize(f, 0, &chunk, &d);
        if (r)
            break;
        bind_decoder(d.channels, d.channel_count, planes, im->channels, im->width,
                     im->height, y);
        if (!y)
            r = exr_decoding_choose_default_routines(f, 0, &d);
        if (!r)
            r = exr_decoding_run(f, 0, &d);
    }
    exr_decoding_destroy(f, &d);
    return r;
}

struct layout {
    bool grey, color, alpha;
};

static exr_result_t read_layout(exr_context_t f, struct layout *l)
{
    const exr_attr_chlist_t *list;
    exr_result_t r = exr_get_channels(f, 0, &list);
    for (int i = 0; !r && i < list->num_channels; i++) {
        const char *name = list->entries[i].name.str;
        l->grey = l->grey || strcmp(name, "Y") == 0;
        l->alpha = l->alpha || strcmp(name, "A") == 0;
        l->color = l->color || strcmp(name, "R") == 0;
    }
    return r;
}

static void interleave(struct image *im, const float *planes, bool grey)
{
    size_t n = (size_t)im->width * (size_t)im->height;
    for (size_t i = 0; i < n; i++) {
        float *p = im->pixel + i * (size_t)im->channels;
        for (int k = 0; k < im->channels; k++)
            p[k] = planes[(grey && k < 3 ? 0 : (size_t)k) * n + i];
    }
}

static bool read_opened(exr_context_t f, struct image *im, size_t size,
                        struct codec_error e)
{
    struct layout l = {0};
    exr_attr_box2i_t box;
    exr_storage_t storage;
    exr_result_t r = exr_get_storage(f, 0, &storage);
    if (!r && storage != EXR_STORAGE_SCANLINE)
        return codec_fail(e, "only scan line EXR files can be read");
    r = r ? r : exr_get_data_window(f, 0, &box);
    r = r ? r : read_layout(f, &l);
    if (r)
        return codec_fail(e, "%s", exr_get_error_code_as_string(r));
    if (!l.grey && !l.color)
        return codec_fail(e, "the file has neither R G B nor Y channels");
    const int64_t width = (int64_t)box.max.x - box.min.x + 1;
    const int64_t height = (int64_t)box.max.y - box.min.y + 1;
    // Every chunk of up to 256 rows has its place in the file's table, 8 bytes.
    if (width < 1 || height < 1 || width > INT32_MAX || height > INT32_MAX ||
        width * height > INT32_MAX || (size_t)(height / 256) > size / 8)
        return codec_fail(e, "it claims %lld x %lld pixels in %zu bytes",
                          (long long)width, (long long)height, size);
    if (!image_init(im, (int)width, (int)height, l.alpha ? 4 : 3))
        return codec_fail(e, "out of memory");
    float *planes = calloc((size_t)im->width * (size_t)im->height,
                           ((size_t)im->channels + 1) * sizeof *planes);
    r = planes ? read_chunks(f, im, planes, box.min.y) : EXR_ERR_OUT_OF_MEMORY;
    if (!r)
        interleave(im, planes, !l.color);
    free(planes);
    return !r || codec_fail(e, "%s", exr_get_error_code_as_string(r));
}

bool exr_decode(struct image *im, const uint8_t *data, size_t size, struct codec_error e)
{
    *im = (struct image){0};
    struct memory_file m = {.in = data, .in_size = size};
    exr_context_initializer_t init = context_initializer(&m);
    exr_context_t f;
    exr_result_t r = exr_start_read(&f, "picture", &init);
    if (r)
        return codec_fail(e, "%s", exr_get_error_code_as_string(r));
    bool ok = read_opened(f, im, size, e);
    exr_finish(&f);
    if (!ok)
        image_free(im);
    return ok;
}

bool exr_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct image im;
    if (!exr_decode(&im, data, size, e))
        return false;
    t->width = im.width;
    t->height = im.height;
    t->channels = im.channels;
    t->format = TEXEL_F32;
    t->max = 1;
    t->premultiplied = true;
    t->data = im.pixel; // handed over
    return true;
}
