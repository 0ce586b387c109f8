// What every shape promises (scene/shape.h), tried on random rays. A shape in shapes.def
// without a sample here fails.
#include "test.h"

#include "base/arena.h"
#include "base/diag.h"
#include "fake_args.h"
#include "math/gamma.h"
#include "scene/shape.h"

struct sample {
    const char *keyword, *text;
};

#define CUBE_FACES                                                                       \
    "face_indices { 12, <0,1,2>, <1,3,2>, <4,6,5>, <5,6,7>, <0,4,1>, <1,4,5>, "          \
    "<2,3,6>, <3,7,6>, <0,2,4>, <2,6,4>, <1,5,3>, <3,5,7> }"
#define CUBE                                                                             \
    "vertex_vectors { 8, <-1,-1,-1>, <1,-1,-1>, <-1,1,-1>, <1,1,-1>, "                   \
    "<-1,-1,1>, <1,-1,1>, <-1,1,1>, <1,1,1> } " CUBE_FACES

static const struct sample samples[] = {
    {"sphere", "<.1,.2,.3>, 1"},
    {"box", "<-1,-.5,-.2>, <.7,.8,.9>"},
    {"plane", "<.1,1,.2>, .3"},
    {"cylinder", "<-.5,-.2,0>, <.6,.7,.8>, .4"},
    {"cylinder", "<0,-1,0>, <0,1,0>, .5 open"},
    {"cone", "<0,-1,0>, 1, <.2,1,.1>, .25"},
    {"cone", "<0,-1,0>, 0, <0,1,0>, 1"},
    {"disc", "<.1,0,0>, <0,1,.2>, 1, .3"},
    {"torus", "1, .25"},
    {"torus", ".5, .5"},
    {"torus", ".4, .7"},
    {"quadric", "<1,2,3>, <.1,.2,.3>, <.4,.5,.6>, -1"},
    {"quadric", "<1,1,-1>, <0,0,0>, <0,0,0>, -.1"},
    {"quadric", "<1,0,1>, <0,0,0>, <0,-1,0>, 0"},
    {"triangle", "<-1,0,0>, <1,0,.2>, <0,1,0>"},
    {"smooth_triangle", "<-1,0,0>, <-.2,0,-1>, <1,0,0>, <.2,0,-1>, <0,1,0>, <0,.2,-1>"},
    {"poly", "2, <1,0,0,0,1,0,0,1,0,-1>"},
    {"cubic", "<1,0,0,0, 0,0,0, 0,0,0, 1,0,0, 0,0,0, 1,0,0,-.5>"},
    {"quartic", "<1,0,0,0, 0,0,0, 0,0,0, 0,0,0,0,0,0,0,0,0,0, 1,0,0,0, 0,0,0, 0,0,0, "
                "1,0,0,0,-1>"},
    {"polynomial", "3, xyz(2,0,0): 1, xyz(0,2,0): 1, xyz(0,1,2): .5, xyz(0,0,2): 1, "
                   "xyz(0,0,0): -1"},
    {"ovus", "1, .5"},
    {"ovus", ".8, 1.2"},
    {"ovus", ".3, 1"},
    {"superellipsoid", "<.5,.5>"},
    {"blob", "threshold .5 sphere { <-.4,0,0>, 1, 1 } sphere { <.4,0,0>, 1, 1 }"},
    {"lathe", "linear_spline 5, <0,-.5>, <.5,-.5>, <.7,.2>, <0,.5>, <0,-.5>"},
    {"sor", "6, <.2,-1>, <.5,-.5>, <.8,0>, <.4,.5>, <.6,1>, <.6,1.5>"},
    {"prism", "-1, 1, 5, <-1,-1>, <1,-1>, <.5,.8>, <-.7,1>, <-1,-1>"},
    {"prism", "conic_sweep .5, 1, 5, <-1,-1>, <1,-1>, <.5,.8>, <-.7,1>, <-1,-1>"},
    {"prism", "bezier_spline conic_sweep -.7, .9, 8, <-1,0>, <-1,-1>, <1,-1>, <1,0>, "
              "<1,0>, <1,1>, <-1,1>, <-1,0>"},
    {"mesh", "triangle { <-1,0,0>, <1,0,0>, <0,1,0> } triangle { <-1,0,0>, <1,0,0>, "
             "<0,0,1> }"},
    {"mesh2", CUBE " inside_vector <.3,1,.2>"},
    {"polygon", "10, <-1,-1,0>, <1,-1,0>, <1,1,0>, <-1,1,0>, <-1,-1,0>, <-.5,-.5,0>, "
                "<.5,-.5,0>, <.5,.5,0>, <-.5,.5,0>, <-.5,-.5,0>"},
    {"julia_fractal", "<-.1, .1, .2, 0> quaternion sqr max_iteration 4 precision 60"},
    {"julia_fractal", "<-.1, .2, .1, -.1> hypercomplex cube max_iteration 4 precision 60 "
                      "slice <.1, .2, .3, 1>, .1"},
    {"height_field", ""},
    {"height_field", "smooth water_level .5"},
    {"sphere_sweep", "linear_spline 2, <-1,0,0>, .5, <1,0,0>, .25"},
    {"sphere_sweep",
     "linear_spline 3, <-.1,0,0>, 1, <.1,0,0>, 1, <1,.5,0>, 0 tolerance .1"},
    {"sphere_sweep", "cubic_spline 5, <-1.5,-1,0>, .2, <-.6,-.6,0>, .3, <0,.6,0>, .2, "
                     "<.7,-.6,0>, .1, <1.5,-1,0>, .2"},
    {"sphere_sweep", "b_spline 6, <-1.5,-1,0>, .2, <-.6,-.6,0>, .3, <0,.6,0>, .4, "
                     "<.7,-.6,0>, .1, <1.5,-1,0>, .2, <-1,-1,1>, .6"},
    {"bicubic_patch", "type 1 flatness .01 u_steps 3 v_steps 3, "
                      "<-1,-1,.2>, <-.3,-1,1>, <.3,-1,-1>, <1,-1,.1>, "
                      "<-1,-.3,0>, <-.3,-.3,2>, <.3,-.3,-2>, <1,-.3,.3>, "
                      "<-1,.3,-.5>, <-.3,.3,1>, <.3,.3,-1>, <1,.3,0>, "
                      "<-1,1,0>, <-.3,1,1>, <.3,1,.5>, <1,1,.2>"},
    {"bicubic_patch", "type 0 <0,0,0>, <0,0,0>, <0,0,0>, <0,0,0>, " // a collapsed edge
                      "<.3,0,0>, <.3,0,.2>, <.2,0,.3>, <0,0,.3>, "
                      "<.6,0,0>, <.6,.1,.4>, <.4,0,.6>, <0,0,.6>, "
                      "<.9,0,0>, <.9,0,.6>, <.6,0,.9>, <0,0,.9>"},
    {"isosurface", "function { x * x + y * y + z * z - 0.8 }"},
    {"isosurface", "function { square(sqrt(x * x + z * z) - 0.7) + y * y - 0.04 }"},
    {"isosurface",
     "function { sin(6 * x) * cos(6 * y) + sin(6 * y) * cos(6 * z) + sin(6 * "
     "z) * cos(6 * x) } contained_by { sphere { <0, 0, 0>, 1 } }"},
    {"isosurface", "function { larger(fabs(x), larger(fabs(y), fabs(z))) - 0.7 }"},
    {"isosurface", "function { y - 0.25 * sin(4 * x) } open"},
    {"parametric", "function { cos(x) * cos(y) } function { sin(y) } function { sin(x) * "
                   "cos(y) } <0, -1.57079632679>, <6.28318530718, 1.57079632679>"},
    {"parametric",
     "function { x } function { 0.3 * sin(5 * x) * cos(4 * y) } function { y } "
     "<-1, -1>, <1, 1> precompute 18"},
    {"text", NULL}, // needs a font file
};

static const size_t sample_count = sizeof samples / sizeof samples[0];

enum { RAYS = 3000 };

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static struct vec3 in_cube(uint64_t *seed)
{
    const double x = uniform(seed), y = uniform(seed), z = uniform(seed);
    return vec3(2 * x - 1, 2 * y - 1, 2 * z - 1);
}

static struct ray random_ray(uint64_t *seed)
{
    const struct vec3 through = vec3_scale(1.2, in_cube(seed));
    const struct vec3 d = vec3_normalize(in_cube(seed));
    return (struct ray){vec3_mad(through, -5, d), d, 0, INFINITY};
}

static void quiet(void *user, const struct diag *d)
{
    (void)user;
    (void)d;
}

static const struct shape_ops *make(struct arena *a, const struct sample *s, void **shape)
{
    struct diag_sink sink = {.emit = quiet};
    const struct shape_ops *ops = shape_find(s->keyword, strlen(s->keyword));
    if (!ops)
        fail_msg("no shape '%s'", s->keyword);
    *shape = arena_alloc(a, ops->size);
    struct args *args = fake_args_new(a, &sink, s->text);
    if (!ops->build(*shape, args) || fake_args_failed(args))
        fail_msg("%s { %s } does not build", s->keyword, s->text);
    return ops;
}

static void every_shape_has_a_sample(void **state)
{
    (void)state;
    for (size_t i = 0; i < shape_count; i++) {
        bool found = false;
        for (size_t k = 0; k < sample_count; k++)
            found |= strcmp(samples[k].keyword, shape_table[i]->keyword) == 0;
        if (!found)
            fail_msg("shapes.def has '%s', this test has no sample of it",
                     shape_table[i]->keyword);
    }
}

// The state on either side of crossings that lie apart is what `inside` says.
static void check_states(const struct sample *s, const struct shape_ops *ops,
                         const void *shape, const struct ray *r,
                         const struct boundary_list *l)
{
    if (!l->count) {
        if ((ops->flags & SHAPE_BOUNDED) && ops->inside(shape, r->o))
            fail_msg("%s: inside, but the line meets nothing", s->keyword);
        return;
    }
    bool in = l->at[0].crossing == CROSS_EXIT;
    for (uint32_t i = 0; i <= l->count; i++) {
        const double from = i ? l->at[i - 1].t : l->at[0].t - 1;
        const double to = i < l->count ? l->at[i].t : from + 1;
        if (i)
            in = l->at[i - 1].crossing == CROSS_ENTER;
        if (to - from > 1e-4 &&
            ops->inside(shape, ray_at(r, from + 0.5 * (to - from))) != in)
            fail_msg(
                "%s: between t = %.17g and %.17g inside() is not %d (o = %.17g %.17g "
                "%.17g, d = %.17g %.17g %.17g)",
                s->keyword, from, to, in, r->o.x, r->o.y, r->o.z, r->d.x, r->d.y, r->d.z);
    }
}

static void check_list(const struct sample *s, const struct shape_ops *ops,
                       const void *shape, const struct ray *r,
                       const struct boundary_list *l)
{
    const bool solid = shape_is_solid(ops, shape);
    const struct aabb box = ops->bounds(shape);
    for (uint32_t i = 0; i < l->count; i++) {
        const struct boundary *b = &l->at[i];
        if (!(b->dt >= 0) || !isfinite(b->t))
            fail_msg("%s: t = %g, dt = %g", s->keyword, b->t, b->dt);
        if (i && b->t < l->at[i - 1].t)
            fail_msg("%s: crossings out of order", s->keyword);
        if ((b->crossing == CROSS_TOUCH) == solid ||
            (i && solid && b->crossing == l->at[i - 1].crossing))
            fail_msg("%s: crossing %u is of kind %d", s->keyword, i, b->crossing);
        struct surface_point at = {0};
        const struct vec3 p = ray_at(r, b->t);
        ops->surface(shape, b, p, &at);
        if (!(fabs(vec3_length(at.ng) - 1) < 1e-12) ||
            !(fabs(vec3_length(at.ns) - 1) < 1e-12))
            fail_msg("%s: a normal is not of unit length", s->keyword);
        const double off = vec3_length(vec3_sub(at.p, p));
        if (!(off <= 1e-6 * (1 + vec3_max_abs(p))))
            fail_msg("%s: the surface is %g away from the crossing", s->keyword, off);
        const double up = vec3_dot(at.ng, r->d);
        if (solid && b->drawn && (b->crossing == CROSS_ENTER ? up > 1e-5 : up < -1e-5))
            fail_msg("%s: the normal of crossing %u points inwards (%g)", s->keyword, i,
                     up);
        const double slack = 1e-9 * (1 + vec3_max_abs(p));
        if (!(p.x >= box.min.x - slack && p.x <= box.max.x + slack &&
              p.y >= box.min.y - slack && p.y <= box.max.y + slack &&
              p.z >= box.min.z - slack && p.z <= box.max.z + slack))
            fail_msg("%s: a crossing lies outside the bounds", s->keyword);
    }
    if (solid)
        check_states(s, ops, shape, r, l);
}

static void crossings_hold_their_promises(void **state)
{
    (void)state;
    struct boundary_list l = {0};
    for (size_t i = 0; i < sample_count; i++) {
        if (!samples[i].text)
            continue;
        struct arena *a = arena_new(1 << 16);
        void *shape;
        const struct shape_ops *ops = make(a, &samples[i], &shape);
        uint64_t seed = 17 + i;
        uint32_t met = 0;
        for (int k = 0; k < RAYS; k++) {
            const struct ray r = random_ray(&seed);
            l.count = 0;
            ops->intersect(shape, &r, &l);
            check_list(&samples[i], ops, shape, &r, &l);
            met += l.count > 0;
        }
        if (met < RAYS / 100)
            fail_msg("%s: only %u of %d rays meet it", samples[i].keyword, met, RAYS);
        arena_free(a);
    }
    boundary_list_free(&l);
}

static bool apart(const struct boundary_list *l)
{
    for (uint32_t i = 1; i < l->count; i++)
        if (l->at[i].t - l->at[i - 1].t < 1e-3)
            return false;
    return l->count > 0;
}

// A shape that absorbs a transform meets the moved ray at the same t.
static void check_moved(const struct sample *s, const struct transform *t,
                        double tolerance)
{
    struct arena *a = arena_new(1 << 16);
    void *shape, *moved;
    const struct shape_ops *ops = make(a, s, &shape);
    make(a, s, &moved);
    struct boundary_list l = {0}, m = {0};
    uint64_t seed = 99;
    for (int k = 0; ops->absorb && ops->absorb(moved, t) && k < 1; k++)
        for (int n = 0; n < RAYS / 4; n++) {
            const struct ray r = random_ray(&seed);
            const struct ray q = {transform_point(t, r.o), transform_vector(t, r.d), 0,
                                  INFINITY};
            l.count = m.count = 0;
            ops->intersect(shape, &r, &l);
            ops->intersect(moved, &q, &m);
            if (!apart(&l))
                continue;
            bool same = l.count == m.count;
            for (uint32_t i = 0; same && i < l.count; i++)
                same = fabs(l.at[i].t - m.at[i].t) <= tolerance * (1 + fabs(l.at[i].t));
            if (!same)
                fail_msg("%s: moved, it is met elsewhere", s->keyword);
        }
    boundary_list_free(&l);
    boundary_list_free(&m);
    arena_free(a);
}

static void absorbed_transforms_change_nothing(void **state)
{
    (void)state;
    const struct transform cases[] = {
        transform_rotate(vec3(10, 20, 30)),
        transform_scale(vec3(1e-5, 1e-5, 1e-5)),
        transform_scale(vec3(1e5, 1e5, 1e5)),
        transform_scale(vec3(-2, 2, 2)),
        transform_translate(vec3(1e6, -1e6, 1e6)),
    };
    const double tolerance[] = {1e-9, 1e-9, 1e-9, 1e-9, 1e-5};
    for (size_t i = 0; i < sample_count; i++)
        for (size_t k = 0; samples[i].text && k < sizeof cases / sizeof cases[0]; k++)
            check_moved(&samples[i], &cases[k], tolerance[k]);
}

// Rays aimed at the corners and edges of a closed mesh: parity stays even, nothing
// slips through, and the nearest crossing is the first of all.
static void mesh_is_watertight(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    static const struct sample cube = {"mesh2", CUBE " inside_vector <0,1,0>"};
    void *shape;
    const struct shape_ops *ops = make(a, &cube, &shape);
    struct boundary_list l = {0};
    uint64_t seed = 5;
    for (int k = 0; k < RAYS; k++) {
        // A point on an edge of a triangle, a diagonal of a face, or a corner.
        const double e = k % 7 == 0 ? 1 : 2 * uniform(&seed) - 1;
        const struct vec3 target = k % 2 ? vec3(e, e, -1) : vec3(1, e, -1);
        const struct vec3 inner = vec3_scale(0.9, in_cube(&seed));
        const struct vec3 d = vec3_sub(target, inner);
        const struct ray r = {inner, d, 0, INFINITY};
        l.count = 0;
        ops->intersect(shape, &r, &l);
        assert_int_equal(l.count % 2, 0);
        assert_true(l.count >= 2);
        struct boundary b;
        assert_true(ops->closest(shape, &r, &b));
        assert_near(b.t, 1, 1e-9);
    }
    assert_true(ops->inside(shape, vec3(0, 0, 0)));
    assert_true(ops->inside(shape, vec3(.5, -.5, .5))); // below a diagonal
    assert_false(ops->inside(shape, vec3(0, -2, 0)));
    assert_false(ops->inside(shape, vec3(1.5, 0, 0)));
    boundary_list_free(&l);
    arena_free(a);
}

static const struct shape_ops *make_slanted_cube(struct arena *a, uint64_t *seed,
                                                 struct vec3 corner[8], void **shape)
{
    const struct vec3 axis[3] = {in_cube(seed), in_cube(seed), in_cube(seed)};
    struct sample s = {"mesh2", "vertex_vectors { 8"};
    for (int i = 0; i < 8; i++) {
        corner[i] = vec3(.1, .2, .3);
        for (int k = 0; k < 3; k++)
            corner[i] = vec3_mad(corner[i], i >> k & 1 ? 1 : -1, axis[k]);
        s.text = arena_printf(a, "%s, <%.17g, %.17g, %.17g>", s.text, corner[i].x,
                              corner[i].y, corner[i].z);
    }
    s.text = arena_printf(a, "%s } %s inside_vector <0,1,0>", s.text, CUBE_FACES);
    return make(a, &s, shape);
}

// How far apart corners are along the largest component of d, in lengths of d.
static double depth_along(const struct vec3 corner[8], struct vec3 d)
{
    const int axis = fabs(d.x) > fabs(d.y) ? (fabs(d.x) > fabs(d.z) ? 0 : 2)
                                           : (fabs(d.y) > fabs(d.z) ? 1 : 2);
    double lo = HUGE_VAL, hi = -HUGE_VAL;
    for (int i = 0; i < 8; i++) {
        const double t = vec3_axis(corner[i], axis) / vec3_axis(d, axis);
        lo = fmin(lo, t);
        hi = fmax(hi, t);
    }
    return hi - lo;
}

// The faces beside such an edge are slivers to the ray. Where it meets them is not known,
// but it is in them: nothing far behind the mesh is swallowed.
static void rays_along_edges_of_a_mesh_cross_at_them(void **state)
{
    (void)state;
    struct boundary_list l = {0};
    uint64_t seed = 15;
    for (int k = 0; k < 200; k++) {
        struct arena *a = arena_new(1 << 14);
        struct vec3 corner[8];
        void *shape;
        const struct shape_ops *ops = make_slanted_cube(a, &seed, corner, &shape);
        for (int i = 0; i < 8; i++)
            for (int axis = 0; axis < 3; axis++) {
                const struct vec3 d = vec3_sub(corner[i ^ (1 << axis)], corner[i]);
                const struct ray r = {vec3_sub(corner[i], d), d, -INFINITY, INFINITY};
                const double depth = depth_along(corner, d);
                l.count = 0;
                ops->intersect(shape, &r, &l);
                assert_int_equal(l.count % 2, 0);
                for (uint32_t n = 0; n < l.count; n++) {
                    const struct boundary *b = &l.at[n];
                    assert_int_equal(b->crossing, n % 2 ? CROSS_EXIT : CROSS_ENTER);
                    assert_true(b->t > 1 - 1e-6 && b->t < 2 + 1e-6);
                    assert_true(b->dt < depth + 1e-6);
                }
            }
        arena_free(a);
    }
    boundary_list_free(&l);
}

// The second loop is a hole; a ray through the height of a corner counts it once.
static void polygon_has_a_hole(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    const struct sample *s = samples;
    while (strcmp(s->keyword, "polygon") != 0)
        s++;
    void *shape;
    const struct shape_ops *ops = make(a, s, &shape);
    static const struct {
        double x, y;
        uint32_t count;
    } rows[] = {{0, 0, 0},     {.75, 0, 1},  {-.75, .5, 1},
                {.75, -.5, 1}, {1.5, .5, 0}, {0, .75, 1}};
    struct boundary_list l = {0};
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const struct ray r = {vec3(rows[i].x, rows[i].y, -5), vec3(0, 0, 1), 0, INFINITY};
        l.count = 0;
        ops->intersect(shape, &r, &l);
        assert_int_equal(l.count, rows[i].count);
        if (l.count)
            assert_near(l.at[0].t, 5, 1e-14);
    }
    boundary_list_free(&l);
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_has_a_sample),
        cmocka_unit_test(crossings_hold_their_promises),
        cmocka_unit_test(absorbed_transforms_change_nothing),
        cmocka_unit_test(mesh_is_watertight),
        cmocka_unit_test(rays_along_edges_of_a_mesh_cross_at_them),
        cmocka_unit_test(polygon_has_a_hole),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
