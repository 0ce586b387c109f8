// Radiance pictures: linear light in 8-bit mantissas with a common exponent, in runs
// (Ward, "Real Pixels", Graphics Gems II, 1991). What is below zero becomes zero.
#include "image/codec.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    PACKED_MIN = 8,
    PACKED_MAX = 0x7fff,
    RUN_MIN = 4,
    RUN_MAX = 127,
    LITERALS_MAX = 128
};

// The reader takes a mantissa for the middle of its step, so it is rounded down.
static void pixel(const float *p, uint8_t rgbe[4])
{
    double c[3], most = 0;
    int exponent;
    for (int k = 0; k < 3; k++) {
        c[k] = p[k] > 0 ? fmin((double)p[k], 0x1p126) : 0;
        most = fmax(most, c[k]);
    }
    memset(rgbe, 0, 4);
    if (most < 0x1p-127)
        return;
    frexp(most, &exponent);
    for (int k = 0; k < 3; k++)
        rgbe[k] = (uint8_t)ldexp(c[k], 8 - exponent);
    rgbe[3] = (uint8_t)(exponent + 128);
}

static int run_at(const uint8_t *p, int left)
{
    int n = 1;
    while (n < left && n < RUN_MAX && p[n] == p[0])
        n++;
    return n;
}

// One of red, green, blue and exponent of a row.
static void write_plane(struct byte_buffer *out, const uint8_t *p, int width)
{
    for (int x = 0; x < width;) {
        int n = run_at(p + x, width - x);
        if (n >= RUN_MIN) {
            const uint8_t run[2] = {(uint8_t)(128 + n), p[x]};
            byte_buffer_append(out, run, 2);
            x += n;
            continue;
        }
        const int start = x;
        while (x < width && x - start < LITERALS_MAX) {
            n = run_at(p + x, width - x);
            if (n >= RUN_MIN)
                break;
            x += n < LITERALS_MAX - (x - start) ? n : LITERALS_MAX - (x - start);
        }
        const uint8_t count = (uint8_t)(x - start);
        byte_buffer_append(out, &count, 1);
        byte_buffer_append(out, p + start, count);
    }
}

// `row` has room for the row's planes behind the row's pixels.
static void write_row(struct byte_buffer *out, const struct image *im, int y,
                      uint8_t *row)
{
    const int width = im->width;
    uint8_t *planes = row + 4 * (size_t)width;
    for (int x = 0; x < width; x++)
        pixel(image_at(im, x, y), row + 4 * (size_t)x);
    if (width < PACKED_MIN || width > PACKED_MAX) {
        byte_buffer_append(out, row, 4 * (size_t)width);
        return;
    }
    const uint8_t start[4] = {2, 2, (uint8_t)(width >> 8), (uint8_t)width};
    byte_buffer_append(out, start, 4);
    for (int k = 0; k < 4; k++) {
        for (int x = 0; x < width; x++)
            planes[x] = row[4 * (size_t)x + (size_t)k];
        write_plane(out, planes, width);
    }
}

static void write_header(struct byte_buffer *out, const struct image *im,
                         const struct image_metadata *m)
{
    char line[512];
    int n = snprintf(line, sizeof line, "#?RADIANCE\n");
    for (size_t i = 0; i < m->count; i++)
        n += snprintf(line + n, sizeof line - (size_t)n, "%.40s=%.40s\n", m->key[i],
                      m->text[i]);
    n += snprintf(line + n, sizeof line - (size_t)n,
                  "FORMAT=32-bit_rle_rgbe\n\n-Y %d +X %d\n", im->height, im->width);
    byte_buffer_append(out, line, (size_t)n);
}

bool hdr_encode(const struct image *im, const struct image_write_options *o,
                struct byte_buffer *out, struct codec_error e)
{
    struct image linear;
    if (!image_linear(&linear, im, o, 3, FLT_MAX))
        return codec_fail(e, "out of memory");
    uint8_t *row = malloc(5 * (size_t)im->width);
    write_header(out, im, &o->metadata);
    for (int y = 0; row && y < im->height; y++)
        write_row(out, &linear, y, row);
    const bool ok = row && !out->failed;
    free(row);
    image_free(&linear);
    return ok || codec_fail(e, "out of memory");
}
