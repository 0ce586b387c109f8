// The search for the nearest photons against all photons one by one, and the same photons in
// the same order with every instruction set there is.
#include "test.h"

#include <stdlib.h>
#include <string.h>

#include "trace/packet.h"
#include "trace/photon_map.h"

static uint64_t state;

static double chance(void)
{
    state = state * 6364136223846793005u + 1442695040888963407u;
    return (double)(state >> 11) * 0x1p-53;
}

static struct vec3 somewhere(void)
{
    const double x = chance(), y = chance();
    return vec3(x, y, chance());
}

// Photons in a few clusters about a place; on a grid many are equally far.
static void fill(struct photon_map *m, uint32_t count, bool grid, struct vec3 about)
{
    *m = (struct photon_map){0};
    for (uint32_t i = 0; i < count; i++) {
        struct vec3 p = somewhere();
        if (i % 3)
            p = vec3_scale(i % 3 == 1 ? .1 : .01, p);
        struct photon x = {.p = {(float)p.x, (float)p.y, (float)p.z}};
        for (int a = 0; grid && a < 3; a++)
            x.p[a] = (float)(int)(16 * x.p[a]) / 16;
        x.p[0] += (float)about.x, x.p[1] += (float)about.y, x.p[2] += (float)about.z;
        photon_add(m, &x);
    }
}

static double measured(const struct photon *x, struct vec3 p, struct vec3 n)
{
    const struct vec3 d = vec3_sub(vec3(x->p[0], x->p[1], x->p[2]), p);
    return vec3_dot(d, d) * (1 + 16 * fabs(vec3_dot(d, n)));
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

// The distances of what was found are those of the nearest of all.
static void check_nearest(const struct photon_map *m, struct vec3 p, struct vec3 n,
                          double radius, const struct photon_near *near, uint32_t found,
                          double reach)
{
    double *all = malloc((m->count + found + 1) * sizeof *all), *got = all + m->count;
    for (uint32_t i = 0; i < m->count; i++)
        all[i] = measured(&m->photon[i], p, n);
    for (uint32_t i = 0; i < found; i++)
        got[i] = all[near->photon[i]];
    qsort(all, m->count, sizeof *all, ascending);
    qsort(got, found, sizeof *got, ascending);
    uint32_t expected = 0;
    while (expected < m->count && expected < near->most &&
           all[expected] <= radius * radius)
        expected++;
    assert_int_equal(found, expected);
    for (uint32_t i = 0; i < found; i++)
        assert_true(fabs(got[i] - all[i]) <= 1e-14 * all[i]);
    const double r = found == near->most ? sqrt(all[found - 1]) : radius;
    assert_true(fabs(reach - r) <= 1e-14 * r);
    free(all);
}

// What a knows of the last place changes nothing.
static void check_map(uint32_t count, uint32_t most, bool grid, struct vec3 about)
{
    const struct packet_kernels *best = packet_kernels_choose();
    struct photon_map m;
    struct photon_near *a = photon_near_new(most), *b = photon_near_new(most);
    fill(&m, count, grid, about);
    photon_map_build(&m, packet_kernels_base.photons);
    for (int i = 0; i < 60; i++) {
        const double radius = i % 4 ? .3 * chance() : 1e7;
        const struct vec3 n =
            i % 2 ? vec3_normalize(somewhere()) : vec3_scale(0, somewhere());
        const struct vec3 p = vec3_mad(about, i % 3 ? .1 : 1.2, somewhere());
        double reach, same;
        m.search = packet_kernels_base.photons;
        const uint32_t found = photons_near(&m, p, n, radius, a, &reach);
        check_nearest(&m, p, n, radius, a, found, reach);
        m.search = best->photons;
        b->likely2 = 0;
        assert_int_equal(photons_near(&m, p, n, radius, b, &same), found);
        assert_memory_equal(&reach, &same, sizeof reach);
        if (found)
            assert_memory_equal(a->photon, b->photon, found * sizeof *a->photon);
    }
    photon_near_free(a);
    photon_near_free(b);
    photon_map_end(&m);
}

static void nearest_photons(void **state_)
{
    (void)state_;
    static const uint32_t counts[] = {1, 7, 8, 9, 64, 65, 1000, 5000};
    state = 7;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        for (int grid = 0; grid < 2; grid++) {
            const struct vec3 far = {-3000, 70, 20000};
            check_map(counts[i], 1, grid, vec3(0, 0, 0));
            check_map(counts[i], 20, grid, vec3(0, 0, 0));
            check_map(counts[i], 100, grid, vec3(0, 0, 0));
            check_map(counts[i], 20, grid, far);
        }
    }
}

// Gathering by its rule, from two searches; what it knows of the last place changes nothing.
static void check_gather(const struct photon_map *m, const struct photon_gather *g)
{
    struct photon_near *a = photon_near_new(g->max), *b = photon_near_new(g->max);
    uint32_t grown = 0, kept = 0;
    for (int i = 0; i < 400; i++) {
        const struct vec3 n =
            i % 2 ? vec3_normalize(somewhere()) : vec3_scale(0, somewhere());
        const struct vec3 p = vec3_scale(i % 3 ? .1 : 1.2, somewhere());
        double reach, wide, got;
        uint32_t count = photons_near(m, p, n, m->radius, a, &reach);
        const uint32_t more = photons_near(m, p, n, m->radius + m->step, b, &wide);
        if (count < g->min && more &&
            (more < g->expand_min || more / (wide * wide) <= (1 + g->expand_increase) *
                                                                 count /
                                                                 (reach * reach))) {
            memcpy(a->photon, b->photon, more * sizeof *a->photon);
            count = more;
            reach = wide;
            grown++;
        } else {
            kept += count < g->min;
        }
        for (int sparse = 0; sparse < 2; sparse++) {
            b->sparse = sparse;
            assert_int_equal(photons_gather(m, g, p, n, b, &got), count);
            assert_memory_equal(&got, &reach, sizeof got);
            if (count)
                assert_memory_equal(a->photon, b->photon, count * sizeof *a->photon);
        }
    }
    assert_true(grown > 10 && kept > 10);
    photon_near_free(a);
    photon_near_free(b);
}

static void gathered_photons(void **state_)
{
    (void)state_;
    struct photon_map m;
    state = 11;
    for (int grid = 0; grid < 2; grid++) {
        fill(&m, 3000, grid, vec3(0, 0, 0));
        m.radius = .02;
        m.step = .04;
        photon_map_build(&m, packet_kernels_choose()->photons);
        check_gather(&m, &(struct photon_gather){20, 100, .2, 20});
        check_gather(&m, &(struct photon_gather){90, 100, .5, 5});
        photon_map_end(&m);
    }
}

static void no_photons(void **state_)
{
    (void)state_;
    struct photon_map m = {0};
    struct photon_near *near = photon_near_new(5);
    double reach;
    photon_map_build(&m, packet_kernels_base.photons);
    assert_int_equal(photons_near(&m, vec3(0, 0, 0), vec3(0, 0, 0), 1, near, &reach), 0);
    assert_true(reach == 1);
    photon_near_free(near);
    photon_map_end(&m);
}

// A map that holds the most says that there was more, and takes nothing.
static void a_full_map_of_photons_says_so(void **state_)
{
    (void)state_;
    const struct photon x = {.p = {1, 2, 3}};
    struct photon_map some = {0},
                      full = {.count = PHOTONS_MOST, .capacity = PHOTONS_MOST};
    for (int i = 0; i < 100; i++)
        photon_add(&some, &x);
    assert_int_equal(some.count, 100);
    assert_false(some.full);
    struct photon_map more = {0};
    photon_map_append(&more, &some);
    photon_map_append(&more, &some);
    assert_int_equal(more.count, 200);
    assert_true(more.photon[199].p[2] == 3);
    photon_map_end(&more);
    photon_add(&full, &x);
    assert_true(full.full);
    full.full = false;
    photon_map_append(&full, &some);
    assert_true(full.full);
    assert_int_equal(full.count, PHOTONS_MOST);
    const struct photon_map cut = {.full = true};
    photon_map_append(&some,
                      &cut); // what another map has left out is missing here as well
    assert_true(some.full);
    photon_map_end(&some);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nearest_photons), cmocka_unit_test(gathered_photons),
        cmocka_unit_test(no_photons), cmocka_unit_test(a_full_map_of_photons_says_so)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
