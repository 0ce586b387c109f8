// Portable bitmaps, greymaps and pixmaps, as text (P1 P2 P3) and binary (P4 P5 P6).
#include <ctype.h>

#include "image/codec.h"

// Past blanks and comments.
static void skip_blanks(struct byte_reader *r)
{
    while (r->at < r->end && (isspace(*r->at) || *r->at == '#')) {
        if (*r->at == '#')
            while (r->at < r->end && *r->at != '\n')
                r->at++;
        else
            r->at++;
    }
}

static uint32_t read_number(struct byte_reader *r)
{
    uint32_t v = 0;
    skip_blanks(r);
    if (r->at == r->end || !isdigit(*r->at))
        r->ended = true;
    while (r->at < r->end && isdigit(*r->at)) {
        if (v > 200000000)
            r->ended = true; // no number of this format is so long
        else
            v = 10 * v + (uint32_t)(*r->at - '0');
        r->at++;
    }
    return v;
}

struct header {
    bool text, bitmap;
    uint32_t max;
};

static uint32_t read_sample(struct byte_reader *r, const struct header *h)
{
    return h->text ? read_number(r) : h->max > 255 ? read_be16(r) : read_u8(r);
}

static bool read_samples(struct byte_reader *r, const struct header *h, struct texels *t)
{
    size_t n = (size_t)t->width * (size_t)t->height * (size_t)t->channels;
    t->max = (float)h->max;
    for (size_t i = 0; i < n && !r->ended; i++) {
        uint32_t v = read_sample(r, h);
        v = v < h->max ? v : h->max;
        if (h->max > 255)
            ((uint16_t *)t->data)[i] = (uint16_t)v;
        else
            ((uint8_t *)t->data)[i] = (uint8_t)v;
    }
    return !r->ended;
}

// One is black. Text bits need no blanks between them.
static bool read_bits(struct byte_reader *r, const struct header *h, struct texels *t)
{
    for (int y = 0; y < t->height; y++) {
        unsigned held = 0;
        for (int x = 0; x < t->width; x++) {
            if (h->text) {
                skip_blanks(r);
                held = read_u8(r) == '1' ? 0x80 : 0;
            } else if (x % 8 == 0) {
                held = read_u8(r);
            }
            texels_row8(t, y)[x] = held & 0x80 ? 0 : 255;
            held <<= 1;
        }
        if (r->ended)
            return false;
    }
    return true;
}

bool pnm_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct byte_reader r = {data + 2, data + size, false};
    int kind = data[1] - '0';
    struct header h = {.text = kind <= 3, .bitmap = kind == 1 || kind == 4, .max = 1};
    uint32_t width = read_number(&r), height = read_number(&r);
    if (!h.bitmap)
        h.max = read_number(&r);
    if (r.ended || h.max < 1 || h.max > 65535)
        return codec_fail(e, "its header makes no sense");
    read_u8(&r); // one blank
    if (!texels_allocate(t, width, height, kind == 3 || kind == 6 ? 3 : 1,
                         h.max > 255 ? TEXEL_U16 : TEXEL_U8, size, h.bitmap ? 8 : 1, e))
        return false;
    return (h.bitmap ? read_bits(&r, &h, t) : read_samples(&r, &h, t)) ||
           codec_fail(e, "it ends too early");
}
