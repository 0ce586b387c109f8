// Shapes that take eight rays at once against their own crossings of one line, and the
// instruction sets against each other.
#include "test.h"

#include <stdlib.h>
#include <string.h>

#include "loaded.h"
#include "scene/shape_kernels.h"
#include "trace/accel.h"
#include "trace/packet.h"
#include "trace/scratch.h"

#define TOUCHED "poly { 2, <1,0,0,0, 0,0,0, 0,0,0> }" // a plane, twice

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

static double unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 33) + .5) / 2147483648.;
}

static double coordinate(uint64_t *s, bool grid)
{
    const double v = 2 * unit(s) - 1;
    return grid && unit(s) < .2 ? round(4 * v) / 4 : v;
}

// Side by side or in all directions, from outside or inside, some along an axis, some
// through the middle, some on a grid.
static void random_rays(uint64_t *s, bool grid, struct shape_rays *r)
{
    double p[3] = {0}, d[3] = {0};
    const bool together = unit(s) < .6, inside = unit(s) < .3, axis = unit(s) < .15;
    const int along = (int)(3 * unit(s));
    for (int l = 0; l < 8; l++) {
        for (int k = 0; k < 3; k++)
            if (l == 0 || !together) {
                p[k] = unit(s) < .05 ? 0 : coordinate(s, grid);
                d[k] = axis ? k == along : coordinate(s, grid);
            } else {
                p[k] += .02 * unit(s);
                d[k] += axis ? 0 : .02 * unit(s);
            }
        if (d[0] == 0 && d[1] == 0 && d[2] == 0)
            d[along] = -1;
        for (int k = 0; k < 3; k++) {
            r->o[k][l] = p[k] - (inside ? 0 : 3 * d[k]);
            r->d[k][l] = d[k];
        }
        r->t_min[l] = unit(s) < .5 ? 0 : 3 * unit(s);
        r->t_max[l] = unit(s) < .5 ? HUGE_VAL : r->t_min[l] + 3 * unit(s);
    }
}

static struct ray lane(const struct shape_rays *r, int l)
{
    return (struct ray){vec3(r->o[0][l], r->o[1][l], r->o[2][l]),
                        vec3(r->d[0][l], r->d[1][l], r->d[2][l]), r->t_min[l],
                        r->t_max[l]};
}

// What the lane may have met: a crossing as near as the first that is wanted, unless that
// or what comes before is a graze or at the very ends of the range.
static bool is_right(const struct boundary_list *all, const struct ray *r, bool met,
                     double t, double dt, unsigned crossing, uint32_t part, bool any,
                     double slack)
{
    const double close = 1e-7;
    for (uint32_t i = 0; i < all->count; i++) {
        const struct boundary *b = &all->at[i];
        const bool unsure = (i + 1 < all->count && all->at[i + 1].t - b->t < close) ||
                            (i > 0 && b->t - all->at[i - 1].t < close) ||
                            fabs(b->t - r->t_min) < close ||
                            fabs(b->t - r->t_max) < close;
        const bool wanted = b->drawn && b->t > r->t_min && b->t < r->t_max;
        // Where the surface leaves the container either may be told.
        const bool same = met && crossing == b->crossing &&
                          fabs(t - b->t) <= dt + b->dt + slack &&
                          (part == b->part || (part == 0) != (b->part == 0));
        if (same || (any && met && wanted))
            return true;
        if (wanted && !unsure)
            return false;
    }
    if (!met)
        return true;
    // A graze that the one line did not report.
    for (uint32_t i = 0; i < all->count; i++)
        if (fabs(t - all->at[i].t) < close)
            return true;
    return false;
}

// The first crossing that is wanted, bit by bit; with `any`, the t of one that is.
static void assert_same_bits(const struct boundary_list *all, const struct ray *r,
                             bool met, bool any, const struct shape_hits *h, int l,
                             const char *text)
{
    const struct boundary *b = NULL;
    for (uint32_t i = 0; i < all->count; i++)
        if (all->at[i].drawn && all->at[i].t > r->t_min && all->at[i].t <= r->t_max &&
            (!b || (any && met && all->at[i].t == h->t[l])))
            b = &all->at[i];
    if (met != (b != NULL) || (b && h->t[l] != b->t) ||
        (b && !any &&
         (h->t[l] != b->t || h->dt[l] != b->dt || h->u[l] != b->u || h->v[l] != b->v ||
          h->part[l] != b->part || h->crossing[l] != b->crossing)))
        fail_msg("%s: %d at %.17g +- %g part %u, not %d at %.17g +- %g part %u; from "
                 "<%.17g, %.17g, %.17g> along <%.17g, %.17g, %.17g>",
                 text, met, met ? h->t[l] : 0, met ? h->dt[l] : 0, met ? h->part[l] : 0,
                 b != NULL, b ? b->t : 0, b ? b->dt : 0, b ? b->part : 0, r->o.x, r->o.y,
                 r->o.z, r->d.x, r->d.y, r->d.z);
}

static void look(const struct loaded *l, const char *text, bool any, int packets,
                 bool grid, bool bits)
{
    // Noise jumps by some 1e-10 where its lattice has planes.
    const double slack = strstr(text, "internal") ? 1e-7 : 0;
    static const struct shape_kernels *kernels[3] = {&shape_kernels_base};
    const struct leaf *leaf = &l->world->leaf[0];
    const struct packet_kernels *best = packet_kernels_choose();
    kernels[1] = kernels[2] = best->shapes;
    struct boundary_list all = {0};
    uint64_t s = 3 + (uint64_t)any;
    int hits = 0;
    for (int n = 0; n < packets; n++) {
        struct shape_rays rays;
        struct shape_hits first, other, alone;
        random_rays(&s, grid, &rays);
        memset(&first, 0, sizeof first);
        memset(&other, 0, sizeof other);
        memset(&alone, 0, sizeof alone);
        const unsigned met =
            leaf->ops->closest8(kernels[0], leaf->shape, &rays, 255, any, &first);
        assert_int_equal(
            met, leaf->ops->closest8(kernels[1], leaf->shape, &rays, 255, any, &other));
        unsigned one_by_one = 0;
        for (int i = 0; i < 8; i++)
            one_by_one |=
                leaf->ops->closest8(kernels[1], leaf->shape, &rays, 1u << i, any, &alone);
        assert_int_equal(met, one_by_one);
        for (int i = 0; i < 8; i++) {
            const struct ray r = lane(&rays, i);
            const bool in = met >> i & 1;
            all.count = 0;
            leaf->ops->intersect(leaf->shape, &r, &all);
            if (bits)
                assert_same_bits(&all, &r, in, any, &first, i, text);
            else if (!is_right(&all, &r, in, first.t[i], first.dt[i], first.crossing[i],
                               first.part[i], any, slack))
                fail_msg(
                    "%s: packet %d lane %d any %d: %d at %.17g +- %g, %u crossings from "
                    "%.17g in %.17g .. %.17g",
                    text, n, i, any, in, first.t[i], first.dt[i], all.count,
                    all.count ? all.at[0].t : 0, r.t_min, r.t_max);
            if (!in)
                continue;
            hits++;
            assert_memory_equal(&first.t[i], &other.t[i], sizeof *first.t);
            assert_memory_equal(&first.dt[i], &other.dt[i], sizeof *first.dt);
            assert_memory_equal(&first.u[i], &other.u[i], sizeof *first.u);
            assert_memory_equal(&first.v[i], &other.v[i], sizeof *first.v);
            assert_int_equal(first.part[i], other.part[i]);
            assert_int_equal(first.crossing[i], other.crossing[i]);
            if (any) // of several crossings, the one that is come to first
                continue;
            assert_memory_equal(&first.t[i], &alone.t[i], sizeof *first.t);
            assert_memory_equal(&first.dt[i], &alone.dt[i], sizeof *first.dt);
        }
    }
    // A touch is no crossing.
    assert_true(hits > packets / 4 || strcmp(text, TOUCHED) == 0);
    boundary_list_free(&all);
}

static void eight_rays_meet_what_one_line_does(void **state)
{
    (void)state;
    for (int i = 0; i < SHAPES; i++)
        for (int any = 0; any < 2; any++) {
            struct loaded l;
            load(&l, "%s", shapes[i]);
            assert_true(l.world->leaf[0].ops->has_lanes(l.world->leaf[0].shape));
            look(&l, shapes[i], any != 0, PACKETS, false, false);
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
        random_rays(&s, false, &rays);
        const unsigned bits =
            leaf->ops->lines8(&shape_kernels_base, leaf->shape, &rays, 255, &base);
        assert_int_equal(bits, leaf->ops->lines8(best, leaf->shape, &rays, 255, &lanes));
        for (int i = 0; i < 8; i++) {
            const struct ray r = lane(&rays, i);
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
            assert_true(l.world->leaf[0].ops->has_lanes(l.world->leaf[0].shape));
            look(&l, walked[i], any != 0, MORE_PACKETS, true, false);
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
            assert_true(l.world->leaf[0].ops->has_lanes(l.world->leaf[0].shape));
            look(&l, turned[i], any != 0, MORE_PACKETS, false, false);
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
            assert_true(l.world->leaf[0].ops->has_lanes(l.world->leaf[0].shape));
            look(&l, same_bits[i], any != 0, MORE_PACKETS, false, true);
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
            assert_true(l.world->leaf[0].ops->has_lanes(l.world->leaf[0].shape));
            look(&l, same_hits[i], any != 0, PACKETS, false, !any);
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
                random_rays(&s, false, &rays);
                struct ray r = lane(&rays, 0);
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

// Of which simple solids cut something off, or clip it (trace/packet_carve.h).
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
        for (int n = 0; n < MORE_PACKETS; n++) {
            struct shape_rays rays;
            uint8_t dark[8];
            random_rays(&seed, false, &rays);
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
                const struct ray_query q = {lane(&rays, k), 0};
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
        assert_true(met > MORE_PACKETS / 4);
        assert_true(grazing < met / 50);
        unload(&l);
    }
    ray_batch_free(batch);
    hit_batch_free(hits);
}

// What intervals know of a bounded polynomial when it is read.
static void boxes_hold_bounded_polynomials(void **state)
{
    (void)state;
    static const char *const bounded[] = {
        "polynomial { 2, xyz(2,0,0): 1, xyz(0,2,0): 4, xyz(0,0,2): 1, xyz(1,0,0): -.8, "
        "xyz(0,0,0): -.2 }",
        "quartic { <1,0,0,0,2,0,0,2,0,-1.3, 0,0,0,0,0,0,0,0,0,0, 1,0,0,2,0,.82,0,0,0,0, "
        "1,0,-1.3,0,.1681> }",
        "polynomial { 4, xyz(4,0,0): 1, xyz(2,2,0): -1, xyz(0,4,0): 1, xyz(0,0,4): 1, "
        "xyz(1,1,1): .3, xyz(0,0,1): -.2, xyz(0,0,0): -.01 }",
        "polynomial { 34, xyz(34,0,0): 1, xyz(0,34,0): 1, xyz(0,0,34): 1, xyz(1,0,0): "
        "-.2, xyz(0,0,0): -.1 }",
    };
    uint64_t s = 11;
    for (size_t n = 0; n < sizeof bounded / sizeof *bounded; n++) {
        struct loaded l;
        load(&l, "%s", bounded[n]);
        const struct leaf *leaf = &l.world->leaf[0];
        const struct aabb box = leaf->ops->bounds(leaf->shape);
        int in = 0;
        assert_true(aabb_is_finite(box));
        assert_true(box.max.x - box.min.x < 4);
        for (int i = 0; i < 20000; i++) {
            const struct vec3 p =
                vec3(4 * unit(&s) - 2, 4 * unit(&s) - 2, 4 * unit(&s) - 2);
            if (!leaf->ops->inside(leaf->shape, p))
                continue;
            in++;
            assert_true(p.x >= box.min.x && p.y >= box.min.y && p.z >= box.min.z &&
                        p.x <= box.max.x && p.y <= box.max.y && p.z <= box.max.z);
        }
        assert_true(in > 20);
        unload(&l);
    }
}

// A blob of many components, which it finds by a tree, against the sum of all of them.
static void many_components_are_all_found(void **state)
{
    (void)state;
    enum { MANY = 400 };
    static char text[64 * MANY];
    static double ball[MANY][5];
    uint64_t s = 23;
    size_t n = (size_t)snprintf(text, sizeof text, "blob { threshold .4");
    for (int i = 0; i < MANY; i++) {
        for (int k = 0; k < 3; k++)
            ball[i][k] = round(2e4 * unit(&s) - 1e4) / 1e4;
        ball[i][3] = round(1e3 * (.05 + .15 * unit(&s))) / 1e3;
        ball[i][4] = unit(&s) < .2 ? -.5 : 1;
        n += (size_t)snprintf(text + n, sizeof text - n,
                              " sphere { <%.4f, %.4f, %.4f>, %.3f, %.1f }", ball[i][0],
                              ball[i][1], ball[i][2], ball[i][3], ball[i][4]);
    }
    struct loaded l;
    load(&l, "%s }", text);
    const struct leaf *leaf = &l.world->leaf[0];
    int in = 0;
    for (int i = 0; i < 20000; i++) {
        const struct vec3 p =
            vec3(2.4 * unit(&s) - 1.2, 2.4 * unit(&s) - 1.2, 2.4 * unit(&s) - 1.2);
        double sum = 0;
        for (int k = 0; k < MANY; k++) {
            const struct vec3 v = vec3_sub(p, vec3(ball[k][0], ball[k][1], ball[k][2]));
            const double q = 1 - vec3_dot(v, v) / (ball[k][3] * ball[k][3]);
            sum += q > 0 ? ball[k][4] * q * q : 0;
        }
        if (fabs(sum - .4) < 1e-12)
            continue;
        in += sum > .4;
        assert_int_equal(leaf->ops->inside(leaf->shape, p), sum > .4);
    }
    assert_true(in > 1000);
    look(&l, "a blob of 400 components", false, MORE_PACKETS, false, false);
    look(&l, "a blob of 400 components", true, MORE_PACKETS, false, false);
    unload(&l);
}

// x^34 + y^34 + z^34 = .2 x + 1: expanded along a ray, terms of 1e9 cancel.
static double value_34(const struct ray *r, double t)
{
    const struct vec3 p = vec3_mad(r->o, t, r->d);
    return pow(p.x, 34) + pow(p.y, 34) + pow(p.z, 34) - .2 * p.x - 1;
}

static void high_orders_are_met_where_they_are(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, "polynomial { 35, xyz(34,0,0): 1, xyz(0,34,0): 1, xyz(0,0,34): 1, "
             "xyz(1,0,0): -.2, xyz(0,0,0): -1 }");
    const struct leaf *leaf = &l.world->leaf[0];
    const struct shape_kernels *k = packet_kernels_choose()->shapes;
    uint64_t s = 5;
    int hits = 0;
    for (int n = 0; n < 200; n++) {
        struct shape_rays rays;
        struct shape_hits out = {.cancel = NULL};
        for (int i = 0; i < 8; i++) {
            for (int a = 0; a < 3; a++) {
                rays.o[a][i] = 8 * unit(&s) - 4;
                rays.d[a][i] = 1.6 * unit(&s) - .8 - rays.o[a][i];
            }
            rays.t_min[i] = 0;
            rays.t_max[i] = 1; // in the set
        }
        unsigned outside = 0;
        for (int i = 0; i < 8; i++) {
            const struct ray r = lane(&rays, i);
            outside |= (unsigned)(value_34(&r, 0) > 0) << i;
        }
        const unsigned met =
            leaf->ops->closest8(k, leaf->shape, &rays, outside, false, &out);
        assert_int_equal(met, outside);
        for (int i = 0; i < 8; i++) {
            if (!(met >> i & 1))
                continue;
            const struct ray r = lane(&rays, i);
            double lo = 0, hi = 1; // convex: one crossing
            for (int b = 0; b < 60; b++) {
                const double t = .5 * (lo + hi);
                *(value_34(&r, t) > 0 ? &lo : &hi) = t;
            }
            assert_true(fabs(out.t[i] - lo) <= out.dt[i] + 1e-15);
            assert_true(out.dt[i] < 1e-4);
            hits++;
        }
    }
    assert_true(hits > 1000);
    unload(&l);
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
        cmocka_unit_test(boxes_hold_bounded_polynomials),
        cmocka_unit_test(many_components_are_all_found),
        cmocka_unit_test(high_orders_are_met_where_they_are),
        cmocka_unit_test(carved_shapes_are_as_the_sweep_has_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
