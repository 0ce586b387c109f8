// What include/lambert/lambert.h promises to a program that uses the library.
#include "test.h"

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

#include <lambert/lambert.h>

enum { WIDTH = 16, HEIGHT = 12 };

// White above, a dark ball below the middle.
static const char scene_text[] = "#version 3.7; global_settings { assumed_gamma 1 }\n"
                                 "background { rgb 1 }\n"
                                 "sphere { <0, -20.5, 30>, 20 pigment { rgb 0 } }\n";

static void write_text(const char *path, const char *text)
{
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    assert_true(fputs(text, f) >= 0);
    assert_int_equal(fclose(f), 0);
}

static int in_own_folder(void **state)
{
    static char folder[] = "/tmp/test-api-XXXXXX";
    *state = folder;
    if (!mkdtemp(folder) || chdir(folder) != 0)
        return -1;
    write_text("scene.pov", scene_text);
    return 0;
}

static int clear_folder(void **state)
{
    static const char *const made[] = {"scene.pov", "wrong.pov", "a.png", "small.pov"};
    for (size_t i = 0; i < sizeof made / sizeof *made; i++)
        unlink(made[i]);
    return chdir("/") == 0 ? rmdir(*state) : -1;
}

static struct lambert_context *context_of_size(const char *width, const char *height)
{
    struct lambert_context *ctx = lambert_context_new();
    assert_non_null(ctx);
    assert_int_equal(lambert_option_set(ctx, "width", width), LAMBERT_OK);
    assert_int_equal(lambert_option_set(ctx, "height", height), LAMBERT_OK);
    return ctx;
}

static struct lambert_context *context(void) { return context_of_size("16", "12"); }

static struct lambert_image *picture(struct lambert_context *ctx)
{
    struct lambert_image *im = NULL;
    assert_int_equal(lambert_load_file(ctx, "scene.pov"), LAMBERT_OK);
    assert_int_equal(lambert_render(ctx, &im), LAMBERT_OK);
    assert_non_null(im);
    return im;
}

static void options(void **state)
{
    (void)state;
    struct lambert_context *ctx = lambert_context_new();
    assert_non_null(ctx);
    assert_false(lambert_option_is_set(ctx, "width"));
    const double initial = lambert_option_number(ctx, "width");
    assert_true(initial > 0);
    assert_int_equal(lambert_option_set(ctx, "width", "many"), LAMBERT_ERROR_OPTION);
    assert_true(*lambert_error(ctx));
    assert_int_equal(lambert_option_set(ctx, "widht", "16"), LAMBERT_ERROR_OPTION);
    assert_string_equal(lambert_option_suggest("widht"), "width");
    assert_false(lambert_option_is_set(ctx, "width"));
    assert_true(lambert_option_number(ctx, "width") == initial);
    assert_int_equal(lambert_option_set(ctx, "width", "16"), LAMBERT_OK);
    assert_true(lambert_option_is_set(ctx, "width"));
    assert_true(lambert_option_number(ctx, "width") == 16);
    for (size_t i = 0; i < lambert_option_count(); i++) {
        const struct lambert_option *o = lambert_option_at(i);
        assert_ptr_equal(lambert_option_find(o->name), o);
    }
    lambert_context_free(ctx);
    lambert_context_free(NULL);
}

static void picture_has_rows_from_the_top(void **state)
{
    (void)state;
    struct lambert_context *ctx = context();
    struct lambert_image *im = picture(ctx);
    struct lambert_stats stats;
    lambert_get_stats(ctx, &stats);
    assert_int_equal(stats.pixels, WIDTH * HEIGHT);
    assert_int_equal(stats.objects, 1);
    lambert_context_free(ctx); // images live on
    assert_int_equal(lambert_image_width(im), WIDTH);
    assert_int_equal(lambert_image_height(im), HEIGHT);
    assert_int_equal(lambert_image_channels(im), 3);
    const float *pixel = lambert_image_pixels(im);
    assert_near((double)pixel[0], 1, 0);
    assert_near((double)pixel[(HEIGHT * WIDTH - WIDTH / 2) * 3], 0, 0);
    lambert_image_free(im);
    lambert_image_free(NULL);
}

static void alpha_is_a_fourth_channel(void **state)
{
    (void)state;
    struct lambert_context *ctx = context();
    assert_int_equal(lambert_option_set(ctx, "alpha", "on"), LAMBERT_OK);
    struct lambert_image *im = picture(ctx);
    assert_int_equal(lambert_image_channels(im), 4);
    assert_near((double)lambert_image_pixels(im)[(HEIGHT * WIDTH - WIDTH / 2) * 4 + 3], 1,
                0);
    lambert_image_free(im);
    lambert_context_free(ctx);
}

static void calls_out_of_order_are_told(void **state)
{
    (void)state;
    struct lambert_context *ctx = context();
    struct lambert_image *im = (struct lambert_image *)ctx; // to be set
    assert_int_equal(lambert_render(ctx, &im), LAMBERT_ERROR_ARGUMENT);
    assert_null(im);
    assert_true(*lambert_error(ctx));
    assert_int_equal(lambert_load_file(ctx, "none.pov"), LAMBERT_ERROR_INPUT);
    assert_non_null(strstr(lambert_error(ctx), "none.pov"));
    assert_int_equal(lambert_image_read(ctx, "none.png", &im), LAMBERT_ERROR_INPUT);
    assert_null(im);
    lambert_context_free(ctx);
}

struct told {
    int count, code;
    unsigned line, column;
};

static void tell(void *user, const struct lambert_message *m)
{
    struct told *t = user;
    if (m->kind != LAMBERT_ERROR)
        return;
    t->count++;
    t->code = m->code;
    t->line = m->line;
    t->column = m->column;
    assert_non_null(m->rendered);
}

static void errors_of_scenes_have_a_place(void **state)
{
    (void)state;
    write_text("wrong.pov", "#version 3.7;\nsphere { 0, ball }\n");
    struct lambert_context *ctx = context();
    struct told told = {0};
    lambert_set_message_function(ctx, tell, &told);
    assert_int_equal(lambert_check_file(ctx, "wrong.pov"), LAMBERT_ERROR_SCENE);
    assert_int_equal(told.count, 1);
    assert_true(told.code > 0);
    assert_int_equal(told.line, 2);
    assert_int_equal(told.column, 13);
    struct lambert_stats stats;
    lambert_get_stats(ctx, &stats);
    assert_int_equal(stats.errors, 1);
    // The context is good for the next scene.
    lambert_image_free(picture(ctx));
    lambert_context_free(ctx);
}

static bool stop_at_once(void *user, uint32_t done, uint32_t total)
{
    (void)total;
    *(uint32_t *)user = done;
    return false;
}

static void cancelled_renders_leave_a_picture(void **state)
{
    (void)state;
    struct lambert_context *ctx = context_of_size("64", "64");
    assert_int_equal(lambert_option_set(ctx, "tile-size", "8"), LAMBERT_OK);
    assert_int_equal(lambert_option_set(ctx, "threads", "1"), LAMBERT_OK);
    assert_int_equal(lambert_load_file(ctx, "scene.pov"), LAMBERT_OK);
    uint32_t done = 0;
    lambert_set_progress_function(ctx, stop_at_once, &done);
    struct lambert_image *im = NULL;
    assert_int_equal(lambert_render(ctx, &im), LAMBERT_CANCELLED);
    assert_non_null(im);
    assert_int_equal(done, 1);
    struct lambert_stats stats;
    lambert_get_stats(ctx, &stats);
    assert_true(stats.tiles_done >= 1 && stats.tiles_done < stats.tiles_total);
    lambert_image_free(im);
    lambert_context_free(ctx);
}

static void *render_on_its_own(void *user)
{
    struct lambert_image **im = user;
    struct lambert_context *ctx = lambert_context_new();
    *im = NULL;
    if (ctx && lambert_option_set(ctx, "width", "16") == LAMBERT_OK &&
        lambert_option_set(ctx, "height", "12") == LAMBERT_OK &&
        lambert_load_file(ctx, "scene.pov") == LAMBERT_OK)
        lambert_render(ctx, im);
    lambert_context_free(ctx);
    return NULL;
}

static void contexts_know_nothing_of_each_other(void **state)
{
    (void)state;
    enum { SEVERAL = 4 };
    pthread_t thread[SEVERAL];
    struct lambert_image *im[SEVERAL];
    for (int i = 0; i < SEVERAL; i++)
        assert_int_equal(pthread_create(&thread[i], NULL, render_on_its_own, &im[i]), 0);
    for (int i = 0; i < SEVERAL; i++)
        pthread_join(thread[i], NULL);
    for (int i = 0; i < SEVERAL; i++) {
        assert_non_null(im[i]);
        assert_memory_equal(lambert_image_pixels(im[i]), lambert_image_pixels(im[0]),
                            sizeof(float) * 3 * WIDTH * HEIGHT);
    }
    for (int i = 0; i < SEVERAL; i++)
        lambert_image_free(im[i]);
}

static void pictures_are_written_read_and_compared(void **state)
{
    (void)state;
    assert_true(lambert_image_can_write("a.PNG") && lambert_image_can_read("a.PNG"));
    assert_false(lambert_image_can_write("a.txt") || lambert_image_can_read("a.txt"));
    struct lambert_context *ctx = context(), *other = context_of_size("8", "12");
    struct lambert_image *im = picture(ctx), *narrow = picture(other), *read = NULL;
    assert_int_equal(lambert_image_write(ctx, im, "none/a.png"), LAMBERT_ERROR_OUTPUT);
    assert_int_equal(lambert_image_write(ctx, im, "a.png"), LAMBERT_OK);
    assert_int_equal(lambert_image_read(ctx, "a.png", &read), LAMBERT_OK);
    assert_int_equal(lambert_image_width(read), WIDTH);
    struct lambert_difference d;
    struct lambert_image *heat = NULL;
    assert_int_equal(lambert_image_compare(ctx, im, im, 0, &d, &heat), LAMBERT_OK);
    assert_int_equal(d.pixels, WIDTH * HEIGHT);
    assert_int_equal(d.pixels_off, 0);
    assert_true(isinf(d.psnr));
    assert_int_equal(lambert_image_width(heat), WIDTH);
    assert_int_equal(lambert_image_compare(ctx, im, narrow, 0, &d, NULL),
                     LAMBERT_ERROR_ARGUMENT);
    lambert_image_free(heat);
    lambert_image_free(read);
    lambert_image_free(narrow);
    lambert_image_free(im);
    lambert_context_free(other);
    lambert_context_free(ctx);
}

// Both pictures are even, half of the encoded range apart.
static void differences_have_known_sizes(void **state)
{
    (void)state;
    struct lambert_context *ctx = context_of_size("2", "2");
    struct lambert_image *im[2];
    static const char *const grey[] = {"srgb 0.25", "srgb 0.75"};
    for (int i = 0; i < 2; i++) {
        char text[128];
        snprintf(text, sizeof text,
                 "#version 3.7; global_settings { assumed_gamma 1 } background { %s }",
                 grey[i]);
        write_text("small.pov", text);
        assert_int_equal(lambert_load_file(ctx, "small.pov"), LAMBERT_OK);
        assert_int_equal(lambert_render(ctx, &im[i]), LAMBERT_OK);
    }
    struct lambert_difference d;
    assert_int_equal(lambert_image_compare(ctx, im[0], im[1], 0.4, &d, NULL), LAMBERT_OK);
    assert_int_equal(d.pixels_off, 4);
    assert_near(d.rmse, 0.5, 1e-6);
    assert_near(d.largest, 0.5, 1e-6);
    assert_near(d.psnr, -20 * log10(0.5), 1e-4);
    assert_int_equal(lambert_image_compare(ctx, im[0], im[1], 0.6, &d, NULL), LAMBERT_OK);
    assert_int_equal(d.pixels_off, 0);
    for (int i = 0; i < 2; i++)
        lambert_image_free(im[i]);
    lambert_context_free(ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(options),
        cmocka_unit_test(picture_has_rows_from_the_top),
        cmocka_unit_test(alpha_is_a_fourth_channel),
        cmocka_unit_test(calls_out_of_order_are_told),
        cmocka_unit_test(errors_of_scenes_have_a_place),
        cmocka_unit_test(cancelled_renders_leave_a_picture),
        cmocka_unit_test(contexts_know_nothing_of_each_other),
        cmocka_unit_test(pictures_are_written_read_and_compared),
        cmocka_unit_test(differences_have_known_sizes),
    };
    return cmocka_run_group_tests(tests, in_own_folder, clear_folder);
}
