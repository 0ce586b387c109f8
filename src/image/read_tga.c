// TGA (Targa) files: palette, colour and grey, plain and run-length encoded.
#include "image/codec.h"

enum { PALETTE = 1, COLOR = 2, GREY = 3, PACKED = 8, FROM_TOP = 0x20, FROM_RIGHT = 0x10 };

struct header {
    unsigned kind, depth, flags;
    unsigned first, count, entry_depth; // of the palette
    bool has_palette;
};

// 15 and 16 bits: five per channel, the top bit is alpha.
static void unpack(struct byte_reader *r, unsigned depth, uint8_t out[4])
{
    out[3] = 255;
    if (depth <= 16) {
        unsigned v = read_le16(r);
        out[0] = (uint8_t)((v >> 10 & 31) << 3);
        out[1] = (uint8_t)((v >> 5 & 31) << 3);
        out[2] = (uint8_t)((v & 31) << 3);
        if (depth == 16)
            out[3] = v & 0x8000 ? 255 : 0;
        return;
    }
    out[2] = (uint8_t)read_u8(r);
    out[1] = (uint8_t)read_u8(r);
    out[0] = (uint8_t)read_u8(r);
    if (depth == 32)
        out[3] = (uint8_t)read_u8(r);
}

static bool read_palette(struct byte_reader *r, const struct header *h, struct texels *t,
                         struct codec_error e)
{
    const unsigned size = (h->entry_depth + 7) / 8;
    if (h->kind != PALETTE) {
        read_skip(r, (size_t)h->count * size);
        return true;
    }
    if (h->first + h->count > 256 || !h->count || size < 2 || size > 4)
        return codec_fail(e, "its palette makes no sense");
    if (!texels_palette(t, (int)(h->first + h->count), e))
        return false;
    t->palette_alpha = h->entry_depth == 16 || h->entry_depth == 32;
    for (unsigned i = 0; i < h->count; i++)
        unpack(r, h->entry_depth, t->palette[h->first + i]);
    return true;
}

static void read_texel(struct byte_reader *r, const struct header *h, int channels,
                       uint8_t out[4])
{
    if (channels == 1)
        out[0] = (uint8_t)read_u8(r);
    else
        unpack(r, h->depth, out);
}

static bool read_texels(struct byte_reader *r, const struct header *h, bool packed,
                        struct texels *t)
{
    unsigned left = 0; // of the run or the stretch
    bool run = false;
    uint8_t p[4] = {0};
    for (int j = 0; j < t->height; j++) {
        int y = h->flags & FROM_TOP ? j : t->height - 1 - j;
        for (int i = 0; i < t->width; i++) {
            int x = h->flags & FROM_RIGHT ? t->width - 1 - i : i;
            bool fresh = !packed || !run;
            if (packed && !left) {
                unsigned n = read_u8(r);
                run = n & 0x80;
                left = (n & 0x7f) + 1;
                fresh = true;
            }
            if (fresh)
                read_texel(r, h, t->channels, p);
            left -= packed;
            for (int k = 0; k < t->channels; k++)
                texels_row8(t, y)[x * t->channels + k] = p[k];
        }
        if (r->ended)
            return false;
    }
    return true;
}

static int channels_of(const struct header *h)
{
    if (h->kind == PALETTE || h->kind == GREY)
        return h->depth == 8 ? 1 : 0;
    if (h->kind != COLOR)
        return 0;
    switch (h->depth) {
    case 15:
    case 24: return 3;
    case 16:
    case 32: return 4;
    default: return 0;
    }
}

bool tga_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct byte_reader r = {data, data + size, false};
    struct header h = {0};
    unsigned id = read_u8(&r);
    h.has_palette = read_u8(&r) == 1;
    h.kind = read_u8(&r);
    h.first = read_le16(&r);
    h.count = read_le16(&r);
    h.entry_depth = read_u8(&r);
    read_skip(&r, 4);
    unsigned width = read_le16(&r), height = read_le16(&r);
    h.depth = read_u8(&r);
    h.flags = read_u8(&r);
    bool packed = h.kind & PACKED;
    h.kind &= ~(unsigned)PACKED;
    int channels = channels_of(&h);
    if (r.ended || !channels || (h.kind == PALETTE && !h.has_palette))
        return codec_fail(e, "it is no TGA file of a known kind");
    read_skip(&r, id);
    if (h.has_palette && !read_palette(&r, &h, t, e))
        return false;
    // A run of two bytes gives 128 texels.
    return texels_allocate(t, width, height, channels, TEXEL_U8, size, packed ? 64 : 1,
                           e) &&
           (read_texels(&r, &h, packed, t) || codec_fail(e, "it ends too early"));
}
