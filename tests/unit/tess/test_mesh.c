// The report on a mesh: whole, torn, turned, pinched.
#include "test.h"

#include "tess/mesh.h"

static const struct vec3 corner[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const uint32_t side[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

// A tetrahedron; its corner k is vertex of[k], a new one where of[k] is UINT32_MAX.
static void add_tetrahedron(struct tess_mesh *m, struct vec3 at, double size,
                            uint32_t of[4])
{
    for (int k = 0; k < 4; k++)
        if (of[k] == UINT32_MAX)
            of[k] = tess_mesh_add_vertex(m, vec3_mad(at, size, corner[k]));
    for (int t = 0; t < 4; t++)
        tess_mesh_add_triangle(m, of[side[t][0]], of[side[t][1]], of[side[t][2]]);
}

static void test_tetrahedron(void **state)
{
    (void)state;
    struct tess_mesh m = {0};
    uint32_t of[4] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
    add_tetrahedron(&m, vec3(1e6, 0, 0), 1, of);
    const struct tess_report r = tess_mesh_report(&m);
    assert_true(r.closed && r.oriented && r.manifold);
    assert_int_equal(r.euler, 2);
    assert_true(fabs(r.volume - (1.0 / 6)) <= 1e-9);
    assert_true(fabs(r.area - (1.5 + sqrt(3) / 2)) <= 1e-9);
    tess_mesh_free(&m);
}

static void test_faults(void **state)
{
    (void)state;
    struct tess_mesh m = {0};
    uint32_t of[4] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
    add_tetrahedron(&m, vec3(0, 0, 0), 1, of);
    m.triangle_count--;
    assert_false(tess_mesh_report(&m).closed);
    m.triangle_count++;
    m.triangle[0][0] = 2; // 0 2 1 turned to 2 0 1: runs the other way
    m.triangle[0][1] = 0;
    const struct tess_report turned = tess_mesh_report(&m);
    assert_true(turned.closed);
    assert_false(turned.oriented || turned.manifold);
    tess_mesh_free(&m);
}

// Two tetrahedra that touch in a corner: every edge is well, the vertex is not.
static void test_pinched(void **state)
{
    (void)state;
    struct tess_mesh m = {0};
    uint32_t of[4] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, UINT32_MAX};
    add_tetrahedron(&m, vec3(0, 0, 0), 1, of);
    uint32_t other[4] = {of[0], UINT32_MAX, UINT32_MAX, UINT32_MAX};
    add_tetrahedron(&m, vec3(0, 0, 0), -1, other);
    for (uint32_t t = 4; t < 8; t++) { // mirrored: turn it outward again
        const uint32_t b = m.triangle[t][1];
        m.triangle[t][1] = m.triangle[t][2];
        m.triangle[t][2] = b;
    }
    const struct tess_report r = tess_mesh_report(&m);
    assert_true(r.closed && r.oriented);
    assert_false(r.manifold);
    assert_int_equal(r.euler, 3);
    assert_true(fabs(r.volume - (2.0 / 6)) <= 1e-12);
    tess_mesh_free(&m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_tetrahedron),
                                       cmocka_unit_test(test_faults),
                                       cmocka_unit_test(test_pinched)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
