// OpenEXR files through the C core: the first part, scan lines or the finest tiles, any
// compression; R G B, grey, or luminance with colour differences, each with alpha or not.
#include "image/exr_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// All of the file lies in memory; the library reads through these.
struct memory_file {
    const uint8_t *in;
    size_t size;
};

static int64_t on_read(exr_const_context_t f, void *user, void *data, uint64_t n,
                       uint64_t offset, exr_stream_error_func_ptr_t fail)
{
    (void)f, (void)fail;
    const struct memory_file *m = user;
    if (offset >= m->size)
        return 0;
    if (n > m->size - offset)
        n = m->size - offset;
    memcpy(data, m->in + offset, n);
    return (int64_t)n;
}

static int64_t on_size(exr_const_context_t f, void *user)
{
    (void)f;
    return (int64_t)((const struct memory_file *)user)->size;
}

// ---- planes ---------------------------------------------------------------------------

enum { RED, GREEN, BLUE, ALPHA, PLANES };

enum kind { COLOR, GREY, LUMA }; // LUMA: Y, RY and BY in RED, GREEN and BLUE

struct layout {
    enum kind kind;
    bool alpha;
    int sample_x, sample_y; // of RY and BY
    int left, top;          // of the data window
};

// One plane per channel: the library's short cut for three interleaved channels (3.1.5)
// stores them in the wrong order. All channels that are not wanted share one more plane,
// since some short cuts write even to those that have none.
struct planes {
    float *at;
    int width, height;
};

static int plane_of(enum kind kind, const char *name)
{
    static const char *const names[3][PLANES] = {
        {"R", "G", "B", "A"}, {"Y", "", "", "A"}, {"Y", "RY", "BY", "A"}};
    for (int i = 0; i < PLANES; i++)
        if (names[kind][i][0] && strcmp(name, names[kind][i]) == 0)
            return i;
    return PLANES;
}

// Where a channel's samples go of a chunk that begins at (x, y) of the picture.
static void bind(exr_coding_channel_info_t *c, int count, const struct layout *l,
                 const struct planes *p, int x, int y)
{
    for (int i = 0; i < count; i++) {
        const int k = plane_of(l->kind, c[i].channel_name);
        const int sx = c[i].x_samples > 0 ? c[i].x_samples : 1;
        const int sy = c[i].y_samples > 0 ? c[i].y_samples : 1;
        const size_t row = (size_t)((y + sy - 1) / sy), column = (size_t)(x / sx);
        const size_t at =
            ((size_t)k * (size_t)p->height + row) * (size_t)p->width + column;
        c[i].user_bytes_per_element = 4;
        c[i].user_data_type = EXR_PIXEL_FLOAT;
        c[i].user_pixel_stride = 4;
        c[i].user_line_stride = p->width * 4;
        c[i].decode_to_ptr = (uint8_t *)(p->at + at);
    }
}

static exr_result_t decode(const struct exr_file *f, exr_decode_pipeline_t *d, bool first,
                           const exr_chunk_info_t *chunk, const struct layout *l,
                           const struct planes *p, int x, int y)
{
    exr_result_t r = first ? f->lib.exr_decoding_initialize(f->context, 0, chunk, d)
                           : f->lib.exr_decoding_update(f->context, 0, chunk, d);
    if (r)
        return r;
    bind(d->channels, d->channel_count, l, p, x, y);
    if (first)
        r = f->lib.exr_decoding_choose_default_routines(f->context, 0, d);
    return r ? r : f->lib.exr_decoding_run(f->context, 0, d);
}

static exr_result_t read_lines(const struct exr_file *f, const struct layout *l,
                               const struct planes *p)
{
    exr_decode_pipeline_t d = EXR_DECODE_PIPELINE_INITIALIZER;
    int lines = 1;
    exr_result_t r = f->lib.exr_get_scanlines_per_chunk(f->context, 0, &lines);
    for (int y = 0; y < p->height && !r; y += lines) {
        exr_chunk_info_t chunk;
        r = f->lib.exr_read_scanline_chunk_info(f->context, 0, l->top + y, &chunk);
        if (!r)
            r = decode(f, &d, y == 0, &chunk, l, p, 0, y);
    }
    f->lib.exr_decoding_destroy(f->context, &d);
    return r;
}

static exr_result_t read_tiles(const struct exr_file *f, const struct layout *l,
                               const struct planes *p)
{
    exr_decode_pipeline_t d = EXR_DECODE_PIPELINE_INITIALIZER;
    int width = 0, height = 0;
    exr_result_t r = f->lib.exr_get_tile_sizes(f->context, 0, 0, 0, &width, &height);
    if (!r && (width < 1 || height < 1))
        r = EXR_ERR_INVALID_ATTR;
    for (int y = 0; !r && y < p->height; y += height) {
        for (int x = 0; !r && x < p->width; x += width) {
            exr_chunk_info_t chunk;
            r = f->lib.exr_read_tile_chunk_info(f->context, 0, x / width, y / height, 0,
                                                0, &chunk);
            if (!r)
                r = decode(f, &d, x == 0 && y == 0, &chunk, l, p, x, y);
        }
    }
    f->lib.exr_decoding_destroy(f->context, &d);
    return r;
}

// ---- luminance and colour differences -------------------------------------------------

// What a sample counts in one that is missing, by its odd distance: the filter of the
// format's own reader (Technical Introduction to OpenEXR, luminance/chroma).
static const float reach_weight[7] = {0.627123f, -0.186077f, 0.087929f, -0.043159f,
                                      0.019597f, -0.007540f, 0.002128f};

static int clamped(int i, int count) { return i < 0 ? 0 : i < count ? i : count - 1; }

// Halfway between samples k and k + 1 of `count`, which are `step` apart.
static float between(const float *from, size_t step, int k, int count)
{
    float sum = 0;
    for (int n = 0; n < 7; n++)
        sum += reach_weight[n] * (from[(size_t)clamped(k - n, count) * step] +
                                  from[(size_t)clamped(k + 1 + n, count) * step]);
    return sum;
}

// A line of `count` samples, `step` apart in `from`, to `size` texels.
static void spread_line(const float *from, size_t step, int sampling, int size, float *to)
{
    const int count = (size + sampling - 1) / sampling;
    for (int i = 0; i < size; i++) {
        const int k = i / sampling;
        to[i] = sampling != 2 || i % 2 == 0 ? from[(size_t)k * step]
                                            : between(from, step, k, count);
    }
}

// A plane with every so many-th sample, packed in its corner, filled.
static bool spread_plane(float *plane, const struct planes *p, const struct layout *l)
{
    const int longest = p->width > p->height ? p->width : p->height;
    const int rows = (p->height + l->sample_y - 1) / l->sample_y;
    const size_t width = (size_t)p->width;
    float *line = malloc((size_t)longest * sizeof *line);
    if (!line)
        return false;
    for (int y = 0; y < rows && l->sample_x > 1; y++) {
        spread_line(plane + (size_t)y * width, 1, l->sample_x, p->width, line);
        memcpy(plane + (size_t)y * width, line, width * sizeof *line);
    }
    for (int x = 0; x < p->width && l->sample_y > 1; x++) {
        spread_line(plane + x, width, l->sample_y, p->height, line);
        for (int y = 0; y < p->height; y++)
            plane[(size_t)y * width + (size_t)x] = line[y];
    }
    free(line);
    return true;
}

// How much each primary has of the luminance, from where they and white are.
static void luminance_weights(const struct exr_file *f, float w[3])
{
    exr_attr_chromaticities_t c = {.red_x = 0.64f,
                                   .red_y = 0.33f,
                                   .green_x = 0.3f,
                                   .green_y = 0.6f,
                                   .blue_x = 0.15f,
                                   .blue_y = 0.06f,
                                   .white_x = 0.3127f,
                                   .white_y = 0.329f};
    f->lib.exr_attr_get_chromaticities(f->context, 0, "chromaticities", &c);
    const double x[3] = {c.red_x, c.green_x, c.blue_x},
                 y[3] = {c.red_y, c.green_y, c.blue_y};
    const double white[3] = {c.white_x / c.white_y, 1,
                             (1 - c.white_x - c.white_y) / c.white_y};
    double m[3][3], sum = 0, part[3];
    for (int i = 0; i < 3; i++) {
        m[0][i] = x[i] / y[i];
        m[1][i] = 1;
        m[2][i] = (1 - x[i] - y[i]) / y[i];
    }
    // Cramer's rule: the amounts of the primaries that make white.
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        part[i] = white[0] * (m[1][j] * m[2][k] - m[1][k] * m[2][j]) -
                  white[1] * (m[0][j] * m[2][k] - m[0][k] * m[2][j]) +
                  white[2] * (m[0][j] * m[1][k] - m[0][k] * m[1][j]);
        sum += part[i];
    }
    static const float usual[3] = {0.2126f, 0.7152f, 0.0722f};
    for (int i = 0; i < 3; i++) {
        w[i] = (float)(part[i] / sum);
        if (!(w[0] > 0 && isfinite(w[i]) && w[i] > 0)) {
            memcpy(w, usual, sizeof usual);
            return;
        }
    }
}

static void rgb_of(float y, float red, float blue, const float w[3], float out[3])
{
    out[0] = (red + 1) * y;
    out[2] = (blue + 1) * y;
    out[1] = (y - out[0] * w[0] - out[2] * w[2]) / w[1];
}

static float most(const float c[3]) { return fmaxf(c[0], fmaxf(c[1], c[2])); }

static float saturation(const float c[3])
{
    const float max = most(c), min = fminf(c[0], fminf(c[1], c[2]));
    return max > 0 ? 1 - min / max : 0;
}

// Paler, of the same luminance.
static void desaturate(float c[3], float by, const float w[3])
{
    const float max = most(c), before = c[0] * w[0] + c[1] * w[1] + c[2] * w[2];
    float after = 0;
    for (int k = 0; k < 3; k++) {
        c[k] = fmaxf(max - (max - c[k]) * by, 0);
        after += c[k] * w[k];
    }
    for (int k = 0; k < 3 && after > 0; k++)
        c[k] *= before / after;
}

// Colours that stand out from their four diagonal neighbours come from few samples of
// chroma at sharp edges: the format's own reader bounds them so.
static void correct(float c[3], const float neighbour[4], const float w[3])
{
    const float here = saturation(c);
    const float mean =
        fminf(1, 0.25f * (neighbour[0] + neighbour[1] + neighbour[2] + neighbour[3]));
    const float bound = fminf(1, 1 - (1 - mean) * 0.25f);
    if (here > mean && here > bound)
        desaturate(c, bound / here, w);
}

// The line before the first: its luminance with differences further out.
static void saturations_above(const struct planes *p, const float *luma, const float *red,
                              const float *blue, const float w[3], float *out)
{
    const size_t width = (size_t)p->width;
    const int rows = (p->height + 1) / 2;
    for (size_t x = 0; x < width; x++) {
        float c[3];
        rgb_of(luma[x], between(red + x, 2 * width, -1, rows),
               between(blue + x, 2 * width, -1, rows), w, c);
        out[x] = saturation(c);
    }
}

static void saturations_of(float *const plane[3], int width, int y, float *out)
{
    for (int x = 0; x < width; x++) {
        const size_t i = (size_t)y * (size_t)width + (size_t)x;
        out[x] = saturation((const float[]){plane[0][i], plane[1][i], plane[2][i]});
    }
}

// Three planes of colours; line: room for the saturations of three lines, that before the
// first being known.
static void correct_planes(const struct planes *p, float *const plane[3],
                           const float w[3], float *line)
{
    const int width = p->width, last = p->height - 1;
    float *above = line, *here = line + width, *below = here + width;
    saturations_of(plane, width, 0, here);
    for (int y = 0; y <= last; y++) {
        if (y < last)
            saturations_of(plane, width, y + 1, below);
        // What stands for the line past the end has differences of its own.
        const float *under = y < last ? below : last % 2 ? above : here;
        for (int x = 0; x < width; x++) {
            const int left = x > 0 ? x - 1 : 0, right = x + 1 < width ? x + 1 : x;
            const size_t i = (size_t)y * (size_t)width + (size_t)x;
            float c[3] = {plane[0][i], plane[1][i], plane[2][i]};
            correct(c,
                    (const float[]){above[left], above[right], under[left], under[right]},
                    w);
            for (int k = 0; k < 3; k++)
                plane[k][i] = c[k];
        }
        float *old = above;
        above = here;
        here = below;
        below = old;
    }
}

static bool color_planes(const struct exr_file *f, const struct planes *p,
                         const struct layout *l)
{
    const size_t n = (size_t)p->width * (size_t)p->height;
    float *plane[3] = {p->at, p->at + GREEN * n, p->at + BLUE * n}, w[3];
    float *line = malloc(3 * (size_t)p->width * sizeof *line);
    const bool sparse = l->sample_x == 2 && l->sample_y == 2;
    if (!line || !spread_plane(plane[1], p, l) || !spread_plane(plane[2], p, l)) {
        free(line);
        return false;
    }
    luminance_weights(f, w);
    if (sparse)
        saturations_above(p, plane[0], plane[1], plane[2], w, line);
    for (size_t i = 0; i < n; i++) {
        float c[3];
        rgb_of(plane[0][i], plane[1][i], plane[2][i], w, c);
        for (int k = 0; k < 3; k++)
            plane[k][i] = c[k];
    }
    if (sparse)
        correct_planes(p, plane, w, line);
    free(line);
    return true;
}

// ---- files ----------------------------------------------------------------------------

static exr_result_t read_layout(const struct exr_file *f, struct layout *l, bool *known)
{
    const exr_attr_chlist_t *list;
    exr_result_t r = f->lib.exr_get_channels(f->context, 0, &list);
    bool color = false, luma = false, differences = false;
    for (int i = 0; !r && i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &list->entries[i];
        const char *name = c->name.str;
        const bool sparse = c->x_sampling != 1 || c->y_sampling != 1;
        color |= strcmp(name, "R") == 0 && !sparse;
        luma |= strcmp(name, "Y") == 0 && !sparse;
        l->alpha |= strcmp(name, "A") == 0 && !sparse;
        if (strcmp(name, "RY") == 0 || strcmp(name, "BY") == 0) {
            differences = true;
            l->sample_x = c->x_sampling;
            l->sample_y = c->y_sampling;
        }
    }
    l->kind = color ? COLOR : differences ? LUMA : GREY;
    *known = color || luma;
    // Both differences have the same samples, and nothing else is sparse.
    for (int i = 0; !r && i < list->num_channels; i++) {
        const exr_attr_chlist_entry_t *c = &list->entries[i];
        const int k = plane_of(l->kind, c->name.str);
        const bool difference = l->kind == LUMA && (k == GREEN || k == BLUE);
        const int x = difference ? l->sample_x : 1, y = difference ? l->sample_y : 1;
        if (x < 1 || y < 1 || (k < PLANES && (c->x_sampling != x || c->y_sampling != y)))
            *known = false;
    }
    return r;
}

static void interleave(struct image *im, const float *planes, enum kind kind)
{
    const size_t n = (size_t)im->width * (size_t)im->height;
    for (size_t i = 0; i < n; i++) {
        float *p = im->pixel + i * (size_t)im->channels;
        for (int k = 0; k < im->channels; k++)
            p[k] = planes[(kind == GREY && k < 3 ? 0 : (size_t)k) * n + i];
    }
}

// A file that lies about its size would take the machine's memory.
static bool believable(int64_t width, int64_t height, size_t size)
{
    // Every chunk of up to 256 rows has its place in the file's table, 8 bytes; no
    // compression makes less than a byte of this many pixels.
    static const double most = 65536;
    // The library counts the bytes of a row of floats in 32 bits.
    return width >= 1 && height >= 1 && width <= INT32_MAX / 4 && height <= INT32_MAX &&
           width * height <= INT32_MAX && (size_t)(height / 256) <= size / 8 &&
           (double)(width * height) <= most * (double)size;
}

static bool read_opened(const struct exr_file *f, struct image *im, size_t size,
                        struct codec_error e)
{
    struct layout l = {0};
    exr_attr_box2i_t box;
    exr_storage_t storage;
    bool known = false;
    exr_result_t r = f->lib.exr_get_storage(f->context, 0, &storage);
    if (!r && storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return codec_fail(e, "deep EXR files cannot be read");
    r = r ? r : f->lib.exr_get_data_window(f->context, 0, &box);
    r = r ? r : read_layout(f, &l, &known);
    if (r)
        return codec_fail(e, "%s", f->lib.exr_get_default_error_message(r));
    if (!known)
        return codec_fail(e, "the file has neither R G B nor Y channels");
    const int64_t width = (int64_t)box.max.x - box.min.x + 1;
    const int64_t height = (int64_t)box.max.y - box.min.y + 1;
    if (!believable(width, height, size))
        return codec_fail(e, "it claims %lld x %lld pixels in %zu bytes",
                          (long long)width, (long long)height, size);
    l.left = box.min.x;
    l.top = box.min.y;
    if (l.kind == LUMA && (l.left % l.sample_x || l.top % l.sample_y))
        return codec_fail(e, "its colour differences begin between pixels");
    if (!image_init(im, (int)width, (int)height, l.alpha ? 4 : 3))
        return codec_fail(e, "out of memory");
    struct planes p = {.width = im->width, .height = im->height};
    p.at = calloc((size_t)im->width * (size_t)im->height, (PLANES + 1) * sizeof *p.at);
    r = !p.at                             ? EXR_ERR_OUT_OF_MEMORY
        : storage == EXR_STORAGE_SCANLINE ? read_lines(f, &l, &p)
                                          : read_tiles(f, &l, &p);
    if (!r && l.kind == LUMA && !color_planes(f, &p, &l))
        r = EXR_ERR_OUT_OF_MEMORY;
    if (!r)
        interleave(im, p.at, l.kind);
    free(p.at);
    return !r || codec_fail(e, "%s", f->lib.exr_get_default_error_message(r));
}

static bool exr_decode(struct image *im, const uint8_t *data, size_t size,
                       struct codec_error e)
{
    *im = (struct image){0};
    struct memory_file m = {data, size};
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.user_data = &m;
    init.error_handler_fn = exr_file_error;
    init.read_fn = on_read;
    init.size_fn = on_size;
    struct exr_file f;
    if (!load(&f.lib, e.text, e.size))
        return false;
    exr_result_t r = f.lib.exr_start_read(&f.context, "picture", &init);
    if (r)
        return codec_fail(e, "%s", f.lib.exr_get_default_error_message(r));
    bool ok = read_opened(&f, im, size, e);
    f.lib.exr_finish(&f.context);
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
