// The same solid placed twice by chains of transforms that are equal but for rounding, far
// from the origin: taken from itself nothing is left, a merge shows one surface. The rays
// are traced in packets and alone, which must give the same bits.
#include "test.h"

#include "loaded.h"

enum { RAYS = 512 };

static double unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 33) + .5) / 2147483648.;
}

static struct vec3 in_cube(uint64_t *s)
{
    const double x = unit(s), y = unit(s), z = unit(s);
    return vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

// Solids that keep their transform, and some that absorb parts of it.
static const char *const solids[] = {
    "box { <-1, -.7, -1.2>, <1, .8, 1>",
    "superellipsoid { <.5, .3>",
    "torus { 1, .4",
    "prism { -1, 1, 5, <-1, -1>, <1, -1>, <.5, .8>, <-.7, 1>, <-1, -1>",
    "cone { <0, -1, 0>, 1, <0, 1, 0>, .3",
    "cylinder { <0, -1, 0>, <0, 1, 0>, .6 scale <1, 1, 2>",
    "sphere { 0, 1 scale <1, 2, .5>",
    "blob { threshold .5 sphere { <-.4, 0, 0>, 1, 1 } sphere { <.4, .3, 0>, 1, 1 }",
    "lathe { linear_spline 5, <0, -.5>, <.5, -.5>, <.7, .2>, <0, .5>, <0, -.5>",
    "isosurface { function { x*x + y*y + z*z - .8 }",
    "quadric { <1, 2, 3>, <.1, .2, .3>, 0, -1",
    "ovus { 1, .5",
    "sor { 6, <.2, -1>, <.5, -.5>, <.8, 0>, <.4, .5>, <.6, 1>, <.6, 1.5>",
    "lathe { cubic_spline 7, <0, -1.5>, <0, -1>, <1, -.6>, <.4, 0>, <.8, .7>, <0, 1>, "
    "<0, "
    "2>",
    "prism { conic_sweep .5, 1, 5, <-1, -1>, <1, -1>, <.5, .8>, <-.7, 1>, <-1, -1>",
    "prism { bezier_spline -.7, .9, 8, <-1, 0>, <-1, -1>, <1, -1>, <1, 0>, <1, 0>, <1, "
    "1>, "
    "<-1, 1>, <-1, 0>",
    "poly { 2, <1, 0, 0, 0, 1, 0, 0, 1, 0, -1>",
    "quartic { <1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, "
    "0, "
    "0, 0, 0, 0, 0, 1, 0, 0, 0, -1>",
    "polynomial { 4, xyz(4, 0, 0): 1, xyz(0, 2, 0): 1, xyz(0, 0, 4): 2, xyz(0, 0, 0): -1",
    "mesh2 { vertex_vectors { 4, <-1, -1, 1>, <1, -1, 1>, <0, -1, -1>, <0, 1, 0> } "
    "face_indices { 4, <0, 1, 2>, <0, 1, 3>, <1, 2, 3>, <2, 0, 3> } inside_vector <.3, "
    "1, "
    ".2>",
    "height_field { function 9, 7 { .5 + .4*sin(9*x)*cos(7*y) } translate <-.5, 0, -.5>",
    "julia_fractal { <-.1, .1, .2, 0> quaternion sqr max_iteration 4 precision 60",
    "sphere_sweep { linear_spline 2, <-1, 0, 0>, .5, <1, 0, 0>, .25",
    "sphere_sweep { b_spline 4, <-2, 0, 0>, .5, <-.5, .5, 0>, .25, <.5, -.5, .3>, .5, "
    "<2, 0, "
    "0>, .3",
    "blob { threshold .5 cylinder { <-.4, -.5, 0>, <.4, .7, .2>, .8, 1 }",
    "torus { .4, 1",
};
enum { SOLIDS = sizeof solids / sizeof solids[0] };

static const struct vec3 place = {1e6, -7e5, 3e5};

// Two ways to the same place.
static const char chains[] =
    "#declare P = <%.17g, %.17g, %.17g>;\n"
    "#declare One = transform { rotate <10, 0, 0> rotate <0, 20, 30> translate P }\n"
    "#declare Other = transform { translate vrotate(vrotate(P, <0, 0, -77>), <0, -33, "
    "0>)\n"
    "  rotate <0, 33, 0> rotate <0, 0, 77> translate -P\n"
    "  rotate <0, 0, -77> rotate <0, -33, 0> rotate <10, 20, 0> rotate <0, 0, 30>\n"
    "  translate P }\n";

struct shots {
    struct ray_batch *batch;
    struct hit hit[RAYS];
    int met;
};

static void trace_all(struct loaded *l, struct shots *f)
{
    uint64_t s = 99;
    f->batch = ray_batch_new(RAYS);
    f->batch->count = RAYS;
    for (int i = 0; i < RAYS; i++) {
        const struct vec3 d = vec3_normalize(in_cube(&s));
        const struct vec3 o =
            vec3_add(place, vec3_mad(vec3_scale(.8, in_cube(&s)), -5, d));
        for (int k = 0; k < 3; k++) {
            f->batch->o[k][i] = vec3_axis(o, k);
            f->batch->d[k][i] = vec3_axis(d, k);
        }
        f->batch->t_min[i] = 0;
        f->batch->t_max[i] = HUGE_VAL;
        f->batch->hidden_by[i] = 0;
    }
    struct hit_batch *hits = hit_batch_new(RAYS);
    trace_closest(l->world, l->scratch, f->batch, hits);
    for (uint32_t i = 0; i < RAYS; i++)
        f->hit[i] = hit_batch_at(hits, i);
    hit_batch_free(hits);
    f->met = 0;
    for (int i = 0; i < RAYS; i++) {
        const struct ray_batch *b = f->batch;
        const struct ray_query q = {.ray = {vec3(b->o[0][i], b->o[1][i], b->o[2][i]),
                                            vec3(b->d[0][i], b->d[1][i], b->d[2][i]), 0,
                                            HUGE_VAL}};
        const struct hit h = trace_closest_1(l->world, l->scratch, &q);
        const bool met = isfinite(h.b.t);
        assert_true(met == isfinite(f->hit[i].b.t));
        if (met) {
            assert_true(h.b.t == f->hit[i].b.t && h.b.dt == f->hit[i].b.dt);
            assert_int_equal(h.b.leaf, f->hit[i].b.leaf);
            assert_int_equal(h.b.part, f->hit[i].b.part);
        }
        assert_true(trace_occluded_1(l->world, l->scratch, &q) == met);
        f->met += met;
    }
    ray_batch_free(f->batch);
}

static void load_pair(struct loaded *l, const char *pair, const char *solid)
{
    char text[4096];
    snprintf(text, sizeof text, chains, place.x, place.y, place.z);
    load(l, "%s#declare A = %s transform One } #declare B = %s transform Other }\n%s",
         text, solid, solid, pair);
}

static int rays_met(const char *pair, const char *solid, double t[RAYS])
{
    struct loaded l;
    struct shots f;
    load_pair(&l, pair, solid);
    trace_all(&l, &f);
    for (int i = 0; i < RAYS; i++)
        t[i] = f.hit[i].b.t;
    unload(&l);
    return f.met;
}

static void nothing_is_left_of_a_solid_less_itself(void **state)
{
    (void)state;
    double t[RAYS];
    int films = 0;
    for (int i = 0; i < SOLIDS; i++) {
        assert_true(rays_met("object { A }", solids[i], t) > RAYS / 8);
        assert_int_equal(
            rays_met("difference { object { A } object { A } }", solids[i], t), 0);
        const int film =
            rays_met("difference { object { A } object { B } }", solids[i], t);
        if (film)
            print_error("%d of %d rays meet film: %s }\n", film, RAYS, solids[i]);
        films += film;
    }
    assert_int_equal(films, 0);
}

// The merge, the intersection, and the solid less a box beside it.
static void twice_the_same_is_the_same(void **state)
{
    (void)state;
    static const char *const same[] = {
        "merge { object { A } object { B } }",
        "intersection { object { A } object { B } }",
        "difference { object { A } box { <-9, -9, -9>, <9, -3, 9> transform Other } }",
    };
    double want[RAYS], t[RAYS];
    for (int i = 0; i < SOLIDS; i++) {
        rays_met("object { A }", solids[i], want);
        for (size_t k = 0; k < sizeof same / sizeof same[0]; k++) {
            rays_met(same[k], solids[i], t);
            int off = 0;
            for (int n = 0; n < RAYS; n++)
                off += isfinite(want[n]) && !(fabs(t[n] - want[n]) < 1e-6);
            if (off) // grazing rays may meet one and miss the other
                print_error("%d rays differ: %s, %s }\n", off, same[k], solids[i]);
            assert_true(off <= 1);
        }
    }
}

// A box cut by one that shares a face: the face is gone, nothing is before it.
static void a_coplanar_cut_leaves_no_film(void **state)
{
    (void)state;
    double whole[RAYS], cut[RAYS];
    rays_met("box { <-1, -.7, -1.2>, <1, .1, 1> transform One }", solids[0], whole);
    rays_met(
        "difference { object { A } box { <-1, .1, -1.2>, <1, .8, 1> transform Other } "
        "}",
        solids[0], cut);
    for (int i = 0; i < RAYS; i++)
        if (isfinite(whole[i]) != isfinite(cut[i]) ||
            (isfinite(whole[i]) && fabs(whole[i] - cut[i]) > 1e-6))
            fail_msg("ray %d: %.17g, not %.17g", i, cut[i], whole[i]);
}

// Solids that end in a face at y = 1: what begins there takes nothing from them, what ends
// there holds all of them.
static void a_shared_face_changes_nothing(void **state)
{
    (void)state;
    static const char *const capped[] = {
        "box { <-1, -.7, -1.2>, <1, 1, 1>",
        "cylinder { -y, y, .8",
        "cone { -y, 1, y, .3",
        "prism { -1, 1, 5, <-1, -1>, <1, -1>, <.5, .8>, <-.7, 1>, <-1, -1>",
        "prism { conic_sweep .5, 1, 5, <-1, -1>, <1, -1>, <.5, .8>, <-.7, 1>, <-1, -1>",
        "lathe { linear_spline 5, <0, -1>, <1, -.8>, <.7, 1>, <0, 1>, <0, -1>",
        "sor { 5, <.2, -1>, <.5, -.5>, <.8, 0>, <.4, 1>, <.6, 1.5>",
        "mesh2 { vertex_vectors { 4, <-1, 1, 1>, <1, 1, 1>, <0, 1, -1>, <0, -1, 0> } "
        "face_indices { 4, <0, 1, 2>, <0, 1, 3>, <1, 2, 3>, <2, 0, 3> } inside_vector "
        "<.3, "
        "1, .2>",
        "isosurface { function { x*x + z*z - .5 }",
        "intersection { sphere { 0, 1.5 } plane { y, 1 }",
    };
    static const char *const same[] = {
        "difference { object { A } box { <-9, 1, -9>, <9, 9, 9> transform Other } }",
        "difference { object { A } plane { -y, -1 transform Other } }",
        "intersection { object { A } box { <-9, -9, -9>, <9, 1, 9> transform Other } }",
        "intersection { object { A } plane { y, 1 transform Other } }",
    };
    double want[RAYS], t[RAYS];
    int off = 0;
    for (size_t i = 0; i < sizeof capped / sizeof capped[0]; i++) {
        assert_true(rays_met("object { A }", capped[i], want) > RAYS / 8);
        for (size_t k = 0; k < sizeof same / sizeof same[0]; k++) {
            rays_met(same[k], capped[i], t);
            int here = 0;
            for (int n = 0; n < RAYS; n++)
                here += isfinite(want[n]) != isfinite(t[n]) ||
                        (isfinite(want[n]) && fabs(t[n] - want[n]) > 1e-6);
            if (here)
                print_error("%d rays differ: %s, %s }\n", here, same[k], capped[i]);
            off += here > 1; // a ray may graze one and miss the other
        }
    }
    assert_int_equal(off, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_left_of_a_solid_less_itself),
        cmocka_unit_test(twice_the_same_is_the_same),
        cmocka_unit_test(a_coplanar_cut_leaves_no_film),
        cmocka_unit_test(a_shared_face_changes_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
