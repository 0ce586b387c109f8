// Every pattern at eight points: the bits must be those of one point after the other, with
// every instruction set that the machine has.

#include "random.h"
#include "test.h"

#include <stdlib.h>

#include "scene/density_grid.h"
#include "scene/noise.h"
#include "scene/noise_kernel.h"
#include "scene/pattern.h"
#include "scene/pigment_tape.h"
#include "scene/texture.h"

// Mostly near the origin, some close together, some on lattice planes, some far off.
static void random_points(double p[3][8], unsigned turn)
{
    static const double size[] = {1, 5, 100, 1e6, 1e17};
    const double s = size[turn % 5], spread = turn % 3 ? 0.2 : 2 * s;
    for (int a = 0; a < 3; a++) {
        const double middle = s * (2 * random_unit() - 1);
        for (int i = 0; i < 8; i++) {
            p[a][i] = middle + spread * (random_unit() - 0.5);
            if (turn % 7 == 0 && i % 2)
                p[a][i] = floor(p[a][i]) - (i == 3 ? 5e-11 : 0);
        }
    }
}

static struct vec3 lane(const double v[3][8], int i)
{
    return vec3(v[0][i], v[1][i], v[2][i]);
}

static bool same_bits(double a, double b) { return memcmp(&a, &b, sizeof a) == 0; }

#define SAME(a, b, what)                                                                 \
    do {                                                                                 \
        const double got_ = (a), want_ = (b);                                            \
        if (!same_bits(got_, want_) && !(isnan(got_) && isnan(want_)))                   \
            fail_msg("%s (%s): %.17g, one by one %.17g", what, k->name, got_, want_);    \
    } while (0)

typedef void check_function(const struct noise_kernels *k);

static void with_all_kernels(check_function *check)
{
    static const char *const names[] = {"base", "avx2", "avx512"};
    unsigned run = 0;
    for (int i = 0; i < 3; i++) {
        const struct noise_kernels *k = noise_kernels_find(names[i]);
        if (k) {
            assert_string_equal(k->name, names[i]);
            check(k);
            run++;
        }
    }
    assert_true(run >= 1);
    assert_null(noise_kernels_find("none"));
}

static void check_noise(const struct noise_kernels *k)
{
    for (unsigned turn = 0; turn < 2000; turn++) {
        double p[3][8], v[8], d[3][8];
        const double scale = turn % 2 ? 1 : 0.01 + 20 * random_unit();
        const int generator = 1 + (int)(turn / 2 % 3);
        random_points(p, turn);
        if (turn % 11 == 0)
            p[turn % 3][turn % 8] = turn % 2 ? -0.0 : 1e300;
        k->value((const double(*)[8])p, scale, generator, v);
        k->vector((const double(*)[8])p, scale, d);
        for (int i = 0; i < 8; i++) {
            const struct vec3 at = vec3_scale(scale, lane((const double(*)[8])p, i));
            const struct vec3 w = noise_vector(at);
            SAME(v[i], noise_value(at, generator), "noise");
            SAME(d[0][i], w.x, "vector noise x");
            SAME(d[1][i], w.y, "vector noise y");
            SAME(d[2][i], w.z, "vector noise z");
        }
    }
}

static void noise(void **state)
{
    (void)state;
    with_all_kernels(check_noise);
}

static double halved(const void *data, struct vec3 p)
{
    (void)data;
    return 0.5 * (p.x + p.y);
}

// Patterns that need data of a scene; by value alone, and tested by the scenes.
static bool needs_data(const struct pattern_ops *ops)
{
    static const char *const names[] = {"object", "pigment_pattern", "image_pattern",
                                        "tiling", "pavement"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (strcmp(ops->keyword, names[i]) == 0) {
            assert_null(ops->values);
            return true;
        }
    return false;
}

// Variants of the parameters that patterns read.
static struct pattern variant(const struct pattern_ops *ops, unsigned turn)
{
    static const struct turbulence moved = {{0.6, 0.4, 0.9}, 4, 2.2f, 0.6f};
    static const struct warp stretch = {.kind = WARP_REPEAT, .repeat = {1.5, 0, 0}};
    static const struct warp turbulent = {.kind = WARP_TURBULENCE,
                                          .next = &stretch,
                                          .turbulence = {{0.3, 0.2, 0.1}, 5, 2, 0.5f}};
    static const struct vec3 form[] = {{1, 0, 0}, {-1, 1, 0}, {0.2, -0.3, 0.4}};
    struct pattern p = {0};
    pattern_set_kind(&p, ops);
    p.noise_generator = 1 + (int)(turn % 3);
    p.turbulence = turn / 3 % 2 ? &moved : NULL;
    p.warps = turn / 6 % 3 == 1 ? &turbulent : turn / 6 % 3 == 2 ? &stretch : NULL;
    p.wave = (enum wave)(turn / 18 % 6);
    p.exponent = 1.5f;
    p.phase = turn % 4 ? 0 : 0.3f;
    p.function = halved;
    if (ops == &crackle_pattern_ops) {
        p.vector = form[turn / 2 % 3];
        p.metric = turn % 5 == 0 ? 1 : turn % 23 == 0 ? 3 : turn % 7 == 3 ? 2.2f : 2;
        p.offset = turn % 4 ? 0 : 0.2f;
        p.solid = turn % 7 == 0;
    }
    if (ops == &julia_pattern_ops || ops == &mandel_pattern_ops ||
        ops == &magnet_pattern_ops) {
        p.integer[1] = 1 + (int)(turn / 5 % 2);
        p.integer[2] = (int)(turn / 7 % 2);
        p.integer[0] = (int)(turn % 31);
        p.fractal_exponent = 2 + (int)(turn / 3 % 4);
        p.vector = vec3(0.35, 0.28, 0);
        p.exterior_type = (int)(turn % 10);
        p.interior_type = (int)(turn / 2 % 8);
        p.exterior_factor = 3.5;
        p.interior_factor = 0.7;
    }
    if (ops == &density_file_pattern_ops) {
        static uint8_t file[6 + 240] = {0, 3, 0, 4, 0, 5};
        static struct density_grid grid[3];
        for (size_t i = 6; i < sizeof file; i++)
            file[i] = (uint8_t)(i * i * 37 + i);
        struct density_grid *g = &grid[turn / 4 % 3];
        assert_true(density_grid_init(g, file, 6 + (60u << turn / 4 % 3)));
        p.density = turn % 16 == 15 ? NULL : g;
        p.integer[0] = (int)(turn % 4 == 3 ? 1 : turn % 4);
    }
    return p;
}

static void check_pattern(const struct noise_kernels *k, const struct pattern_ops *ops)
{
    const struct surface_kernels *surface = surface_kernels_find(k->name);
    assert_string_equal(surface->name, k->name);
    for (unsigned turn = 0; turn < 240; turn++) {
        const struct pattern p = variant(ops, turn);
        double at[3][8], normal[3][8], ray[3][8], q[3][8], v[8];
        random_points(at, turn);
        random_points(normal, 0);
        random_points(ray, 0);
        for (int i = 0; i < 24 && ops == &density_file_pattern_ops && turn % 8 < 6; i++)
            at[i / 8][i % 8] = random_unit();
        const struct pattern_packet packet = {(const double(*)[8])at,
                                              (const double(*)[8])normal,
                                              (const double(*)[8])ray, NULL};
        memcpy(q, at, sizeof q);
        surface->warp(&p, q);
        surface->values(&p, &packet, (const double(*)[8])q, 255, v);
        for (int i = 0; i < 8; i++) {
            const struct vec3 place = lane((const double(*)[8])at, i);
            const struct pattern_context c = {.p_world = place,
                                              .normal =
                                                  lane((const double(*)[8])normal, i),
                                              .ray_d = lane((const double(*)[8])ray, i)};
            SAME(v[i], pattern_value(&p, place, &c), ops->keyword);
        }
        if (!ops->perturbs)
            continue;
        assert_non_null(ops->perturb);
        double n[3][8];
        memcpy(n, normal, sizeof n);
        ops->perturbs(&p, k, 0.7f, (const double(*)[8])q, n);
        for (int i = 0; i < 8; i++) {
            const struct vec3 one =
                ops->perturb(&p, 0.7f, lane((const double(*)[8])normal, i),
                             lane((const double(*)[8])q, i));
            SAME(n[0][i], one.x, ops->keyword);
            SAME(n[1][i], one.y, ops->keyword);
            SAME(n[2][i], one.z, ops->keyword);
        }
    }
}

static void check_patterns(const struct noise_kernels *k)
{
    unsigned in_lanes = 0;
    for (size_t i = 0; i < pattern_count; i++) {
        if (needs_data(pattern_table[i]))
            continue;
        in_lanes += pattern_table[i]->values != NULL;
        check_pattern(k, pattern_table[i]);
    }
    assert_true(in_lanes >= 10);
}

static void patterns(void **state)
{
    (void)state;
    with_all_kernels(check_patterns);
}

// Points near the rim of the Mandelbrot set's cardioid and of its largest disc: lanes know
// them not to escape, one point iterates.
static void check_mandel_rims(const struct noise_kernels *k)
{
    struct pattern p = {0};
    pattern_set_kind(&p, &mandel_pattern_ops);
    p.integer[0] = 5000;
    p.interior_factor = 0.7;
    for (unsigned turn = 0; turn < 60; turn++) {
        double at[3][8] = {{0}}, v[8];
        const double inside = turn % 6 ? pow(10, -(double)(turn % 6) - 1) : -1e-3;
        for (int i = 0; i < 8; i++) {
            const double angle = 6.3 * random_unit(), r = 1 - inside;
            const double x = r * cos(angle), y = r * sin(angle);
            const bool disc = turn % 2;
            at[0][i] = disc ? x / 4 - 1 : x / 2 - (x * x - y * y) / 4;
            at[1][i] = disc ? y / 4 : y / 2 - x * y / 2;
        }
        p.ops->values(&p, k, (const double(*)[8])at, v);
        for (int i = 0; i < 8; i++) {
            const struct pattern_context c = {.p_world = {0}};
            SAME(v[i], p.ops->value(&p, lane((const double(*)[8])at, i), &c), "mandel");
            assert_true(inside < 0 || v[i] == p.interior_factor);
        }
    }
}

static void mandel_rims(void **state)
{
    (void)state;
    with_all_kernels(check_mandel_rims);
}

// The nearest points by all cells, without bounds.
static void crackle_searches_enough(void **state)
{
    (void)state;
    for (unsigned turn = 0; turn < 300; turn++) {
        double p[3][8], best[3] = {INFINITY, INFINITY, INFINITY};
        random_points(p, turn % 5 < 3 ? turn : turn - 3);
        const struct vec3 at = lane((const double(*)[8])p, 0);
        const struct vec3 c =
            vec3(floor(at.x - 1e-10), floor(at.y - 1e-10), floor(at.z - 1e-10));
        for (int i = -2; i <= 2; i++)
            for (int j = -2; j <= 2; j++)
                for (int m = -2; m <= 2; m++) {
                    if ((abs(i) == 2) + (abs(j) == 2) + (abs(m) == 2) > 1)
                        continue;
                    const struct vec3 e =
                        vec3_sub(noise_cell_point(c.x + i, c.y + j, c.z + m), at);
                    double sum = e.x * e.x + e.y * e.y + e.z * e.z;
                    for (int s = 0; s < 3; s++)
                        if (sum < best[s]) {
                            const double t = best[s];
                            best[s] = sum;
                            sum = t;
                        }
                }
        for (int s = 0; s < 3; s++) {
            struct pattern pattern = {0};
            pattern_set_kind(&pattern, &crackle_pattern_ops);
            pattern.vector = vec3(s == 0, s == 1, s == 2);
            const double want = fmin(1, sqrt(best[s]));
            const double got = crackle_pattern_ops.value(&pattern, at, NULL);
            if (!same_bits(got, want))
                fail_msg("distance %d: %.17g, all cells say %.17g", s, got, want);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(noise),
        cmocka_unit_test(patterns),
        cmocka_unit_test(mandel_rims),
        cmocka_unit_test(crackle_searches_enough),
    };
    return cmocka_run_group_tests_name("pattern_packets", tests, NULL, NULL);
}
