// Whole pictures that must not depend on the size or the place of the scene, on threads
// or on tiles, and secondary rays in narrow gaps (the cases of doc/accuracy.md).
#include "test.h"

#include "loaded.h"
#include "scenes.h"

static struct image picture_of(double size, double place)
{
    struct loaded l;
    load(&l, still_life, size, place);
    const struct image picture = render_picture(&l, 1, 32);
    unload(&l);
    return picture;
}

static void assert_same(struct image *a, struct image *b, const char *what)
{
    const int d = picture_difference(a, b);
    if (d > 1)
        fail_msg("%s: a pixel differs by %d of 255", what, d);
}

// T29
static void size_does_not_show(void **state)
{
    (void)state;
    static const double sizes[] = {1e-5, 1e-3, 1e-1, 10, 1e3, 1e5};
    struct image one = picture_of(1, 0);
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char what[32];
        struct image other = picture_of(sizes[i], 0);
        snprintf(what, sizeof what, "size %g", sizes[i]);
        assert_same(&one, &other, what);
        image_free(&other);
    }
    image_free(&one);
}

// T30
static void place_does_not_show(void **state)
{
    (void)state;
    struct image here = picture_of(1, 0), there = picture_of(1, 1e6);
    assert_same(&here, &there, "moved by 1e6");
    image_free(&here);
    image_free(&there);
}

// T32: a sheet that rises from g = .0002 to .002 shadows all of the floor below it, and
// the picture depends on no tile and no thread.
static void narrow_gap_is_dark_in_any_order(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, "%s", rising_sheet);
    static const int tiles[] = {4, 16, 32, 64};
    for (int i = 0; i < 8; i++) {
        struct image picture = render_picture(&l, i % 2 ? 4 : 1, tiles[i / 2]);
        for (int k = 0; k < PICTURE_SIZE * PICTURE_SIZE; k++)
            for (int c = 0; c < 3; c++)
                assert_true(picture.pixel[4 * k + c] == 0);
        image_free(&picture);
    }
    unload(&l);
}

static void order_does_not_show(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, still_life, 1., 0.);
    struct image one = render_picture(&l, 1, 32);
    static const int tiles[] = {4, 16, 64};
    for (int i = 0; i < 3; i++) {
        struct image other = render_picture(&l, 4, tiles[i]);
        assert_memory_equal(one.pixel, other.pixel,
                            4 * PICTURE_SIZE * PICTURE_SIZE * sizeof *one.pixel);
        image_free(&other);
    }
    image_free(&one);
    unload(&l);
}

// T33: through clear glass 7e-5 above it a white plane is seen, at every size.
static void glass_close_to_a_wall_is_clear(void **state)
{
    (void)state;
    static const double sizes[] = {1, 1e-3, 1e3};
    for (int i = 0; i < 3; i++) {
        struct loaded l;
        load(&l, close_glass, sizes[i]);
        struct image picture = render_picture(&l, 1, 32);
        for (int k = 0; k < PICTURE_SIZE * PICTURE_SIZE; k++)
            for (int c = 0; c < 3; c++)
                assert_true(picture.pixel[4 * k + c] > .9f);
        image_free(&picture);
        unload(&l);
    }
}

// T36: shading over a bumpy ball has no pixel that differs from all its neighbours by more
// than `jump` in the same direction.
static void bumps_make_no_speckles(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, "camera { orthographic location <0, 0, -5> right 1.3*x up 1.3*y }\n"
             "light_source { <50, 20, -3>, rgb 1 }\n"
             "sphere { 0, 1 pigment { rgb 1 } normal { bumps .6 scale .4 }\n"
             "  finish { ambient 0 diffuse 1 } }\n");
    struct image p = render_picture(&l, 1, 32);
    const float jump = .15f;
    int dark = 0, lit = 0;
    for (int y = 1; y < PICTURE_SIZE - 1; y++)
        for (int x = 1; x < PICTURE_SIZE - 1; x++) {
            const float v = *image_at(&p, x, y);
            int above = 0, below = 0;
            for (int k = 0; k < 9; k++) {
                const float w = *image_at(&p, x + k % 3 - 1, y + k / 3 - 1);
                above += v > w + jump;
                below += v < w - jump;
            }
            dark += v == 0;
            lit += v > 0;
            assert_true(above < 8 && below < 8);
        }
    assert_true(dark > 200 && lit > 1000); // both sides of the terminator are in sight
    image_free(&p);
    unload(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(size_does_not_show),
        cmocka_unit_test(place_does_not_show),
        cmocka_unit_test(narrow_gap_is_dark_in_any_order),
        cmocka_unit_test(order_does_not_show),
        cmocka_unit_test(glass_close_to_a_wall_is_clear),
        cmocka_unit_test(bumps_make_no_speckles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
