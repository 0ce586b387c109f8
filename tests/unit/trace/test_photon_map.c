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
    struct photon_near *a = photon_near_new(most, PHOTON_PICTURE),
                       *b = photon_near_new(most, PHOTON_PICTURE);
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

// Gathering by its rule, from two searches; what the grid knows of a place changes nothing.
static void check_gather(const struct photon_map *m, const struct photon_gather *g)
{
    struct photon_near *a = photon_near_new(g->max, PHOTON_PICTURE),
                       *b = photon_near_new(g->max, PHOTON_PICTURE);
    const struct photon_range *r = &m->range[PHOTON_PICTURE];
    const double radius2 = r->radius * r->radius;
    const struct photon_hint hints[] = {
        {false, 0}, {true, 0}, {false, radius2}, {false, .1 * radius2}, {false, 1e-200}};
    uint32_t grown = 0, kept = 0, empty = 0;
    for (int i = 0; i < 400; i++) {
        const struct vec3 n =
            i % 2 ? vec3_normalize(somewhere()) : vec3_scale(0, somewhere());
        const struct vec3 p = vec3_scale(i % 3 ? .1 : 1.2, somewhere());
        double reach, wide, got;
        a->likely2 = b->likely2 = 0;
        uint32_t count = photons_near(m, p, n, r->radius, a, &reach);
        const uint32_t more = photons_near(m, p, n, r->radius + r->step, b, &wide);
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
        const int32_t place = photon_grid_place(&r->grid, p, n);
        empty += place == PHOTON_PLACE_EMPTY;
        for (size_t k = 0; k < sizeof hints / sizeof *hints; k++) {
            photon_grid_remember(&r->grid, place, hints[k]);
            assert_int_equal(photons_gather(m, g, p, n, b, &got), count);
            assert_memory_equal(&got, &reach, sizeof got);
            if (count)
                assert_memory_equal(a->photon, b->photon, count * sizeof *a->photon);
        }
    }
    assert_true(grown > 10 && kept > 10 && empty > 10 && empty < 390);
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
        m.range[PHOTON_PICTURE] =
            (struct photon_range){.radius = .02, .step = .04, .last = 1};
        photon_map_build(&m, packet_kernels_choose()->photons);
        photon_map_ready(&m, PHOTON_PICTURE);
        check_gather(&m, &(struct photon_gather){20, 100, .2, 20});
        check_gather(&m, &(struct photon_gather){90, 100, .5, 5});
        photon_map_end(&m);
    }
}

// What is kept of a distance is not less than it, and little more.
static void hints_hold_distances(void **state_)
{
    (void)state_;
    const float places[] = {0, 0, 0, 1, 1, 1};
    struct photon_grid g = {.near = NULL};
    photon_grid_build(&g, places, 2, 3 * sizeof *places, .5, 1);
    const int32_t place = photon_grid_place(&g, vec3(0, 0, 0), vec3(0, 1, 0));
    assert_true(place >= 0);
    for (double d = .25; d > 1e-15; d *= .7) {
        photon_grid_remember(&g, place, (struct photon_hint){.likely2 = d});
        const struct photon_hint got = photon_grid_recall(&g, place);
        assert_false(got.sparse);
        assert_true(got.likely2 >= d && got.likely2 <= 1.5 * d);
    }
    photon_grid_remember(&g, place, (struct photon_hint){.sparse = true});
    assert_true(photon_grid_recall(&g, place).sparse);
    const int32_t other = photon_grid_place(&g, vec3(0, 0, 0), vec3(1, 0, 0));
    assert_false(photon_grid_recall(&g, other).sparse);
    assert_int_equal(photon_grid_place(&g, vec3(9, 0, 0), vec3(1, 0, 0)),
                     PHOTON_PLACE_EMPTY);
    photon_grid_end(&g);
}

// Few photons, as samples gather, make the density that there is, but for one alone.
static void few_photons_tell_the_density(void **state_)
{
    (void)state_;
    enum { COUNT = 40000, PLACES = 4000 };
    static const uint32_t maxima[] = {100, 12, 1};
    struct photon_map m;
    state = 5;
    fill(&m, COUNT, false, vec3(0, 0, 0));
    for (int i = 0; i < COUNT; i++) {
        m.photon[i].p[0] = (float)chance();
        m.photon[i].p[1] = 0;
        m.photon[i].p[2] = (float)chance();
    }
    photon_map_build(&m, packet_kernels_choose()->photons);
    for (size_t k = 0; k < sizeof maxima / sizeof *maxima; k++) {
        m.range[PHOTON_PICTURE] = (struct photon_range){.radius = 1, .last = 1};
        photon_grid_end(&m.range[PHOTON_SAMPLE].grid);
        m.range[PHOTON_SAMPLE] = (struct photon_range){.radius = 0};
        const uint32_t most = photon_map_for_samples(&m, maxima[k], false);
        const struct photon_gather g[PHOTON_USES] = {[PHOTON_SAMPLE] = {.max = most}};
        struct photon_near *near = photon_near_new(most, PHOTON_SAMPLE);
        double sum = 0;
        for (int i = 0; i < PLACES; i++) {
            const struct vec3 p = {.1 + .8 * chance(), 0, .1 + .8 * chance()};
            double reach;
            const uint32_t n = photons_gather(&m, g, p, vec3(0, 1, 0), near, &reach);
            assert_int_equal(n, most);
            assert_true(reach > 0 && reach < 1);
            sum += n / (3.14159265358979323846 * reach * reach);
        }
        if (most > 1)
            assert_near(sum / PLACES / COUNT, 1, .03);
        photon_near_free(near);
    }
    photon_map_end(&m);
}

// Without photons to gather nothing is found, and no number is lost.
static void no_samples_of_none(void **state_)
{
    (void)state_;
    struct photon_map m = {.range[PHOTON_PICTURE] = {.radius = 2}};
    assert_int_equal(photon_map_for_samples(&m, 0, true), 0);
    assert_true(m.range[PHOTON_SAMPLE].radius == 2 && m.range[PHOTON_SAMPLE].last == 1);
    photon_map_end(&m);
}

static void no_photons(void **state_)
{
    (void)state_;
    struct photon_map m = {0};
    struct photon_near *near = photon_near_new(5, PHOTON_PICTURE);
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(nearest_photons),
                                       cmocka_unit_test(gathered_photons),
                                       cmocka_unit_test(hints_hold_distances),
                                       cmocka_unit_test(few_photons_tell_the_density),
                                       cmocka_unit_test(no_samples_of_none),
                                       cmocka_unit_test(no_photons),
                                       cmocka_unit_test(a_full_map_of_photons_says_so)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
