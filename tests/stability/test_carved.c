// Shapes with eight rays of their own that simple solids cut or clip
// (trace/packet_carve.h), against the sweep.
#include "test.h"

#include <string.h>

#include "lanes.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/scratch.h"

enum { PACKETS = 400 };

#define BLOB                                                                             \
    "blob { threshold .5 sphere { <-.4, 0, 0>, .8, 1 } sphere { <.4, .2, 0>, .7, 1 } "   \
    "sphere { <0, -.2, .3>, .5, -1 } rotate <10, 20, 30> }"
#define WAVES "isosurface { function { y - 0.25*sin(4*x) } }"
static const char *const carved[] = {
    "difference { object { " BLOB " } plane { y, -.1 } plane { x, -.2 } rotate 40*y }",
    "difference { object { " BLOB
    " } box { <-.2, -1, -1>, <.2, 1, 1> } sphere { <.5, .2, "
    "-.3>, .3 } cylinder { -2*z, 2*z, .1 } }",
    "intersection { box { -.7, .7 rotate 30 } object { " BLOB " } }",
    "difference { box { -.7, .7 rotate 30 } object { " BLOB
    " } }", // the shape is inverted
    "difference { quartic { <1,0,0,0,2,0,0,2,0,-1.3, 0,0,0,0,0,0,0,0,0,0, "
    "1,0,0,2,0,.82,0,0,0,0, 1,0,-1.3,0,.1681> } box { <0, -1, -2>, <2, 1, 2> } "
    "cone { -y, .9, y, .6 } }",
    "difference { isosurface { function { x*x*x*x + y*y*y*y + z*z*z*z - .07 } } sphere { "
    "0, 1 "
    "scale <.45, .45, .05> translate -.5*z } sphere { 0, 1 scale <.45, .45, .05> "
    "translate "
    ".5*z rotate 90*x } cylinder { -y, y, .2 } }",
    "object { " WAVES " clipped_by { box { -.6, .6 rotate 20*y } } }",
    "object { " WAVES
    " clipped_by { sphere { 0, .6 inverse } plane { <1, 1, 1>, .4 } } }",
    "object { " BLOB " clipped_by { box { <-.3, -2, -2>, <.3, 2, 2> inverse } } }",
    "difference { lathe { cubic_spline 6 <0, -1>, <0, -.8>, <.6, -.5>, <.3, .1>, <0, "
    ".7>, <0, 1> "
    "rotate 20*x } box { <0, -1, -1>, 1 } }",
    "difference { lathe { linear_spline 5 <.2, -.5>, <.7, -.4>, <.6, .4>, <.3, .3>, <.2, "
    "-.5> } "
    "plane { x, .1 } cylinder { -y, y, .4 } }",
    "intersection { box { -.5, .5 rotate 20 } sor { 5 <.3, -1>, <.5, -.7>, <.3, 0>, <.6, "
    ".5>, "
    "<.4, 1> } }",
    "difference { sphere { 0, .8 } sor { 5 <.3, -1>, <.5, -.7>, <.3, 0>, <.6, .5>, <.4, "
    "1> } }",
    "difference { ovus { .6, .3 translate -.3*y } plane { x + y, .1 } }",
    "difference { superellipsoid { <.3, .6> scale .7 rotate 20 } cylinder { -y, y, .4 } "
    "}",
    "difference { sphere_sweep { cubic_spline 5 <-1, 0, 0>, .3, <-.6, .2, 0>, .3, <0, "
    "-.2, .2>, "
    ".2, <.6, .2, 0>, .35, <1, 0, 0>, .2 } box { <-.2, -1, -1>, <.1, 1, 1> } }",
    "difference { text { ttf FONT \"g&8\" .4, <-.3, 0> } plane { x, .3 } sphere { <.8, "
    ".3, 0>, "
    ".3 } }",
    "intersection { object { " BLOB
    " } box { -.4, .4 pigment { rgbt 1 } } plane { y, .2 pigment { rgbt 1 } } "
    "sphere { .3, .2 inverse } }", // some surfaces are clear
    "intersection { object { " BLOB
    " pigment { rgbt 1 } } box { -.4, .4 pigment { rgbt 1 } } }",
    "difference { object { " BLOB
    " } quadric { <1, 0, -1>, <0, 0, 0>, <0, 0, 0>, -.05 } }",
    "cylinder { -y, y, .4 clipped_by { object { " BLOB " } } }",
    "difference { box { -.5, .5 } sphere { 0, .6 } clipped_by { object { " BLOB
    " inverse } } }",
    "cylinder { -y, y, .4 clipped_by { height_field { function 9, 9 { x*y } scale 2 "
    "translate -1 } } }",
    "box { <-1, -.7, -1>, <1, .7, 1> clipped_by { height_field { function 9, 9 { x*y } "
    "scale "
    "2 translate -1 } } }", // they share sides
    "intersection { object { " BLOB
    " } quadric { <1, 0, -1>, <0, 0, 0>, <0, 0, 0>, -.05 } plane { -z, 0 } }",
    // The solid's surface lies in its container's faces.
    "difference { isosurface { function { sqrt(pow(max(abs(x) - .45, 0), 2) + "
    "pow(max(abs(y) - .45, 0), 2) + pow(max(abs(z) - .45, 0), 2)) - .05 } contained_by { "
    "box { -.5, .5 } } } sphere { 0, 1 scale <.45, .45, .05> translate -.5*z } sphere { 0, 1 "
    "scale <.45, .45, .05> translate .5*z } sphere { 0, 1 scale <.45, .05, .45> translate "
    ".5*y } }",
};

static const double GRAZING = 1e-6; // an error of t that only touching crossings have

// What the carving finds, the sweep finds; batches have the bits of one ray.
static void carved_shapes_are_as_the_sweep_has_them(void **state)
{
    (void)state;
    uint64_t seed = 77;
    struct ray_batch *batch = ray_batch_new(8);
    struct hit_batch *hits = hit_batch_new(8);
    for (size_t i = 0; i < sizeof carved / sizeof *carved; i++) {
        struct loaded l;
        const char *font = font_file();
        unsigned met = 0, grazing = 0;
        if (!font && strstr(carved[i], "FONT"))
            continue;
        load(&l, "#declare FONT = \"%s\"; %s", font ? font : "", carved[i]);
        assert_int_equal(l.world->accel->object_shape[0], PACKET_CARVED);
        for (int n = 0; n < PACKETS; n++) {
            struct shape_rays rays;
            uint8_t dark[8];
            lanes_random_rays(&seed, false, &rays);
            batch->count = 8;
            for (int k = 0; k < 8; k++) {
                for (int a = 0; a < 3; a++) {
                    batch->o[a][k] = rays.o[a][k];
                    batch->d[a][k] = rays.d[a][k];
                }
                batch->t_min[k] = rays.t_min[k];
                batch->t_max[k] = rays.t_max[k];
                batch->hidden_by[k] = 0;
            }
            trace_closest(l.world, l.scratch, batch, hits);
            trace_occluded(l.world, l.scratch, batch, dark);
            for (int k = 0; k < 8; k++) {
                const struct ray_query q = {lanes_ray(&rays, k), 0};
                const struct hit one = trace_closest_1(l.world, l.scratch, &q);
                struct boundary b = {.t = INFINITY}, opaque = b;
                sweep_object(l.world, l.scratch, 0, &q.ray, INFINITY, SWEEP_CLOSEST, &b);
                sweep_object(l.world, l.scratch, 0, &q.ray, INFINITY, SWEEP_OPAQUE,
                             &opaque);
                assert_true(hits->t[k] == one.b.t);
                // Grazing rays, of which neither form knows whether they meet the shape.
                if (fmax(one.b.dt, b.dt) > GRAZING) {
                    grazing++;
                    continue;
                }
                assert_int_equal(one.b.t < INFINITY, b.t < INFINITY);
                assert_int_equal(dark[k], opaque.t < INFINITY);
                assert_int_equal(dark[k], trace_occluded_1(l.world, l.scratch, &q));
                if (!(b.t < INFINITY))
                    continue;
                assert_true(fabs(one.b.t - b.t) <= 2 * (one.b.dt + b.dt));
                assert_int_equal(one.b.leaf, b.leaf);
                assert_int_equal(one.b.crossing, b.crossing);
                assert_int_equal(hits->leaf[k], b.leaf);
                met++;
            }
        }
        assert_true(met > PACKETS / 4);
        assert_true(grazing < met / 50);
        unload(&l);
    }
    ray_batch_free(batch);
    hit_batch_free(hits);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(carved_shapes_are_as_the_sweep_has_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
