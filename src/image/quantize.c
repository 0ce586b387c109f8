// From floats to the integers of files.
#include "image/codec.h"
#include "image/dither.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Alpha below this counts as this when colours are divided by it.
static const double alpha_least = 1e-6;

int quantize_channels(const struct image_write_options *o)
{
    return (o->grey ? 1 : 3) + (o->alpha ? 1 : 0);
}

static double grey(const double c[3])
{
    return 0.297 * c[0] + 0.589 * c[1] + 0.114 * c[2];
}

static double encode(const struct image_write_options *o, double v)
{
    if (o->unmanaged || transfer_equal(o->working, o->transfer))
        return v;
    return transfer_encode(o->transfer, transfer_decode(o->working, v));
}

static uint16_t quantize(double v, double max)
{
    v = v > 0 ? v : 0; // NaN becomes 0
    v = v < 1 ? v : 1;
    return (uint16_t)floor(v * max + 0.5);
}

// From premultiplied to plain colour. A pixel brighter than its alpha (a highlight
// on glass) gets the alpha it needs, so that it is not lost.
static double unpremultiply(double c[3], double alpha)
{
    double brightness = grey(c);
    if (brightness > alpha)
        alpha = brightness < 1 ? brightness : 1;
    double divisor = alpha > alpha_least ? alpha : alpha_least;
    for (int k = 0; k < 3; k++)
        c[k] /= divisor;
    return alpha;
}

// ---- tables -----------------------------------------------------------------------------
// The encoding is monotone, so a code is found by comparing with the least value of each
// code: the same result as the formula, without a power per sample.

// So fine that buckets mostly have one border between 8 bit codes at most.
enum { BUCKET_BITS = 15, BUCKETS = 13 << (23 - BUCKET_BITS), EXPONENT_LEAST = 127 - 13 };

// A table costs more than it saves for files of more bits.
enum { TABLE_BITS_MAX = 10 };

struct quantizer {
    double max;
    double *least; // least[i]: the least value with code >= i; least[codes] = infinity
    struct dither *dither; // NULL: none, and then the table
    uint16_t *guess;       // the code at the low end of a bucket of float bit patterns
};

static double from_bits(uint64_t bits)
{
    double v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static uint64_t to_bits(double v)
{
    uint64_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

// The least double whose code is at least i: bisection over bit patterns, which are
// ordered like the positive numbers. It begins around the inverse of the encoding, where
// that is as near as it should be.
static double least_of(const struct image_write_options *o, double max, int i)
{
    static const double nearly = 0x1p-36;
    uint64_t lo = 0, hi = 0x3ff8000000000000u; // 1.5
    const double about =
        o->unmanaged || transfer_equal(o->working, o->transfer)
            ? (i - 0.5) / max
            : transfer_encode(o->working, transfer_decode(o->transfer, (i - 0.5) / max));
    const double below = about * (1 - nearly), above = about * (1 + nearly);
    if (below > 0 && quantize(encode(o, below), max) < i)
        lo = to_bits(below);
    if (above < 1.5 && quantize(encode(o, above), max) >= i)
        hi = to_bits(above);
    while (lo < hi) {
        const uint64_t mid = lo + (hi - lo) / 2;
        if (quantize(encode(o, from_bits(mid)), max) >= i)
            hi = mid;
        else
            lo = mid + 1;
    }
    return from_bits(lo);
}

static uint32_t bucket_of(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    const uint32_t first = (uint32_t)EXPONENT_LEAST << (23 - BUCKET_BITS);
    bits >>= BUCKET_BITS;
    return bits <= first ? 0 : bits - first >= BUCKETS ? BUCKETS - 1 : bits - first;
}

static struct quantizer *dithering(const struct image_write_options *o, int width)
{
    struct quantizer *q = calloc(1, sizeof *q);
    struct dither *d = dither_new(o->dither, width);
    if (q && d) {
        q->max = (1 << o->bits) - 1;
        q->dither = d;
        return q;
    }
    free(q);
    dither_free(d);
    return NULL;
}

struct quantizer *quantizer_new(const struct image_write_options *o, int width)
{
    if (o->dither)
        return dithering(o, width);
    const int codes = 1 << o->bits;
    struct quantizer *q = malloc(sizeof *q);
    if (q && o->bits > TABLE_BITS_MAX) {
        *q = (struct quantizer){.max = codes - 1};
        return q;
    }
    double *least = malloc(((size_t)codes + 1) * sizeof *least);
    uint16_t *guess = malloc(BUCKETS * sizeof *guess);
    if (!q || !least || !guess) {
        free(q);
        free(least);
        free(guess);
        return NULL;
    }
    *q = (struct quantizer){.max = codes - 1, .least = least, .guess = guess};
    least[0] = -INFINITY;
    for (int i = 1; i < codes; i++)
        least[i] = least_of(o, q->max, i);
    least[codes] = INFINITY;
    int code = 0;
    for (uint32_t b = 0; b < BUCKETS; b++) {
        const uint32_t bits = (b + ((uint32_t)EXPONENT_LEAST << (23 - BUCKET_BITS)))
                              << BUCKET_BITS;
        float v;
        memcpy(&v, &bits, sizeof v);
        while (least[code + 1] <= (double)v)
            code++;
        guess[b] = (uint16_t)code;
    }
    return q;
}

void quantizer_free(struct quantizer *q)
{
    if (!q)
        return;
    dither_free(q->dither);
    free(q->least);
    free(q->guess);
    free(q);
}

static uint16_t code_of(const struct quantizer *q, const struct image_write_options *o,
                        double v)
{
    if (!(v > 0))
        return 0; // NaN too
    if (!q->least)
        return quantize(encode(o, v), q->max);
    int i = q->guess[bucket_of((float)v)];
    i += v >= q->least[i + 1]; // no branch: noise is hard to predict
    while (v < q->least[i])
        i--;
    while (v >= q->least[i + 1])
        i++;
    return (uint16_t)i;
}

// Of a sample of the pixel (x, y).
static uint16_t sample_code(const struct quantizer *q,
                            const struct image_write_options *o, int x, int y, int k,
                            double v)
{
    if (q->dither)
        return dither_code(q->dither, x, y, k, encode(o, v > 0 ? v : 0) * q->max, q->max);
    return code_of(q, o, v);
}

void quantize_row(const struct quantizer *q, const struct image *im, int y,
                  const struct image_write_options *o, uint16_t *out)
{
    for (int x = 0; x < im->width; x++) {
        const float *p = image_at(im, x, y);
        double c[3], alpha = 1;
        for (int k = 0; k < 3; k++)
            c[k] = im->channels >= 3 ? (double)p[k] : (double)p[0];
        if (o->alpha)
            alpha = unpremultiply(c, im->channels == 4 ? (double)p[3] : 1);
        if (o->grey) {
            *out++ = sample_code(q, o, x, y, 0, grey(c));
        } else {
            for (int k = 0; k < 3; k++)
                *out++ = sample_code(q, o, x, y, k, c[k]);
        }
        if (o->alpha)
            *out++ = quantize(alpha, q->max);
    }
}

// ---- rows -------------------------------------------------------------------------------

bool sample_rows_begin(struct sample_rows *r, const struct image *im,
                       const struct image_write_options *o)
{
    *r = (struct sample_rows){.im = im, .o = *o};
    r->count = (size_t)im->width * (size_t)quantize_channels(o);
    r->quantizer = quantizer_new(o, im->width);
    r->samples = malloc(r->count * sizeof *r->samples);
    r->bytes = malloc(r->count * 2);
    return r->quantizer && r->samples && r->bytes;
}

void sample_rows_end(struct sample_rows *r)
{
    quantizer_free(r->quantizer);
    free(r->samples);
    free(r->bytes);
    *r = (struct sample_rows){0};
}

const uint8_t *sample_rows_bytes(struct sample_rows *r, int y, int shift)
{
    quantize_row(r->quantizer, r->im, y, &r->o, r->samples);
    uint8_t *to = r->bytes;
    for (size_t i = 0; i < r->count; i++) {
        const unsigned v = (unsigned)r->samples[i] << shift;
        if (r->o.bits > 8)
            *to++ = (uint8_t)(v >> 8);
        *to++ = (uint8_t)v;
    }
    return r->bytes;
}

const uint8_t *sample_rows_bgr(struct sample_rows *r, int y)
{
    sample_rows_bytes(r, y, 0);
    const size_t channels = (size_t)quantize_channels(&r->o);
    for (size_t i = 0; channels >= 3 && i < r->count; i += channels) {
        const uint8_t red = r->bytes[i];
        r->bytes[i] = r->bytes[i + 2];
        r->bytes[i + 2] = red;
    }
    return r->bytes;
}
