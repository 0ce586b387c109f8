#include "test.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "image/texels.h"

static const struct transfer none = {TRANSFER_NONE, 0};

static void path_of(char *out, size_t n, const char *name)
{
    snprintf(out, n, "%s/tests/data/images/%s", getenv("top_srcdir"), name);
}

static void load(struct texels *t, const char *name)
{
    char path[1024], error[256] = "";
    path_of(path, sizeof path, name);
    if (!texels_read(t, path, IMAGE_UNKNOWN, error, sizeof error))
        fail_msg("%s: %s", name, error);
}

struct color {
    double c[3], transmit;
};

// Colours as an image_map shows them: not premultiplied.
static struct color color_of(const struct texels *t, int x, int y)
{
    struct color o = {.transmit = 0};
    if (t->indexed) {
        const uint8_t *p = t->palette[texels_index(t, x, y)];
        for (int k = 0; k < 3; k++)
            o.c[k] = p[k] / 255.0;
        o.transmit = 1 - p[3] / 255.0;
        return o;
    }
    const bool color = t->channels >= 3, alpha = t->channels == 2 || t->channels == 4;
    double a = alpha ? (double)texels_sample(t, x, y, t->channels - 1, none) : 1;
    for (int k = 0; k < 3; k++) {
        double v = (double)texels_sample(t, x, y, color ? k : 0, none);
        o.c[k] = t->premultiplied && a > 0 ? v / a : v;
    }
    o.transmit = 1 - a;
    return o;
}

// Every texel of every file as POV-Ray 3.7 gives it, and the heights of height fields.
static void files_have_the_known_texels(void **state)
{
    (void)state;
    char path[1024], line[512], last[64] = "", name[64];
    struct texels t = {.type = IMAGE_UNKNOWN};
    path_of(path, sizeof path, "texels.tsv");
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    int rows = 0;
    while (fgets(line, sizeof line, f)) {
        int x, y;
        double c[4], height;
        if (line[0] == '#')
            continue;
        assert_int_equal(sscanf(line, "%63s %d %d %lf %lf %lf %lf %lf", name, &x, &y,
                                &c[0], &c[1], &c[2], &c[3], &height),
                         8);
        if (strcmp(name, last) != 0) {
            texels_free(&t);
            load(&t, name);
            strcpy(last, name);
        }
        rows++;
        // 16-bit grey TIFF files keep all their bits here, 8 of them there.
        bool deep = t.type == IMAGE_TIFF && t.format == TEXEL_U16;
        const double slack = deep ? 1 / 255.0 : 2e-7;
        struct color mine = color_of(&t, x, y);
        for (int k = 0; k < 3; k++)
            if (fabs(mine.c[k] - c[k]) > slack * fmax(1, fabs(c[k])))
                fail_msg("%s %d,%d channel %d: %.9f, not %.9f", name, x, y, k, mine.c[k],
                         c[k]);
        if (fabs(mine.transmit - c[3]) > slack)
            fail_msg("%s %d,%d transmit: %.9f, not %.9f", name, x, y, mine.transmit,
                     c[3]);
        double h = texels_height(&t, x, y, none);
        if (height >= 0 && fabs(h - height) > (deep ? 257 : 0.01))
            fail_msg("%s %d,%d height: %.3f, not %.3f", name, x, y, h, height);
    }
    texels_free(&t);
    fclose(f);
    assert_true(rows > 800);
}

static void raw_values_are_kept(void **state)
{
    (void)state;
    struct texels t;
    load(&t, "rgb16.png");
    assert_int_equal(t.format, TEXEL_U16);
    assert_int_equal((int)texels_raw(&t, 1, 0, 0), 257 * 48 - 3);
    assert_int_equal(texels_size(&t), 5 * 4 * 3 * 2);
    texels_free(&t);
    load(&t, "palette4.png");
    assert_true(t.indexed);
    for (int i = 0; i < 20; i++)
        assert_int_equal(texels_index(&t, i % 5, i / 5), (3 * i + 1) % 5);
    assert_int_equal(t.palette_count, 5);
    texels_free(&t);
    load(&t, "grey1000.pgm");
    assert_int_equal((int)texels_raw(&t, 0, 0, 0), 17 * 1000 / 255);
    texels_free(&t);
    load(&t, "grey16.tif");
    assert_int_equal((int)texels_raw(&t, 1, 0, 0), 257 * 70 - 3);
    texels_free(&t);
    load(&t, "rgb8-gama.png");
    assert_true(t.has_encoding && t.encoding.kind == TRANSFER_POWER);
    assert_true(fabs(t.encoding.gamma - 1.8) < 1e-4);
    texels_free(&t);
}

// Files that POV-Ray does not read, or reads wrongly (1-bit BMP).
static void own_kinds(void **state)
{
    (void)state;
    static const char *const palettes[] = {"palette.iff", "palette-packed.iff"};
    static const char *const bits[] = {"bits.pbm", "bits4.pbm"};
    struct texels t;
    for (int f = 0; f < 2; f++) {
        load(&t, palettes[f]);
        for (int i = 0; i < 20; i++)
            assert_int_equal(texels_index(&t, i % 5, i / 5), (3 * i + 1) % 5);
        assert_int_equal(t.palette[1][1], 200);
        texels_free(&t);
        load(&t, bits[f]);
        for (int i = 0; i < 20; i++)
            assert_int_equal((int)texels_raw(&t, i % 5, i / 5, 0),
                             (3 * i + 1) % 5 % 2 ? 0 : 255);
        texels_free(&t);
    }
    load(&t, "bits.bmp");
    for (int i = 0; i < 20; i++)
        assert_int_equal(texels_index(&t, i % 5, i / 5), (3 * i + 1) % 5 % 2);
    texels_free(&t);
    load(&t, "palette4.tif");
    for (int i = 0; i < 20; i++)
        assert_int_equal(texels_index(&t, i % 5, i / 5), (3 * i + 1) % 5);
    texels_free(&t);
    static const char *const colors[] = {"rgb24.iff", "rgb24-top.bmp"};
    for (int f = 0; f < 2; f++) {
        load(&t, colors[f]);
        for (int i = 0; i < 20; i++)
            assert_int_equal((int)texels_raw(&t, i % 5, i / 5, 1), (91 * i + 30) % 256);
        texels_free(&t);
    }
    // Texel 4k takes a palette colour, the next ones change blue, red, green.
    load(&t, "ham6.iff");
    assert_int_equal(t.channels, 3);
    assert_int_equal((int)texels_raw(&t, 4, 0, 1), 240); // index 13 % 5
    assert_int_equal((int)texels_raw(&t, 1, 0, 2), 5 * 17);
    assert_int_equal((int)texels_raw(&t, 2, 0, 0), 10 * 17);
    assert_int_equal((int)texels_raw(&t, 3, 0, 1), 15 * 17);
    texels_free(&t);
}

static int scaled(int v, int bits)
{
    return ((v >> (8 - bits)) * 255 + (1 << bits) / 2 - 1) / ((1 << bits) - 1);
}

// Red, green, blue and alpha of texel i, of so many bits.
static void has_fields(const char *name, const int bits[4])
{
    struct texels t;
    load(&t, name);
    assert_int_equal(t.channels, bits[3] ? 4 : 3);
    for (int i = 0; i < 20; i++) {
        const int value[4] = {(37 * i + 11) % 256, (91 * i + 30) % 256,
                              (151 * i + 200) % 256, (67 * i + 40) % 256};
        for (int k = 0; k < t.channels; k++)
            if ((int)texels_raw(&t, i % 5, i / 5, k) != scaled(value[k], bits[k]))
                fail_msg("%s, texel %d, channel %d: %d, not %d", name, i, k,
                         (int)texels_raw(&t, i % 5, i / 5, k), scaled(value[k], bits[k]));
    }
    texels_free(&t);
}

static void fields_of_bmp(void **state)
{
    (void)state;
    has_fields("rgb555.bmp", (const int[4]){5, 5, 5, 0});
    has_fields("rgb565.bmp", (const int[4]){5, 6, 5, 0});
    has_fields("argb4444.bmp", (const int[4]){4, 4, 4, 4});
    has_fields("xbgr32.bmp", (const int[4]){8, 8, 8, 0});
}

static void interlaced_gif(void **state)
{
    (void)state;
    struct texels t;
    load(&t, "palette-interlaced.gif");
    assert_true(t.indexed);
    for (int i = 0; i < 20; i++)
        assert_int_equal(texels_index(&t, i % 5, i / 5), (3 * i + 1) % 5);
    texels_free(&t);
}

static void near(double got, double want)
{
    if (!(fabs(got - want) <= 1e-5 * fmax(1, fabs(want))))
        fail_msg("%.9g, not %.9g", got, want);
}

static void tiled_exr(void **state)
{
    (void)state;
    struct texels t;
    load(&t, "tiled.exr");
    assert_int_equal(t.channels, 4);
    for (int i = 0; i < 20; i++) {
        near(texels_raw(&t, i % 5, i / 5, 0), (37 * i + 11) % 256 / 256.);
        near(texels_raw(&t, i % 5, i / 5, 1), (91 * i + 30) % 256 / 256.);
        near(texels_raw(&t, i % 5, i / 5, 2), (151 * i + 200) % 256 / 256.);
        near(texels_raw(&t, i % 5, i / 5, 3), (67 * i + 40) % 256 / 256.);
    }
    texels_free(&t);
}

// RY = (R - Y)/Y is 0.25 x + 0.5 y where there are samples, BY = (B - Y)/Y is -0.25
// everywhere; Y is that of Rec. ITU-R BT.709.
static void luminance_and_differences(void **state)
{
    (void)state;
    struct texels t;
    load(&t, "luma.exr");
    assert_int_equal(t.channels, 3);
    for (int i = 0; i < 16; i++) {
        const int x = i % 4, y = i / 4;
        const double luma = (i + 1) / 32., r = texels_raw(&t, x, y, 0),
                     g = texels_raw(&t, x, y, 1), b = texels_raw(&t, x, y, 2);
        near(b, 0.75 * luma);
        if (fabs(0.2126 * r + 0.7152 * g + 0.0722 * b - luma) > 2e-4)
            fail_msg("texel %d has luminance %.6f, not %.6f", i,
                     0.2126 * r + 0.7152 * g + 0.0722 * b, luma);
        if (x % 2 == 0 && y % 2 == 0)
            near(r, (0.25 * x + 0.5 * y + 1) * luma);
    }
    texels_free(&t);
}

// Colours far from their neighbours' are made paler, as the format's own reader does; it
// rounds to 11 bits on the way.
static void lone_colours_are_made_paler(void **state)
{
    (void)state;
    char path[1024], line[256];
    struct texels t;
    load(&t, "saturated.exr");
    path_of(path, sizeof path, "saturated.tsv");
    FILE *f = fopen(path, "r");
    assert_non_null(f);
    int rows = 0;
    while (fgets(line, sizeof line, f)) {
        int x, y;
        double want[3];
        if (line[0] == '#')
            continue;
        assert_int_equal(
            sscanf(line, "%d %d %lf %lf %lf", &x, &y, &want[0], &want[1], &want[2]), 5);
        for (int k = 0; k < 3; k++)
            if (fabs(texels_raw(&t, x, y, k) - want[k]) > 2e-3)
                fail_msg("%d,%d channel %d: %.6f, not %.6f", x, y, k,
                         texels_raw(&t, x, y, k), want[k]);
        rows++;
    }
    fclose(f);
    texels_free(&t);
    assert_int_equal(rows, 120);
}

// Adobe's inks are inverted: pure cyan on the left, half magenta under a quarter of black
// on the right.
static void inks_of_jpeg(void **state)
{
    (void)state;
    static const int want[2][3] = {{0, 255, 255}, {191, 95, 191}};
    struct texels t;
    load(&t, "cmyk.jpg");
    assert_int_equal(t.channels, 3);
    for (int side = 0; side < 2; side++)
        for (int k = 0; k < 3; k++)
            assert_in_range((int)texels_raw(&t, 8 * side + 3, 4, k) + 3,
                            want[side][k] + 1, want[side][k] + 5);
    texels_free(&t);
}

static const struct {
    const char *text;
    size_t size;
    const char *message;
} bad[] = {
    {"", 0, "no image"},
    {"hello", 5, "no image"},
    {"P6\n50000 50000\n255\n", 19, "claims 50000 x 50000"},
    {"P6\n3 3\n255\nabc", 14, "ends too early"},
    {"P5\n2 2\n0\nabcd", 13, "header"},
    {"P5\n99999999999 2\n255\nabcd", 25, "header"},
    {"BM....", 6, "header"},
    {"GIF89a\x05\0\x04\0\0\0\0;", 14, "no picture"},
    {"GIF89a\xff\xff\xff\xff\x80\0\0\1\2\3\4\5\6,\0\0\0\0\xff\xff\xff\xff\0\x02\0;", 32,
     "claims 65535 x 65535"},
    {"FORM\0\0\0\x04ILBM", 12, "no picture"},
    {"#?RADIANCE\n\n-Y 60000 +X 60000\n", 30, "claims 60000 x 60000"},
    {"#?RADIANCE\n\n-Y 2 +X 2\n\1\1\1\1", 26, "damaged"},
    {"\x89PNG\r\n\x1a\n", 8, "early"},
    {"\xff\xd8\xff\xe0", 4, "JPEG"},
    {"II*\0\x08\0\0\0", 8, ""},
};

static void bad_files_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        char error[256] = "";
        struct texels t;
        if (texels_decode(&t, (const uint8_t *)bad[i].text, bad[i].size, IMAGE_UNKNOWN,
                          error, sizeof error))
            fail_msg("case %zu was read", i);
        if (!error[0] || !strstr(error, bad[i].message))
            fail_msg("case %zu says '%s'", i, error);
        assert_null(t.data);
    }
}

// A file of each type with the sizes in its header replaced by the largest that fit: more
// texels than it can hold, mostly more than 2^31.
static const struct huge {
    const char *name;
    const char *mark; // what stands before the sizes
    size_t mark_size;
    size_t at[2]; // width and height after the beginning of the mark
    int bytes;
    bool big_endian;
} huge[] = {
    {"rgb8.png", "IHDR", 4, {4, 8}, 4, true},
    {"grey8.tif", "II*", 3, {18, 30}, 4, false},
    {"rgb24.bmp", "BM", 2, {18, 22}, 4, false},
    {"rgb24.tga", "\0\0\2", 3, {12, 14}, 2, false},
    {"rgb24.iff", "BMHD", 4, {8, 10}, 2, true},
    {"photo.jpg", "\xff\xc0", 2, {7, 5}, 2, true},
    {"photo.exr", "dataWindow\0box2i", 16, {29, 33}, 4, false},
    {"tiled.exr", "dataWindow\0box2i", 16, {29, 33}, 4, false},
};

static void put_most(uint8_t *p, int bytes, bool big_endian)
{
    memset(p, 0xff, (size_t)bytes);
    if (bytes == 4) // signed in some
        p[big_endian ? 0 : 3] = 0x7f;
}

// The checksum of a PNG's chunk (ISO/IEC 15948, annex D).
static void seal_png(uint8_t *type, size_t size)
{
    uint32_t c = 0xffffffffu;
    for (size_t i = 0; i < size; i++) {
        c ^= type[i];
        for (int k = 0; k < 8; k++)
            c = c & 1 ? 0xedb88320u ^ c >> 1 : c >> 1;
    }
    for (int i = 0; i < 4; i++)
        type[size + (size_t)i] = (uint8_t)(~c >> (24 - 8 * i));
}

static void huge_pictures_are_refused(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof huge / sizeof huge[0]; i++) {
        const struct huge *h = &huge[i];
        static uint8_t data[8192];
        char path[1024], error[256] = "";
        path_of(path, sizeof path, h->name);
        FILE *f = fopen(path, "rb");
        assert_non_null(f);
        const size_t size = fread(data, 1, sizeof data, f);
        fclose(f);
        uint8_t *mark = data;
        while (mark < data + size && memcmp(mark, h->mark, h->mark_size) != 0)
            mark++;
        assert_true(mark + 64 < data + size || h->bytes == 2);
        put_most(mark + h->at[0], h->bytes, h->big_endian);
        put_most(mark + h->at[1], h->bytes, h->big_endian);
        if (strcmp(h->mark, "IHDR") == 0)
            seal_png(mark, 17);
        struct texels t;
        if (texels_decode(&t, data, size, IMAGE_TGA, error, sizeof error))
            fail_msg("%s with huge sizes was read", h->name);
        assert_null(t.data);
        if (!error[0] || strstr(error, "memory"))
            fail_msg("%s says '%s'", h->name, error);
        print_message("%s: %s\n", h->name, error);
    }
}

// Cut anywhere, a file is either refused or (cut behind its last texel) the same.
static void truncated_files_are_refused(void **state)
{
    (void)state;
    static const char *const names[] = {
        "rgb8.png",     "palette.gif",  "rgb24-rle.tga",
        "rgb16.ppm",    "palette8.bmp", "palette-rle8.bmp",
        "rgb24.iff",    "plain.hdr",    "packed.hdr",
        "palette8.tif", "photo.jpg",    "photo.exr",
        "tiled.exr",    "luma.exr",     "saturated.exr",
        "cmyk.jpg",     "rgb565.bmp",   "palette-interlaced.gif"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char path[1024], error[256] = "";
        path_of(path, sizeof path, names[i]);
        FILE *f = fopen(path, "rb");
        assert_non_null(f);
        static uint8_t data[8192];
        size_t size = fread(data, 1, sizeof data, f);
        fclose(f);
        struct texels whole, t;
        load(&whole, names[i]);
        int refused = 0;
        for (size_t n = 0; n < size; n++) {
            if (!texels_decode(&t, data, n, IMAGE_TGA, error, sizeof error)) {
                refused++;
                continue;
            }
            assert_int_equal(texels_size(&t), texels_size(&whole));
            if (memcmp(t.data, whole.data, texels_size(&t) - 4 * (size_t)t.palette_count))
                fail_msg("%s: another picture when cut after %zu bytes", names[i], n);
            texels_free(&t);
        }
        assert_true(refused > (int)size / 2);
        texels_free(&whole);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_have_the_known_texels),
        cmocka_unit_test(raw_values_are_kept),
        cmocka_unit_test(own_kinds),
        cmocka_unit_test(fields_of_bmp),
        cmocka_unit_test(interlaced_gif),
        cmocka_unit_test(tiled_exr),
        cmocka_unit_test(luminance_and_differences),
        cmocka_unit_test(inks_of_jpeg),
        cmocka_unit_test(lone_colours_are_made_paler),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(huge_pictures_are_refused),
        cmocka_unit_test(truncated_files_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
