#include "test.h"

#include <stdbool.h>

#include "math/polynomial.h"
#include "math/polynomial_lanes.h"

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

static double random_in(uint64_t *seed, double lo, double hi)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return lo + (hi - lo) * ((double)(*seed >> 11) * 0x1p-53);
}

// (t - a)^2 + b, (t - d)^2 + e: roots where b or e are negative; a leading coefficient of any size.
static void random_quartic(uint64_t *seed, double c[5])
{
    const double a = random_in(seed, -5, 5), b = random_in(seed, -1, 3);
    const double d = random_in(seed, -5, 5), e = random_in(seed, -1, 3);
    const double p[3] = {a * a + b, -2 * a, 1}, q[3] = {d * d + e, -2 * d, 1};
    const double size = pow(10, random_in(seed, -6, 3)) * (*seed & 1 << 20 ? 1 : -1);
    for (int i = 0; i < 5; i++)
        c[i] = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            c[i + k] += size * p[i] * q[k];
}

// All roots stay between the narrowed ends, and what has none is nearly always told; the first root
// is the same when a stretch is begun with its half.
static void narrowed_quartics_keep_their_roots(void **state)
{
    (void)state;
    uint64_t seed = 1;
    int without = 0, told = 0;
    for (int n = 0; n < 20000; n++) {
        double c[5][8], from[8], to[8], t[2][8];
        struct real8 v[5], lo = r8_set(-20), hi = r8_set(20);
        for (int l = 0; l < 8; l++) {
            double one[5];
            random_quartic(&seed, one);
            for (int i = 0; i < 5; i++)
                c[i][l] = one[i];
        }
        for (int i = 0; i < 5; i++)
            v[i] = r8_load(c[i]);
        const struct narrowed8 narrowed = quartic8_narrow(v, &lo, &hi);
        r8_store(from, lo);
        r8_store(to, hi);
        const struct real8 sign = r8_copysign(r8_set(1), v[4]);
        const unsigned left = 255 & ~narrowed.none;
        const struct brackets8 all = poly8_isolate(v, 4, lo, hi, sign, left, 0, false,
                                                   NULL),
                               half = poly8_isolate(v, 4, lo, hi, sign, left,
                                                    narrowed.both, false, NULL);
        r8_store(t[0], poly8_refine(v, 4, &all, all.found));
        r8_store(t[1], poly8_refine(v, 4, &half, half.found));
        for (int l = 0; l < 8; l++) {
            const double one[] = {c[0][l], c[1][l], c[2][l], c[3][l], c[4][l]};
            struct polynomial_root root[4];
            const int count = polynomial_roots(one, 4, -20, 20, 0, root);
            without += count == 0;
            told += narrowed.none >> l & 1;
            if (narrowed.none >> l & 1)
                assert_int_equal(count, 0);
            for (int i = 0; i < count; i++)
                assert_true(root[i].t > from[l] && root[i].t < to[l]);
            if ((all.found & half.found) >> l & 1) {
                assert_true(count > 0);
                assert_near(t[0][l], root[0].t, 1e-6);
                assert_near(t[1][l], root[0].t, 1e-6);
            }
        }
        assert_int_equal(all.found & ~half.unsure, half.found & ~all.unsure);
    }
    assert_true(told > 0.99 * without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_roots_at_every_scale),
        cmocka_unit_test(dt_bounds_the_error),
        cmocka_unit_test(dt_is_finite_at_multiple_roots),
        cmocka_unit_test(bound_holds_all_roots),
        cmocka_unit_test(narrowed_quartics_keep_their_roots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
