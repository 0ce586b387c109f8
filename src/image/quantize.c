// From floats to the integers of PNG and PPM files.
#include "image/codec.h"

#include <math.h>

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

void quantize_row(const struct image *im, int y, const struct image_write_options *o,
                  uint16_t *out)
{
    double max = (double)((1 << o->bits) - 1);
    for (int x = 0; x < im->width; x++) {
        const float *p = image_at(im, x, y);
        double c[3], alpha = 1;
        for (int k = 0; k < 3; k++)
            c[k] = im->channels >= 3 ? (double)p[k] : (double)p[0];
        if (o->alpha)
            alpha = unpremultiply(c, im->channels == 4 ? (double)p[3] : 1);
        if (o->grey) {
            *out++ = quantize(encode(o, grey(c)), max);
        } else {
            for (int k = 0; k < 3; k++)
                *out++ = quantize(encode(o, c[k]), max);
        }
        if (o->alpha)
            *out++ = quantize(alpha, max);
    }
}
