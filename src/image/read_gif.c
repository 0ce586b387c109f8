// GIF files: the first picture, as palette indices. A reader of our own: giflib leaves
// the transparent colour and all checks to its caller, and what is left is this LZW.
#include <stdlib.h>
#include <string.h>

#include "image/codec.h"

enum { CODES = 4096, INTERLACED = 0x40, LOCAL_PALETTE = 0x80 };

// The bytes of a chain of blocks, taken as codes from the low bit up.
struct bits {
    struct byte_reader *in;
    unsigned block; // bytes left of it
    uint32_t held;
    int count;
};

static int next_code(struct bits *b, int size)
{
    while (b->count < size) {
        if (!b->block) {
            b->block = read_u8(b->in);
            if (!b->block)
                return -1;
        }
        b->block--;
        b->held |= (uint32_t)read_u8(b->in) << b->count;
        b->count += 8;
        if (b->in->ended)
            return -1;
    }
    int code = (int)(b->held & ((1u << size) - 1));
    b->held >>= size;
    b->count -= size;
    return code;
}

struct lzw {
    uint16_t prefix[CODES];
    uint8_t last[CODES], first[CODES];
    uint16_t length[CODES];
};

// Writes the string of a code; returns how far it got.
static size_t emit(const struct lzw *l, int code, uint8_t *out, size_t at, size_t n)
{
    const size_t length = l->length[code];
    for (size_t i = length; i-- > 0;) {
        if (at + i < n)
            out[at + i] = l->last[code];
        code = l->prefix[code];
    }
    return at + length < n ? at + length : n;
}

static bool decode(struct byte_reader *in, uint8_t *out, size_t n, struct codec_error e)
{
    static const char early[] = "it ends too early";
    struct lzw l;
    memset(&l, 0, sizeof l);
    struct bits b = {.in = in};
    const int minimum = (int)read_u8(in);
    if (minimum < 1 || minimum > 8)
        return codec_fail(e, "its codes have %d bits", minimum);
    const int clear = 1 << minimum;
    for (int i = 0; i < clear; i++) {
        l.last[i] = l.first[i] = (uint8_t)i;
        l.length[i] = 1;
    }
    int size = minimum + 1, next = clear + 2, before = -1;
    for (size_t at = 0; at < n;) {
        int code = next_code(&b, size);
        if (code < 0 || code == clear + 1)
            return codec_fail(e, early);
        if (code == clear) {
            size = minimum + 1;
            next = clear + 2;
            before = -1;
            continue;
        }
        if (code > next || (code >= clear && before < 0) ||
            (code == next && next == CODES))
            return codec_fail(e, "it has a code that means nothing");
        if (before >= 0 && next < CODES) {
            l.prefix[next] = (uint16_t)before;
            l.first[next] = l.first[before];
            l.length[next] = (uint16_t)(l.length[before] + 1);
            l.last[next] = l.first[code == next ? before : code];
            next++;
        }
        at = emit(&l, code, out, at, n);
        before = code;
        if (next == 1 << size && size < 12)
            size++;
    }
    return true;
}

static void skip_blocks(struct byte_reader *r)
{
    for (unsigned n; (n = read_u8(r)) > 0;)
        read_skip(r, n);
}

// A graphic control block says which colour is transparent.
static void read_extension(struct byte_reader *r, int *transparent)
{
    if (read_u8(r) == 0xf9 && r->at < r->end && *r->at >= 4) {
        unsigned n = read_u8(r), flags = read_u8(r);
        read_skip(r, 2);
        unsigned color = read_u8(r);
        *transparent = flags & 1 ? (int)color : -1;
        read_skip(r, n - 4);
    }
    skip_blocks(r);
}

static bool read_palette(struct byte_reader *r, unsigned flags, struct texels *t,
                         struct codec_error e)
{
    int count = 2 << (flags & 7);
    if (!t->palette && !texels_palette(t, 256, e)) // codes may exceed the colours given
        return false;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            t->palette[i][k] = (uint8_t)read_u8(r);
    return true;
}

// Interlaced rows come in four passes: every eighth, those between, and so on.
static bool unweave(struct texels *t, struct codec_error e)
{
    static const int first[4] = {0, 4, 2, 1}, step[4] = {8, 8, 4, 2};
    const size_t width = (size_t)t->width, size = width * (size_t)t->height;
    uint8_t *woven = malloc(size);
    if (!woven)
        return codec_fail(e, "out of memory");
    memcpy(woven, t->data, size);
    const uint8_t *row = woven;
    for (int pass = 0; pass < 4; pass++)
        for (int y = first[pass]; y < t->height; y += step[pass], row += width)
            memcpy(texels_row8(t, y), row, width);
    free(woven);
    return true;
}

static bool read_picture(struct byte_reader *r, struct texels *t, size_t size,
                         int transparent, struct codec_error e)
{
    read_skip(r, 4);
    unsigned width = read_le16(r), height = read_le16(r), flags = read_u8(r);
    if (flags & LOCAL_PALETTE && !read_palette(r, flags, t, e))
        return false;
    if (!t->palette)
        return codec_fail(e, "it has no palette");
    if (transparent >= 0)
        t->palette[transparent][3] = 0;
    t->palette_alpha = true;
    // A code of 12 bits stands for up to 4096 texels.
    return texels_allocate(t, width, height, 1, TEXEL_U8, size, 4096, e) &&
           decode(r, t->data, (size_t)t->width * (size_t)t->height, e) &&
           (!(flags & INTERLACED) || unweave(t, e));
}

bool gif_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct byte_reader r = {data, data + size, false};
    int transparent = -1;
    read_skip(&r, 10);
    unsigned flags = read_u8(&r);
    read_skip(&r, 2);
    if (flags & LOCAL_PALETTE && !read_palette(&r, flags, t, e))
        return false;
    while (!r.ended) {
        unsigned mark = read_u8(&r);
        if (mark == ',')
            return read_picture(&r, t, size, transparent, e);
        if (mark == '!')
            read_extension(&r, &transparent);
        else if (mark != 0)
            break;
    }
    return codec_fail(e, "it has no picture");
}
