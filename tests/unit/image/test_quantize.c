// The codes that quantize_row looks up are those of the formula.
#include "test.h"

#include <math.h>
#include <string.h>

#include "image/codec.h"

static uint16_t formula(const struct image_write_options *o, double v)
{
    const double max = (1 << o->bits) - 1;
    if (!(v > 0))
        return 0;
    if (!transfer_equal(o->working, o->transfer))
        v = transfer_encode(o->transfer, transfer_decode(o->working, v));
    return (uint16_t)floor((v < 1 ? v : 1) * max + 0.5);
}

static const struct encoding {
    struct transfer working, transfer;
} encodings[] = {
    {{TRANSFER_NONE, 0}, {TRANSFER_NONE, 0}},
    {{TRANSFER_NONE, 0}, {TRANSFER_SRGB, 0}},
    {{TRANSFER_SRGB, 0}, {TRANSFER_SRGB, 0}},
    {{TRANSFER_SRGB, 0}, {TRANSFER_NONE, 0}},
    {{TRANSFER_NONE, 0}, {TRANSFER_POWER, 2.2}},
    {{TRANSFER_POWER, 2.2}, {TRANSFER_SRGB, 0}},
    {{TRANSFER_POWER, 1.8}, {TRANSFER_POWER, 2.5}},
    {{TRANSFER_NONE, 0}, {TRANSFER_POWER, 0.3}}, // several codes in a bucket
    {{TRANSFER_NONE, 0}, {TRANSFER_POWER, 5}},
};

// About the least number whose code is i.
static double border(const struct image_write_options *o, int i)
{
    const double max = (1 << o->bits) - 1;
    return transfer_encode(o->working, transfer_decode(o->transfer, (i - 0.5) / max));
}

enum { EITHER = 40, WIDTH = 2 * EITHER + 1 };

// Floats on both sides of `about`, each in all three channels.
static void neighbours(struct image *im, double about, const float *alpha)
{
    float low = (float)about;
    for (int i = 0; i < EITHER; i++)
        low = nextafterf(low, -1);
    for (int x = 0; x < im->width; x++) {
        float *p = image_at(im, x, 0);
        p[0] = p[1] = p[2] = low;
        p[3] = alpha ? *alpha : 1;
        low = nextafterf(low, 2);
    }
}

static void check_row(const struct quantizer *q, const struct image *im,
                      const struct image_write_options *o)
{
    uint16_t got[4 * WIDTH];
    quantize_row(q, im, 0, o, got);
    const int channels = quantize_channels(o);
    for (int x = 0; x < im->width; x++) {
        const float *p = image_at(im, x, 0);
        for (int k = 0; k < 3; k++) {
            const double v = o->alpha ? (double)p[k] / (double)p[3] : (double)p[k];
            if (got[channels * x + k] != formula(o, v))
                fail_msg("%d bits, %a: %d instead of %d", o->bits, v,
                         got[channels * x + k], formula(o, v));
        }
    }
}

static void with_all(void (*check)(struct image *im, const struct quantizer *q,
                                   const struct image_write_options *o),
                     bool alpha)
{
    static const int bits[] = {5, 8, 10, 16};
    struct image im;
    assert_true(image_init(&im, WIDTH, 1, 4));
    for (size_t e = 0; e < sizeof encodings / sizeof encodings[0]; e++)
        for (size_t b = 0; b < sizeof bits / sizeof bits[0]; b++) {
            const struct image_write_options o = {.bits = bits[b],
                                                  .alpha = alpha,
                                                  .working = encodings[e].working,
                                                  .transfer = encodings[e].transfer};
            struct quantizer *q = quantizer_new(&o, WIDTH);
            assert_non_null(q);
            check(&im, q, &o);
            quantizer_free(q);
        }
    image_free(&im);
}

// All codes of 8 bits; of more bits some.
static int step(const struct image_write_options *o) { return 1 + (3 << o->bits) / 2048; }

static void floats(struct image *im, const struct quantizer *q,
                   const struct image_write_options *o)
{
    for (int i = 1; i < 1 << o->bits; i += step(o)) {
        neighbours(im, border(o, i), NULL);
        check_row(q, im, o);
    }
}

// Colours divided by their alpha are no floats.
static void quotients(struct image *im, const struct quantizer *q,
                      const struct image_write_options *o)
{
    uint32_t seed = 1;
    for (int i = 1; i < 1 << o->bits; i += step(o)) {
        seed = seed * 1664525 + 1013904223;
        const float alpha = 0.3f + (float)(seed >> 8) * 0x1p-25f;
        if (border(o, i) < 0.99) { // brighter pixels get more alpha
            neighbours(im, border(o, i) * (double)alpha, &alpha);
            check_row(q, im, o);
        }
    }
}

static void strange(struct image *im, const struct quantizer *q,
                    const struct image_write_options *o)
{
    static const float values[] = {-1,    -0.0f, 0,         NAN,       -NAN, INFINITY,
                                   1e30f, 1,     0x1p-149f, 0x1p-126f, 2,    -INFINITY};
    for (int x = 0; x < im->width; x++)
        for (int k = 0; k < 4; k++)
            image_at(im, x, 0)[k] =
                k < 3 ? values[(size_t)(x + k) % (sizeof values / sizeof values[0])] : 1;
    check_row(q, im, o);
}

static void codes_of_floats(void **state)
{
    (void)state;
    with_all(floats, false);
}

static void codes_of_quotients(void **state)
{
    (void)state;
    with_all(quotients, true);
}

static void codes_of_what_is_no_colour(void **state)
{
    (void)state;
    with_all(strange, false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(codes_of_floats),
        cmocka_unit_test(codes_of_quotients),
        cmocka_unit_test(codes_of_what_is_no_colour),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
