#include "test.h"

#include "eval/internal.h"
#include "scene/pattern.h"

static const struct {
    int number;
    double value, argument[3 + INTERNAL_PARAMETERS_MAX];
} rows[] = {
#define VALUE(number, value, ...) {number, value, {__VA_ARGS__}},
#include "internal_values.def"
#undef VALUE
};

static void check_values(void **state)
{
    (void)state;
    const struct pattern_defaults defaults = {.noise_generator = 2};
    int wrong = 0, seen = 0;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const double *a = rows[i].argument, want = rows[i].value;
        const struct internal_function *f = internal_function(rows[i].number);
        assert_non_null(f);
        double got = f->value(vec3(a[0], a[1], a[2]), a + 3, &defaults);
        seen += rows[i].number == (int)(i ? rows[i - 1].number : -1) ? 0 : 1;
        if (fabs(got - want) <= 2e-13 * (1 + fabs(want)))
            continue;
        print_message("%d %s: got %.15f, want %.15f\n", rows[i].number, f->name, got,
                      want);
        wrong++;
    }
    assert_int_equal(wrong, 0);
    assert_int_equal(seen, 79);
}

static void check_numbers(void **state)
{
    (void)state;
    assert_null(internal_function(79));
    assert_null(internal_function(-1));
    assert_null(internal_function(nan("")));
    assert_int_equal(internal_function(0)->parameters, 5);
    assert_string_equal(internal_function(61.9)->name, "sphere");
    assert_string_equal(internal_function(78)->name, "noise_generator");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_values),
        cmocka_unit_test(check_numbers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
