// Libraries that are loaded by name, and what is said when they are not there.
#include "test.h"

#include <string.h>

#include "base/library.h"

static const char *const names[] = {"TIFFGetVersion", "TIFFClose"};

struct pointers {
    const char *(*version)(void);
    void (*close)(void *);
};

static void a_missing_library_is_named(void **state)
{
    (void)state;
    struct pointers p = {0};
    char why[256] = "";
    assert_false(library_load("libnosuchthing.so.9", names, 2, &p, why, sizeof why));
    assert_non_null(strstr(why, "libnosuchthing.so.9"));
}

#ifdef TIFF_SONAME
static void functions_are_those_of_the_library(void **state)
{
    (void)state;
    struct pointers p = {0};
    char why[256] = "";
    assert_true(library_load(TIFF_SONAME, names, 2, &p, why, sizeof why));
    assert_non_null(p.close);
    assert_non_null(strstr(p.version(), "LIBTIFF"));
}

static void a_missing_function_is_named(void **state)
{
    (void)state;
    static const char *const wrong[] = {"TIFFGetVersion", "TIFFNoSuchThing"};
    struct pointers p = {0};
    char why[256] = "";
    assert_false(library_load(TIFF_SONAME, wrong, 2, &p, why, sizeof why));
    assert_non_null(strstr(why, "TIFFNoSuchThing"));
}
#endif

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_missing_library_is_named),
#ifdef TIFF_SONAME
        cmocka_unit_test(functions_are_those_of_the_library),
        cmocka_unit_test(a_missing_function_is_named),
#endif
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
