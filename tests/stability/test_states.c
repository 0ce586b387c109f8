// Every solid's crossings against its own `inside`: along any line they ascend, alternate,
// and between two of them the points are inside or outside as they say. LAMBERT_ROUNDS in
// the environment searches on.
#include "test.h"

#include <stdlib.h>

#include "loaded.h"

static const char *const solids[] = {
    "box { <-1, -.5, -1.5>, <1, .7, 1> }",
    "sphere { <.2, .1, 0>, 1.1 }",
    "cylinder { <-.5, -1, 0>, <.5, 1, .3>, .6 }",
    "cone { <0, -1, 0>, 1, <0, 1, .2>, 0 }",
    "cone { <0, -1, 0>, .3, <.2, 1, 0>, .9 }",
    "torus { 1, .3 }",
    "torus { 1, .3 rotate 30*x scale <1, 2, .5> }",
    "torus { 1, .001 }",
    "plane { <1, 2, -1>, .3 }",
    "quadric { <1, 1, -1>, 0, 0, -.5 }",
    "quadric { <1, 2, 3>, <.1, .2, -.3>, <.1, 0, .2>, -1 }",
    "quadric { <1, 0, 1>, 0, -y, -.5 }",
    "superellipsoid { <.5, .3> }",
    "superellipsoid { <1.5, .7> }",
    "prism { -1, 1, 6, <-1, -1>, <1, -.8>, <.3, 0>, <1, 1>, <-.8, .9>, <-1, -1> }",
    "prism { cubic_spline -1, 1, 8, <-1, -1>, <1, -1>, <1, 0>, <.5, 1>, <-1, 1>, <-1, "
    "0>, "
    "<1, -1>, <1, 0> }",
    "sor { 6, <0, -1.2>, <.6, -1>, <.9, -.3>, <.4, .3>, <.5, 1>, <.5, 1.4> }",
    "lathe { linear_spline 5, <.2, -1>, <1, -.5>, <.5, .2>, <.9, .8>, <.2, 1> }",
    "lathe { cubic_spline 7, <0, -1.5>, <0, -1>, <1, -.6>, <.4, 0>, <.8, .7>, <0, 1>, "
    "<0, 2> }",
    "blob { threshold .5 sphere { <-.5, 0, 0>, 1, 1 } sphere { <.5, .2, 0>, 1, 1 } "
    "cylinder { <0, -1, 0>, <0, 1, .5>, .6, .8 } }",
    "quartic { <1, 0, 0, 0, 2, 0, 0, 2, 0, -1.5, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, "
    "2, 0, "
    "-1.5, 0, 0, 0, 0, 1, 0, -1.5, 0, .2> }",
    "cubic { <1, 0, 0, 1, 0, 0, 0, 0, 0, -1, 1, 0, 0, 1, 0, 0, -1, 0, 0, .1> }",
};

static double unit(uint64_t *s)
{
    *s = *s * 6364136223846793005u + 1442695040888963407u;
    return ((double)(*s >> 33) + .5) / 2147483648.;
}

// Arbitrary lines; lines along an axis, often through round numbers; and lines that lean
// off an axis by a little, down to less than the rounding.
static struct ray random_line(uint64_t *s)
{
    struct ray r = {.t_min = -HUGE_VAL, .t_max = HUGE_VAL};
    double o[3], d[3];
    const int kind = (int)(3 * unit(s));
    for (int k = 0; k < 3; k++) {
        o[k] = 4 * unit(s) - 2;
        d[k] = 2 * unit(s) - 1;
        if (kind && unit(s) < .6)
            o[k] = .25 * floor(4 * o[k]);
    }
    if (kind) {
        const int axis = (int)(3 * unit(s));
        const double lean = kind == 1 ? 0 : pow(10, -2 - 16 * unit(s));
        for (int k = 0; k < 3; k++)
            d[k] = k == axis ? 1 : lean * d[k];
        o[axis] -= 3;
    }
    r.o = vec3(o[0], o[1], o[2]);
    r.d = vec3_normalize(vec3(d[0], d[1], d[2]));
    return r;
}

// Whether p or a point very near it is inside (outside).
static bool is_state_near(const struct leaf *l, struct vec3 p, bool want)
{
    static const double near = 1e-7;
    for (int k = 0; k < 27; k++) {
        const struct vec3 by = vec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
        const struct vec3 q = vec3_mad(p, near, by);
        if (l->ops->inside(l->shape, transform_inverse_point(l->transform, q)) == want)
            return true;
    }
    return false;
}

// What is wrong with the crossings of leaf l, or NULL.
static const char *fault(const struct leaf *l, const struct ray *r,
                         const struct boundary_list *b, double *where)
{
    for (uint32_t i = 0; i < b->count; i++) {
        const struct boundary *at = &b->at[i];
        *where = at->t;
        if (!isfinite(at->t) || !(at->dt >= 0) || !isfinite(at->dt))
            return "not finite";
        if (i && at->t < at[-1].t)
            return "not ascending";
        if (i && at->crossing == at[-1].crossing)
            return "not alternating";
    }
    // Points well away from the crossings, and before and after all of them.
    for (uint32_t i = 0; i <= b->count && b->count > 0; i++) {
        const double from = i ? b->at[i - 1].t : b->at[0].t - 1;
        const double to = i < b->count ? b->at[i].t : from + 1;
        const double margin =
            1e-6 + 4 * fmax(i ? b->at[i - 1].dt : 0, i < b->count ? b->at[i].dt : 0);
        if (to - from < 4 * margin)
            continue;
        const bool want =
            i ? b->at[i - 1].crossing == CROSS_ENTER : b->at[0].crossing == CROSS_EXIT;
        for (int k = 1; k < 4; k++) {
            *where = from + margin + (to - from - 2 * margin) * k / 4;
            const struct vec3 p = ray_at(r, *where);
            if (!is_state_near(l, p, want))
                return want ? "outside where it should be inside"
                            : "inside where it should be outside";
        }
    }
    return NULL;
}

static bool is_solid_sound(const char *text, int rays, bool *met)
{
    struct loaded l;
    load(&l, "%s", text);
    uint64_t s = 12345;
    struct boundary_list b = {0};
    bool sound = true;
    const struct leaf *leaf = &l.world->leaf[0];
    for (int i = 0; i < rays && sound; i++) {
        const struct ray r = random_line(&s);
        const struct ray local = transform_inverse_ray(leaf->transform, &r);
        b.count = 0;
        leaf->ops->intersect(leaf->shape, leaf->transform->identity ? &r : &local, &b);
        double where = 0;
        const char *why = fault(leaf, &r, &b, &where);
        if (why) {
            print_error("%.60s, line %d <%.17g,%.17g,%.17g> -> <%.17g,%.17g,%.17g>: %s "
                        "at %.17g\n",
                        text, i, r.o.x, r.o.y, r.o.z, r.d.x, r.d.y, r.d.z, why, where);
            for (uint32_t k = 0; k < b.count; k++)
                print_error("  t %.17g +- %g, %d\n", b.at[k].t, b.at[k].dt,
                            b.at[k].crossing);
            sound = false;
        }
        *met |= b.count > 0;
    }
    boundary_list_free(&b);
    unload(&l);
    return sound;
}

static void crossings_agree_with_inside(void **state)
{
    (void)state;
    const char *v = getenv("LAMBERT_ROUNDS");
    const int rays = v ? atoi(v) : 4000;
    int failed = 0;
    for (size_t i = 0; i < sizeof solids / sizeof solids[0]; i++) {
        bool met = false;
        failed += !is_solid_sound(solids[i], rays, &met);
        assert_true(met);
    }
    assert_int_equal(failed, 0);
}

// A line down the rim of a lathe once ran on inside to the end of the next segment.
static void a_line_along_the_rim(void **state)
{
    (void)state;
    struct loaded l;
    load(&l,
         "lathe { linear_spline 5, <.2, -1>, <1, -.5>, <.5, .2>, <.9, .8>, <.2, 1> }");
    const struct leaf *leaf = &l.world->leaf[0];
    const struct ray r = {{1, -1.412340416572988, 0},
                          {-8.0510312734597764e-19, 1, 1.1138772163623738e-18},
                          -HUGE_VAL,
                          HUGE_VAL};
    struct boundary_list b = {0};
    double where = 0;
    leaf->ops->intersect(leaf->shape, &r, &b);
    assert_null(fault(leaf, &r, &b, &where));
    boundary_list_free(&b);
    unload(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crossings_agree_with_inside),
        cmocka_unit_test(a_line_along_the_rim),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
