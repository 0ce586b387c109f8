// BMP files: 1, 4 and 8 bits with a palette (plain and run-length encoded), 16, 24 and 32,
// the fields of 16 and 32 by masks if given.

#include "image/codec.h"

enum { RGB, RLE8, RLE4, FIELDS, ALPHA_FIELDS = 6 };

struct header {
    uint32_t data, size; // of the pixels, of the information header
    uint32_t width, height, depth, compression, colors;
    bool from_top;
    uint32_t mask[4]; // of red, green, blue, alpha; 0: none
};

static bool is_field(uint32_t mask)
{
    const uint32_t low = mask & (~mask + 1), up = mask + low; // one run of bits
    return (up & (up - 1)) == 0;
}

// Where the bits of 16 and 32 are; true if they can be.
static bool read_masks(struct byte_reader *r, struct header *h, uint32_t given)
{
    if (h->compression != FIELDS && h->compression != ALPHA_FIELDS) {
        h->mask[0] = 0x7c00, h->mask[1] = 0x03e0, h->mask[2] = 0x001f;
        return true;
    }
    // Behind a header of 40 bytes, within larger ones.
    const int count = given >= 16 || h->compression == ALPHA_FIELDS ? 4 : 3;
    bool ok = h->depth == 16 || h->depth == 32;
    for (int k = 0; k < count; k++) {
        h->mask[k] = read_le32(r);
        ok &= is_field(h->mask[k]) && (h->depth == 32 || h->mask[k] <= 0xffff);
    }
    return ok && h->mask[0] && h->mask[1] && h->mask[2];
}

static bool has_fields(const struct header *h)
{
    return h->compression == FIELDS || h->compression == ALPHA_FIELDS;
}

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
        const uint32_t more = h->size > 40 ? h->size - 40 : 0;
        const uint8_t *masks = r->at;
        if (!read_masks(r, h, more))
            return codec_fail(e, "its colour masks make no sense");
        read_skip(r, more > (size_t)(r->at - masks) ? more - (size_t)(r->at - masks) : 0);
    }
    if (r->ended || (h->size != 12 && h->size < 40))
        return codec_fail(e, "its header makes no sense");
    bool fits = h->compression == RGB || (h->compression == RLE8 && h->depth == 8) ||
                (h->compression == RLE4 && h->depth == 4) || has_fields(h);
    if (!fits || (h->depth != 1 && h->depth != 4 && h->depth != 8 && h->depth != 16 &&
                  h->depth != 24 && h->depth != 32))
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

// A field's bits as 0..255.
static uint8_t field_of(uint32_t pixel, uint32_t mask)
{
    const uint32_t low = mask & (~mask + 1), most = mask / low;
    return (uint8_t)(((uint64_t)((pixel & mask) / low) * 255 + most / 2) / most);
}

static void read_field_row(struct byte_reader *r, const struct header *h,
                           const struct texels *t, uint8_t *row)
{
    for (uint32_t x = 0; x < h->width; x++) {
        const uint32_t pixel = h->depth == 16 ? read_le16(r) : read_le32(r);
        for (int k = 0; k < t->channels; k++)
            *row++ = field_of(pixel, h->mask[k]);
    }
    if (h->depth == 16 && h->width % 2)
        read_skip(r, 2);
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
    const bool packed = h.compression == RLE8 || h.compression == RLE4;
    const bool fields = h.depth == 16 || has_fields(&h);
    // Plain rows take the bits that they need; what jumps skip takes none at all.
    if (!texels_allocate(t, h.width, h.height,
                         h.depth == 32 ? (fields && !h.mask[3] ? 3 : 4)
                         : h.depth > 8 ? (h.mask[3] ? 4 : 3)
                                       : 1,
                         TEXEL_U8, size, packed ? 65536 : 8.0 / h.depth, e))
        return false;
    r.at = data;
    read_skip(&r, h.data);
    bool ok = true;
    if (packed)
        ok = read_packed(&r, &h, t);
    for (int j = 0; !packed && j < t->height && !r.ended; j++)
        (fields ? read_field_row : read_plain_row)(
            &r, &h, t, texels_row8(t, h.from_top ? j : t->height - 1 - j));
    return (ok && !r.ended) || codec_fail(e, "it is damaged or ends too early");
}
