// crackle against all cells by its formula (spec/textures 5.3): what is left out on the
// way to the nearest points must not matter.

#include "test.h"

#include <stdlib.h>

#include "math/elementary.h"
#include "scene/noise.h"
#include "scene/object.h"
#include "scene/pattern.h"

// Stands in for the object pattern's only need, so that no shape is linked.
bool object_inside(const struct object *o, struct vec3 p)
{
    (void)o;
    return p.x > 0;
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double power(double x, double metric)
{
    return metric == 1 ? x : metric == 2 ? x * x : det_pow(x, metric);
}

static double distance(struct vec3 e, double metric, double offset)
{
    double sum =
        power(fabs(e.x), metric) + power(fabs(e.y), metric) + power(fabs(e.z), metric);
    if (offset != 0)
        sum += power(offset, metric);
    return metric == 1 ? sum : metric == 2 ? sqrt(sum) : det_pow(sum, 1 / metric);
}

static double by_formula(const struct pattern *p, struct vec3 at)
{
    double d[81];
    int n = 0;
    struct vec3 nearest = at;
    for (int i = 0; i < 125; i++) {
        const int o[3] = {i / 25 - 2, i / 5 % 5 - 2, i % 5 - 2};
        if ((abs(o[0]) == 2) + (abs(o[1]) == 2) + (abs(o[2]) == 2) > 1)
            continue;
        const struct vec3 q =
            noise_cell_point(floor(at.x - 1e-10) + o[0], floor(at.y - 1e-10) + o[1],
                             floor(at.z - 1e-10) + o[2]);
        d[n] = distance(vec3_sub(q, at), p->metric, p->offset);
        bool first = true;
        for (int k = 0; k < n; k++)
            first &= d[n] < d[k];
        if (first)
            nearest = q;
        n++;
    }
    assert_int_equal(n, 81);
    if (p->solid)
        return noise_value(nearest, 2);
    qsort(d, (size_t)n, sizeof *d, ascending);
    const double v = p->vector.x * d[0] + p->vector.y * d[1] + p->vector.z * d[2];
    return v < 0 ? 0 : v > 1 ? 1 : v;
}

static double drawn(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

static void all_cells(void **state)
{
    (void)state;
    static const float metric[] = {1,    2,    3,    4, 8,    9,  0.5f,
                                   1.5f, 2.5f, 2.2f, 7, 0.3f, 30, 1.01f};
    static const struct vec3 form[] = {
        {-1, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0.3, -0.4, 0.5}};
    static const double size[] = {2, 50, 1e7};
    uint64_t seed = 7;
    unsigned between = 0, count = 0;
    for (size_t m = 0; m < sizeof metric / sizeof *metric; m++)
        for (int i = 0; i < 400; i++, count++) {
            struct pattern p = {0};
            pattern_set_kind(&p, &crackle_pattern_ops);
            p.metric = metric[m];
            p.vector = form[i % 4];
            p.offset = i % 5 == 0 ? 0.25f : 0;
            p.solid = i % 7 == 0;
            const double s = size[i % 3];
            struct vec3 at = vec3(s * (drawn(&seed) - 0.5), s * (drawn(&seed) - 0.5),
                                  s * drawn(&seed));
            if (i % 11 == 0)
                at = vec3(floor(at.x), floor(at.y) + 0.5, at.z);
            const double got = p.ops->value(&p, at, NULL), want = by_formula(&p, at);
            if (fabs(got - want) > 1e-13)
                print_error("metric %g at %.17g %.17g %.17g: got %.17g, want %.17g\n",
                            (double)metric[m], at.x, at.y, at.z, got, want);
            assert_near(got, want, 1e-13);
            between += got > 0 && got < 1;
        }
    assert_true(between > count / 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_cells)};
    return cmocka_run_group_tests_name("crackle", tests, NULL, NULL);
}
