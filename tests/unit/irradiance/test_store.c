// Samples of irradiance are found where they lie, and every instruction set weighs them to
// the bit as the rule does.
#include "test.h"

#include <stdlib.h>

#include "irradiance/store_kernel.h"
#include "trace/packet.h"

enum { SAMPLES = 1000, POINTS = 2000 };

static uint64_t random_state;

static double between(double low, double high)
{
    random_state = random_state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(random_state >> 11) * 0x1p-53;
}

static struct vec3 some_point(double size)
{
    const double x = between(-size, size), y = between(-size, size);
    return vec3(x, y, between(-size, size));
}

static struct vec3 some_normal(void)
{
    // Most are nearly upright, so that samples agree about them.
    const struct vec3 n = some_point(between(0, 1) < 0.2 ? 1 : 0.1);
    return vec3_normalize(vec3_add(n, vec3(0, 1, 0)));
}

static struct cache_sample some_sample(double bound)
{
    struct cache_sample s = {.p = some_point(0.5), .n = some_normal()};
    s.radius = exp(between(-2, 0));
    s.nearest = between(0, 1) < 0.1 ? INFINITY : s.radius * between(0.1, 1);
    s.to = s.nearest < INFINITY ? vec3_normalize(some_point(1)) : vec3(0, 0, 0);
    s.quality = between(0, 1) < 0.2 ? 1 : between(0, 1);
    s.light = rgb((float)between(0, 1), (float)between(0, 1), (float)between(0, 1));
    s.depth = between(0, 1) < 0.5;
    s.reach = s.radius * bound;
    return s;
}

static struct cache_point some_place(const struct cache_sample *s, double bound)
{
    struct cache_point at = {.error_bound = bound * between(0.3, 1),
                             .depth = s->depth,
                             .smooth = between(0, 1) < 0.5,
                             .enough = INFINITY};
    at.p = vec3_add(s->p, some_point(between(0, 1) < 0.1 ? 1e-7 : 0.3 * s->radius));
    at.n = some_normal();
    return at;
}

// Every instruction set that the machine has: packet_kernels_choose takes the one that is
// named, or the best.
static bool isa_present(const char *name)
{
    setenv("LAMBERT_ISA", name, 1);
    const bool present = strcmp(packet_kernels_choose()->name, name) == 0;
    unsetenv("LAMBERT_ISA");
    return present;
}

static const char *const isas[] = {"base", "avx2", "avx512"};

// The same elsewhere, and so much larger.
static struct vec3 moved(struct vec3 p, struct vec3 by, double scale)
{
    return vec3_scale(scale, vec3_add(p, by));
}

// Near and far, tiny and huge, beyond what floats hold.
static void move_both(struct cache_sample *x, struct cache_point *at)
{
    const double scale = exp(between(-120, 120)),
                 far = between(0, 1) < 0.5 ? 0 : exp(between(0, 15));
    const struct vec3 by = some_point(far);
    x->p = moved(x->p, by, scale);
    x->radius *= scale;
    x->nearest *= scale;
    x->reach *= scale;
    at->p = moved(at->p, by, scale);
}

static void test_weight_of_one(void **state)
{
    (void)state;
    for (int k = 0; k < 3; k++) {
        if (!isa_present(isas[k]))
            continue;
        uint32_t heard = 0;
        random_state = 1;
        for (int i = 0; i < POINTS; i++) {
            struct store s;
            const double bound = between(0.1, 2);
            struct cache_sample x = some_sample(bound);
            struct cache_point at = some_place(&x, bound);
            if (i % 2)
                move_both(&x, &at);
            const double want = cache_weight(&x, &at);
            struct cache_mean mean = {0};
            store_init(&s, isas[k]);
            store_add(&s, &x);
            store_mean(&s, &at, &mean);
            assert_true(mean.weight == want);
            assert_true(mean.light[1] == (want > 0 ? want * (double)x.light.g : 0));
            heard += want > 0;
            store_free(&s);
        }
        assert_true(heard > POINTS / 10 && heard < POINTS);
    }
}

// All of many samples are found, and in one order.
static void test_sum_of_many(void **state)
{
    const double bound = 0.8;
    struct cache_sample sample[SAMPLES];
    struct store s[3];
    (void)state;
    random_state = 2;
    for (int i = 0; i < SAMPLES; i++)
        sample[i] = some_sample(bound);
    for (int k = 0; k < 3; k++) {
        store_init(&s[k], isa_present(isas[k]) ? isas[k] : isas[0]);
        for (int i = 0; i < SAMPLES; i++)
            store_add(&s[k], &sample[i]);
    }
    uint32_t crowded = 0;
    for (int i = 0; i < POINTS; i++) {
        struct cache_point at = some_place(&sample[i % SAMPLES], bound);
        struct cache_mean mean[3] = {0};
        double weight = 0;
        uint32_t heard = 0;
        for (int j = 0; j < SAMPLES; j++) {
            const double w =
                sample[j].depth == at.depth ? cache_weight(&sample[j], &at) : 0;
            weight += w;
            heard += w > 0;
        }
        for (int k = 0; k < 3; k++)
            store_mean(&s[k], &at, &mean[k]);
        assert_near(mean[0].weight, weight, SAMPLES * 0x1p-52 * weight);
        assert_memory_equal(&mean[0], &mean[1], sizeof mean[0]);
        assert_memory_equal(&mean[0], &mean[2], sizeof mean[0]);
        crowded += heard > 8;
        if (!(weight > 0))
            continue;
        // Half of it is enough: no more is added than what exceeds it.
        struct cache_mean half = {0};
        at.enough = weight / 2;
        store_mean(&s[0], &at, &half);
        assert_true(half.weight >= at.enough && half.weight <= mean[0].weight);
    }
    assert_true(crowded > POINTS / 20);
    for (int k = 0; k < 3; k++)
        store_free(&s[k]);
}

// Eight points at once, some in one cell, hear what each alone hears.
static void test_eight_points(void **state)
{
    const double bound = 0.8;
    struct store s;
    (void)state;
    for (int k = 0; k < 3; k++) {
        struct cache_sample sample[SAMPLES];
        uint32_t heard = 0;
        struct store_memo memo = {0};
        random_state = 3;
        store_init(&s, isa_present(isas[k]) ? isas[k] : isas[0]);
        for (int i = 0; i < SAMPLES; i++) {
            sample[i] = some_sample(bound);
            store_add(&s, &sample[i]);
        }
        for (int i = 0; i < POINTS; i++) {
            struct cache_points at = {.lanes = (unsigned)between(0, 256)};
            struct cache_means got = {0};
            const struct cache_point first = some_place(&sample[i % SAMPLES], bound);
            const double spread = between(0, 1) < 0.5 ? 0.01 : 0.5;
            at.depth = first.depth;
            at.smooth = first.smooth;
            at.enough = i % 2 ? INFINITY : between(0, 2);
            for (int j = 0; j < 8; j++) {
                const struct vec3 p = vec3_add(first.p, some_point(spread));
                const struct vec3 n = some_normal();
                at.p[0][j] = p.x, at.p[1][j] = p.y, at.p[2][j] = p.z;
                at.n[0][j] = n.x, at.n[1][j] = n.y, at.n[2][j] = n.z;
                at.error_bound[j] = bound * between(0.3, 1);
            }
            store_means(&s, &at, i % 4 ? &memo : NULL, &got);
            for (int j = 0; j < 8; j++) {
                const struct cache_point alone = {
                    vec3(at.p[0][j], at.p[1][j], at.p[2][j]),
                    vec3(at.n[0][j], at.n[1][j], at.n[2][j]),
                    at.error_bound[j],
                    at.depth,
                    at.smooth,
                    at.enough};
                struct cache_mean want = {0};
                if (at.lanes >> j & 1)
                    store_mean(&s, &alone, &want);
                // Past what is enough either may have stopped elsewhere.
                assert_true((got.weight[j] < at.enough) == (want.weight < at.enough));
                if (want.weight >= at.enough)
                    continue;
                assert_true(got.weight[j] == want.weight);
                for (int a = 0; a < 3; a++)
                    assert_true(got.light[a][j] == want.light[a]);
                heard += want.weight > 0;
            }
        }
        assert_true(heard > POINTS);
        store_free(&s);
    }
}

static struct cache_sample plain_sample(struct vec3 p, double reach)
{
    return (struct cache_sample){.p = p,
                                 .n = {0, 1, 0},
                                 .radius = reach,
                                 .reach = reach,
                                 .nearest = INFINITY,
                                 .quality = 1,
                                 .light = {1, 1, 1}};
}

static double weight_at(const struct store *s, struct vec3 p)
{
    const struct cache_point at = {p, {0, 1, 0}, 1, 0, false, INFINITY};
    struct cache_mean mean = {0};
    store_mean(s, &at, &mean);
    return mean.weight;
}

// The same, as eight points ask.
static double weight_by_memo(const struct store *s, struct vec3 p,
                             struct store_memo *memo)
{
    const struct cache_points at = {.p = {{p.x}, {p.y}, {p.z}},
                                    .n = {{0}, {1}, {0}},
                                    .error_bound = {1},
                                    .lanes = 1,
                                    .enough = INFINITY};
    struct cache_means mean = {0};
    store_means(s, &at, memo, &mean);
    return mean.weight[0];
}

// A sample in cells that are known already, when half of the index is used: what a thread
// remembers of a cell stays true.
static void test_memo_when_full(void **state)
{
    struct store s;
    struct store_memo memo = {0};
    (void)state;
    store_init(&s, isas[0]);
    for (int i = 0; i < 16; i++) {
        const struct cache_sample x = plain_sample(vec3(2 * i, 0, 0), 0.3);
        store_add(&s, &x);
    }
    assert_int_equal(s.cell_count, 128);
    assert_int_equal(s.cell_capacity, 2 * s.cell_count);
    const struct vec3 p = vec3(0.1, 0, 0.1);
    const double before = weight_by_memo(&s, p, &memo);
    const struct cache_sample x = plain_sample(vec3(0, 0, 0), 0.3);
    store_add(&s, &x);
    assert_int_equal(s.cell_count, 128);
    assert_true(before > 0 && weight_by_memo(&s, p, &memo) == 2 * before);
    store_free(&s);
}

// Cells so small that their places are no integers, and large ones at the same point.
static void test_far_from_origin(void **state)
{
    struct store s;
    (void)state;
    for (int sign = -1; sign <= 1; sign += 2) {
        const struct vec3 p = vec3(sign * 1e5, sign * 0.3, -sign * 1e5);
        store_init(&s, isas[0]);
        for (int i = -6; i <= 3; i++) {
            const struct cache_sample x = plain_sample(p, pow(10, i));
            store_add(&s, &x);
        }
        assert_near(weight_at(&s, p), 10, 1e-12);
        assert_true(weight_at(&s, vec3_add(p, vec3(0, 0.05, 0))) > 3);
        store_free(&s);
    }
}

// No sample whose normal may count is left out with its side, whatever the two normals.
static void test_sides(void **state)
{
    enum { PAIRS = 200000 };
    uint32_t counted = 0, left_out = 0;
    (void)state;
    random_state = 4;
    for (int i = 0; i < PAIRS; i++) {
        const double bound = exp(between(-2, 1));
        const struct vec3 n = vec3_normalize(some_point(1)),
                          m = vec3_scale(between(0.9991, 1.0009),
                                         vec3_normalize(vec3_add(
                                             n, some_point(bound * between(0, 2.5)))));
        const struct cache_point at = {.n = n, .error_bound = bound};
        const bool listed = cache_sides(n, bound) >> cache_side(m) & 1;
        const bool counts = cache_may_count(at.p, m, 1, &at);
        assert_true(listed || !counts);
        counted += counts;
        left_out += !listed;
    }
    assert_true(counted > PAIRS / 4 && left_out > PAIRS / 100);
}

struct hashed {
    uint32_t hash;
    struct vec3 middle;
};

static int by_hash(const void *a, const void *b)
{
    const struct hashed *p = a, *q = b;
    return (p->hash > q->hash) - (p->hash < q->hash);
}

// Two places whose hashes are the same share a cell; no sample says anything in the other.
static void test_same_hash(void **state)
{
    enum { SIDE = 512, PLACES = SIDE * SIDE };
    struct hashed *all = malloc(PLACES * sizeof *all);
    uint32_t pairs = 0;
    (void)state;
    assert_non_null(all);
    for (int32_t i = 0; i < PLACES; i++) {
        const int32_t place[3] = {i % SIDE * 7919, i / SIDE * 104729,
                                  i % SIDE ^ i / SIDE};
        all[i] = (struct hashed){cache_cell_hash(place, 0, 0),
                                 vec3(place[0] + 0.5, place[1] + 0.5, place[2] + 0.5)};
    }
    qsort(all, PLACES, sizeof *all, by_hash);
    for (uint32_t i = 0; i + 1 < PLACES; i++) {
        if (all[i].hash != all[i + 1].hash)
            continue;
        struct store s;
        store_init(&s, isas[0]);
        for (uint32_t k = 0; k < 2; k++) {
            struct cache_sample x = plain_sample(all[i + k].middle, 0.25);
            x.reach = 0.5; // in 8 cells of size 1
            store_add(&s, &x);
        }
        assert_true(s.cell_count < 16);
        for (uint32_t k = 0; k < 2; k++)
            assert_near(weight_at(&s, all[i + k].middle), 1, 1e-12);
        pairs++;
        store_free(&s);
    }
    assert_true(pairs > 0);
    free(all);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_weight_of_one),   cmocka_unit_test(test_sum_of_many),
        cmocka_unit_test(test_eight_points),    cmocka_unit_test(test_memo_when_full),
        cmocka_unit_test(test_far_from_origin), cmocka_unit_test(test_sides),
        cmocka_unit_test(test_same_hash)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
