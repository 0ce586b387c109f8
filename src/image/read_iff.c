// IFF ILBM files: bit planes as palette indices, as HAM, or as 24-bit colour.
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

enum { HAM = 0x800, HALF_BRITE = 0x80, MASK_PLANE = 1 };

struct header {
    unsigned width, height, planes, masking, compression;
    uint32_t mode;
    bool seen;
};

static void read_bitmap_header(struct byte_reader *r, struct header *h)
{
    h->width = read_be16(r);
    h->height = read_be16(r);
    read_skip(r, 4);
    h->planes = read_u8(r);
    h->masking = read_u8(r);
    h->compression = read_u8(r);
    h->seen = !r->ended;
}

static bool read_palette(struct byte_reader *r, size_t length, struct texels *t,
                         struct codec_error e)
{
    int count = length / 3 < 256 ? (int)(length / 3) : 256;
    if (t->palette)
        return true; // the first one counts
    if (!texels_palette(t, 256, e))
        return false;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            t->palette[i][k] = (uint8_t)read_u8(r);
    return true;
}

// One row of one plane.
static bool read_plane(struct byte_reader *r, bool packed, uint8_t *out, size_t n)
{
    for (size_t at = 0; at < n && !r->ended;) {
        size_t count = 1;
        bool run = false;
        if (packed) {
            unsigned v = read_u8(r);
            if (v == 128)
                continue;
            run = v > 128;
            count = run ? 257 - v : v + 1;
        }
        if (count > n - at)
            return false;
        unsigned v = run ? read_u8(r) : 0;
        for (; count > 0; count--)
            out[at++] = (uint8_t)(run ? v : read_u8(r));
    }
    return !r->ended;
}

static uint32_t planar_value(const uint8_t *planes, size_t stride, unsigned count,
                             unsigned x)
{
    uint32_t v = 0;
    for (unsigned k = 0; k < count; k++)
        v |= (uint32_t)(planes[k * stride + x / 8] >> (7 - x % 8) & 1) << k;
    return v;
}

// Hold and modify: a texel is a colour of the palette, or its left neighbour with one
// channel changed.
static void hold_modify(const struct texels *t, const struct header *h, uint32_t v,
                        uint8_t p[3])
{
    const unsigned low = h->planes - 2, value = v & ((1u << low) - 1), shift = 8 - low;
    const uint8_t level =
        (uint8_t)(value << shift | value >> (low > shift ? low - shift : 0));
    switch (v >> low) {
    case 0: memcpy(p, t->palette[value], 3); break;
    case 1: p[2] = level; break;
    case 2: p[0] = level; break;
    case 3: p[1] = level; break;
    }
}

static void unpack_row(const struct texels *t, const struct header *h,
                       const uint8_t *planes, size_t stride, uint8_t *row)
{
    uint8_t p[3];
    memcpy(p, t->palette ? t->palette[0] : (uint8_t[4]){0}, 3);
    for (unsigned x = 0; x < h->width; x++) {
        uint32_t v = planar_value(planes, stride, h->planes, x);
        if (t->channels == 1) {
            row[x] = (uint8_t)v;
            continue;
        }
        if (h->planes == 24)
            for (int k = 0; k < 3; k++)
                p[k] = (uint8_t)(v >> 8 * k);
        else
            hold_modify(t, h, v, p);
        memcpy(row + 3 * (size_t)x, p, 3);
    }
}

static void add_half_brite(struct texels *t)
{
    for (int i = 32; i < 64; i++)
        for (int k = 0; k < 3; k++)
            t->palette[i][k] = t->palette[i - 32][k] >> 1;
}

static bool read_body(struct byte_reader *r, const struct header *h, struct texels *t,
                      size_t size, struct codec_error e)
{
    const bool ham = h->mode & HAM && h->planes >= 5 && h->planes <= 8;
    if (!h->seen || !h->planes || (h->planes > 8 && h->planes != 24) ||
        h->compression > 1)
        return codec_fail(e, "IFF files of %u planes and compression %u cannot be read",
                          h->planes, h->compression);
    if (h->planes <= 8 && !t->palette)
        return codec_fail(e, "it has no palette");
    if (h->mode & HALF_BRITE && h->planes == 6)
        add_half_brite(t);
    // Packed bytes give up to 64 of a plane for one; 8 texels in each.
    const bool color = ham || h->planes == 24;
    if (!texels_allocate(t, h->width, h->height, color ? 3 : 1, TEXEL_U8, size,
                         (h->compression ? 64 : 1) * 8.0 / h->planes, e))
        return false;
    const size_t stride = (h->width + 15) / 16 * 2;
    const unsigned planes = h->planes + (h->masking == MASK_PLANE);
    uint8_t *buffer = malloc(stride * planes);
    if (!buffer)
        return codec_fail(e, "out of memory");
    bool ok = true;
    for (int y = 0; y < t->height && ok; y++) {
        for (unsigned k = 0; k < planes && ok; k++)
            ok = read_plane(r, h->compression, buffer + k * stride, stride);
        if (ok)
            unpack_row(t, h, buffer, stride, texels_row8(t, y));
    }
    free(buffer);
    if (color) { // the palette was the coder's own
        free(t->palette);
        t->palette = NULL;
        t->palette_count = 0;
        t->indexed = false;
    }
    return ok || codec_fail(e, "it is damaged or ends too early");
}

bool iff_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct byte_reader r = {data, data + size, false};
    struct header h = {0};
    read_skip(&r, 8);
    if (size < 12 || memcmp(r.at, "ILBM", 4) != 0)
        return codec_fail(e, "it is no IFF file of the kind ILBM");
    read_skip(&r, 4);
    while (!r.ended && r.end - r.at >= 8) {
        const uint8_t *id = r.at;
        read_skip(&r, 4);
        size_t length = read_be32(&r);
        size_t rest = (size_t)(r.end - r.at);
        struct byte_reader in = {r.at, r.at + (length < rest ? length : rest), false};
        if (memcmp(id, "BMHD", 4) == 0)
            read_bitmap_header(&in, &h);
        else if (memcmp(id, "CAMG", 4) == 0)
            h.mode = read_be32(&in);
        else if (memcmp(id, "CMAP", 4) == 0 && !read_palette(&in, length, t, e))
            return false;
        else if (memcmp(id, "BODY", 4) == 0)
            return read_body(&in, &h, t, size, e);
        read_skip(&r, length + (length & 1));
    }
    return codec_fail(e, "it has no picture");
}
