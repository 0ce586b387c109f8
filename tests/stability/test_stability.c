// Cases in which ray tracers fail, with the true answers (doc/accuracy.md). Each object
// is written as a scene text, traced by one ray, and traced again with the whole case
// scaled by 1e-5 and 1e5 and moved by 1e6: the answer must scale and move with it.
#include "test.h"

#include <stdbool.h>

#include "cases.h"
#include "loaded.h"

static bool matches(const struct ray_case *c, double scale, double move)
{
    struct loaded l;
    struct interaction at = {.p = {0, 0, 0}};
    load(&l, "#declare Thing = %s\nobject { Thing scale %.17g translate %.17g }\n",
         c->object, scale, move);
    const struct vec3 shift = vec3(move, move, move);
    const struct hit h = shoot(&l, vec3_add(vec3_scale(scale, c->o), shift), c->d, &at);
    unload(&l);
    const double want = c->tolerance == -1 ? torus_crest(c) : c->t;
    if (want == MISS)
        return !isfinite(h.b.t);
    const double tolerance =
        scale * (c->tolerance == -1 ? 1e-8 : c->tolerance) + 64 * 0x1p-52 * move;
    if (!(fabs(h.b.t - scale * want) <= tolerance))
        return false;
    if (!(fabs(vec3_length(at.ng) - 1) < 1e-9)) // finite and unit, also at an apex
        return false;
    const double lost = move > 0 ? 1e-3 : 1e-6;
    return vec3_dot(c->n, c->n) == 0 || vec3_length(vec3_sub(at.ng, c->n)) < lost;
}

// All cases that bear it; says which fail.
static void check_all(double scale, double move, unsigned without)
{
    int failed = 0;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        if (!(cases[i].flags & without) && !matches(&cases[i], scale, move)) {
            print_error("%s (scale %g, move %g)\n", cases[i].name, scale, move);
            failed++;
        }
    assert_int_equal(failed, 0);
}

static void as_written(void **state)
{
    (void)state;
    check_all(1, 0, 0);
}

static void scaled(void **state)
{
    (void)state;
    check_all(1e-5, 0, FIXED);
    check_all(1e5, 0, FIXED);
}

static void moved(void **state)
{
    (void)state;
    check_all(1, 1e6, FIXED | STILL);
}

// T22: all of 400 rays inside the silhouette of a small, far quadric hit.
static void far_quadric_is_whole(void **state)
{
    (void)state;
    static const double far[] = {1e6, 1e7};
    for (int k = 0; k < 2; k++) {
        char text[256];
        struct loaded l;
        snprintf(text, sizeof text, "quadric { 100, 0, 0, -1 translate %g }", far[k]);
        load(&l, "%s", text);
        for (int i = 0; i < 400; i++) {
            const double r = .095 * sqrt((i + .5) / 400), a = 2.399963 * i;
            const struct ray_query q = {
                .ray = {vec3(far[k] + r * cos(a), far[k] + r * sin(a), far[k] - 5),
                        {0, 0, 1},
                        0,
                        HUGE_VAL}};
            assert_near(trace_closest_1(l.world, l.scratch, &q).b.t,
                        5 - sqrt(.01 - r * r), 1e-6);
        }
        unload(&l);
    }
}

// T09: a ray in the contact plane of a cylinder standing on a box gives the same from
// both ends.
static void contact_plane_is_symmetric(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, "merge { box { <-2,-1,-2>, <2,0,2> } cylinder { 0, y, 1 } }");
    struct ray_query q = {.ray = {{-5, 0, .25}, {1, 0, 0}, 0, HUGE_VAL}};
    const struct hit there = trace_closest_1(l.world, l.scratch, &q);
    q.ray = (struct ray){{5, 0, .25}, {-1, 0, 0}, 0, HUGE_VAL};
    const struct hit back = trace_closest_1(l.world, l.scratch, &q);
    assert_true(isfinite(there.b.t) && isfinite(back.b.t));
    assert_near(there.b.t, back.b.t, 1e-12);
    unload(&l);
}

// T31, T34: a sheet close over a floor shadows it at every gap; a secondary ray meets
// what lies 5e-5 ahead and not the surface it leaves.
static void narrow_gaps_are_seen(void **state)
{
    (void)state;
    static const double gaps[] = {5e-5, 1e-4, 5e-4, 9e-4, 2e-3};
    static const double scales[] = {1, 1e-5, 1e5};
    for (int g = 0; g < 5; g++)
        for (int s = 0; s < 3; s++) {
            struct loaded l;
            const double gap = gaps[g] * scales[s];
            load(&l, "plane { y, 0 } disc { %.17g*y, y, %.17g }", gap, scales[s]);
            struct ray_query q = {
                .ray = {vec3_scale(scales[s], vec3(.3, -5, .2)), {0, 1, 0}, 0, HUGE_VAL}};
            const struct hit h = trace_closest_1(l.world, l.scratch, &q);
            struct interaction at;
            trace_interaction(l.world, &q.ray, &h, &at);
            const struct vec3 up = vec3_normalize(vec3(.3, 1, .2));
            q.ray = (struct ray){trace_offset(&at, up), up, 0, 10 * scales[s]};
            assert_true(trace_occluded_1(l.world, l.scratch, &q));
            assert_near(trace_closest_1(l.world, l.scratch, &q).b.t, gap / up.y,
                        1e-3 * gap);
            unload(&l);
        }
}

// T35: no ray that leaves a far ball at an angle meets it again.
static void far_ball_does_not_shadow_itself(void **state)
{
    (void)state;
    struct loaded l;
    load(&l, "sphere { 1e6, 1 }");
    for (int i = 0; i < 2000; i++) {
        const double r = .99 * sqrt((i + .5) / 2000), a = 2.399963 * i;
        struct ray_query q = {.ray = {vec3(1e6 + r * cos(a), 1e6 + r * sin(a), 1e6 - 5),
                                      {0, 0, 1},
                                      0,
                                      HUGE_VAL}};
        const struct hit h = trace_closest_1(l.world, l.scratch, &q);
        assert_true(isfinite(h.b.t));
        struct interaction at;
        trace_interaction(l.world, &q.ray, &h, &at);
        const struct vec3 light = vec3_normalize(vec3(1, 1, -1));
        if (vec3_dot(at.ng, light) < .05)
            continue;
        q.ray = (struct ray){trace_offset(&at, light), light, 0, HUGE_VAL};
        assert_false(trace_occluded_1(l.world, l.scratch, &q));
    }
    unload(&l);
}

// T41: 2,000 differences built by re-declaring equal the flat form.
static void deep_difference_equals_flat(void **state)
{
    (void)state;
    static const char *const texts[] = {
        "#declare D = box { <0,-1,-1>, <2001,1,1> }\n"
        "#for (I, 1, 2000) #declare D = difference { object { D } sphere { <I, 0, -1>, "
        ".3 } } #end\n"
        "object { D }",
        "difference { box { <0,-1,-1>, <2001,1,1> }\n"
        "#for (I, 1, 2000) sphere { <I, 0, -1>, .3 } #end }"};
    struct loaded l[2];
    for (int k = 0; k < 2; k++)
        load(&l[k], "%s", texts[k]);
    for (int i = 0; i < 500; i++) {
        const struct ray_query q = {
            .ray = {{4.003 * i + .5, .1 * (i % 5) - .2, -5}, {0, 0, 1}, 0, HUGE_VAL}};
        const struct hit a = trace_closest_1(l[0].world, l[0].scratch, &q);
        const struct hit b = trace_closest_1(l[1].world, l[1].scratch, &q);
        assert_true(isfinite(a.b.t) && a.b.t == b.b.t);
    }
    unload(&l[0]);
    unload(&l[1]);
}

// T07: where a cutter's plane runs through an edge of a prism the cut starts at the edge,
// with nothing of the other side.
static void cut_through_an_edge_is_clean(void **state)
{
    (void)state;
    static const char *const turns[] = {"0", "<10, 20, 30>", "<-73, 41, 155>"};
    for (int k = 0; k < 3; k++) {
        struct loaded l;
        load(&l,
             "intersection { prism { 0, 1, 5, <-1,0>, <0,1>, <1,0>, <0,-1>, <-1,0> }\n"
             "plane { x, 0 } rotate %s }",
             turns[k]);
        double r[3] = {0, 0, 0};
        if (k)
            sscanf(turns[k], "<%lf, %lf, %lf>", &r[0], &r[1], &r[2]);
        const struct transform turn = transform_rotate(vec3(r[0], r[1], r[2]));
        for (int i = -1000; i <= 1000; i++) {
            const double x = .9e-6 * i * fabs((double)i), y = .5 + .0004 * i;
            const struct vec3 o = vec3(x, y, -5);
            struct interaction at;
            const struct hit h = shoot(&l, transform_point(&turn, o),
                                       transform_vector(&turn, vec3(0, 0, 1)), &at);
            if (i > 0)
                assert_false(isfinite(h.b.t));
            if (i < 0) {
                assert_near(h.b.t, 4 - x, 1e-12);
                assert_true(vec3_dot(at.ng, transform_vector(&turn, vec3(-1, 0, -1))) >
                            1.41);
            }
        }
        unload(&l);
    }
}

// T08: a skin of 0.00034 between a solid's face and a cutter is there from every side,
// and a cutter that protrudes by as little leaves a hole from every side.
static void slivers_do_not_depend_on_the_view(void **state)
{
    (void)state;
    static const double scales[] = {1, 1e-5, 1e5};
    for (int s = 0; s < 3; s++)
        for (int hole = 0; hole < 2; hole++) {
            struct loaded l;
            load(&l,
                 "difference { box { -1, 1 } box { <-.5,-.5,-1 %c .00034>, <.5,.5,2> }\n"
                 "scale %.17g }",
                 hole ? '-' : '+', scales[s]);
            for (int i = 0; i < 200; i++) {
                // From all around the point <.1, -.2, -1>, to 88 degrees off the normal.
                const double angle = 1.536 * i / 199, turn = 2.399963 * i;
                const struct vec3 d =
                    vec3(sin(angle) * cos(turn), sin(angle) * sin(turn), cos(angle));
                const struct vec3 o = vec3_mad(vec3(.1, -.2, -1), -3, d);
                const double t = shoot(&l, vec3_scale(scales[s], o), d, NULL).b.t;
                if (hole)
                    assert_true(t > 3.0001 * scales[s]); // a wall of the hole, or nothing
                else
                    assert_near(t, 3 * scales[s], 1e-12 * scales[s]);
            }
            unload(&l);
        }
}

// T19: a ray in a cone's generator, which is tangent: no NaN, the same from both ends.
static void generator_of_a_cone(void **state)
{
    (void)state;
    struct loaded l;
    struct interaction at;
    load(&l, "cone { 0, 0, y, 1 }");
    const struct hit up = shoot(&l, vec3(-1, -1, 0), vec3(1, 1, 0), &at);
    assert_false(isnan(up.b.t) || isnan(up.b.dt));
    if (isfinite(up.b.t)) {
        assert_true(up.b.t >= sqrt(2) - 1e-9 && up.b.t <= 2 * sqrt(2) + 1e-9);
        assert_near(vec3_length(at.ng), 1, 1e-9);
    }
    const struct hit down = shoot(&l, vec3(2, 2, 0), vec3(-1, -1, 0), &at);
    assert_false(isnan(down.b.t) || isnan(down.b.dt));
    if (isfinite(down.b.t)) {
        assert_true(down.b.t >= sqrt(2) - 1e-9 && down.b.t <= 2 * sqrt(2) + 1e-9);
        assert_near(vec3_length(at.ng), 1, 1e-9);
    }
    // A little inside it must be met.
    assert_near(shoot(&l, vec3(-1, -1 + 1e-6, 0), vec3(1, 1, 0), NULL).b.t, sqrt(2),
                1e-5);
    unload(&l);
}

// T40: a box less 4,000 balls, against the union of the chords of the balls on each ray.
static void many_holes(void **state)
{
    (void)state;
    enum { HOLES = 4000 };
    struct loaded l;
    load(&l,
         "#declare R = seed(1);\n"
         "difference { box { -1, 1 }\n"
         "#for (I, 1, %d) sphere { <rand(R)*2-1, rand(R)*2-1, rand(R)*2-1>, .1 } #end }",
         HOLES);
    assert_int_equal(l.world->leaf_count, HOLES + 1);
    int through = 0, inside = 0;
    for (int i = 0; i < 4096; i++) {
        const struct vec3 o =
            vec3(1.98 * (i % 64 + .5) / 64 - .99, 1.98 * (i / 64 + .5) / 64 - .99, -3);
        double t = 2; // the front of the box, moved on by every ball that covers it
        for (bool moved_on = true; moved_on;) {
            moved_on = false;
            for (uint32_t k = 0; k < l.world->leaf_count; k++) {
                struct boundary_list b = {0};
                const struct leaf *leaf = &l.world->leaf[k];
                const struct ray ray = {o, {0, 0, 1}, 0, HUGE_VAL};
                if (!leaf->inverted)
                    continue;
                leaf->ops->intersect(leaf->shape, &ray, &b);
                if (b.count == 2 && b.at[0].t <= t && b.at[1].t > t) {
                    t = b.at[1].t;
                    moved_on = true;
                }
                boundary_list_free(&b);
            }
        }
        const double got = shoot(&l, o, vec3(0, 0, 1), NULL).b.t;
        if (t >= 4)
            assert_false(isfinite(got));
        else
            assert_true(got == t);
        through += t >= 4;
        inside += t > 2 && t < 4;
    }
    assert_true(inside > 1000);
    (void)through;
    unload(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(as_written),
        cmocka_unit_test(scaled),
        cmocka_unit_test(moved),
        cmocka_unit_test(far_quadric_is_whole),
        cmocka_unit_test(contact_plane_is_symmetric),
        cmocka_unit_test(narrow_gaps_are_seen),
        cmocka_unit_test(far_ball_does_not_shadow_itself),
        cmocka_unit_test(deep_difference_equals_flat),
        cmocka_unit_test(cut_through_an_edge_is_clean),
        cmocka_unit_test(slivers_do_not_depend_on_the_view),
        cmocka_unit_test(generator_of_a_cone),
        cmocka_unit_test(many_holes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
