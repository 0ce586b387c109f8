// Pictures as the public interface has them.
#include "api/context.h"
#include "api/state.h"
#include "image/texels.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void lambert_image_free(struct lambert_image *image)
{
    if (image)
        image_free(&image->im);
    free(image);
}

int lambert_image_width(const struct lambert_image *image) { return image->im.width; }

int lambert_image_height(const struct lambert_image *image) { return image->im.height; }

int lambert_image_channels(const struct lambert_image *image)
{
    return image->im.channels;
}

const float *lambert_image_pixels(const struct lambert_image *image)
{
    return image->im.pixel;
}

bool lambert_image_can_read(const char *path)
{
    return texels_type_of(path) != IMAGE_UNKNOWN;
}

bool lambert_image_can_write(const char *path)
{
    return image_type_of(path) != IMAGE_UNKNOWN;
}

static enum image_type type_of(const struct lambert_context *ctx, const char *path)
{
    const char *word = lambert_option_text(ctx, "type");
    const enum image_type type = word ? image_type_of_word(word) : image_type_of(path);
    return type == IMAGE_UNKNOWN ? IMAGE_PNG : type;
}

// Grey PNG files have 16 bits unless told (spec/lighting.md 3.4).
static int bits_of(const struct lambert_context *ctx, enum image_type type, bool grey)
{
    int bits = (int)option_number(ctx, "bits");
    if (type == IMAGE_EXR)
        return bits > 16 ? 32 : 16;
    if (type == IMAGE_PNG && grey && !lambert_option_is_set(ctx, "bits"))
        return 16;
    return bits > 16 ? 16 : bits;
}

static enum dither_method dither_of(const struct lambert_context *ctx)
{
    static const char *const words[] = {
        [DITHER_BAYER_2] = "B2", [DITHER_BAYER_3] = "B3",
        [DITHER_BAYER_4] = "B4", [DITHER_NEXT] = "D1",
        [DITHER_HALVES] = "D2",  [DITHER_FLOYD_STEINBERG] = "FS"};
    const char *word = lambert_option_text(ctx, "dither-method");
    if (!option_flag(ctx, "dither"))
        return DITHER_NONE;
    for (int i = DITHER_BAYER_2; i < DITHER_FLOYD_STEINBERG; i++)
        if (strncmp(word, words[i], 2) == 0)
            return (enum dither_method)i;
    return DITHER_FLOYD_STEINBERG;
}

enum lambert_status lambert_image_write(struct lambert_context *ctx,
                                        const struct lambert_image *image,
                                        const char *path)
{
    static const char *const keys[] = {"Software"};
    static const char *const texts[] = {"lambert"};
    enum image_type type = type_of(ctx, path);
    const bool grey = option_flag(ctx, "grey"), light = image_type_is_light(type);
    struct image_write_options o = {
        .type = type,
        .dither = dither_of(ctx),
        .bits = bits_of(ctx, type, grey),
        .alpha = option_flag(ctx, "alpha"),
        .grey = grey && !light,
        .compression = (int)option_number(ctx, "compression"),
        .transfer = option_transfer(ctx, image->unmanaged && light ? "display-gamma"
                                                                   : "file-gamma"),
        .working = image->working,
        .unmanaged = image->unmanaged,
        .metadata = {keys, texts, 1},
    };
    double start = context_seconds();
    bool ok = image_write(&image->im, path, &o, ctx->error, sizeof ctx->error);
    ctx->stats.write_seconds += context_seconds() - start;
    if (ok)
        render_state_remove(ctx);
    return ok ? LAMBERT_OK : LAMBERT_ERROR_OUTPUT;
}

enum lambert_status lambert_image_read(struct lambert_context *ctx, const char *path,
                                       struct lambert_image **out)
{
    *out = NULL;
    struct lambert_image *image = calloc(1, sizeof *image);
    if (!image)
        return context_fail(ctx, LAMBERT_ERROR_MEMORY, "no memory for the picture");
    char error[512];
    // The numbers of an integer file are kept as they are.
    if (!image_read(&image->im, path, (struct transfer){0}, error, sizeof error)) {
        free(image);
        return context_fail(ctx, LAMBERT_ERROR_INPUT, "cannot read '%s': %s", path,
                            error);
    }
    image->unmanaged = !image_type_is_light(image_type_of_file(path));
    *out = image;
    return LAMBERT_OK;
}

static const struct transfer srgb = {TRANSFER_SRGB, 0};

static double shown(const struct lambert_image *image, const float *p, int k)
{
    double v = (double)p[image->im.channels >= 3 ? k : 0];
    if (!image->unmanaged && !transfer_equal(image->working, srgb))
        v = transfer_encode(srgb, transfer_decode(image->working, v));
    return v > 0 ? (v < 1 ? v : 1) : 0;
}

// Black, blue, red, yellow, white: more is brighter. The root spreads small values.
static void heat(float *p, double difference)
{
    double h = 4 * sqrt(difference);
    double ramp[5][3] = {{0, 0, 0}, {0, 0, 0.8}, {0.9, 0, 0}, {1, 0.9, 0}, {1, 1, 1}};
    int i = h < 3 ? (int)h : 3;
    double f = h - i;
    for (int k = 0; k < 3; k++)
        p[k] = (float)((1 - f) * ramp[i][k] + f * ramp[i + 1][k]);
}

static void compare_pixels(const struct lambert_image *a, const struct lambert_image *b,
                           double threshold, struct lambert_difference *out,
                           struct image *map)
{
    double squares = 0;
    for (int y = 0; y < a->im.height; y++) {
        for (int x = 0; x < a->im.width; x++) {
            double most = 0;
            for (int k = 0; k < 3; k++) {
                double d = fabs(shown(a, image_at(&a->im, x, y), k) -
                                shown(b, image_at(&b->im, x, y), k));
                squares += d * d;
                most = d > most ? d : most;
            }
            out->largest = most > out->largest ? most : out->largest;
            out->pixels_off += most > threshold;
            if (map)
                heat(image_at(map, x, y), most);
        }
    }
    out->rmse = sqrt(squares / (3.0 * (double)out->pixels));
    out->psnr = out->rmse > 0 ? -20 * log10(out->rmse) : INFINITY;
}

enum lambert_status lambert_image_compare(struct lambert_context *ctx,
                                          const struct lambert_image *a,
                                          const struct lambert_image *b, double threshold,
                                          struct lambert_difference *out,
                                          struct lambert_image **heat_map)
{
    int width = a->im.width, height = a->im.height;
    *out = (struct lambert_difference){.pixels = (uint64_t)width * (uint64_t)height};
    if (heat_map)
        *heat_map = NULL;
    if (b->im.width != width || b->im.height != height)
        return context_fail(ctx, LAMBERT_ERROR_ARGUMENT,
                            "the pictures have different sizes: %d x %d and %d x %d",
                            width, height, b->im.width, b->im.height);
    struct lambert_image *map = heat_map ? calloc(1, sizeof *map) : NULL;
    if (heat_map && (!map || !image_init(&map->im, width, height, 3))) {
        free(map);
        return context_fail(ctx, LAMBERT_ERROR_MEMORY, "no memory for the picture");
    }
    // 1e-9: the difference of two 8 bit values n/255 must not exceed n/255 by rounding.
    compare_pixels(a, b, threshold + 1e-9, out, map ? &map->im : NULL);
    if (map) {
        map->unmanaged = true;
        *heat_map = map;
    }
    return LAMBERT_OK;
}
