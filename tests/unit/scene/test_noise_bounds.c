// Bounds of the noise hold over boxes of one to many cells of its lattice, are the same for one
// box and for eight but for roundings, and say something where the box is small.
#include "test.h"

#include "math/interval.h"
#include "scene/noise.h"
#include "scene/noise_kernel.h"
#include "scene/noise_tables.h"

enum { TURNS = 4000 };

static uint64_t random_state;

static double between(double low, double high)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(random_state >> 11) * 0x1p-53;
}

struct boxes {
    double lo[3][8], hi[3][8];
};

// Thin, flat and thick ones, up to four cells long.
static struct boxes some_boxes(void)
{
    struct boxes b;
    for (int l = 0; l < 8; l++) {
        const double size = pow(2, between(-20, 2));
        for (int k = 0; k < 3; k++) {
            b.lo[k][l] = between(-30, 30);
            b.hi[k][l] = b.lo[k][l] + size * (between(0, 1) < 0.5 ? 1 : between(0, 1));
        }
    }
    return b;
}

static void box_of(const struct boxes *b, int l, struct interval box[3])
{
    for (int k = 0; k < 3; k++)
        box[k] = interval(b->lo[k][l], b->hi[k][l]);
}

static struct vec3 point_in(const struct interval box[3])
{
    const double x = between(box[0].lo, box[0].hi), y = between(box[1].lo, box[1].hi);
    return vec3(x, y, between(box[2].lo, box[2].hi));
}

static void check_points(const struct interval box[3], int generator, struct interval v,
                         const struct interval slope[3])
{
    enum { POINTS = 8 };
    for (int i = 0; i < POINTS; i++) {
        const struct vec3 p = point_in(box), q = point_in(box);
        const double a = noise_value(p, generator), b = noise_value(q, generator);
        assert_true(a >= v.lo && a <= v.hi);
        // Between two points it rises by no more than its slopes say.
        const struct interval d[3] = {interval_point(q.x - p.x),
                                      interval_point(q.y - p.y),
                                      interval_point(q.z - p.z)};
        struct interval rise = interval_point(0);
        for (int k = 0; k < 3; k++)
            rise = interval_add(rise, interval_multiply(slope[k], d[k]));
        // Generator 3 adds 1e7 to the coordinates, which rounds them.
        const double slack = generator == NOISE_PERLIN ? 3e-8 : 1e-12;
        assert_true(b - a >= rise.lo - slack && b - a <= rise.hi + slack);
    }
}

static void test_boxes(void **state)
{
    (void)state;
    random_state = 1;
    double small_widths = 0;
    int small = 0;
    for (int turn = 0; turn < TURNS; turn++) {
        const struct boxes b = some_boxes();
        for (int generator = 1; generator <= 3; generator++) {
            struct interval box[3], v, slope[3];
            box_of(&b, turn % 8, box);
            noise_bounds(box, generator, &v, slope);
            check_points(box, generator, v, slope);
            const double most = noise_slope_max(generator);
            for (int k = 0; k < 3; k++)
                assert_true(slope[k].lo >= -most && slope[k].hi <= most);
            const double size = b.hi[0][turn % 8] - b.lo[0][turn % 8];
            if (size < 1e-3 && size > 1e-4) {
                small_widths += interval_width(v) / size;
                small++;
            }
        }
    }
    // The mean slope is about one, and there are two more axes.
    assert_true(small > 100 && small_widths / small < 10);
}

static double gap(struct interval a, double lo, double hi)
{
    return fmax(fabs(a.lo - lo), fabs(a.hi - hi));
}

static void test_eight(void **state)
{
    static const char *const names[] = {"base", "avx2", "avx512"};
    (void)state;
    random_state = 2;
    for (int turn = 0; turn < TURNS; turn++) {
        const struct boxes b = some_boxes();
        const int generator = 1 + turn % 3;
        struct noise_bounds8 first;
        for (int n = 0; n < 3; n++) {
            const struct noise_kernels *kernels = noise_kernels_find(names[n]);
            struct noise_bounds8 got;
            if (!kernels)
                continue;
            kernels->bounds(b.lo, b.hi, generator, &got);
            if (n == 0)
                first = got;
            assert_memory_equal(&got, &first, sizeof got);
        }
        for (int l = 0; l < 8; l++) {
            struct interval box[3], v, slope[3];
            box_of(&b, l, box);
            noise_bounds(box, generator, &v, slope);
            assert_true(gap(v, first.lo[l], first.hi[l]) < 1e-12);
            for (int k = 0; k < 3; k++)
                assert_true(gap(slope[k], first.slope_lo[k][l], first.slope_hi[k][l]) <
                            1e-11);
        }
    }
}

// ---- the steepest slope there can be -----------------------------------------------------

// Between the functions of two corners c + slope . (place - corner) along axis k, at any place of
// the sides: the noise is a mean of four such pairs.
static double steepest(const double *a, const double *b, double half_a, double half_b,
                       int k)
{
    enum { STEPS = 20 };
    double most = 0;
    for (unsigned corner = 0; corner < 16; corner++) {
        double c = half_b - half_a;
        for (unsigned n = 0; n < 2; n++) {
            const int i = (k + 1 + (int)n) % 3;
            c += ((corner >> n & 1) - (double)(corner >> (n + 2) & 1)) * (b[i] - a[i]);
        }
        for (int step = 0; step <= STEPS; step++) {
            const double u = step / (double)STEPS, s = u * u * (3 - 2 * u);
            const double rise = c + b[k] * (u - 1) - a[k] * u;
            most = fmax(most, fabs(6 * u * (1 - u) * rise + a[k] + s * (b[k] - a[k])));
        }
    }
    return most;
}

static void test_steepest(void **state)
{
    enum { ROWS = 256, SKIP = 23 };
    double value = 0, gradient = 0;
    (void)state;
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < ROWS; i++)
            for (int j = 0; j < ROWS; j++) {
                const double *a = noise_value_table + i, *b = noise_value_table + j;
                value = fmax(value, steepest(a + 1, b + 1, 0.5 * a[0], 0.5 * b[0], k));
            }
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < NOISE_GRADIENT_PERIOD; i += 2)
            for (int j = i % SKIP; j < NOISE_GRADIENT_PERIOD; j += SKIP)
                gradient = fmax(gradient,
                                steepest(noise_gradient[i], noise_gradient[j], 0, 0, k));
    const double steepest_of[] = {value, value, gradient};
    for (int generator = 1; generator <= 3; generator++) {
        const double most = noise_slope_max(generator);
        const double slope = noise_range_of(generator).scale * steepest_of[generator - 1];
        assert_true(slope < most && slope > 0.95 * most);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_boxes),
                                       cmocka_unit_test(test_eight),
                                       cmocka_unit_test(test_steepest)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
