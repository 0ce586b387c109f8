// What deflate_zlib packs, libpng unpacks: a picture of one row of grey is the stream of its
// bytes.
#include "test.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "image/codec.h"
#include "image/deflate.h"
#include "image/image.h"

static uint32_t state = 1;

static uint32_t drawn(void) { return (state = state * 1664525 + 1013904223) >> 8; }

static void check(const uint8_t *byte, int count)
{
    static const struct image_write_options o = {
        .type = IMAGE_PNG, .bits = 8, .grey = true, .unmanaged = true};
    struct image im, back;
    char error[256] = "";
    assert_true(image_init(&im, count, 1, 3));
    for (int i = 0; i < 3 * count; i++)
        im.pixel[i] = (float)byte[i / 3] / 255;
    assert_true(image_write(&im, "t_deflate.png", &o, error, sizeof error));
    assert_true(image_read(&back, "t_deflate.png", (struct transfer){TRANSFER_NONE, 0},
                           error, sizeof error));
    assert_int_equal(back.width, count);
    for (int i = 0; i < count; i++)
        assert_int_equal((int)(image_at(&back, i, 0)[0] * 255 + 0.5f), byte[i]);
    image_free(&im);
    image_free(&back);
    unlink("t_deflate.png");
}

enum { COUNT = 150000 }; // of bytes: several blocks

static void short_rows(void **s)
{
    (void)s;
    uint8_t byte[40];
    for (int count = 1; count <= 40; count++)
        for (int kinds = 1; kinds <= 4; kinds++) {
            for (int i = 0; i < count; i++)
                byte[i] = (uint8_t)(drawn() % (uint32_t)kinds);
            check(byte, count);
        }
}

static void noise(void **s)
{
    (void)s;
    static const uint32_t kinds[] = {1, 2, 3, 17, 256};
    uint8_t *byte = malloc(COUNT);
    for (int k = 0; k < 5; k++) {
        for (int i = 0; i < COUNT; i++)
            byte[i] = (uint8_t)(drawn() % kinds[k]);
        check(byte, COUNT);
    }
    free(byte);
}

// Each value half as often as the one before: words would be longer than deflate's.
static void rare_values(void **s)
{
    (void)s;
    uint8_t *byte = malloc(COUNT);
    for (int i = 0; i < COUNT; i++)
        byte[i] = (uint8_t)(9 * __builtin_ctz(drawn() | 1u << 23));
    check(byte, COUNT);
    free(byte);
}

// Matches of all lengths, from as far away as there may be and from further.
static void repeated(void **s)
{
    (void)s;
    uint8_t *byte = malloc(COUNT);
    for (int period = 1; period < 40000; period += period < 300 ? 7 : 3011) {
        for (int i = 0; i < COUNT; i++)
            byte[i] =
                i < period || drawn() % 300 == 0 ? (uint8_t)drawn() : byte[i - period];
        check(byte, COUNT);
    }
    for (int period = 32767; period <= 32770; period++) {
        for (int i = 0; i < COUNT; i++)
            byte[i] = i < period ? (uint8_t)drawn() : byte[i - period];
        check(byte, COUNT);
    }
    free(byte);
}

static void checksums(void **s)
{
    (void)s;
    uint8_t *byte = malloc(COUNT);
    memset(byte, 255, COUNT);
    for (int i = COUNT / 2; i < COUNT; i++)
        byte[i] = (uint8_t)drawn();
    for (size_t count = 1; count <= COUNT; count += count < 9 ? 1 : 14999) {
        uint32_t a = 1, b = 0;
        for (size_t i = 0; i < count; i++) {
            a = (a + byte[i]) % 65521;
            b = (b + a) % 65521;
        }
        size_t size;
        uint8_t *packed = deflate_zlib(byte, count, &size);
        assert_non_null(packed);
        const uint8_t *end = packed + size - 4;
        assert_int_equal((uint32_t)end[0] << 24 | end[1] << 16 | end[2] << 8 | end[3],
                         b << 16 | a);
        free(packed);
    }
    free(byte);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_rows),  cmocka_unit_test(noise),
        cmocka_unit_test(rare_values), cmocka_unit_test(repeated),
        cmocka_unit_test(checksums),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
