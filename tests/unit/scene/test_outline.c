// Pieces of outlines and lines: the roots lie on the line, and eight lines have the same bits.
#include "test.h"

#include "base/arena.h"
#include "scene/shapes/outline.h"
#include "scene/shapes/outline_lanes.h"

static double unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return (double)(*s >> 11) * 0x1p-53;
}

// Half of them on a coarse grid, so that tangents and lines run along each other and axes.
static double coordinate(uint64_t *s)
{
    const double x = 4 * unit(s) - 2;
    return unit(s) < .5 ? floor(x) : x;
}

static struct vec2 point(uint64_t *s)
{
    const double u = coordinate(s), v = coordinate(s);
    return (struct vec2){u, v};
}

static void check(const struct outline_segment *s, double k[8][3])
{
    struct line8 line;
    struct outline_roots8 r;
    double at[3][8], norm[8], w[OUTLINE_ROOTS], in_lane[OUTLINE_ROOTS][8] = {{0}};
    for (int l = 0; l < 8; l++) {
        for (int i = 0; i < 3; i++)
            at[i][l] = k[l][i];
        norm[l] = sqrt(k[l][0] * k[l][0] + k[l][1] * k[l][1]);
    }
    for (int i = 0; i < 3; i++)
        line.k[i] = r8_load(at[i]);
    line.norm = r8_load(norm);
    outline_roots8(s, &line, 255, &r);
    for (int i = 0; i < OUTLINE_ROOTS; i++)
        if (r.met[i])
            r8_store(in_lane[i], r.w[i]);
    for (int l = 0; l < 8; l++) {
        const int n = outline_roots(s, k[l], w);
        int m = 0;
        for (int i = 0; i < OUTLINE_ROOTS; i++)
            if (r.met[i] >> l & 1) {
                assert_true(m < n && w[m] == in_lane[i][l]);
                m++;
            }
        assert_int_equal(m, n);
        for (int i = 0; i < n; i++) {
            const struct vec2 p = outline_point(s, w[i]);
            assert_true(fabs(k[l][0] * p.u + k[l][1] * p.v + k[l][2]) < 1e-13);
            assert_true(i == 0 || w[i - 1] <= w[i]);
        }
    }
}

static void random_pieces(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    uint64_t seed = 5;
    for (int n = 0; n < 4000; n++) {
        struct outline o;
        double k[8][3];
        outline_init(&o, a);
        const struct vec2 p[4] = {point(&seed), point(&seed), point(&seed), point(&seed)};
        if (n % 3 == 0)
            outline_line(&o, p[0], p[1]);
        else if (n % 3 == 1)
            outline_parabola(&o, p[0], p[1], p[2]);
        else
            outline_cubic(&o, p[0], p[1], p[2], p[3]);
        for (int l = 0; l < 8; l++) {
            const struct vec2 on = point(&seed), d = point(&seed);
            k[l][0] = d.v;
            k[l][1] = -d.u;
            k[l][2] = d.u * on.v - d.v * on.u;
        }
        if (o.count)
            check(&o.segment[0], k);
    }
    arena_free(a);
}

// The line along u meets v = w^2 where the tangent's coefficient is -0.
static void a_tangent_along_the_line(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 12);
    struct outline o;
    outline_init(&o, a);
    outline_parabola(&o, (struct vec2){1, 0}, (struct vec2){0, 0}, (struct vec2){0, 1});
    double k[8][3], w[OUTLINE_ROOTS];
    for (int l = 0; l < 8; l++) {
        k[l][0] = 0;
        k[l][1] = l % 2 ? 1 : -1;
        k[l][2] = -0.25 * k[l][1];
    }
    check(&o.segment[0], k);
    assert_int_equal(outline_roots(&o.segment[0], k[0], w), 1);
    assert_true(w[0] == 0.5);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_pieces),
        cmocka_unit_test(a_tangent_along_the_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
