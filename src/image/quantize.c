// From floats to the integers of files.
#include "image/codec.h"
#include "image/dither.h"
#include "math/color.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Alpha below this counts as this when colours are divided by it.
static const double alpha_least = 1e-6;

int quantize_channels(const struct image_write_options *o)
{
    return (o->grey ? 1 : 3) + (o->alpha ? 1 : 0);
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
    double brightness = luminance(c[0], c[1], c[2]);
    if (brightness > alpha)
        alpha = brightness < 1 ? brightness : 1;
    double divisor = alpha > alpha_least ? alpha : alpha_least;
    for (int k = 0; k < 3; k++)
        c[k] /= divisor;
    return alpha;
}

// ---- tables -----------------------------------------------------------------------------
// The encoding is monotone, so the code of a float is found by comparing with the least
// float of each code: the same result as the formula, without a power per sample.

// Samples are looked up by the upper bits of the float, so fine that a bucket mostly has
// one border between 8 bit codes at most.
enum { BUCKET_SHIFT = 15 };

enum { PLAIN_FLOATS = 256 }; // of so many a row is looked up at a time

// A table costs more than it saves for files of more bits.
enum { TABLE_BITS_MAX = 10 };

struct quantizer {
    double max;
    struct dither *dither; // NULL: none
    // border[i]: the bits of the least float with code >= i; border[codes] is above all.
    // NULL: the formula.
    uint32_t *border;
    uint16_t *guess; // the code just below each bucket, the first and all before it
    uint32_t first;  // the bucket of border[1]
    // NULL where a bucket has two borders. Of the bucket before the first and of each from
    // there: with the bits of a float added, its code above STEP_SHIFT bits (modulo 2^32).
    uint32_t *step;
};

enum { STEP_SHIFT = 16 }; // above BUCKET_SHIFT

static uint32_t to_bits(float v)
{
    uint32_t bits;
    memcpy(&bits, &v, sizeof bits);
    return bits;
}

static float from_bits(uint32_t bits)
{
    float v;
    memcpy(&v, &bits, sizeof v);
    return v;
}

static bool reaches(const struct image_write_options *o, double max, uint32_t bits, int i)
{
    return quantize(encode(o, (double)from_bits(bits)), max) >= i;
}

// The curves and their inverses differ by less than this share of a number, but at the bend of
// sRGB's.
static const double inverse_slack = 0x1p-34, srgb_bend = 0.04045, bend_slack = 1e-5;

// The bits of the least float whose code is at least i > 0: bisection over bit patterns,
// which are ordered like the positive numbers. The inverse of the encoding tells which float
// that is where it lies clear of all floats, else it is mostly rounded to it or to one beside it.
static uint32_t border_of(const struct image_write_options *o, double max, int i)
{
    const double plain = (i - 0.5) / max;
    const bool same = o->unmanaged || transfer_equal(o->working, o->transfer);
    const double exact =
        same ? plain : transfer_encode(o->working, transfer_decode(o->transfer, plain));
    const uint32_t about = to_bits((float)exact);
    const double off = (double)(float)exact - exact, slack = inverse_slack * exact;
    if (exact > (double)FLT_MIN && exact < 1 && fabs(off) > slack &&
        fabs(plain - srgb_bend) > bend_slack)
        return off > 0 ? about : about + 1;
    uint32_t lo = 0, hi = to_bits(1);
    if (about > 1 && about < hi - 1) {
        if (!reaches(o, max, about, i)) {
            lo = about + 1;
            if (reaches(o, max, lo, i))
                return lo;
        } else {
            hi = about;
            if (!reaches(o, max, about - 1, i))
                return about;
        }
    }
    while (lo < hi) {
        const uint32_t mid = lo + (hi - lo) / 2;
        if (reaches(o, max, mid, i))
            hi = mid;
        else
            lo = mid + 1;
    }
    return lo;
}

static bool fill_steps(struct quantizer *q, uint32_t buckets)
{
    q->step = malloc((buckets + 1) * sizeof *q->step);
    if (!q->step)
        return false;
    q->step[0] = 0u - ((q->first - 1) << BUCKET_SHIFT);
    for (uint32_t b = 0; b < buckets; b++) {
        const uint32_t begin = (q->first + b) << BUCKET_SHIFT, code = q->guess[b];
        const uint32_t border = q->border[code + 1] - begin; // the last is far above
        const uint32_t up = (uint32_t)1 << STEP_SHIFT;
        q->step[b + 1] = (code << STEP_SHIFT) + (border < up ? up - border : 0) - begin;
    }
    return true;
}

static bool fill_table(struct quantizer *q, const struct image_write_options *o)
{
    const int codes = 1 << o->bits;
    q->border = malloc(((size_t)codes + 1) * sizeof *q->border);
    if (!q->border)
        return false;
    q->border[0] = 0;
    for (int i = 1; i < codes; i++)
        q->border[i] = border_of(o, q->max, i);
    q->border[codes] = UINT32_MAX;
    q->first = q->border[1] >> BUCKET_SHIFT;
    const uint32_t buckets = (to_bits(1) >> BUCKET_SHIFT) - q->first + 1;
    q->guess = malloc(buckets * sizeof *q->guess);
    if (!q->guess)
        return false;
    bool single = true;
    int code = 0;
    for (uint32_t b = 0; b < buckets; b++) {
        q->guess[b] = (uint16_t)code;
        const uint32_t end = (q->first + b + 1) << BUCKET_SHIFT;
        const int before = code;
        while (q->border[code + 1] < end)
            code++;
        single = single && code <= before + 1;
    }
    return !single || fill_steps(q, buckets);
}

struct quantizer *quantizer_new(const struct image_write_options *o, int width)
{
    struct quantizer *q = calloc(1, sizeof *q);
    if (!q)
        return NULL;
    q->max = (1 << o->bits) - 1;
    bool ok = true;
    if (o->dither)
        ok = (q->dither = dither_new(o->dither, width)) != NULL;
    else if (o->bits <= TABLE_BITS_MAX)
        ok = fill_table(q, o);
    if (ok)
        return q;
    quantizer_free(q);
    return NULL;
}

void quantizer_free(struct quantizer *q)
{
    if (!q)
        return;
    dither_free(q->dither);
    free(q->border);
    free(q->guess);
    free(q->step);
    free(q);
}

// The bits of v as a colour: NaN becomes 0.
static inline uint32_t color_bits(float v)
{
    v = v > 0 ? v : 0;
    v = v < 1 ? v : 1;
    return to_bits(v);
}

static inline uint32_t bucket_of(const struct quantizer *q, uint32_t bits)
{
    const uint32_t bucket = bits >> BUCKET_SHIFT;
    return (bucket > q->first ? bucket : q->first) - q->first;
}

static inline unsigned code_in(const struct quantizer *q, uint32_t bits)
{
    unsigned code = q->guess[bucket_of(q, bits)];
    while (bits >= q->border[code + 1])
        code++;
    return code;
}

// A number that is no float has the code of the float it is rounded to, but where a
// border may lie between the two.
static uint16_t code_of(const struct quantizer *q, const struct image_write_options *o,
                        double v)
{
    if (!(v > 0))
        return 0; // NaN too
    if (!q->border)
        return quantize(encode(o, v), q->max);
    const float f = (float)v;
    const uint32_t bits = color_bits(f);
    const unsigned code = code_in(q, bits);
    if ((double)f != v && (bits == q->border[code] || bits + 1 == q->border[code + 1]))
        return quantize(encode(o, v), q->max);
    return (uint16_t)code;
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

// The first three of each pixel's floats as they are. The part that the compiler can do in
// lanes comes first, and there is no branch: noise is hard to predict.
static inline uint16_t *stepped_codes(const struct quantizer *q, const float *p,
                                      int count, int channels, uint16_t *out)
{
    const uint32_t before = (q->first << BUCKET_SHIFT) - 1;
    const float least = from_bits(before);
    const uint32_t *step = q->step;
    const uint32_t first = before >> BUCKET_SHIFT;
    uint32_t bits[PLAIN_FLOATS];
    for (int i = 0; i < count; i++) {
        float v = p[i] > least ? p[i] : least; // NaN too has the code 0
        v = v < 1 ? v : 1;
        bits[i] = to_bits(v);
    }
    for (int i = 0; i < count; i += channels)
        for (int k = 0; k < 3; k++) {
            const uint32_t v = bits[i + k];
            *out++ = (uint16_t)((step[(v >> BUCKET_SHIFT) - first] + v) >> STEP_SHIFT);
        }
    return out;
}

static uint16_t *plain_codes(const struct quantizer *q, const float *p, int count,
                             int channels, uint16_t *out)
{
    for (int i = 0; i < count; i += channels)
        for (int k = 0; k < 3; k++)
            *out++ = (uint16_t)code_in(q, color_bits(p[i + k]));
    return out;
}

static void plain_row(const struct quantizer *q, const struct image *im, int y,
                      uint16_t *out)
{
    const int step = PLAIN_FLOATS / im->channels;
    for (int x = 0; x < im->width; x += step) {
        const int n = im->width - x < step ? im->width - x : step;
        const float *p = image_at(im, x, y);
        const int channels = im->channels;
        if (!q->step)
            out = plain_codes(q, p, n * channels, channels, out);
        else if (channels == 3)
            out = stepped_codes(q, p, n * 3, 3, out);
        else
            out = stepped_codes(q, p, n * channels, channels, out);
    }
}

void quantize_row(const struct quantizer *q, const struct image *im, int y,
                  const struct image_write_options *o, uint16_t *out)
{
    if (q->border && im->channels >= 3 && !o->alpha && !o->grey) {
        plain_row(q, im, y, out);
        return;
    }
    for (int x = 0; x < im->width; x++) {
        const float *p = image_at(im, x, y);
        double c[3], alpha = 1;
        for (int k = 0; k < 3; k++)
            c[k] = im->channels >= 3 ? (double)p[k] : (double)p[0];
        if (o->alpha)
            alpha = unpremultiply(c, im->channels == 4 ? (double)p[3] : 1);
        if (o->grey) {
            *out++ = sample_code(q, o, x, y, 0, luminance(c[0], c[1], c[2]));
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
    const uint16_t *from = r->samples;
    uint8_t *to = r->bytes;
    const size_t count = r->count;
    const int bits = r->o.bits;
    for (size_t i = 0; bits <= 8 && i < count; i++)
        to[i] = (uint8_t)(from[i] << shift);
    for (size_t i = 0; bits > 8 && i < count; i++) {
        const unsigned v = (unsigned)from[i] << shift;
        to[2 * i] = (uint8_t)(v >> 8);
        to[2 * i + 1] = (uint8_t)v;
    }
    return to;
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
