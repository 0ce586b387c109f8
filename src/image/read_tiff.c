// TIFF files through libtiff: palette and grey samples as stored where the layout is
// plain; everything else through the library's conversion to 8-bit colour.
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <tiffio.h>

#include "base/library.h"
#include "image/codec.h"

#define FUNCTIONS(F)                                                                     \
    F(TIFFClientOpen)                                                                    \
    F(TIFFClose)                                                                         \
    F(TIFFGetField)                                                                      \
    F(TIFFGetFieldDefaulted)                                                             \
    F(TIFFIsTiled)                                                                       \
    F(TIFFRGBAImageOK)                                                                   \
    F(TIFFReadRGBAImageOriented)                                                         \
    F(TIFFReadScanline)                                                                  \
    F(TIFFScanlineSize)                                                                  \
    F(TIFFSetErrorHandler)                                                               \
    F(TIFFSetErrorHandlerExt)                                                            \
    F(TIFFSetWarningHandler)

struct libtiff {
    FUNCTIONS(LIBRARY_POINTER)
};

#ifdef TIFF_SONAME
LIBRARY_LOADED(libtiff, TIFF_SONAME)
#else
LIBRARY_LINKED(libtiff)
#endif

struct job {
    const uint8_t *data;
    tmsize_t size, at;
    struct codec_error error;
    bool failed;
};

static tmsize_t on_read(thandle_t h, void *out, tmsize_t n)
{
    struct job *job = h;
    if (n > job->size - job->at)
        n = job->size - job->at;
    if (n <= 0)
        return 0;
    memcpy(out, job->data + job->at, (size_t)n);
    job->at += n;
    return n;
}

static tmsize_t on_write(thandle_t h, void *in, tmsize_t n)
{
    (void)h, (void)in, (void)n;
    return -1;
}

static toff_t on_seek(thandle_t h, toff_t to, int whence)
{
    struct job *job = h;
    toff_t base = whence == SEEK_CUR   ? (toff_t)job->at
                  : whence == SEEK_END ? (toff_t)job->size
                                       : 0;
    toff_t at = base + to; // may wrap: `to` may be negative
    if (at > (toff_t)job->size)
        at = (toff_t)job->size;
    job->at = (tmsize_t)at;
    return at;
}

static int on_close(thandle_t h)
{
    (void)h;
    return 0;
}

static toff_t on_size(thandle_t h) { return (toff_t)((struct job *)h)->size; }

// The library's handlers are the process's: the extended ones get the file's handle.
static void on_error(thandle_t h, const char *module, const char *format, va_list ap)
{
    struct job *job = h;
    (void)module;
    if (job && !job->failed)
        vsnprintf(job->error.text, job->error.size, format, ap);
    if (job)
        job->failed = true;
}

struct layout {
    uint32_t width, height;
    uint16_t bits, samples, photometric, planar, format;
    uint16_t *map[3];
};

static void read_layout(const struct libtiff *lib, TIFF *f, struct layout *l)
{
    lib->TIFFGetField(f, TIFFTAG_IMAGEWIDTH, &l->width);
    lib->TIFFGetField(f, TIFFTAG_IMAGELENGTH, &l->height);
    lib->TIFFGetFieldDefaulted(f, TIFFTAG_BITSPERSAMPLE, &l->bits);
    lib->TIFFGetFieldDefaulted(f, TIFFTAG_SAMPLESPERPIXEL, &l->samples);
    lib->TIFFGetFieldDefaulted(f, TIFFTAG_PLANARCONFIG, &l->planar);
    lib->TIFFGetFieldDefaulted(f, TIFFTAG_SAMPLEFORMAT, &l->format);
    if (!lib->TIFFGetField(f, TIFFTAG_PHOTOMETRIC, &l->photometric))
        l->photometric = PHOTOMETRIC_MINISBLACK;
    if (l->photometric == PHOTOMETRIC_PALETTE)
        lib->TIFFGetField(f, TIFFTAG_COLORMAP, &l->map[0], &l->map[1], &l->map[2]);
}

// Maps are of 16 bits, unless an old program wrote 8.
static bool read_palette(const struct layout *l, struct texels *t, struct codec_error e)
{
    int count = 1 << l->bits;
    bool wide = false;
    if (!texels_palette(t, count, e))
        return false;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            wide = wide || l->map[k][i] > 255;
    for (int i = 0; i < count; i++)
        for (int k = 0; k < 3; k++)
            t->palette[i][k] = (uint8_t)(wide ? l->map[k][i] >> 8 : l->map[k][i]);
    return true;
}

static bool read_rows(const struct libtiff *lib, TIFF *f, const struct layout *l,
                      struct texels *t, struct codec_error e)
{
    tmsize_t size = lib->TIFFScanlineSize(f);
    size_t need = (size_t)l->width * l->bits * l->samples;
    uint8_t *row =
        size > 0 && (size_t)size >= (need + 7) / 8 ? malloc((size_t)size) : NULL;
    bool ok = row || codec_fail(e, "its rows make no sense");
    const size_t n = (size_t)l->width * l->samples;
    for (int y = 0; y < t->height && ok; y++) {
        ok = lib->TIFFReadScanline(f, row, (uint32_t)y, 0) == 1;
        for (size_t i = 0; i < n && ok; i++) {
            if (l->bits == 16)
                memcpy(texels_row16(t, y) + i, row + 2 * i, 2);
            else
                texels_row8(t, y)[i] =
                    (uint8_t)(row[i * l->bits / 8] >> (8 - l->bits - i * l->bits % 8) &
                              ((1 << l->bits) - 1));
        }
    }
    free(row);
    return ok;
}

static bool read_converted(const struct libtiff *lib, TIFF *f, const struct layout *l,
                           struct texels *t, size_t size, struct codec_error e)
{
    uint16_t extra = 0, *kinds = NULL;
    lib->TIFFGetFieldDefaulted(f, TIFFTAG_EXTRASAMPLES, &extra, &kinds);
    char why[1024] = "";
    if (!lib->TIFFRGBAImageOK(f, why))
        return codec_fail(e, "%s", why);
    if (!texels_allocate(t, l->width, l->height, 4, TEXEL_U8, size, 1e6, e))
        return false;
    if (!lib->TIFFReadRGBAImageOriented(f, l->width, l->height, t->data,
                                        ORIENTATION_TOPLEFT, 1))
        return false;
    uint8_t *p = t->data;
    size_t n = (size_t)l->width * l->height;
    for (size_t i = 0; i < n; i++, p += 4) {
        uint32_t v;
        memcpy(&v, p, 4);
        p[0] = (uint8_t)TIFFGetR(v);
        p[1] = (uint8_t)TIFFGetG(v);
        p[2] = (uint8_t)TIFFGetB(v);
        p[3] = (uint8_t)TIFFGetA(v);
    }
    t->premultiplied = true;
    return true;
}

static bool read_opened(const struct libtiff *lib, TIFF *f, struct texels *t, size_t size,
                        struct codec_error e)
{
    struct layout l = {0};
    read_layout(lib, f, &l);
    bool plain =
        !lib->TIFFIsTiled(f) && l.samples == 1 && l.format != SAMPLEFORMAT_IEEEFP;
    bool palette = plain && l.photometric == PHOTOMETRIC_PALETTE && l.map[0] &&
                   (l.bits == 1 || l.bits == 2 || l.bits == 4 || l.bits == 8);
    bool grey = plain && l.photometric == PHOTOMETRIC_MINISBLACK && l.bits == 16;
    if (!palette && !grey)
        return read_converted(lib, f, &l, t, size, e);
    return (!palette || read_palette(&l, t, e)) &&
           texels_allocate(t, l.width, l.height, 1, grey ? TEXEL_U16 : TEXEL_U8, size,
                           1e6, e) &&
           read_rows(lib, f, &l, t, e);
}

bool tiff_texels(struct texels *t, const uint8_t *data, size_t size, struct codec_error e)
{
    struct libtiff lib;
    if (!load(&lib, e.text, e.size))
        return false;
    struct job job = {data, (tmsize_t)size, 0, e, false};
    lib.TIFFSetErrorHandler(NULL);
    lib.TIFFSetWarningHandler(NULL);
    lib.TIFFSetErrorHandlerExt(on_error);
    codec_fail(e, "it is damaged");
    // "m": nothing is mapped, all goes through the functions.
    TIFF *f = lib.TIFFClientOpen("file", "rm", &job, on_read, on_write, on_seek, on_close,
                                 on_size, NULL, NULL);
    bool ok = f && read_opened(&lib, f, t, size, e) && !job.failed;
    if (f)
        lib.TIFFClose(f);
    return ok;
}
