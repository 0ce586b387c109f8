// Surfaces given by functions against the shapes they equal, against dense samples of the
// functions, and against themselves on other threads.
#include "test.h"

#include <stdlib.h>

#include "loaded.h"

static double unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 33) + .5) / 2147483648.;
}

// Through the cube of half side 1, some along an axis.
static struct ray random_line(uint64_t *s)
{
    double p[3], d[3];
    for (int k = 0; k < 3; k++) {
        p[k] = 2 * unit(s) - 1;
        d[k] = 2 * unit(s) - 1;
    }
    if (unit(s) < .2) {
        const int axis = (int)(3 * unit(s));
        for (int k = 0; k < 3; k++)
            d[k] = k == axis;
    }
    struct ray r = {.d = vec3_normalize(vec3(d[0], d[1], d[2])),
                    .t_min = -HUGE_VAL,
                    .t_max = HUGE_VAL};
    r.o = vec3_mad(vec3(p[0], p[1], p[2]), -4, r.d);
    return r;
}

static void crossings(const struct loaded *l, const struct ray *r,
                      struct boundary_list *b)
{
    const struct leaf *leaf = &l->world->leaf[0];
    const struct ray local = transform_inverse_ray(leaf->transform, r);
    b->count = 0;
    leaf->ops->intersect(leaf->shape, leaf->transform->identity ? r : &local, b);
}

// Two lists of crossings are one within their error bounds, but for pairs that leave and
// come back within a stretch of `grazing`.
static bool are_equal(const struct boundary_list *a, const struct boundary_list *b,
                      double grazing)
{
    uint32_t i = 0, k = 0;
    while (i < a->count || k < b->count) {
        if (i < a->count && k < b->count &&
            fabs(a->at[i].t - b->at[k].t) <= a->at[i].dt + b->at[k].dt &&
            a->at[i].crossing == b->at[k].crossing) {
            i++;
            k++;
        } else if (i + 1 < a->count && a->at[i + 1].t - a->at[i].t < grazing) {
            i += 2;
        } else if (k + 1 < b->count && b->at[k + 1].t - b->at[k].t < grazing) {
            k += 2;
        } else {
            return false;
        }
    }
    return true;
}

static const struct {
    const char *function, *exact;
} pairs[] = {
    {"isosurface { function { x*x + y*y + z*z - 0.81 } ", "sphere { 0, 0.9 "},
    {"isosurface { function { sqrt(x*x + y*y + z*z) } threshold 0.9 ",
     "sphere { 0, 0.9 "},
    {"isosurface { function { 1e6*(x*x + y*y + z*z - 0.81) } ", "sphere { 0, 0.9 "},
    {"isosurface { function { 1e-6*(x*x + y*y + z*z - 0.81) } ", "sphere { 0, 0.9 "},
    {"isosurface { function { pow(x*x + y*y + z*z, 3) - 0.531441 } ", "sphere { 0, 0.9 "},
    {"isosurface { function { x*x + y*y + z*z - 2 } contained_by { sphere { 0, 0.9 } } ",
     "sphere { 0, 0.9 "},
    {"isosurface { function { sqrt(pow(sqrt(x*x + z*z) - 0.7, 2) + y*y) - 0.2 } ",
     "torus { 0.7, 0.2 "},
    {"isosurface { function { pow(x*x + y*y + z*z + 0.45, 2) - 1.96*(x*x + z*z) } ",
     "torus { 0.7, 0.2 "},
    {"isosurface { function { max(abs(x) - 0.5, abs(y) - 0.6, abs(z) - 0.7) } ",
     "box { <-.5, -.6, -.7>, <.5, .6, .7> "},
    {"isosurface { function { select(x, -1, -1, 1) } ", "box { -1, <0, 1, 1> "},
    {"isosurface { function { y - 1 } ", "box { -1, 1 "}, // coincident with the container
    {"isosurface { function { -1 } ", "box { -1, 1 "},
    {"isosurface { function { sqrt(x*x + y*y) - 0.5 } ", "cylinder { -z, z, 0.5 "},
    {"isosurface { function { max(abs(z) - 1, sqrt(x*x + y*y) - 0.5) } contained_by { "
     "box { "
     "-2, 2 } } ",
     "cylinder { -z, z, 0.5 "},
};

static void surfaces_are_the_shapes_they_equal(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-3, 1e5};
    struct boundary_list a = {0}, b = {0};
    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        for (int k = 0; k < 3; k++) {
            struct loaded f, e;
            load(&f, "%s scale %g }", pairs[i].function, scales[k]);
            load(&e, "%s scale %g }", pairs[i].exact, scales[k]);
            uint64_t s = 77 + i;
            uint32_t met = 0;
            for (int n = 0; n < 1500; n++) {
                struct ray r = random_line(&s);
                r.o = vec3_scale(scales[k], r.o);
                crossings(&f, &r, &a);
                crossings(&e, &r, &b);
                met += b.count > 0;
                if (!are_equal(&a, &b, 1e-5 * scales[k]))
                    fail_msg("%s scale %g }, line %d: %u crossings from %.17g +- %g, the "
                             "shape has %u from %.17g",
                             pairs[i].function, scales[k], n, a.count,
                             a.count ? a.at[0].t : 0, a.count ? a.at[0].dt : 0, b.count,
                             b.count ? b.at[0].t : 0);
            }
            assert_true(met > 300);
            unload(&f);
            unload(&e);
        }
    boundary_list_free(&a);
    boundary_list_free(&b);
}

// A shell of a hundred-thousandth is met four times by every line that is no tangent.
static void thin_shells_are_whole(void **state)
{
    (void)state;
    struct loaded l;
    struct boundary_list b = {0};
    load(&l, "isosurface { function { abs(sqrt(x*x + y*y + z*z) - 0.8) - 0.5e-5 } }");
    uint64_t s = 3;
    for (int n = 0; n < 2000; n++) {
        const struct ray r = random_line(&s);
        const double nearest = vec3_length(vec3_cross(r.o, r.d));
        crossings(&l, &r, &b);
        if (nearest < 0.799)
            assert_int_equal(b.count, 4);
        if (nearest > 0.801)
            assert_int_equal(b.count, 0);
    }
    boundary_list_free(&b);
    unload(&l);
}

static const char *const functions[] = {
    "isosurface { function { sin(9*x)*cos(9*y) + sin(9*y)*cos(9*z) + sin(9*z)*cos(9*x) } "
    "}",
    "isosurface { function { sqrt(x*x + y*y + z*z) - 0.7 + 0.1*sin(12*atan2(x, z)) } }",
    "#declare N = function { internal(76) } isosurface { function { sqrt(x*x + y*y + "
    "z*z) - "
    "0.8 + 0.4*N(4*x, 4*y, 4*z) } }",
    "#declare N = function { internal(78) } isosurface { function { y + N(6*x, 0, 6*z, "
    "3) - "
    "0.5 } }",
    "#declare R = function { internal(59) } isosurface { function { y - 0.4*R(x + 5, 0, "
    "z, "
    "0.3, 2.5, 5, 0.8, 0.9, 3) } }",
    "#declare H = function { internal(25) } isosurface { function { H(x, y, z, 2, 8, "
    "0.15, "
    "0.5, 1, 1, 0) } }",
    "isosurface { function { mod(abs(x) + 0.1, 0.4) - 0.2 + y } }",
    "isosurface { function { floor(3*x) + 3*y } }",
    "isosurface { function { y - sqrt(x) } }", // no number for x < 0: outside
    "isosurface { function { exp(-4*(x*x + y*y + z*z)) + 0.3*cos(20*x) - 0.5 } threshold "
    ".1 }",
    "isosurface { function { sum(k, 1, 4, sin(k*5*x)/k) + 2*y } contained_by { sphere { "
    "0, 1 "
    "} } }",
};

// The state at thousands of points along lines is what the crossings say.
static void no_surface_is_missed(void **state)
{
    (void)state;
    struct boundary_list b = {0};
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
        struct loaded l;
        load(&l, "%s", functions[i]);
        const struct leaf *leaf = &l.world->leaf[0];
        uint64_t s = 5 + i;
        uint32_t met = 0;
        for (int n = 0; n < 150; n++) {
            const struct ray r = random_line(&s);
            crossings(&l, &r, &b);
            met += b.count > 0;
            uint32_t at = 0;
            for (int k = 0; k < 1500; k++) {
                const double t = 2 + 4 * (k + unit(&s)) / 1500;
                while (at < b.count && b.at[at].t < t)
                    at++;
                const double room =
                    fmin(at ? t - b.at[at - 1].t : 1, at < b.count ? b.at[at].t - t : 1);
                const bool in = at && b.at[at - 1].crossing == CROSS_ENTER;
                if (room > 1e-8 && leaf->ops->inside(leaf->shape, ray_at(&r, t)) != in)
                    fail_msg("%s: line %d is not %d at t = %.17g", functions[i], n, in,
                             t);
            }
        }
        assert_true(met > 50);
        unload(&l);
    }
    boundary_list_free(&b);
}

// Cells are made by whichever ray comes first; the picture does not show which.
static void threads_make_the_same_picture(void **state)
{
    (void)state;
    struct image one, four;
    for (int k = 0; k < 2; k++) {
        struct loaded l;
        load(&l, "camera { location <0, 1, -3> look_at 0 angle 50 } light_source { <5, "
                 "8, -9>, 1 } "
                 "isosurface { function { sqrt(x*x + y*y + z*z) - 0.7 + "
                 "0.1*sin(12*atan2(x, z)) } "
                 "pigment { rgb 1 } } parametric { function { u } function { "
                 "0.2*sin(9*u*v) - 0.8 "
                 "} function { v } <-1, -1>, <1, 1> pigment { rgb <1, .5, .2> } }");
        *(k ? &four : &one) = render_picture(&l, k ? 4 : 1, k ? 8 : 32);
        unload(&l);
    }
    const size_t size = (size_t)one.width * (size_t)one.height * (size_t)one.channels;
    assert_memory_equal(one.pixel, four.pixel, size * sizeof *one.pixel);
    image_free(&one);
    image_free(&four);
}

// A sphere given by angles, all points of which are known.
static void parametric_is_the_sphere_it_equals(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-3, 1e5};
    struct boundary_list a = {0}, b = {0};
    for (int k = 0; k < 3; k++) {
        struct loaded f, e;
        load(&f,
             "parametric { function { 0.9*cos(u)*cos(v) } function { 0.9*sin(v) } "
             "function { "
             "0.9*sin(u)*cos(v) } <0, -pi/2>, <2*pi, pi/2> scale %g }",
             scales[k]);
        load(&e, "sphere { 0, 0.9 scale %g }", scales[k]);
        uint64_t s = 9;
        for (int n = 0; n < 600; n++) {
            struct ray r = random_line(&s);
            r.o = vec3_scale(scales[k], r.o);
            crossings(&f, &r, &a);
            crossings(&e, &r, &b);
            const double nearest = vec3_length(vec3_cross(r.o, r.d)) / scales[k];
            if (nearest > 0.899 && nearest < 0.901)
                continue;
            if (a.count != b.count)
                fail_msg("scale %g, line %d: %u crossings, not %u", scales[k], n, a.count,
                         b.count);
            for (uint32_t i = 0; i < a.count; i++)
                assert_near(a.at[i].t, b.at[i].t, 1e-9 * scales[k]);
        }
        unload(&f);
        unload(&e);
    }
    boundary_list_free(&a);
    boundary_list_free(&b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_are_the_shapes_they_equal),
        cmocka_unit_test(thin_shells_are_whole),
        cmocka_unit_test(no_surface_is_missed),
        cmocka_unit_test(threads_make_the_same_picture),
        cmocka_unit_test(parametric_is_the_sphere_it_equals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
