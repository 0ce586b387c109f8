// Maps of shapes: points on the surface, normals, inverses, exact areas and volumes.
#include "test.h"

#include "../scene/fake_args.h"
#include "base/arena.h"
#include "base/diag.h"
#include "tess/map.h"
#include "tess/map_mesh.h"

static const double pi = 3.14159265358979323846;

struct sample {
    const struct shape_ops *ops;
    const char *text;
    double area, volume; // in shape space; < 0: not compared
};

// Areas and volumes: Pappus for tori and cones, the sor's cubic by hand: with points in
// line it is a cylinder. The ellipsoid with two equal axes by the spheroid's formula.
static const struct sample samples[] = {
    {&disc_ops, "<1, 2, 3>, <1, 1, 0>, 2, 0.5", 3.14159265358979323846 * 3.75, -1},
    {&disc_ops, "<0, 0, 0>, <0, 0, 1>, 2", 3.14159265358979323846 * 4, -1},
    {&torus_ops, "1, 0.25", 4 * 9.8696044010893586188 * 0.25,
     2 * 9.8696044010893586188 * 0.0625},
    {&quadric_ops, "<1, 1, 1>, <0, 0, 0>, <-2, 0, 0>, -3", 4 * 3.14159265358979323846 * 4,
     4 * 3.14159265358979323846 / 3 * 8},
    {&quadric_ops, "<0.25, 1, 1>, <0, 0, 0>, <0, 0, 0>, -1",
     2 * 3.14159265358979323846 + 8 * 9.8696044010893586188 / (3 * 1.7320508075688773),
     4 * 3.14159265358979323846 / 3 * 2},
    {&lathe_ops, "linear_spline 4, <1, 0>, <2, 0>, <2, 3>, <1, 3>", -1, -1},
    {&lathe_ops, "linear_spline 4, <0, 0>, <2, 0>, <1, 1>, <0, 1>",
     3.14159265358979323846 * (4 + 1 + 3 * 1.4142135623730951),
     3.14159265358979323846 * 7 / 3},
    {&lathe_ops, "bezier_spline 4, <0, -1>, <1.3, -1>, <1.3, 1>, <0, 1>", -1, -1},
    {&sor_ops, "4, <1, -1>, <1, 0>, <1, 2>, <1, 3>", 6 * 3.14159265358979323846,
     2 * 3.14159265358979323846},
    {&sor_ops, "5, <0.5, -1>, <0.5, 0>, <1, 1>, <0.3, 2>, <0.2, 3>", -1, -1},
    {&bicubic_patch_ops,
     "type 1 <0,0,0> <1,0,0> <2,0,0> <3,0,0> <0,1,0> <1,1,0> <2,1,0> <3,1,0> "
     "<0,2,0> <1,2,0> <2,2,0> <3,2,0> <0,3,0> <1,3,0> <2,3,0> <3,3,0>",
     9, -1},
    {&bicubic_patch_ops,
     "type 1 <0,0,0> <1,0,1> <2,0,0> <3,0,0> <0,1,0> <1,1,2> <2,1,0> <3,1,1> "
     "<0,2,0> <1,2,0> <2,2,-1> <3,2,0> <0,3,0> <1,3,0> <2,3,0> <3,3,1>",
     -1, -1},
};
enum { SAMPLES = sizeof samples / sizeof *samples };

struct made {
    struct arena *arena;
    const struct tess_map *map;
    void *shape;
};

static struct made make(const struct sample *s)
{
    struct made m = {.arena = arena_new(1 << 14), .map = tess_map_find(s->ops)};
    m.shape = arena_alloc(m.arena, s->ops->size);
    struct args *args = fake_args_new(m.arena, NULL, s->text);
    if (!m.map || !s->ops->build(m.shape, args) || fake_args_failed(args) ||
        !m.map->count(m.shape))
        fail_msg("%s { %s }: no map", s->ops->keyword, s->text);
    return m;
}

// A line through the point along its normal must cross the shape there, with that normal,
// and the crossing must be found in the map where it came from.
static void check_point(const struct sample *s, const struct made *m, uint32_t piece,
                        double u, double v)
{
    struct map_point at;
    m->map->at(m->shape, piece, u, v, &at);
    const struct ray ray = {at.p, at.n, -INFINITY, INFINITY};
    struct boundary_list list = {0};
    s->ops->intersect(m->shape, &ray, &list);
    const struct boundary *near = NULL;
    for (uint32_t i = 0; i < list.count; i++)
        if (list.at[i].drawn && (!near || fabs(list.at[i].t) < fabs(near->t)))
            near = &list.at[i];
    if (!near || !(fabs(near->t) < 1e-9))
        fail_msg("%s piece %u at %g %g: off the surface", s->text, piece, u, v);
    struct surface_point sp = {.p = ray_at(&ray, near->t)};
    s->ops->surface(m->shape, near, sp.p, &sp);
    double dot = vec3_dot(sp.ng, at.n);
    if (!(s->ops->flags & SHAPE_SOLID))
        dot = fabs(dot);
    assert_near(dot, 1, 1e-9);
    double x, y;
    const uint32_t found = m->map->locate(m->shape, near, sp.p, &x, &y);
    assert_int_equal(found, piece);
    assert_near(x, u, 1e-7);
    assert_near(y, v, 1e-7);
    boundary_list_free(&list);
}

static void test_points(void **state)
{
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        const struct made m = make(&samples[i]);
        for (uint32_t k = 0; k < m.map->count(m.shape); k++)
            for (int j = 0; j < 25; j++)
                check_point(&samples[i], &m, k, (j % 5 + 0.37) / 5, (j / 5 + 0.41) / 5);
        arena_free(m.arena);
    }
}

// du and dv against differences of points.
static void test_derivatives(void **state)
{
    (void)state;
    const double h = 1e-6;
    for (int i = 0; i < SAMPLES; i++) {
        const struct made m = make(&samples[i]);
        for (uint32_t k = 0; k < m.map->count(m.shape); k++) {
            struct map_point at, u[2], v[2];
            m.map->at(m.shape, k, 0.3, 0.6, &at);
            for (int s = 0; s < 2; s++) {
                m.map->at(m.shape, k, 0.3 + (2 * s - 1) * h, 0.6, &u[s]);
                m.map->at(m.shape, k, 0.3, 0.6 + (2 * s - 1) * h, &v[s]);
            }
            const struct vec3 du = vec3_scale(0.5 / h, vec3_sub(u[1].p, u[0].p));
            const struct vec3 dv = vec3_scale(0.5 / h, vec3_sub(v[1].p, v[0].p));
            assert_near(vec3_length(vec3_sub(du, at.du)), 0, 1e-7);
            assert_near(vec3_length(vec3_sub(dv, at.dv)), 0, 1e-7);
        }
        arena_free(m.arena);
    }
}

static void whole(const struct made *m, const struct transform *t, int panels,
                  double *area, double *volume)
{
    *area = *volume = 0;
    for (uint32_t k = 0; k < m->map->count(m->shape); k++) {
        const struct map_part all = {k, 0, 0, 1, 1};
        *area += tess_map_area(m->map, m->shape, t, &all, panels);
        *volume += tess_map_volume(m->map, m->shape, t, &all, panels);
    }
}

static void test_integrals(void **state)
{
    (void)state;
    for (int i = 0; i < SAMPLES; i++) {
        const struct sample *s = &samples[i];
        const struct made m = make(s);
        double area, volume;
        whole(&m, &transform_identity, 8, &area, &volume);
        if (s->area >= 0)
            assert_near(area, s->area, 1e-9 * s->area);
        if (s->volume >= 0)
            assert_near(volume, s->volume, 1e-9 * s->volume);
        arena_free(m.arena);
    }
}

// Quarters of a part add up to it, also after a map that keeps no angles; the volume is
// multiplied by its determinant, wherever the solid is.
static void test_transformed(void **state)
{
    (void)state;
    const struct transform scale = transform_scale(vec3(3, 1, -2));
    const struct transform turn = transform_rotate(vec3(20, 30, 40));
    const struct transform move = transform_translate(vec3(10, -20, 5));
    struct transform t = transform_then(&scale, &turn);
    t = transform_then(&t, &move);
    for (int i = 0; i < SAMPLES; i++) {
        const struct made m = make(&samples[i]);
        double area, volume, fine, unused;
        whole(&m, &t, 8, &area, &volume);
        whole(&m, &t, 16, &fine, &unused);
        assert_near(area, fine, 1e-6 * fine);
        double quarters = 0, all = 0;
        for (int q = 0; q < 4; q++) {
            const struct map_part part = {0, q % 2 / 2.0, q / 2 / 2.0, (q % 2 + 1) / 2.0,
                                          (q / 2 + 1) / 2.0};
            quarters += tess_map_area(m.map, m.shape, &t, &part, 8);
        }
        const struct map_part first = {0, 0, 0, 1, 1};
        all = tess_map_area(m.map, m.shape, &t, &first, 16);
        assert_near(quarters, all, 1e-12 * all);
        if (samples[i].volume >= 0)
            assert_near(volume, 6 * samples[i].volume, 1e-8 * volume);
        arena_free(m.arena);
    }
}

// Every row of maps.def has a sample here.
static void test_table(void **state)
{
    (void)state;
    static const struct tess_map *const table[] = {
#define MAP(name) &name##_map,
#include "tess/maps.def"
#undef MAP
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        bool found = false;
        for (int k = 0; k < SAMPLES; k++)
            found |= samples[k].ops == table[i]->ops;
        if (!found)
            fail_msg("no sample of %s", table[i]->ops->keyword);
        assert_ptr_equal(tess_map_find(table[i]->ops), table[i]);
    }
}

// The triangles of a map close up: a torus is a torus, its volume that of the solid.
static void test_mesh(void **state)
{
    (void)state;
    const struct made m = make(&samples[2]);
    double off[2];
    for (int i = 0; i < 2; i++) {
        struct tess_mesh mesh = {0};
        tess_map_mesh(m.map, m.shape, &transform_identity, i ? 0.025 : 0.05, &mesh);
        const struct tess_report r = tess_mesh_report(&mesh);
        assert_true(r.manifold);
        assert_int_equal(r.euler, 0);
        off[i] = samples[2].volume - r.volume;
        tess_mesh_free(&mesh);
    }
    // Facets lose volume by the square of their size.
    assert_true(off[1] > 0 && off[1] < 0.02 * samples[2].volume);
    assert_near(off[0] / off[1], 4, 0.4);
    arena_free(m.arena);
}

// Open ends have a rim of length 2 pi r; the disc's middle is one vertex.
static void test_disc_mesh(void **state)
{
    (void)state;
    const struct made m = make(&samples[1]);
    struct tess_mesh mesh = {0};
    tess_map_mesh(m.map, m.shape, &transform_identity, 0.1, &mesh);
    const struct tess_report r = tess_mesh_report(&mesh);
    assert_false(r.closed);
    assert_int_equal(r.euler, 1);
    assert_near(r.area, 4 * pi, 0.01 * pi);
    for (uint32_t i = 0; i < mesh.triangle_count; i++) {
        const struct vec3 a = mesh.vertex[mesh.triangle[i][0]];
        const struct vec3 b = mesh.vertex[mesh.triangle[i][1]];
        const struct vec3 c = mesh.vertex[mesh.triangle[i][2]];
        assert_true(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)).z > 0);
    }
    tess_mesh_free(&mesh);
    arena_free(m.arena);
}

// An infinite quadric and a spindle torus have no map, and say so.
static void test_none(void **state)
{
    (void)state;
    static const struct sample none[] = {
        {&quadric_ops, "<1, 1, 0>, <0, 0, 0>, <0, 0, 0>, -1", 0, 0},
        {&quadric_ops, "<1, 1, -1>, <0, 0, 0>, <0, 0, 0>, -1", 0, 0},
        {&quadric_ops, "<1, 1, 0>, <0, 0, 0>, <0, 0, -1>, 0", 0, 0},
        {&torus_ops, "1, 2", 0, 0},
    };
    for (size_t i = 0; i < sizeof none / sizeof *none; i++) {
        struct arena *a = arena_new(1 << 12);
        void *shape = arena_alloc(a, none[i].ops->size);
        assert_true(none[i].ops->build(shape, fake_args_new(a, NULL, none[i].text)));
        assert_int_equal(tess_map_find(none[i].ops)->count(shape), 0);
        arena_free(a);
    }
    assert_null(tess_map_find(&blob_ops));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_points),    cmocka_unit_test(test_derivatives),
        cmocka_unit_test(test_integrals), cmocka_unit_test(test_transformed),
        cmocka_unit_test(test_mesh),      cmocka_unit_test(test_disc_mesh),
        cmocka_unit_test(test_none),      cmocka_unit_test(test_table),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
