#include "test.h"

#include <stdbool.h>

#include "math/polynomial.h"

// Coefficients of scale * product of (t - r_i).
static void from_roots(const double *r, int n, double scale, double *c)
{
    memset(c, 0, (size_t)(n + 1) * sizeof *c);
    c[0] = scale;
    for (int k = 0; k < n; k++)
        for (int i = k + 1; i >= 0; i--)
            c[i] = (i > 0 ? c[i - 1] : 0) - r[k] * c[i];
}

struct row {
    int n;
    double root[6];
    int found;
    double want[6];
};

static const struct row rows[] = {
    {1, {0.5}, 1, {0.5}},
    {2, {-1, 3}, 2, {-1, 3}},
    {2, {2, 2}, 0, {0}}, // touches from above: no change of sign
    {3, {1, 1, 3}, 1, {3}},
    {3, {1, 1, 1}, 1, {1}},
    {4, {-1, 3, 3, 8}, 2, {-1, 8}}, // T13: the touch at 3 is no crossing
    {4, {2, 2, 2, 2}, 0, {0}},      // T14
    {4, {1, 1, 1, 3}, 2, {1, 3}},   // T14
    {4, {3.75, 4.25, 5.75, 6.25}, 4, {3.75, 4.25, 5.75, 6.25}}, // T16
    {6, {-3, -2, -1, 1, 2, 3}, 6, {-3, -2, -1, 1, 2, 3}},
};

static void known_roots_at_every_scale(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-12, 1e150, -1e-150};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
        for (size_t s = 0; s < 4; s++) {
            double c[8];
            struct polynomial_root got[6];
            from_roots(rows[i].root, rows[i].n, scales[s], c);
            int n = polynomial_roots(c, rows[i].n, -100, 100, 0, got);
            assert_int_equal(n, rows[i].found);
            for (int k = 0; k < n; k++) {
                // A root of multiplicity m is known to the m-th root of the rounding.
                double tolerance = rows[i].n - n >= 2 ? 1e-4 : 1e-12;
                assert_near(got[k].t, rows[i].want[k], tolerance);
                if (k)
                    assert_int_equal(got[k].rising, !got[k - 1].rising);
            }
        }
}

static void dt_bounds_the_error(void **state)
{
    (void)state;
    for (int k = 3; k <= 14; k++) { // two roots that close in on each other
        double gap = pow(10, -k / 2.), r[4] = {1, 1 + gap, -2, 5}, c[8];
        struct polynomial_root got[4];
        from_roots(r, 4, 1, c);
        int n = polynomial_roots(c, 4, -100, 100, 10, got);
        if (n < 4)
            continue;
        assert_true(fabs(got[1].t - 1) <= got[1].dt + 1e-15);
        assert_true(fabs(got[2].t - (1 + gap)) <= got[2].dt + 1e-15);
    }
}

// Also at a root whose slope and curvature vanish the bound is finite, and it is small.
static void dt_is_finite_at_multiple_roots(void **state)
{
    (void)state;
    static const double triple[] = {1, 1, 1, 3}, at_two[] = {2, 2, 2};
    double c[8];
    struct polynomial_root got[5];
    from_roots(triple, 4, 1, c);
    assert_int_equal(polynomial_roots(c, 4, -100, 100, 10, got), 2);
    assert_true(got[0].dt < 1e-3 && fabs(got[0].t - 1) <= got[0].dt);
    assert_true(got[1].dt < 1e-12 && fabs(got[1].t - 3) <= got[1].dt);
    from_roots(triple, 3, 1, c);
    assert_int_equal(polynomial_roots(c, 3, -100, 100, 10, got), 1);
    assert_true(got[0].dt < 1e-3 && fabs(got[0].t - 1) <= got[0].dt);
    from_roots(at_two, 3, 1, c); // exactly at the root
    assert_int_equal(polynomial_roots(c, 3, 0, 4, 10, got), 1);
    assert_true(got[0].dt < 1e-3);
}

static void bound_holds_all_roots(void **state)
{
    (void)state;
    double r[5] = {-120, 0.001, 3, 77, 120.5}, c[8];
    from_roots(r, 5, 3, c);
    assert_true(polynomial_root_bound(c, 5) >= 120.5);
    assert_true(polynomial_root_bound(c, 5) < 1e4);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_roots_at_every_scale),
        cmocka_unit_test(dt_bounds_the_error),
        cmocka_unit_test(dt_is_finite_at_multiple_roots),
        cmocka_unit_test(bound_holds_all_roots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
