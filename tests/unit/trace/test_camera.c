#include "test.h"

#include "scene/camera.h"
#include "trace/lens.h"

// POV-Ray 3.7's colours for the hit point of the ray on a sphere of radius 3 around
// the origin, (p/3.2+1)/2 (linear values, five digits).
struct row {
    int x, y;
    double r, g, b;
};

static void check(const struct camera *c, int w, int h, const struct row *row, int count)
{
    for (int i = 0; i < count; i++) {
        struct ray ray;
        assert_true(camera_ray(c, row[i].x + 0.5, row[i].y + 0.5, w, h, &ray));
        assert_near(vec3_length(ray.d), 1, 1e-14);
        const double b = vec3_dot(ray.o, ray.d), q = vec3_dot(ray.o, ray.o) - 9;
        const struct vec3 p = ray_at(&ray, -b + sqrt(b * b - q));
        assert_near((p.x / 3.2 + 1) / 2, row[i].r, 5e-4);
        assert_near((p.y / 3.2 + 1) / 2, row[i].g, 5e-4);
        assert_near((p.z / 3.2 + 1) / 2, row[i].b, 5e-4);
    }
}

static struct camera simple(enum camera_kind kind, double right, double up, double angle)
{
    struct camera c = camera_default;
    c.kind = kind;
    c.right = vec3(right, 0, 0);
    c.up = vec3(0, up, 0);
    c.angle = angle;
    return c;
}

#define CHECK(c, w, h, ...)                                                              \
    do {                                                                                 \
        static const struct row rows[] = {__VA_ARGS__};                                  \
        check(&(c), w, h, rows, (int)(sizeof rows / sizeof rows[0]));                    \
    } while (0)

static void perspective(void **state)
{
    (void)state;
    CHECK(camera_default, 4, 3, {0, 0, 0.29952, 0.634, 0.90198},
          {3, 0, 0.70048, 0.634, 0.90198}, {0, 2, 0.29952, 0.366, 0.90198},
          {3, 2, 0.70048, 0.366, 0.90198});
}

static void fisheye(void **state)
{
    (void)state;
    const struct camera c = simple(CAMERA_FISHEYE, 1, 1, 180);
    CHECK(c, 5, 5, {2, 0, 0.50001, 0.94581, 0.64485}, {1, 1, 0.24272, 0.75728, 0.79556},
          {2, 2, 0.50001, 0.50001, 0.96875}, {3, 3, 0.75728, 0.24272, 0.79556});
    struct ray ray;
    assert_false(camera_ray(&c, 0.5, 0.5, 5, 5, &ray));
}

static void ultra_wide(void **state)
{
    (void)state;
    const struct camera c = simple(CAMERA_ULTRA_WIDE_ANGLE, 4.0 / 3, 1, 150);
    CHECK(c, 4, 3, {0, 0, 0.15226, 0.7546, 0.68434}, {3, 2, 0.84774, 0.2454, 0.68434});
}

static void omnimax(void **state)
{
    (void)state;
    const struct camera c = simple(CAMERA_OMNIMAX, 4.0 / 3, 1, 90);
    CHECK(c, 8, 6, {2, 0, 0.30951, 0.92548, 0.5491}, {3, 0, 0.4331, 0.94826, 0.61967},
          {4, 0, 0.5669, 0.94826, 0.61967}, {1, 1, 0.16791, 0.81221, 0.60942});
}

static void cylinders(void **state)
{
    (void)state;
    const struct camera one = simple(CAMERA_CYLINDER_1, 4.0 / 3, 1.5, 180);
    CHECK(one, 4, 3, {0, 0, 0.11266, 0.70964, 0.66044},
          {3, 2, 0.88734, 0.29036, 0.66044});
    const struct camera three = simple(CAMERA_CYLINDER_3, 4.0 / 3, 1.5, 180);
    CHECK(three, 4, 3, {0, 0, 0.07298, 0.57812, 0.67688},
          {3, 2, 0.92702, 0.42188, 0.67688});
}

static void spherical(void **state)
{
    (void)state;
    struct camera c = simple(CAMERA_SPHERICAL, 4.0 / 3, 1, 200);
    c.angle_v = 80;
    c.direction = vec3_normalize(vec3(1, 0.3, 1));
    c.right = vec3_scale(4.0 / 3, vec3_normalize(vec3_cross(vec3(0, 1, 0), c.direction)));
    c.up = vec3_normalize(vec3_cross(c.direction, c.right));
    CHECK(c, 4, 3, {0, 0, 0.25801, 0.7283, 0.83023}, {3, 2, 0.89197, 0.3167, 0.31975});
}

// spec/lighting 1.4: after each batch it is asked whether a pixel has had enough.
static void samples_of_a_lens_come_in_batches(void **state)
{
    (void)state;
    static const int want[][10] = {
        {5, 4, 1}, {10, 7, 3}, {20, 7, 6, 6, 1}, {40, 7, 6, 6, 4, 4, 4, 4, 2, 3}};
    for (size_t i = 0; i < sizeof want / sizeof *want; i++) {
        const struct lens lens = {.count = want[i][0]};
        int done = 0;
        for (int k = 1; k < 10 && want[i][k]; k++) {
            assert_int_equal(lens_batch(&lens, done), want[i][k]);
            done += want[i][k];
        }
        assert_int_equal(done, lens.count);
        assert_int_equal(lens_batch(&lens, done), 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(samples_of_a_lens_come_in_batches),
        cmocka_unit_test(perspective),
        cmocka_unit_test(fisheye),
        cmocka_unit_test(ultra_wide),
        cmocka_unit_test(omnimax),
        cmocka_unit_test(cylinders),
        cmocka_unit_test(spherical),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
