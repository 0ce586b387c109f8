// Portable pixmaps: P6, and P5 for grey.
#include "image/codec.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void write_header(struct byte_buffer *out, const struct image *im,
                         const struct image_write_options *o)
{
    char line[64];
    byte_buffer_append(out, o->grey ? "P5\n" : "P6\n", 3);
    for (size_t i = 0; i < o->metadata.count; i++) {
        // A line end inside the text would end the comment.
        byte_buffer_append(out, "# ", 2);
        byte_buffer_append(out, o->metadata.key[i], strlen(o->metadata.key[i]));
        byte_buffer_append(out, ": ", 2);
        size_t n = strcspn(o->metadata.text[i], "\r\n");
        byte_buffer_append(out, o->metadata.text[i], n);
        byte_buffer_append(out, "\n", 1);
    }
    int n = snprintf(line, sizeof line, "%d %d\n%d\n", im->width, im->height,
                     (1 << o->bits) - 1);
    byte_buffer_append(out, line, (size_t)n);
}

bool ppm_encode(const struct image *im, const struct image_write_options *options,
                struct byte_buffer *out, struct codec_error e)
{
    struct image_write_options o = *options;
    o.alpha = false; // the format has none
    if (o.grey)      // and grey is written without gamma (spec/lighting.md 3.4)
        o.transfer = o.working;
    size_t n = (size_t)im->width * (size_t)quantize_channels(&o);
    struct quantizer *q = quantizer_new(&o, im->width);
    uint16_t *samples = malloc(n * sizeof *samples);
    uint8_t *row = malloc(n * 2);
    write_header(out, im, &o);
    for (int y = 0; q && samples && row && y < im->height; y++) {
        quantize_row(q, im, y, &o, samples);
        size_t used = 0;
        for (size_t i = 0; i < n; i++) {
            if (o.bits > 8)
                row[used++] = (uint8_t)(samples[i] >> 8);
            row[used++] = (uint8_t)samples[i];
        }
        byte_buffer_append(out, row, used);
    }
    bool ok = q && samples && row && !out->failed;
    quantizer_free(q);
    free(samples);
    free(row);
    return ok || codec_fail(e, "out of memory");
}

struct reader {
    const uint8_t *at, *end;
};

// The next number of the header, past blanks and comments; -1 when there is none.
static long read_number(struct reader *r)
{
    while (r->at < r->end && (isspace(*r->at) || *r->at == '#')) {
        if (*r->at == '#')
            while (r->at < r->end && *r->at != '\n')
                r->at++;
        else
            r->at++;
    }
    if (r->at == r->end || !isdigit(*r->at))
        return -1;
    long v = 0;
    while (r->at < r->end && isdigit(*r->at) && v < 100000000)
        v = 10 * v + (*r->at++ - '0');
    return v;
}

static long read_sample(struct reader *r, bool text, bool wide)
{
    if (text)
        return read_number(r);
    if (r->end - r->at < (wide ? 2 : 1))
        return -1;
    long v = *r->at++;
    return wide ? v << 8 | *r->at++ : v;
}

static bool read_pixels(struct image *im, struct reader *r, bool text, bool grey,
                        long max, struct transfer t)
{
    size_t pixels = (size_t)im->width * (size_t)im->height;
    for (size_t i = 0; i < pixels; i++) {
        float *p = im->pixel + 3 * i;
        for (int k = 0; k < (grey ? 1 : 3); k++) {
            long v = read_sample(r, text, max > 255);
            if (v < 0)
                return false;
            p[k] = (float)transfer_decode(t, (double)v / (double)max);
        }
        if (grey)
            p[1] = p[2] = p[0];
    }
    return true;
}

bool ppm_decode(struct image *im, const uint8_t *data, size_t size, struct transfer t,
                struct codec_error e)
{
    *im = (struct image){0};
    struct reader r = {data, data + size};
    int kind = size > 2 && data[0] == 'P' ? data[1] - '0' : 0;
    if (kind != 2 && kind != 3 && kind != 5 && kind != 6)
        return codec_fail(e, "not a PPM or PGM file");
    r.at += 2;
    long width = read_number(&r), height = read_number(&r), max = read_number(&r);
    bool text = kind <= 3, grey = kind == 2 || kind == 5;
    if (width <= 0 || height <= 0 || max <= 0 || max > 65535 || r.at == r.end)
        return codec_fail(e, "the header makes no sense");
    // The smallest file with that many pixels, so that a bad header asks for little.
    if ((size_t)width > size / (size_t)height)
        return codec_fail(e, "the file ends too early");
    r.at++; // one blank
    if (!image_init(im, (int)width, (int)height, 3))
        return codec_fail(e, "out of memory");
    if (read_pixels(im, &r, text, grey, max, t))
        return true;
    image_free(im);
    return codec_fail(e, "the file ends too early");
}
