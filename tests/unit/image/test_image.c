#include "test.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "image/codec.h"
#include "image/image.h"

static const struct transfer srgb = {TRANSFER_SRGB, 0};
static const struct transfer none = {TRANSFER_NONE, 0};

// Values a half float holds exactly, some outside 0..1.
static struct image sample(int channels)
{
    struct image im;
    assert_true(image_init(&im, 37, 23, channels));
    for (int y = 0; y < im.height; y++)
        for (int x = 0; x < im.width; x++)
            for (int k = 0; k < channels; k++)
                image_at(&im, x, y)[k] =
                    k == 3 ? 1 : (float)((x * 3 + y * 5 + k * 7) % 80 - 8) / 64;
    return im;
}

static struct image_write_options options(enum image_type type, int bits)
{
    return (struct image_write_options){.type = type, .bits = bits, .transfer = srgb};
}

// The first row.
static void quantize(const struct image *im, const struct image_write_options *o,
                     uint16_t *out)
{
    struct quantizer *q = quantizer_new(o, im->width);
    assert_non_null(q);
    quantize_row(q, im, 0, o, out);
    quantizer_free(q);
}

static void write_file(const struct image *im, const char *path,
                       struct image_write_options o)
{
    char error[256] = "";
    if (!image_write(im, path, &o, error, sizeof error))
        fail_msg("%s", error);
}

static void read_file(struct image *im, const char *path, struct transfer t)
{
    char error[256] = "";
    if (!image_read(im, path, t, error, sizeof error))
        fail_msg("%s", error);
}

static char *contents(const char *path, size_t *n)
{
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    char *text = calloc(1, 1 << 20);
    *n = fread(text, 1, 1 << 20, f);
    fclose(f);
    return text;
}

// spec/lighting.md 3.4: the values POV-Ray writes for these.
static void quantisation_table(void **state)
{
    (void)state;
    static const float linear[] = {.075f, .225f, .375f, .525f,
                                   .675f, .825f, .975f, 1.125f};
    static const unsigned want8[] = {77, 130, 165, 192, 214, 234, 252, 255};
    static const unsigned want16[] = {0x4db4, 0x82fc, 0xa565, 0xc067,
                                      0xd733, 0xeb31, 0xfd29, 0xffff};
    struct image im;
    assert_true(image_init(&im, 8, 1, 3));
    for (int x = 0; x < 8; x++)
        for (int k = 0; k < 3; k++)
            image_at(&im, x, 0)[k] = linear[x];
    uint16_t got[24];
    struct image_write_options o = options(IMAGE_PNG, 8);
    quantize(&im, &o, got);
    for (int x = 0; x < 8; x++)
        assert_int_equal(got[3 * x], want8[x]);
    o.bits = 16;
    quantize(&im, &o, got);
    for (int x = 0; x < 8; x++)
        assert_int_equal(got[3 * x], want16[x]);
    image_free(&im);
}

static void unmanaged_numbers_stay(void **state)
{
    (void)state;
    struct image im;
    assert_true(image_init(&im, 1, 1, 3));
    im.pixel[0] = 0.5f, im.pixel[1] = -1, im.pixel[2] = NAN;
    struct image_write_options o = options(IMAGE_PNG, 8);
    uint16_t got[3];
    o.unmanaged = true;
    quantize(&im, &o, got);
    assert_int_equal(got[0], 128);
    assert_int_equal(got[1], 0);
    assert_int_equal(got[2], 0);
    // A working space equal to the file's encoding changes nothing either.
    o.unmanaged = false;
    o.working = srgb;
    quantize(&im, &o, got);
    assert_int_equal(got[0], 128);
    image_free(&im);
}

static void alpha_rules(void **state)
{
    (void)state;
    static const float pixel[3][4] = {
        {0.25f, 0.25f, 0.25f, 0.5f},  // plain 0.5
        {0.75f, 0.75f, 0.75f, 0.25f}, // brighter than its alpha: alpha rises
        {0, 0, 0, 0},
    };
    static const unsigned want[3][4] = {{128, 128, 128, 128}, {255, 255, 255, 191}, {0}};
    struct image im;
    assert_true(image_init(&im, 3, 1, 4));
    memcpy(im.pixel, pixel, sizeof pixel);
    struct image_write_options o = options(IMAGE_PNG, 8);
    o.alpha = true;
    o.transfer = none;
    uint16_t got[12];
    quantize(&im, &o, got);
    for (int i = 0; i < 12; i++)
        assert_int_equal(got[i], want[i / 4][i % 4]);
    image_free(&im);
}

static void curves_are_inverse(void **state)
{
    (void)state;
    const struct transfer all[] = {srgb, none, {TRANSFER_POWER, 2.2}};
    for (int t = 0; t < 3; t++)
        for (int i = 0; i <= 1000; i++)
            assert_near(transfer_decode(all[t], transfer_encode(all[t], i / 1000.0)),
                        i / 1000.0, 1e-7); // the two sRGB pieces meet that well
    assert_near(transfer_encode(srgb, 0.5), 0.735356983052449, 1e-14);
}

// Packing some pictures saves nothing, by chance: 6 pixels of 32 bits.
static void exr_of_few_pixels(void **state)
{
    (void)state;
    uint32_t s = 1;
    for (int i = 0; i < 400; i++) {
        struct image im, back;
        assert_true(image_init(&im, 6, 1, 3));
        for (int k = 0; k < 18; k++) {
            s = s * 1664525 + 1013904223;
            im.pixel[k] = k % 3 == 1 && k > 3 ? im.pixel[1] : (float)(s >> 8) / (1 << 24);
        }
        write_file(&im, "t_few.exr", options(IMAGE_EXR, 32));
        read_file(&back, "t_few.exr", none);
        assert_memory_equal(im.pixel, back.pixel, 18 * sizeof(float));
        image_free(&im);
        image_free(&back);
    }
    unlink("t_few.exr");
}

static void exr_round_trip(void **state)
{
    (void)state;
    for (int bits = 16; bits <= 32; bits += 16)
        for (int channels = 3; channels <= 4; channels++) {
            struct image im = sample(channels), back;
            struct image_write_options o = options(IMAGE_EXR, bits);
            o.alpha = channels == 4;
            write_file(&im, "t_image.exr", o);
            read_file(&back, "t_image.exr", none);
            assert_int_equal(back.width, im.width);
            assert_int_equal(back.height, im.height);
            assert_int_equal(back.channels, channels);
            assert_memory_equal(back.pixel, im.pixel,
                                sizeof(float) * 37 * 23 * (size_t)channels);
            image_free(&im);
            image_free(&back);
        }
    unlink("t_image.exr");
}

// Files of light hold numbers, and of those what their type can: 65504 is the largest half.
static void light_beyond_numbers(void **state)
{
    (void)state;
    const float wild[6] = {1e6f, -1e30f, NAN, INFINITY, -INFINITY, 3};
    for (int bits = 16; bits <= 32; bits += 16) {
        const float most = bits == 16 ? 65504 : FLT_MAX;
        const float kept[6] = {
            bits == 16 ? most : 1e6f, bits == 16 ? -most : -1e30f, 0, most, -most, 3};
        struct image im, back;
        assert_true(image_init(&im, 2, 1, 3));
        memcpy(im.pixel, wild, sizeof wild);
        write_file(&im, "t_wild.exr", options(IMAGE_EXR, bits));
        read_file(&back, "t_wild.exr", none);
        assert_memory_equal(back.pixel, kept, sizeof kept);
        image_free(&im);
        image_free(&back);
    }
    unlink("t_wild.exr");
}

static void check_integer(enum image_type type, const char *path, int bits, int channels,
                          bool grey, int compression)
{
    struct image im = sample(channels), back;
    struct image_write_options o = options(type, bits);
    const bool alpha = channels == 4 && (type == IMAGE_PNG || !grey);
    o.alpha = channels == 4;
    o.compression = compression;
    o.grey = grey;
    o.transfer = none;
    write_file(&im, path, o);
    read_file(&back, path, none);
    assert_int_equal(back.channels, alpha ? 4 : 3);
    double step = 1.0 / ((1 << bits) - 1);
    for (int y = 0; y < 23; y++)
        for (int x = 0; x < 37; x++) {
            const float *p = image_at(&im, x, y), *q = image_at(&back, x, y);
            double level =
                0.297 * (double)p[0] + 0.589 * (double)p[1] + 0.114 * (double)p[2];
            for (int k = 0; k < 3; k++) {
                double want = grey ? level : (double)p[k];
                want = want < 0 ? 0 : want > 1 ? 1 : want;
                assert_near((double)q[k], want, 0.5 * step + 1e-6);
            }
        }
    image_free(&im);
    image_free(&back);
    unlink(path);
}

static void integer_round_trips(void **state)
{
    (void)state;
    for (int bits = 8; bits <= 16; bits += 8)
        for (int grey = 0; grey < 2; grey++) {
            check_integer(IMAGE_PNG, "t_image.png", bits, 3, grey, 0);
            check_integer(IMAGE_PNG, "t_image.png", bits, 4, grey, 9);
            check_integer(IMAGE_PPM, "t_image.ppm", bits, 3, grey, 0);
        }
    for (int channels = 3; channels <= 4; channels++)
        for (int grey = 0; grey < 2; grey++) {
            check_integer(IMAGE_BMP, "t_image.bmp", 8, channels, grey, 0);
            check_integer(IMAGE_TGA, "t_image.tga", 8, channels, grey, 0);
            check_integer(IMAGE_TGA, "t_image.tga", 8, channels, grey, 1);
        }
}

static void check_runs(const struct image *im, enum image_type type, int bits,
                       const char *path)
{
    struct image back;
    struct image_write_options o = options(type, bits);
    o.transfer = none;
    o.compression = type == IMAGE_TGA;
    write_file(im, path, o);
    read_file(&back, path, none);
    for (int i = 0; i < im->width * im->height * 3; i++)
        assert_near((double)back.pixel[i], (double)im->pixel[i],
                    0.5 / ((1 << bits) - 1) + 1e-6);
    image_free(&back);
    unlink(path);
}

// Rows of every mixture of runs and differences, in widths around the longest run.
static void packed_runs(void **state)
{
    (void)state;
    uint32_t s = 7;
    for (int width = 1; width < 400; width += width < 20 ? 1 : 37) {
        struct image im, back;
        assert_true(image_init(&im, width, 5, 3));
        for (int i = 0; i < width * 5; i++) {
            s = s * 1664525 + 1013904223;
            const bool repeat = i > 0 && s >> 29 < (uint32_t)(i / width) * 2;
            for (int k = 0; k < 3; k++)
                im.pixel[3 * i + k] =
                    repeat ? im.pixel[3 * i + k - 3] : (float)(s >> (8 + k) & 7) / 8;
        }
        check_runs(&im, IMAGE_TGA, 8, "t_runs.tga");
        check_runs(&im, IMAGE_PNG, 8, "t_runs.png");
        check_runs(&im, IMAGE_PNG, 16, "t_runs.png");
        write_file(&im, "t_runs.hdr", options(IMAGE_HDR, 8));
        read_file(&back, "t_runs.hdr", none);
        for (int i = 0; i < width * 5; i++) {
            const float *p = im.pixel + 3 * i;
            const double most = (double)fmaxf(p[0], fmaxf(p[1], p[2]));
            for (int k = 0; k < 3; k++)
                assert_near((double)back.pixel[3 * i + k], (double)p[k], most / 256);
        }
        image_free(&back);
        image_free(&im);
    }
    unlink("t_runs.hdr");
}

// Light far outside of 0..1 keeps its size; what is no light is none.
static void hdr_extremes(void **state)
{
    (void)state;
    const float in[] = {1e30f, 1e-30f, 3e5f, -1, NAN, 0, 1e-38f, 0, 0, 0.5f, 0.5f, 0.5f};
    struct image im, back;
    assert_true(image_init(&im, 4, 1, 3));
    memcpy(im.pixel, in, sizeof in);
    write_file(&im, "t_image.hdr", options(IMAGE_HDR, 8));
    read_file(&back, "t_image.hdr", none);
    assert_near((double)back.pixel[0], 1e30, 1e30 / 256);
    assert_near((double)back.pixel[9], 0.5, 0.5 / 256);
    for (int i = 1; i < 9; i++)
        assert_near((double)back.pixel[i], 0, i < 3 ? 1e30 / 256 : 1e-37);
    image_free(&im);
    image_free(&back);
    unlink("t_image.hdr");
}

// JPEG loses something: little at the usual quality, more at a low one.
static void jpeg_quality(void **state)
{
    (void)state;
    struct image im = sample(3), back;
    double error[2] = {0};
    for (int i = 0; i < 2; i++) {
        struct image_write_options o = options(IMAGE_JPEG, 8);
        o.compression = i ? 20 : 0;
        o.transfer = none;
        write_file(&im, "t_image.jpg", o);
        read_file(&back, "t_image.jpg", none);
        assert_int_equal(back.width, im.width);
        for (int k = 0; k < im.width * im.height * 3; k++) {
            const double d = (double)back.pixel[k] - fmax((double)im.pixel[k], 0);
            error[i] += d * d / (im.width * im.height * 3);
        }
        image_free(&back);
    }
    assert_true(sqrt(error[0]) < 0.03);
    assert_true(error[1] > 4 * error[0]);
    image_free(&im);
    unlink("t_image.jpg");
}

static void same_picture_same_bytes(void **state)
{
    (void)state;
    static const enum image_type types[] = {IMAGE_PNG, IMAGE_EXR, IMAGE_PPM, IMAGE_JPEG,
                                            IMAGE_TGA, IMAGE_BMP, IMAGE_HDR};
    static const char *const key[] = {"Software"}, *const text[] = {"lambert"};
    struct image im = sample(4);
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        struct image_write_options o = options(types[i], 8);
        o.alpha = true;
        o.metadata = (struct image_metadata){key, text, 1};
        size_t n[2];
        char *bytes[2];
        for (int k = 0; k < 2; k++) {
            write_file(&im, "t_same", o);
            bytes[k] = contents("t_same", &n[k]);
        }
        assert_int_equal(n[0], n[1]);
        assert_memory_equal(bytes[0], bytes[1], n[0]);
        free(bytes[0]);
        free(bytes[1]);
    }
    image_free(&im);
    unlink("t_same");
}

// A folder that takes no new file: the old picture stays. Root may write anywhere, so
// the failure is a folder in the way of the file.
static void old_file_survives_failure(void **state)
{
    (void)state;
    struct image im = sample(3);
    char error[256] = "";
    struct image_write_options o = options(IMAGE_PNG, 8);
    assert_false(image_write(&im, "no-such-folder/t.png", &o, error, sizeof error));
    assert_non_null(strstr(error, "no-such-folder/t.png"));
    write_file(&im, "t_old.png", o);
    size_t before, after;
    char *old = contents("t_old.png", &before);
    o.type = IMAGE_UNKNOWN;
    assert_false(image_write(&im, "t_old.png", &o, error, sizeof error));
    char *now = contents("t_old.png", &after);
    assert_int_equal(before, after);
    assert_memory_equal(old, now, before);
    free(old);
    free(now);
    image_free(&im);
    unlink("t_old.png");
}

static void damaged_files_are_refused(void **state)
{
    (void)state;
    static const enum image_type types[] = {IMAGE_PNG, IMAGE_EXR, IMAGE_PPM, IMAGE_JPEG,
                                            IMAGE_TGA, IMAGE_BMP, IMAGE_HDR};
    struct image im = sample(3), back;
    char error[256];
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        if (types[i] == IMAGE_TGA)
            continue; // its type is in its name only; see packed_runs
        size_t n;
        write_file(&im, "t_cut", options(types[i], 8));
        char *bytes = contents("t_cut", &n);
        FILE *f = fopen("t_cut", "wb");
        fwrite(bytes, 1, n / 2, f);
        fclose(f);
        free(bytes);
        error[0] = 0;
        assert_false(image_read(&back, "t_cut", none, error, sizeof error));
        assert_true(error[0]);
        assert_null(back.pixel);
    }
    image_free(&im);
    unlink("t_cut");
    assert_false(image_read(&back, "t_none", none, error, sizeof error));
}

static void types_by_name(void **state)
{
    (void)state;
    assert_int_equal(image_type_of("a.png"), IMAGE_PNG);
    assert_int_equal(image_type_of("dir.exr/a.EXR"), IMAGE_EXR);
    assert_int_equal(image_type_of("a.ppm"), IMAGE_PPM);
    assert_int_equal(image_type_of("a.jpeg"), IMAGE_JPEG);
    assert_int_equal(image_type_of("a.Tga"), IMAGE_TGA);
    assert_int_equal(image_type_of("a.tiff"), IMAGE_UNKNOWN);
    assert_int_equal(image_type_of("a.jp"), IMAGE_UNKNOWN);
    assert_string_equal(image_type_word_of_letter('c'), "tga");
    assert_null(image_type_word_of_letter('x'));
    assert_int_equal(image_type_of_word("bmp"), IMAGE_BMP);
    assert_int_equal(image_type_of_word("gif"), IMAGE_UNKNOWN);
    assert_true(image_type_is_light(IMAGE_HDR) && !image_type_is_light(IMAGE_TGA));
    assert_int_equal(image_type_of("png"), IMAGE_UNKNOWN);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quantisation_table),
        cmocka_unit_test(unmanaged_numbers_stay),
        cmocka_unit_test(alpha_rules),
        cmocka_unit_test(curves_are_inverse),
        cmocka_unit_test(exr_round_trip),
        cmocka_unit_test(exr_of_few_pixels),
        cmocka_unit_test(light_beyond_numbers),
        cmocka_unit_test(integer_round_trips),
        cmocka_unit_test(packed_runs),
        cmocka_unit_test(hdr_extremes),
        cmocka_unit_test(jpeg_quality),
        cmocka_unit_test(same_picture_same_bytes),
        cmocka_unit_test(old_file_survives_failure),
        cmocka_unit_test(damaged_files_are_refused),
        cmocka_unit_test(types_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
