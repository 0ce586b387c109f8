// Radiance pictures: 8-bit mantissas with a common exponent, run-length encoded.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

// The next line without its end, as a string; false at the end of the file.
static bool read_line(struct byte_reader *r, char *line, size_t n)
{
    size_t used = 0;
    while (r->at < r->end && *r->at != '\n') {
        if (used + 1 < n)
            line[used++] = (char)*r->at;
        r->at++;
    }
    line[used] = 0;
    if (r->at == r->end)
        return false;
    r->at++;
    return true;
}

// Four runs per row: red, green, blue, exponent.
static bool read_packed(struct byte_reader *r, uint8_t *row, int width)
{
    for (int k = 0; k < 4; k++) {
        for (int x = 0; x < width;) {
            unsigned n = read_u8(r);
            bool run = n > 128;
            if (run)
                n -= 128;
            if (r->ended || n == 0 || n > (unsigned)(width - x))
                return false;
            unsigned v = run ? read_u8(r) : 0;
            for (; n > 0; n--, x++)
                row[4 * x + k] = (uint8_t)(run ? v : read_u8(r));
        }
    }
    return !r->ended;
}

// Texel by texel; three ones repeat the last texel.
static bool read_plain(struct byte_reader *r, uint8_t *row, int width)
{
    int shift = 0;
    for (int x = 0; x < width;) {
        uint8_t p[4];
        for (int k = 0; k < 4; k++)
            p[k] = (uint8_t)read_u8(r);
        if (r->ended)
            return false;
        if (p[0] != 1 || p[1] != 1 || p[2] != 1) {
            memcpy(row + 4 * (size_t)x++, p, 4);
            shift = 0;
            continue;
        }
        size_t n = (size_t)p[3] << shift;
        if (!x || shift > 24 || n > (size_t)(width - x))
            return false;
        for (; n > 0; n--, x++)
            memcpy(row + 4 * (size_t)x, row + 4 * (size_t)(x - 1), 4);
        shift += 8;
    }
    return true;
}

static bool read_row(struct byte_reader *r, uint8_t *row, int width)
{
    const uint8_t *p = r->at;
    if (r->end - p >= 4 && p[0] == 2 && p[1] == 2 && (p[2] << 8 | p[3]) == width &&
        width >= 8 && width < 0x8000) {
        r->at += 4;
        return read_packed(r, row, width);
    }
    return read_plain(r, row, width);
}

// A mantissa stands for the middle of its step.
static void convert(const uint8_t *row, float *out, int width)
{
    for (int x = 0; x < width; x++) {
        const uint8_t *p = row + 4 * (size_t)x;
        const double scale = p[3] ? ldexp(1, p[3] - (128 + 8)) : 0;
        for (int k = 0; k < 3; k++)
            out[3 * x + k] = (float)((p[k] + 0.5) * scale);
    }
}

bool hdr_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct byte_reader r = {data, data + size, false};
    char line[256];
    long width, height;
    while (read_line(&r, line, sizeof line) && line[0])
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return codec_fail(e, "its pixels are of the format '%.40s'", line + 7);
    if (!read_line(&r, line, sizeof line) ||
        sscanf(line, "-Y %9ld +X %9ld", &height, &width) != 2 || width < 1 || height < 1)
        return codec_fail(e, "its header makes no sense");
    // A run of the old kind repeats up to 2^32 times, in multiples of 255 per four bytes
    // for the sizes there are.
    if (!texels_allocate(t, (uint64_t)width, (uint64_t)height, 3, TEXEL_F32, size, 16384,
                         e))
        return false;
    uint8_t *row = malloc((size_t)width * 4);
    if (!row)
        return codec_fail(e, "out of memory");
    bool ok = true;
    for (int y = 0; y < t->height && ok; y++) {
        ok = read_row(&r, row, t->width);
        if (ok)
            convert(row, (float *)t->data + 3 * (size_t)y * (size_t)t->width, t->width);
    }
    free(row);
    return ok || codec_fail(e, "it is damaged or ends too early");
}
