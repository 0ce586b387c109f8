#include "test.h"

#include <stdlib.h>
#include <string.h>
#include <zlib.h>

#include "image/deflate.h"
#include "image/pack.h"

static uint32_t random_bits(uint32_t *state)
{
    *state = *state * 1664525u + 1013904223u;
    return *state >> 8;
}

// zlib gives back what was packed; returns the size of it.
static size_t check(const uint8_t *data, size_t row, size_t pixel, size_t height)
{
    const size_t size = (row + 1) * height;
    size_t packed = 0;
    uint8_t *p = pack_pixels(&(struct pixel_rows){data, row, pixel, height}, &packed);
    uint8_t *back = malloc(size + 1);
    uLongf n = size + 1;
    assert_non_null(p);
    assert_non_null(back);
    const int result = uncompress(back, &n, p, packed);
    if (result != Z_OK || n != size || memcmp(back, data, size) != 0)
        fail_msg("rows of %zu bytes, pixels of %zu, %zu rows: %d, %lu bytes", row, pixel,
                 height, result, n);
    free(back);
    free(p);
    return packed;
}

// Bytes of kind 0 are all alike, of others more and more of their own.
static uint8_t byte_of(int kind, size_t i, uint32_t *state)
{
    switch (kind) {
    case 0: return 0;
    case 1: return (uint8_t)(i / 300);
    case 2: return (uint8_t)(random_bits(state) % 50 == 0);
    case 3: return (uint8_t)(i % 700 * i % 251);
    case 4: return (uint8_t)(random_bits(state) % 3 ? i : random_bits(state));
    default: return (uint8_t)random_bits(state);
    }
}

static void test_all_layouts(void **s)
{
    static const size_t pixels[] = {1, 2, 3, 4, 6, 8}, widths[] = {1, 2, 5, 86, 321};
    static const size_t heights[] = {1, 2, 9, 130};
    (void)s;
    for (size_t p = 0; p < 6; p++)
        for (size_t w = 0; w < 5; w++)
            for (size_t h = 0; h < 4; h++)
                for (int kind = 0; kind < 6; kind++) {
                    const size_t row = pixels[p] * widths[w],
                                 size = (row + 1) * heights[h];
                    uint8_t *data = malloc(size);
                    uint32_t state = (uint32_t)size;
                    assert_non_null(data);
                    for (size_t i = 0; i < size; i++)
                        data[i] = byte_of(kind, i, &state);
                    check(data, row, pixels[p], heights[h]);
                    free(data);
                }
}

// More repeats than a block has room for, and more bytes.
static void test_many_blocks(void **s)
{
    enum { ROW = 3000, HEIGHT = 1500, SIZE = (ROW + 1) * HEIGHT };
    uint8_t *data = calloc(SIZE, 1);
    uint32_t state = 1;
    (void)s;
    assert_non_null(data);
    assert_true(check(data, ROW, 3, HEIGHT) < SIZE / 500);
    for (size_t i = 0; i < SIZE; i++)
        data[i] = (uint8_t)random_bits(&state);
    assert_true(check(data, ROW, 3, HEIGHT) < SIZE + SIZE / 100);
    // What stands just within reach, and just beyond it.
    for (size_t distance = DEFLATE_FARTHEST - 2; distance <= DEFLATE_FARTHEST + 2;
         distance++) {
        memcpy(data + distance, data, 4000);
        check(data, ROW, 3, HEIGHT);
        check(data, DEFLATE_FARTHEST - 1, 1, 20); // rows one reach apart
    }
    free(data);
}

// Counts that grow as Fibonacci's numbers would have codes of more than 15 bits.
static void test_long_codes(void **s)
{
    enum { KINDS = 24, ROW = 75024 };
    uint8_t *data = malloc(ROW + 1);
    uint32_t state = 7;
    size_t n = 0;
    (void)s;
    assert_non_null(data);
    for (size_t kind = 0, a = 1, b = 1; kind < KINDS; kind++) {
        for (size_t i = 0; i < a && n <= ROW; i++)
            data[n++] = (uint8_t)(kind * 10);
        const size_t next = a + b;
        a = b;
        b = next;
    }
    for (; n <= ROW; n++)
        data[n] = 255;
    for (size_t i = ROW; i > 0; i--) {
        const size_t k = random_bits(&state) % (i + 1);
        const uint8_t byte = data[i];
        data[i] = data[k];
        data[k] = byte;
    }
    check(data, ROW, 1, 1);
    check(data, ROW, 4, 1);
    free(data);
}

// Each length and each distance by itself, as one block.
static void check_repeat(size_t length, size_t distance)
{
    const size_t size = distance + length;
    uint8_t *data = malloc(size), *to = malloc(deflate_bound(size, 1) + 16);
    uint8_t *back = malloc(size);
    uint32_t state = (uint32_t)size;
    assert_true(data && to && back);
    for (size_t i = 0; i < size; i++)
        data[i] = i < distance ? (uint8_t)random_bits(&state) : data[i - distance];
    const struct repeat r = {(uint32_t)distance, (uint16_t)length, (uint16_t)distance};
    struct bit_writer out = {.at = to};
    deflate_block(&out, data, &r, 1, 0, true);
    bits_align(&out);
    z_stream z = {.next_in = to, .avail_in = (unsigned)(out.at - to), .next_out = back};
    z.avail_out = (unsigned)size;
    assert_int_equal(inflateInit2(&z, -15), Z_OK);
    assert_int_equal(inflate(&z, Z_FINISH), Z_STREAM_END);
    assert_int_equal(z.total_out, size);
    assert_memory_equal(data, back, size);
    inflateEnd(&z);
    free(data);
    free(to);
    free(back);
}

static void test_repeats(void **s)
{
    (void)s;
    for (size_t length = DEFLATE_SHORTEST; length <= DEFLATE_LONGEST; length++)
        check_repeat(length, 3);
    for (size_t distance = 1; distance <= 40; distance++)
        check_repeat(5, distance);
    for (size_t power = 64; power <= DEFLATE_FARTHEST; power *= 2)
        for (size_t less = 0; less < 3; less++) {
            check_repeat(9, power - less);
            check_repeat(9, power / 4 * 3 + less);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_layouts),
        cmocka_unit_test(test_many_blocks),
        cmocka_unit_test(test_long_codes),
        cmocka_unit_test(test_repeats),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
