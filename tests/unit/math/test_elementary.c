// Every function against the long double library: below one ulp (two for the
// hyperbolic ones), over ordinary, tiny and huge arguments.
#include "test.h"

#include <float.h>
#include <stdbool.h>

#include "math/acos_lanes.h"
#include "math/elementary.h"
#include "math/larger.h"
#include "math/next_float.h"
#include "math/power_lanes.h"

typedef double (*fn)(double);
typedef long double (*reference)(long double);

static double random_unit(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

// Those for single precision: below 2^-35 of the value, over all that shading asks for.
static void single_precision(void **state)
{
    (void)state;
    uint64_t seed = 77;
    for (int i = 0; i < 200000; i++) {
        const double x = i & 1 ? random_unit(&seed) : exp2(60 * random_unit(&seed) - 30);
        const double y = i & 2 ? 2 * random_unit(&seed) : 1000 * random_unit(&seed);
        const long double p = powl(x, y), e = expl(-y);
        if (p > 1e-290L && p < 1e290L)
            assert_true(fabsl(det_pow_single(x, y) / p - 1) < 0x1p-35L);
        if (e > 1e-290L)
            assert_true(fabsl(det_exp_single(-y) / e - 1) < 0x1p-35L);
    }
    assert_true(det_pow_single(0, 2) == 0 && det_pow_single(0, 0) == 1);
    assert_true(det_pow_single(1, 1e9) == 1 && det_pow_single(0.5, 2000) == 0);
    assert_true(isinf(det_pow_single(2, 2000)) && det_exp_single(0) == 1);
    assert_true(det_pow_single(-2, 2) == 4 && det_exp_single(-1000) == 0);
}

static double ulps(double got, long double want)
{
    if (got == (double)want)
        return fabs((double)((long double)got - want)) == 0 ? 0 : 0.5;
    int e;
    frexpl(want, &e);
    long double unit = ldexpl(1, e - 53 < -1074 ? -1074 : e - 53);
    return (double)(fabsl((long double)got - want) / unit);
}

struct row {
    const char *name;
    fn f;
    reference r;
    double lo, hi;
    bool logarithmic; // spread arguments over the exponents
    double bound;
};

static const struct row rows[] = {
    {"sin", det_sin, sinl, -100, 100, false, 0.95},
    {"sin large", det_sin, sinl, 1, 0x1p60, true, 0.95},
    {"sin tiny", det_sin, sinl, 1e-300, 1, true, 0.95},
    {"cos", det_cos, cosl, -100, 100, false, 0.95},
    {"cos large", det_cos, cosl, 1, 0x1p60, true, 0.95},
    {"tan", det_tan, tanl, -100, 100, false, 0.95},
    {"asin", det_asin, asinl, -1, 1, false, 0.95},
    {"asin tiny", det_asin, asinl, 1e-200, 1, true, 0.95},
    {"acos", det_acos, acosl, -1, 1, false, 0.95},
    {"atan", det_atan, atanl, -20, 20, false, 0.95},
    {"atan wide", det_atan, atanl, 1e-300, 1e300, true, 0.95},
    {"exp", det_exp, expl, -700, 700, false, 0.95},
    {"exp small", det_exp, expl, 1e-20, 1, true, 0.95},
    {"log", det_log, logl, 1e-300, 1e300, true, 0.95},
    {"log near 1", det_log, logl, 0.5, 2, false, 0.95},
    {"log10", det_log10, log10l, 1e-300, 1e300, true, 0.95},
    {"sinh", det_sinh, sinhl, -50, 50, false, 2},
    {"sinh small", det_sinh, sinhl, 1e-20, 1, true, 2},
    {"cosh", det_cosh, coshl, -50, 50, false, 2},
    {"tanh", det_tanh, tanhl, -25, 25, false, 2},
    {"tanh small", det_tanh, tanhl, 1e-20, 1, true, 2},
    {"asinh", det_asinh, asinhl, 1e-20, 1e20, true, 2},
    {"acosh", det_acosh, acoshl, 1, 1e10, true, 2},
    {"atanh", det_atanh, atanhl, -1, 1, false, 2},
};

static void against_long_double(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct row *r = &rows[i];
        uint64_t seed = 1;
        for (int n = 0; n < 20000; n++) {
            double u = random_unit(&seed);
            double x = r->logarithmic ? r->lo * exp(u * log(r->hi / r->lo))
                                      : r->lo + u * (r->hi - r->lo);
            double e = ulps(r->f(x), r->r(x));
            if (!(e <= r->bound))
                fail_msg("%s(%a): %.3f ulp", r->name, x, e);
        }
    }
}

static void pow_against_long_double(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int n = 0; n < 100000; n++) {
        double x = exp(40 * random_unit(&seed) - 20), y = 60 * random_unit(&seed) - 30;
        long double want = powl(x, y);
        if (want > DBL_MAX || want < DBL_MIN)
            continue;
        double e = ulps(det_pow(x, y), want);
        if (!(e <= 0.95))
            fail_msg("pow(%a, %a): %.3f ulp", x, y, e);
    }
}

static void atan2_in_all_quadrants(void **state)
{
    (void)state;
    uint64_t seed = 9;
    for (int n = 0; n < 100000; n++) {
        double x = 2 * random_unit(&seed) - 1, y = 2 * random_unit(&seed) - 1;
        double e = ulps(det_atan2(y, x), atan2l(y, x));
        if (!(e <= 0.95))
            fail_msg("atan2(%a, %a): %.3f ulp", y, x, e);
    }
}

static void special_values(void **state)
{
    (void)state;
    assert_true(det_pow(0, 0) == 1 && det_pow(0, 2) == 0 && det_pow(-2, 3) == -8);
    assert_true(det_pow(-2, 2) == 4 && isnan(det_pow(-2, 0.5)));
    assert_true(isinf(det_pow(0, -1)) && det_pow(HUGE_VAL, -1) == 0);
    assert_true(det_pow(2, 1024) == HUGE_VAL && det_pow(2, -1075) == 0);
    assert_true(det_exp(0) == 1 && det_log(1) == 0 && isnan(det_log(-1)));
    assert_true(det_log(0) == -HUGE_VAL && det_exp(1000) == HUGE_VAL);
    assert_true(det_atan2(0, -1) == 3.14159265358979323846 && det_atan2(0, 1) == 0);
    assert_true(det_atan2(1, 0) == 1.57079632679489661923);
    assert_true(det_asin(1) == 1.57079632679489661923 && det_acos(1) == 0);
    assert_true(det_acos(-1) == 3.14159265358979323846);
    assert_true(det_sin(0) == 0 && det_cos(0) == 1 && signbit(det_sin(-0.0)));
    assert_true(isnan(det_sin(HUGE_VAL)) && isnan(det_acos(1.5)));
    assert_near(det_sin(0x1p1000), (double)sinl(0x1p1000L), 1e-16);
}

// Of the whole range, and close to its ends and its middle.
static void acos_in_lanes(void **state)
{
    (void)state;
    uint32_t random = 7;
    for (int i = 0; i < 20000; i++) {
        double x[8], y[8];
        for (int k = 0; k < 8; k++) {
            random = random * 1664525u + 1013904223u;
            const double u = random * 0x1p-31 - 1;
            const double near = ldexp(u, -(int)(random >> 8) % 60);
            x[k] = i % 4 == 0 ? near : i % 4 == 1 ? copysign(1 - fabs(near), u) : u;
        }
        if (i < 3)
            x[0] = i - 1;
        r8_store(y, det_acos8(r8_load(x)));
        for (int k = 0; k < 8; k++) {
            const double want = det_acos(x[k]);
            assert_memory_equal(&want, &y[k], sizeof want);
        }
    }
}

static void assert_same(double got, double want)
{
    if (!(isnan(got) && isnan(want)))
        assert_memory_equal(&want, &got, sizeof want);
}

// Of all sizes, and special values among them.
static double random_argument(uint64_t *seed)
{
    static const double special[] = {
        0,  -0.0,      1,     -1,      2,        -2,        0.5,    3,
        -3, 0x1p-1074, 1e308, -1e-310, HUGE_VAL, -HUGE_VAL, 0x1p60, (double)NAN};
    const double u = 2 * random_unit(seed) - 1, pick = random_unit(seed);
    if (pick < 0.1)
        return special[(int)(160 * pick)];
    if (pick < 0.2)
        return floor(20 * u);
    return pick < 0.6 ? u : pick < 0.8 ? 100 * u : u * exp2(600 * (pick - 0.9));
}

static void powers_in_lanes(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 20000; i++) {
        double x[8], y[8], p[8], e[8], l[8];
        for (int k = 0; k < 8; k++) {
            x[k] = random_argument(&seed);
            y[k] = random_argument(&seed);
            if (i % 2)
                x[k] = fabs(x[k]);
        }
        r8_store(p, det_pow8(r8_load(x), r8_load(y)));
        r8_store(e, det_exp8(r8_load(y)));
        r8_store(l, det_log8(r8_load(x)));
        for (int k = 0; k < 8; k++) {
            assert_same(p[k], det_pow(x[k], y[k]));
            assert_same(e[k], det_exp(y[k]));
            assert_same(l[k], det_log(x[k]));
        }
    }
}

static void assert_neighbours(float f)
{
    const float above = float_above(f), below = float_below(f);
    const float want_above = nextafterf(f, INFINITY),
                want_below = nextafterf(f, -INFINITY);
    assert_memory_equal(&above, &want_above, sizeof above);
    assert_memory_equal(&below, &want_below, sizeof below);
}

static void neighbours_of_floats(void **state)
{
    (void)state;
    const float odd[] = {FLT_TRUE_MIN, FLT_MIN, FLT_MAX, INFINITY, 1, 0x1.fffffep0f};
    uint64_t seed = 5;
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        assert_neighbours(odd[i]);
        assert_neighbours(-odd[i]);
    }
    assert_true(float_above(0) == FLT_TRUE_MIN && float_below(0) == -FLT_TRUE_MIN);
    assert_true(isnan(float_above(NAN)) && isnan(float_below(NAN)));
    for (int i = 0; i < 10000; i++)
        assert_neighbours((float)random_argument(&seed));
}

// As fmax and fmin, but for a NaN that comes second.
static void larger_and_smaller(void **state)
{
    (void)state;
    const double number[] = {0, 1, -1, 0x1p-1074, -DBL_MAX, INFINITY, -INFINITY, NAN};
    enum { COUNT = sizeof number / sizeof *number };
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < COUNT - 1; k++) {
            assert_true(larger(number[i], number[k]) == fmax(number[i], number[k]));
            assert_true(smaller(number[i], number[k]) == fmin(number[i], number[k]));
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_precision),
        cmocka_unit_test(against_long_double),
        cmocka_unit_test(pow_against_long_double),
        cmocka_unit_test(atan2_in_all_quadrants),
        cmocka_unit_test(special_values),
        cmocka_unit_test(acos_in_lanes),
        cmocka_unit_test(powers_in_lanes),
        cmocka_unit_test(neighbours_of_floats),
        cmocka_unit_test(larger_and_smaller),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
