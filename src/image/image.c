#define _DEFAULT_SOURCE // madvise
// Pictures in memory and the curves between linear light and file numbers.
#include "image/image.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

#include "math/elementary.h"

// Large pictures ask for large pages: the first touch of each page costs more than what
// is written to it.
static void *zeroed(size_t size)
{
#ifdef MADV_HUGEPAGE
    enum { PAGE = 1 << 21 };
    if (size >= 2 * PAGE && size <= SIZE_MAX - PAGE) {
        size = (size + PAGE - 1) & ~(size_t)(PAGE - 1);
        void *p = aligned_alloc(PAGE, size);
        if (!p)
            return NULL;
        madvise(p, size, MADV_HUGEPAGE); // where it is refused, small pages do
        return memset(p, 0, size);
    }
#endif
    return calloc(size, 1);
}

bool image_init(struct image *im, int width, int height, int channels)
{
    *im = (struct image){width, height, channels, NULL};
    if (width <= 0 || height <= 0 || channels <= 0)
        return false;
    size_t pixels = (size_t)width * (size_t)height;
    if (pixels > SIZE_MAX / sizeof(float) / (size_t)channels)
        return false;
    im->pixel = zeroed(pixels * (size_t)channels * sizeof(float));
    return im->pixel;
}

void image_free(struct image *im)
{
    free(im->pixel);
    *im = (struct image){0};
}

// IEC 61966-2-1, with the break points as spec/lighting.md 3.1 gives them.
static double srgb_encode(double x)
{
    return x <= 0.0031308 ? 12.92 * x : 1.055 * det_pow(x, 1 / 2.4) - 0.055;
}

static double srgb_decode(double x)
{
    return x < 0.04045 ? x / 12.92 : det_pow((x + 0.055) / 1.055, 2.4);
}

double transfer_encode(struct transfer t, double linear)
{
    switch (t.kind) {
    case TRANSFER_SRGB: return srgb_encode(linear);
    case TRANSFER_POWER: return linear > 0 ? det_pow(linear, 1 / t.gamma) : 0;
    case TRANSFER_NONE: break;
    }
    return linear;
}

double transfer_decode(struct transfer t, double encoded)
{
    switch (t.kind) {
    case TRANSFER_SRGB: return srgb_decode(encoded);
    case TRANSFER_POWER: return encoded > 0 ? det_pow(encoded, t.gamma) : 0;
    case TRANSFER_NONE: break;
    }
    return encoded;
}

bool transfer_equal(struct transfer a, struct transfer b)
{
    return a.kind == b.kind && (a.kind != TRANSFER_POWER || a.gamma == b.gamma);
}
