#include "test.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/diag.h"

static void closest_word(void **state)
{
    (void)state;
    static const char *const words[] = {"pigment", "finish", "normal", "rotate"};
    assert_string_equal(diag_closest("pigmnt", 6, words, 4), "pigment");
    assert_string_equal(diag_closest("rotte", 5, words, 4), "rotate");
    assert_null(diag_closest("zebra", 5, words, 4));
}

struct printed {
    char *text;
    size_t len;
};

static void text_style_underlines_the_place(void **state)
{
    (void)state;
    struct arena *a = arena_new(1024);
    struct source_map map;
    source_map_init(&map, a);
    const char *text = "sphere {\n  0, oops\n}\n";
    uint32_t file = source_add(&map, "a.scn", text, strlen(text), (struct span){0});
    struct diag d = {DIAG_NOT_BUILT,    SEV_ERROR,
                     {file, 14, 18, 0}, {0},
                     "no such word",    "did you mean 'open'?"};
    struct printed p = {0};
    FILE *out = open_memstream(&p.text, &p.len);
    diag_print(out, &map, &d, DIAG_TEXT, false);
    fclose(out);
    assert_string_equal(p.text, "a.scn:2:6: error: no such word [E0900]\n"
                                "    2 |   0, oops\n"
                                "      |      ^~~~ did you mean 'open'?\n");
    free(p.text);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closest_word),
        cmocka_unit_test(text_style_underlines_the_place),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
