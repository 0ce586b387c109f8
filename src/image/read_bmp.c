// BMP files: 1, 4 and 8 bits with a palette (plain and run-length encoded), 24 and 32.
#include <stdlib.h>

#include "image/codec.h"

enum { RGB, RLE8, RLE4 };

struct header {
    uint32_t data, size; // of the pixels, of the information header
    uint32_t width, height, depth, compression, colors;
    bool from_top;
};

static bool read_header(struct byte_reader *r, struct header *h, struct codec_error e)
{
    read_skip(r, 10);
    h->data = read_le32(r);
    h->size = read_le32(r);
    if (h->size == 12) { // OS/2
        h->width = read_le16(r);
        h->height = read_le16(r);
        read_skip(r, 2);
        h->depth = read_le16(r);
    } else {
        h->width = read_le32(r);
        h->height = read_le32(r);
        h->from_top = h->height >> 31;
        if (h->from_top)
            h->height = -h->height;
        read_skip(r, 2);
        h->depth = read_le16(r);
        h->compression = read_le32(r);
        read_skip(r, 12);
        h->colors = read_le32(r);
        read_skip(r, 4);
        read_skip(r, h->size > 40 ? h->size - 40 : 0);
    }
    if (r->ended || (h->size != 12 && h->size < 40))
        return codec_fail(e, "its header makes no sense");
    bool fits = h->compression == RGB || (h->compression == RLE8 && h->depth == 8) ||
                (h->compression == RLE4 && h->depth == 4);
    if (!fits || (h->depth != 1 && h->depth != 4 && h->depth != 8 && h->depth != 24 &&
                  h->depth != 32))
        return codec_fail(e, "BMP files of %u bits and compression %u cannot be read",
                          (unsigned)h->depth, (unsigned)h->compression);
    return true;
}

static bool read_palette(struct byte_reader *r, const struct header *h, struct texels *t,
                         struct codec_error e)
{
    uint32_t count = 1u << h->depth;
    uint32_t given = h->colors && h->colors < count ? h->colors : count;
    if (!texels_palette(t, (int)count, e))
        return false;
    for (uint32_t i = 0; i < given; i++) {
        for (int k = 2; k >= 0; k--)
            t->palette[i][k] = (uint8_t)read_u8(r);
        if (h->size != 12)
            read_u8(r);
    }
    return true;
}

static void read_plain_row(struct byte_reader *r, const struct header *h,
                           const struct texels *t, uint8_t *row)
{
    const uint8_t *start = r->at;
    unsigned held = 0, bits = 0;
    for (uint32_t x = 0; x < h->width; x++) {
        if (h->depth >= 24) {
            for (int k = 2; k >= 0; k--)
                row[x * (uint32_t)t->channels + (uint32_t)k] = (uint8_t)read_u8(r);
            if (h->depth == 32)
                row[4 * x + 3] = (uint8_t)read_u8(r);
            continue;
        }
        if (!bits) {
            held = read_u8(r);
            bits = 8;
        }
        bits -= h->depth;
        row[x] = (uint8_t)(held >> bits & ((1u << h->depth) - 1));
    }
    read_skip(r, (size_t)(start - r->at) & 3); // rows end at multiples of four bytes
}

// Pixels that runs and jumps leave out stay 0.
static bool read_packed(struct byte_reader *r, const struct header *h, struct texels *t)
{
    uint32_t x = 0, y = 0; // y from the bottom
    while (!r->ended) {
        unsigned n = read_u8(r), v = read_u8(r);
        if (!n && v == 1)
            return true;
        if (!n && v == 0) {
            x = 0;
            y++;
            continue;
        }
        if (!n && v == 2) {
            x += read_u8(r);
            y += read_u8(r);
            continue;
        }
        const bool copy = !n;
        const uint8_t *start = r->at;
        for (unsigned i = 0, count = copy ? v : n; i < count; i++, x++) {
            unsigned p = v;
            if (copy && (h->depth == 8 || i % 2 == 0))
                v = p = read_u8(r);
            if (h->depth == 4)
                p = i % 2 ? p & 15 : p >> 4;
            if (x >= h->width || y >= h->height)
                return false;
            texels_row8(t, (int)(h->height - 1 - y))[x] = (uint8_t)p;
        }
        if (copy)
            read_skip(r, (size_t)(r->at - start) & 1);
    }
    return false;
}

bool bmp_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct byte_reader r = {data, data + size, false};
    struct header h = {0};
    if (!read_header(&r, &h, e) || (h.depth <= 8 && !read_palette(&r, &h, t, e)))
        return false;
    const bool packed = h.compression != RGB;
    // Plain rows take the bits that they need; what jumps skip takes none at all.
    if (!texels_allocate(t, h.width, h.height,
                         h.depth == 32   ? 4
                         : h.depth == 24 ? 3
                                         : 1,
                         TEXEL_U8, size, packed ? 65536 : 8.0 / h.depth, e))
        return false;
    r.at = data;
    read_skip(&r, h.data);
    bool ok = true;
    if (packed)
        ok = read_packed(&r, &h, t);
    for (int j = 0; !packed && j < t->height && !r.ended; j++)
        read_plain_row(&r, &h, t, texels_row8(t, h.from_top ? j : t->height - 1 - j));
    return (ok && !r.ended) || codec_fail(e, "it is damaged or ends too early");
}
