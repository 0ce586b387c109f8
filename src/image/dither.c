#include "image/dither.h"

#include <math.h>
#include <stdlib.h>

enum { CHANNELS = 3 };

struct dither {
    enum dither_method method;
    int width, row;
    // Errors for this row and the next, with a place to spare at both ends.
    double *here, *below;
};

struct dither *dither_new(enum dither_method method, int width)
{
    struct dither *d = calloc(1, sizeof *d);
    const size_t n = ((size_t)width + 2) * CHANNELS;
    if (!d)
        return NULL;
    *d = (struct dither){method, width, 0, calloc(n, sizeof(double)),
                         calloc(n, sizeof(double))};
    if (d->here && d->below)
        return d;
    dither_free(d);
    return NULL;
}

void dither_free(struct dither *d)
{
    if (!d)
        return;
    free(d->here);
    free(d->below);
    free(d);
}

// Ranks of the thresholds in squares of side 2, 3 and 4.
static double threshold(enum dither_method method, int x, int y)
{
    static const unsigned char two[2][2] = {{0, 2}, {3, 1}};
    static const unsigned char three[3][3] = {{0, 7, 3}, {6, 5, 2}, {4, 1, 8}};
    switch (method) {
    case DITHER_BAYER_2: return (two[y % 2][x % 2] + 0.5) / 4;
    case DITHER_BAYER_3: return (three[y % 3][x % 3] + 0.5) / 9;
    default: // each place of the square of 2 is one of these
        return (4 * two[y % 2][x % 2] + two[y / 2 % 2][x / 2 % 2] + 0.5) / 16;
    }
}

static double clamp(double v, double max)
{
    return v > 0 ? (v < max ? v : max) : 0; // NaN becomes 0
}

static void hand_on(struct dither *d, size_t at, double error)
{
    switch (d->method) {
    case DITHER_NEXT: d->here[at + CHANNELS] += error; break;
    case DITHER_HALVES:
        d->here[at + CHANNELS] += error / 2;
        d->below[at] += error / 2;
        break;
    default:
        d->here[at + CHANNELS] += error * 7 / 16;
        d->below[at - CHANNELS] += error * 3 / 16;
        d->below[at] += error * 5 / 16;
        d->below[at + CHANNELS] += error / 16;
        break;
    }
}

static void next_row(struct dither *d, int y)
{
    double *old = d->here;
    d->here = d->below;
    d->below = old;
    for (size_t i = 0; i < ((size_t)d->width + 2) * CHANNELS; i++)
        old[i] = 0;
    d->row = y;
}

uint16_t dither_code(struct dither *d, int x, int y, int channel, double v, double max)
{
    v = clamp(v, max);
    if (d->method <= DITHER_BAYER_4)
        return (uint16_t)clamp(floor(v + threshold(d->method, x, y)), max);
    if (y != d->row)
        next_row(d, y);
    const size_t at = ((size_t)x + 1) * CHANNELS + (size_t)channel;
    const double wanted = v + d->here[at];
    const double code = clamp(floor(wanted + 0.5), max);
    hand_on(d, at, wanted - code);
    return (uint16_t)code;
}
