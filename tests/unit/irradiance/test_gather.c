// How many rays samples of each depth take.
#include "irradiance/gather.h"
#include "scene/effects.h"
#include "test.h"

static uint32_t rays_at(int count, uint32_t depth)
{
    const struct radiosity_settings settings = {.count = count};
    const struct irradiance_cache c = {.settings = &settings};
    return gather_count(&c, depth);
}

// What the scene says at first, half of it at every depth, but no less than five.
static void test_halved(void **state)
{
    (void)state;
    for (int count = 5; count <= 97; count++) {
        assert_int_equal(rays_at(count, 0), count);
        for (uint32_t depth = 1; depth < 40; depth++) {
            const uint32_t half = depth < 31 ? (uint32_t)count >> depth : 0;
            assert_int_equal(rays_at(count, depth), half < 5 ? 5 : half);
        }
    }
    assert_int_equal(rays_at(1, 0), 5);
}

// Deeper samples take no more than their mean needs, the more the more the scene asks for.
static void test_bounded(void **state)
{
    (void)state;
    assert_int_equal(rays_at(1000, 0), 1000);
    assert_int_equal(rays_at(1000, 1), 48);
    assert_int_equal(rays_at(1000, 4), 48);
    assert_int_equal(rays_at(1000, 5), 31);
    assert_int_equal(rays_at(10000, 1), 150);
    assert_int_equal(rays_at(1000000, 2), 1500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_halved),
                                       cmocka_unit_test(test_bounded)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
