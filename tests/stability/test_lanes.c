// Shapes that take eight rays at once against their own crossings of one line, and the
// instruction sets against each other.
#include "test.h"

#include <string.h>

#include "lanes.h"
#include "trace/packet.h"

static const char *const shapes[] = {
    "isosurface { function { x*x + y*y + z*z - 0.81 } }",
    "isosurface { function { sqrt(pow(sqrt(x*x + z*z) - 0.7, 2) + y*y) - 0.2 } }",
    "isosurface { function { sin(9*x)*cos(9*y) + sin(9*y)*cos(9*z) + sin(9*z)*cos(9*x) } "
    "}",
    "isosurface { function { sin(6*x)*cos(6*y) + sin(6*y)*cos(6*z) + sin(6*z)*cos(6*x) } "
    "contained_by { sphere { 0, 1.3 } } }",
    "isosurface { function { y - 0.25*sin(4*x) } open }",
    "isosurface { function { sqrt(x*x + y*y + z*z) - 0.7 + 0.1*sin(12*atan2(x, z)) } }",
    "#declare N = function { internal(76) } isosurface { function { sqrt(x*x + y*y + "
    "z*z) - "
    "0.8 + 0.4*N(4*x, 4*y, 4*z) } }",
    "#declare H = function { internal(25) } isosurface { function { H(x, y, z, 2, 8, "
    "0.15, "
    "0.5, 1, 1, 0) } }",
    "isosurface { function { max(abs(x) - 0.5, abs(y) - 0.6, abs(z) - 0.7) } }",
    "isosurface { function { abs(sqrt(x*x + y*y + z*z) - 0.8) - 0.5e-5 } }",
    "isosurface { function { floor(3*x) + 3*y } }",
    "isosurface { function { mod(abs(x) + 0.1, 0.4) - 0.2 + y } }",
    "isosurface { function { select(x*x - z*z, y - 0.2, y, y + 0.3*x) } }",
    "isosurface { function { y - (x < z)*0.3 + (x >= 0.2)*z - (y > 0.4)*x } }",
    "#declare R = function { internal(59) } isosurface { function { y - 0.4*R(x + 5, 0, "
    "z, "
    "0.3, 2.5, 5, 0.8, 0.9, 3) } }",
    "isosurface { function { y - sqrt(x) } }",
    "isosurface { function { exp(-4*(x*x + y*y + z*z)) + 0.3*cos(20*x) - 0.5 } threshold "
    ".1 "
    "}",
    "isosurface { function { sum(k, 1, 4, sin(k*5*x)/k) + 2*y } contained_by { sphere { "
    "0, 1 "
    "} } }",
    "quartic { <1,0,0,0,2,0,0,2,0,-1.3, 0,0,0,0,0,0,0,0,0,0, 1,0,0,2,0,.82,0,0,0,0, "
    "1,0,-1.3,0,.1681> }", // a torus of .8 and .3, by its expanded square
    "cubic { <1,0,0,0, 0,0,-1, 0,0,0, 1,0,0, 0,0,0, 1,0,-.2,-.1> }",
    "poly { 2, <1,0,0,0, 2,0,0, 3,0,-1> }",
    TOUCHED,
    "polynomial { 12, xyz(12,0,0): 1, xyz(0,12,0): 1, xyz(0,0,12): 1, xyz(0,0,0): -.1 }",
    "polynomial { 35, xyz(34,0,0): 1, xyz(0,34,0): 1, xyz(0,0,34): 1, xyz(1,0,0): -.2, "
    "xyz(0,0,0): -.1 }",
    "polynomial { 5, xyz(3,1,1): 1, xyz(0,0,2): -1, xyz(1,2,0): .7, xyz(0,1,0): -.3 }",
    "polynomial { 6, xyz(2,0,0): 1, xyz(0,1,0): -.7, xyz(0,0,0): .01 }", // degree 2
    "polynomial { 4, xyz(4,0,0): 1, xyz(0,4,0): 1, xyz(0,0,4): 1, xyz(2,0,0): -1, "
    "xyz(0,2,0): -1, xyz(0,0,2): -1, xyz(0,0,0): .4 }",
    "polynomial { 35, xyz(35,0,0): 1, xyz(0,2,0): -1, xyz(0,0,1): .3, xyz(0,0,0): .1 }",
    // Barth's sextic, with double points
    "#declare Q = (1 + sqrt(5))/2; #declare P = Q*Q; polynomial { 6, xyz(4,2,0): 4*P*P, "
    "xyz(0,4,2): 4*P*P, xyz(2,0,4): 4*P*P, xyz(2,4,0): -4*P, xyz(0,2,4): -4*P, "
    "xyz(4,0,2): -4*P, xyz(2,2,2): 4*P*P*P - 4, xyz(4,0,0): -1-2*Q, xyz(0,4,0): -1-2*Q, "
    "xyz(0,0,4): -1-2*Q, xyz(2,2,0): -2-4*Q, xyz(0,2,2): -2-4*Q, xyz(2,0,2): -2-4*Q, "
    "xyz(2,0,0): 2+4*Q, xyz(0,2,0): 2+4*Q, xyz(0,0,2): 2+4*Q, xyz(0,0,0): -1-2*Q }",
    "blob { threshold .5 sphere { <-.4, 0, 0>, .8, 1 } sphere { <.4, .2, 0>, .7, 1 } "
    "sphere { <0, -.2, .3>, .5, -1 } }",
    "blob { threshold .3 cylinder { <-.6, -.2, 0>, <.6, .3, .2>, .5, 1 } sphere { 0, .6, "
    "1 "
    "scale <1, .5, 2> rotate 30*z } cylinder { <0, -.8, 0>, <0, .8, 0>, .3, 2 rotate "
    "20*x } "
    "}",
    "blob { threshold .4 sphere { 0, 1, 1 scale <.1, .9, .05> rotate 40*x translate .3*x "
    "} cylinder { -y, y, .8, 1 matrix <.3, .2, 0, -.1, .5, .1, 0, .3, .2, -.2, 0, .1> } "
    "sphere { <.9, 0, .4>, .6, .8 scale .5 } }", // thin, sheared
    "blob { threshold .6 #declare S = seed(1); #for (I, 0, 119) sphere { <rand(S), "
    "rand(S), "
    "rand(S)>*1.6 - .8, .3, 1 } #end }",
    "superellipsoid { <3, .5> }", // pinched
    "superellipsoid { <.3, 3> }",
    "superellipsoid { <2.5, 4> }",
    "superellipsoid { <2, 3> }",
};

// Trees and grids, which rays meet at edges and corners too.
static const char *const walked[] = {
    "height_field { function 9, 9 { x*y } }",
    "height_field { function 5, 9 { sin(12*x)*cos(9*y)/2 + .5 } water_level .4 }",
    "height_field { function 3, 2 { abs(x - .4) } smooth }",
    "height_field { function 70, 33 { pattern { bumps scale .05 } } }",
    "height_field { function 9, 9 { .5 } }",
    "bicubic_patch { type 1 <-1, 0, -1>, <-.3, .3, -1>, <.3, -.3, -1>, <1, 0, -1>, "
    "<-1, .2, -.3>, <-.3, .9, -.3>, <.3, -.9, -.3>, <1, .3, -.3>, <-1, -.2, .3>, "
    "<-.3, -.9, .3>, <.3, .9, .3>, <1, .1, .3>, <-1, 0, 1>, <-.3, .1, 1>, <.3, .6, 1>, "
    "<1, 0, 1> }",
    "bicubic_patch { type 1 <-1, 0, -1>, <-.3, 0, -1>, <.3, 0, -1>, <1, 0, -1>, "
    "<-1, 0, -.3>, <-.3, 0, -.3>, <.3, 0, -.3>, <1, 0, -.3>, <-1, 0, .3>, <-.3, 0, .3>, "
    "<.3, 0, .3>, <1, 0, .3>, <-1, 0, 1>, <-.3, 0, 1>, <.3, 0, 1>, <1, 0, 1> }",
    "bicubic_patch { type 1 <0, 1, 0>, <0, 1, 0>, <0, 1, 0>, <0, 1, 0>, <.55, 1, 0>, "
    "<.55, 1, .3>, <.3, 1, .55>, <0, 1, .55>, <1, .55, 0>, <1, .55, .55>, "
    "<.55, .55, 1>, <0, .55, 1>, <1, 0, 0>, <1, 0, .55>, <.55, 0, 1>, <0, 0, 1> }",
    "bicubic_patch { type 1 <-1, 0, -1>, <2, 0, -1>, <-2, 0, -1>, <1, 0, -1>, "
    "<-1, .5, -.3>, <2, .5, -.3>, <-2, .5, -.3>, <1, .5, -.3>, <-1, .5, .3>, "
    "<2, .5, .3>, <-2, .5, .3>, <1, .5, .3>, <-1, 0, 1>, <2, 0, 1>, <-2, 0, 1>, "
    "<1, 0, 1> }",
};

static const char *const turned[] = {
    "lathe { linear_spline 5, <0, -.9>, <.7, -.6>, <.3, 0>, <.8, .5>, <.2, .9> }",
    "lathe { linear_spline 5, <.3, -.7>, <.8, -.6>, <.8, .4>, <.4, .5>, <.3, -.7> }",
    "lathe { quadratic_spline 6, <0, -1>, <.2, -.9>, <.7, -.6>, <.3, 0>, <.8, .5>, <.2, "
    ".9> "
    "}",
    "lathe { cubic_spline 7, <0, -1>, <.2, -.9>, <.7, -.6>, <.3, 0>, <.8, .5>, <.2, .9>, "
    "<0, "
    "1> }",
    "lathe { bezier_spline 8, <0, -.9>, <.9, -.9>, <.9, -.3>, <.4, 0>, <.4, 0>, <.1, "
    ".3>, "
    "<.9, .9>, <0, .8> }",
    "sor { 7, <.1, -1>, <.5, -.8>, <.7, -.6>, <.3, 0>, <.8, .5>, <.2, .9>, <0, 1> }",
    "sor { 6, <.1, -1>, <.5, -.8>, <.7, -.6>, <.3, 0>, <.8, .5>, <.2, .9> open }",
};

// Those whose lanes have the bits of the one line's crossings.
static const char *const same_bits[] = {
    "prism { -.4, .5, 5, <-.8, -.7>, <.9, -.5>, <.7, .8>, <-.6, .6>, <-.8, -.7> }",
    "prism { -.4, .5, 10, <-1, -1>, <1, -1>, <1, 1>, <-1, 1>, <-1, -1>, <-.5, -.5>, <.5, "
    "-.5>, <.5, .5>, <-.5, .5>, <-.5, -.5> open }",
    "prism { 0, 0, 4, <-1, -1>, <1, -1>, <0, 1>, <-1, -1> }",
    "prism { quadratic_spline -.5, .5, 6, <1, -1>, <-.8, -.7>, <.9, -.5>, <.7, .8>, "
    "<-.6, "
    ".6>, <-.8, -.7> }",
    "prism { cubic_spline -.5, .5, 7, <-.6, .6>, <-.8, -.7>, <.9, -.5>, <.7, .8>, <-.6, "
    ".6>, <-.8, -.7>, <.9, -.5> }",
    "prism { bezier_spline -.3, .6, 8, <-.9, 0>, <-.9, 1.2>, <.9, 1.2>, <.9, 0>, <.9, "
    "0>, "
    "<.9, -1.2>, <-.9, .5>, <-.9, 0> open }",
    "prism { conic_sweep 0, 1, 5, <-.8, -.7>, <.9, -.5>, <.7, .8>, <-.6, .6>, <-.8, -.7> "
    "}",
    "prism { conic_sweep bezier_spline -.7, .9, 8, <-.9, 0>, <-.9, 1.2>, <.9, 1.2>, <.9, "
    "0>, <.9, 0>, <.9, -1.2>, <-.9, .5>, <-.9, 0> }",
    "prism { conic_sweep .2, .9, 5, <-.8, -.7>, <.9, -.5>, <.7, .8>, <-.6, .6>, <-.8, "
    "-.7> open }",
    "text { ttf FONT \"g&8\" .4, <-.3, 0> split_union off }",
    "sphere_sweep { linear_spline 5, <-.8, -.5, 0>, .3, <.2, -.6, .3>, .1, <.7, .4, "
    "-.2>, .2, "
    "<-.3, .7, .1>, 0, <-.6, .1, -.6>, .25 }",
    "sphere_sweep { linear_spline 3, 0, .5, <.1, 0, 0>, .1, <.4, .3, .1>, .4 }",
    "sphere_sweep { b_spline 6, <-.8, -.5, 0>, .3, <.2, -.6, .3>, .3, <.7, .4, -.2>, .2, "
    "<-.3, .7, .1>, .4, <-.6, .1, -.6>, .25, <.4, .1, .6>, .3 }",
    "sphere_sweep { cubic_spline 6, <-.8, -.5, 0>, .3, <.2, -.6, .3>, .3, <.7, .4, -.2>, "
    ".2, "
    "<-.3, .7, .1>, .1, <-.6, .1, -.6>, .25, <.4, .1, .6>, .3 }",
    "polygon { 4, <-.9, -.8, .1>, <.8, -.9, .2>, <.1, .9, 0>, <-.9, -.8, .1> }",
    "polygon { 10, <-.8, 0, -.8>, <.8, 0, -.8>, <.8, 0, .8>, <-.8, 0, .8>, <-.8, 0, "
    "-.8>, "
    "<-.4, 0, -.4>, <.4, 0, -.4>, <.4, 0, .4>, <-.4, 0, .4>, <-.4, 0, -.4> }",
};

// The same, where a crossing is to be found and not only to be known of.
static const char *const same_hits[] = {
    "julia_fractal { <-.083, 0, -.83, -.025> quaternion sqr max_iteration 8 precision 40 "
    "}",
    "julia_fractal { <-.2, .6, .2, .1> quaternion cube max_iteration 6 precision 20 "
    "slice "
    "<.2, .1, 0, 1>, .1 }",
    "julia_fractal { <-.083, 0, -.83, -.025> max_iteration 1 }",
    "julia_fractal { <-.083, 0, -.83, -.025> hypercomplex sqr max_iteration 8 }",
    "julia_fractal { <.1, .2, .4, -.1> hypercomplex cube max_iteration 5 }",
    "julia_fractal { <.5, .2, .3, 0> hypercomplex sin max_iteration 6 }",
    "julia_fractal { <.5, .2, .3, 0> hypercomplex cos max_iteration 5 slice <0, .3, 0, "
    "1>, .2 }",
    "julia_fractal { <.5, .2, .3, 0> hypercomplex sinh max_iteration 6 precision 40 }",
    "julia_fractal { <-.5, .2, .3, 0> hypercomplex cosh max_iteration 5 }",
    "julia_fractal { <-.5, .2, .3, 0> hypercomplex tan max_iteration 5 }",
    "julia_fractal { <-.5, .2, .3, 0> hypercomplex tanh max_iteration 5 }",
    "julia_fractal { <-1, .2, .3, 0> hypercomplex exp max_iteration 5 }",
    "julia_fractal { <.4, .2, .3, 0> hypercomplex reciprocal max_iteration 5 }",
    "ovus { .6, .4 }",
    "ovus { .3, .4 }",
    "ovus { .2, .5 }",
    "superellipsoid { <.2, .3> }",
    "superellipsoid { <1.4, .6> }",
    "superellipsoid { <1, 1> }",
    "superellipsoid { <2, 2> }",
    "superellipsoid { <.01, 1e-3> }",
};

enum {
    SHAPES = sizeof shapes / sizeof *shapes,
    WALKED = sizeof walked / sizeof *walked,
    TURNED = sizeof turned / sizeof *turned,
    SAME_BITS = sizeof same_bits / sizeof *same_bits,
    SAME_HITS = sizeof same_hits / sizeof *same_hits,
    PACKETS = 50,
    MORE_PACKETS = 400
};

static void eight_rays_meet_what_one_line_does(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++)
        for (int any = 0; any < 2; any++) {
            struct loaded l;
            load(&l, "%s", shapes[i]);
            assert_true(shape_has_lanes(l.world->leaf[0].ops, l.world->leaf[0].shape));
            lanes_compare(&l, shapes[i], any != 0, PACKETS, false, false);
            unload(&l);
        }
}

// Two crossings so close that lines may pass them by, or a touch.
static bool has_graze(const struct boundary_list *l)
{
    for (uint32_t i = 0; i < l->count; i++)
        if (l->at[i].dt > 1e-9 || (i > 0 && l->at[i].t - l->at[i - 1].t < 1e-6))
            return true;
    return false;
}

static void assert_same_lines(const struct boundary_list *all,
                              const struct boundary_list *got, const char *text)
{
    if (has_graze(all) || has_graze(got))
        return;
    if (all->count != got->count)
        fail_msg("%s: %u crossings, not %u", text, got->count, all->count);
    for (uint32_t i = 0; i < all->count; i++) {
        const struct boundary *a = &all->at[i], *b = &got->at[i];
        assert_int_equal(a->crossing, b->crossing);
        if (!(fabs(a->t - b->t) <= a->dt + b->dt))
            fail_msg("%s: at %.17g +- %g, not %.17g +- %g", text, b->t, b->dt, a->t,
                     a->dt);
    }
}

// All crossings of eight lines: those of one, whatever the other lanes and the instruction set.
static int look_at_lines(const struct loaded *l, const char *text)
{
    const struct leaf *leaf = &l->world->leaf[0];
    const struct shape_kernels *best = packet_kernels_choose()->shapes;
    struct boundary_list all = {0}, got = {0}, other = {0};
    uint64_t s = 9;
    int told = 0;
    for (int n = 0; n < 3000; n++) {
        struct shape_rays rays;
        struct shape_lines base, lanes, alone;
        lanes_random_rays(&s, false, &rays);
        const unsigned bits =
            leaf->ops->lines8(&shape_kernels_base, leaf->shape, &rays, 255, &base);
        assert_int_equal(bits, leaf->ops->lines8(best, leaf->shape, &rays, 255, &lanes));
        for (int i = 0; i < 8; i++) {
            const struct ray r = lanes_ray(&rays, i);
            const struct shape_rays alike = shape_rays_alike(&r);
            const bool known = bits >> i & 1;
            assert_int_equal(known,
                             leaf->ops->lines8(best, leaf->shape, &alike, 1, &alone));
            if (!known)
                continue;
            told++;
            all.count = got.count = other.count = 0;
            shape_lines_add(&lanes, i, &got);
            shape_lines_add(&base, i, &other);
            assert_int_equal(got.count, other.count);
            shape_lines_add(&alone, 0, &other);
            assert_int_equal(2 * got.count, other.count);
            for (uint32_t k = 0; k < other.count; k++) {
                const struct boundary *b = &got.at[k % got.count];
                assert_memory_equal(&b->t, &other.at[k].t, sizeof b->t);
                assert_memory_equal(&b->dt, &other.at[k].dt, sizeof b->dt);
                assert_int_equal(b->crossing, other.at[k].crossing);
            }
            leaf->ops->intersect(leaf->shape, &r, &all);
            assert_same_lines(&all, &got, text);
        }
    }
    boundary_list_free(&all);
    boundary_list_free(&got);
    boundary_list_free(&other);
    return told;
}

static void eight_lines_have_all_crossings_of_one(void **state)
{
    (void)state;
    int kinds = 0;
    for (int i = 0; i < SHAPES; i++) {
        struct loaded l;
        load(&l, "%s", shapes[i]);
        if (l.world->leaf[0].ops->lines8)
            kinds += look_at_lines(&l, shapes[i]) > 12000; // the others have high orders
        unload(&l);
    }
    assert_true(kinds >= 6);
}

static void eight_rays_walk_as_one_line_does(void **state)
{
    (void)state;
    for (int i = 0; i < WALKED; i++)
        for (int any = 0; any < 2; any++) {
            struct loaded l;
            load(&l, "%s", walked[i]);
            assert_true(shape_has_lanes(l.world->leaf[0].ops, l.world->leaf[0].shape));
            lanes_compare(&l, walked[i], any != 0, MORE_PACKETS, true, false);
            unload(&l);
        }
}

static void eight_rays_meet_what_is_turned(void **state)
{
    (void)state;
    for (int i = 0; i < TURNED; i++)
        for (int any = 0; any < 2; any++) {
            struct loaded l;
            load(&l, "%s", turned[i]);
            assert_true(shape_has_lanes(l.world->leaf[0].ops, l.world->leaf[0].shape));
            lanes_compare(&l, turned[i], any != 0, MORE_PACKETS, false, false);
            unload(&l);
        }
}

static void eight_rays_have_the_bits_of_one_line(void **state)
{
    (void)state;
    for (int i = 0; i < SAME_BITS; i++)
        for (int any = 0; any < 2; any++) {
            struct loaded l;
            if (strstr(same_bits[i], "FONT") && !font_file()) {
                print_message("not tried, for want of a font: %s\n", same_bits[i]);
                continue;
            }
            load(&l, "#declare FONT = \"%s\"; %s", font_file() ? font_file() : "",
                 same_bits[i]);
            assert_true(shape_has_lanes(l.world->leaf[0].ops, l.world->leaf[0].shape));
            lanes_compare(&l, same_bits[i], any != 0, MORE_PACKETS, false, true);
            unload(&l);
        }
}

static void eight_rays_have_the_bits_of_one_lines_hits(void **state)
{
    (void)state;
    for (int i = 0; i < SAME_HITS; i++)
        for (int any = 0; any < 2; any++) {
            struct loaded l;
            load(&l, "%s", same_hits[i]);
            assert_true(shape_has_lanes(l.world->leaf[0].ops, l.world->leaf[0].shape));
            lanes_compare(&l, same_hits[i], any != 0, PACKETS, false, !any);
            unload(&l);
        }
}

// A ray that begins at a crossing meets the next one, or that where rounding puts it behind the
// start; not what lies before it alone.
static void assert_goes_on(const struct leaf *leaf, struct ray r,
                           const struct boundary_list *all, double apart,
                           const char *text)
{
    struct boundary_list first = {.first_only = true};
    for (uint32_t i = 0; i + 1 < all->count; i++) {
        const struct boundary *b = &all->at[i], *next = b + 1;
        if (next->t - b->t < apart || !next->drawn ||
            (i + 2 < all->count && next[1].t - next->t < apart))
            continue;
        bool found = false;
        r.t_min = b->t;
        first.count = 0;
        leaf->ops->intersect(leaf->shape, &r, &first);
        for (uint32_t k = 0; k < first.count; k++)
            found |= first.at[k].t > r.t_min;
        if (!found)
            fail_msg(
                "%s: nothing at %.17g behind %.17g, from <%.17g, %.17g, %.17g> along "
                "<%.17g, %.17g, %.17g>",
                text, next->t, b->t, r.o.x, r.o.y, r.o.z, r.d.x, r.d.y, r.d.z);
    }
    boundary_list_free(&first);
}

static void one_line_goes_on_from_a_crossing(void **state)
{
    (void)state;
    static const struct {
        const char *const *text;
        int count;
        double apart; // what the search may overlook, from another start
    } lists[] = {
        {shapes, SHAPES, 1e-6}, {turned, TURNED, 1e-6}, {same_hits, SAME_HITS, .2}};
    uint64_t s = 91;
    for (int n = 0; n < 3; n++)
        for (int i = 0; i < lists[n].count; i++) {
            struct loaded l;
            struct boundary_list all = {0};
            // The estimate of a hypercomplex set's distance may step over parts of it.
            if (strstr(lists[n].text[i], "hypercomplex"))
                continue;
            load(&l, "%s", lists[n].text[i]);
            const struct leaf *leaf = &l.world->leaf[0];
            for (int k = 0; k < PACKETS; k++) {
                struct shape_rays rays;
                lanes_random_rays(&s, false, &rays);
                struct ray r = lanes_ray(&rays, 0);
                r.t_min = -HUGE_VAL;
                r.t_max = HUGE_VAL;
                all.count = 0;
                leaf->ops->intersect(leaf->shape, &r, &all);
                assert_goes_on(leaf, r, &all, lists[n].apart, lists[n].text[i]);
            }
            boundary_list_free(&all);
            unload(&l);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_rays_meet_what_one_line_does),
        cmocka_unit_test(eight_lines_have_all_crossings_of_one),
        cmocka_unit_test(eight_rays_walk_as_one_line_does),
        cmocka_unit_test(eight_rays_meet_what_is_turned),
        cmocka_unit_test(eight_rays_have_the_bits_of_one_line),
        cmocka_unit_test(eight_rays_have_the_bits_of_one_lines_hits),
        cmocka_unit_test(one_line_goes_on_from_a_crossing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
