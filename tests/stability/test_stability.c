// Cases in which ray tracers fail, with the true answers (doc/accuracy.md). Each object
// is written as a scene text, traced by one ray, and traced again with the whole case
// scaled by 1e-5 and 1e5 and moved by 1e6: the answer must scale and move with it.
#include "test.h"

#include <stdbool.h>

#include "base/arena.h"
#include "eval/eval.h"
#include "trace/intersect.h"

enum flags {
    FIXED = 1, // the case is about exact numbers: not moved, not scaled
    STILL = 2, // not moved (the case is itself about size or place)
};

struct ray_case {
    const char *name, *object;
    struct vec3 o, d;
    double t;      // of the nearest surface; < 0: a miss
    struct vec3 n; // its unit normal, or 0: not looked at
    double tolerance;
    unsigned flags;
};

#define MISS (-1)
#define ANY_NORMAL                                                                       \
    {                                                                                    \
        0, 0, 0                                                                          \
    }
#define BOX  "box { -1, 1 }"
#define BALL "sphere { 0, 1 }"
#define ROD  "cylinder { -z, z, 1 }"

static const struct ray_case cases[] = {
#include "cases.def"
};

// T12: t = 3 - sqrt((1 + rho)^2 - z^2), rho = sqrt(r^2 - y^2), in long double.
static double torus_crest(const struct ray_case *c)
{
    long double rho = sqrtl(.0625L - (long double)c->o.y * c->o.y);
    return (double)(3 - sqrtl((1 + rho) * (1 + rho) - .01L));
}

struct loaded {
    struct arena *arena;
    struct scene scene;
    struct world *world;
    struct trace_scratch *scratch;
};

static void print_diag(void *user, const struct diag *d)
{
    diag_print(stdout, user, d, DIAG_TEXT, false);
}

static void load(struct loaded *l, const char *text)
{
    struct source_map *sources;
    l->arena = arena_new(1 << 16);
    sources = arena_new_struct(l->arena, struct source_map);
    source_map_init(sources, l->arena);
    uint32_t file = source_add(sources, "case.scn", text, strlen(text), (struct span){0});
    struct diag_sink sink = {.emit = print_diag, .user = sources};
    const struct eval_options options = {
        .image_width = 1, .image_height = 1, .input_name = "case"};
    if (!eval_scene(l->arena, sources, file, &sink, &options, &l->scene))
        fail_msg("the scene does not evaluate: %s", text);
    l->world = world_build(l->arena, &l->scene);
    l->scratch = trace_scratch_new(l->world);
}

static void unload(struct loaded *l)
{
    trace_scratch_free(l->scratch);
    arena_free(l->arena);
}

static void check(const struct ray_case *c, double scale, double move)
{
    char text[1024];
    struct loaded l;
    snprintf(text, sizeof text,
             "#version 3.7; global_settings { assumed_gamma 1 }\n"
             "#declare Thing = %s\nobject { Thing scale %.17g translate %.17g }\n",
             c->object, scale, move);
    load(&l, text);
    const struct vec3 d = vec3_normalize(c->d), shift = vec3(move, move, move);
    const struct ray_query q = {
        .ray = {vec3_add(vec3_scale(scale, c->o), shift), d, 0, HUGE_VAL}};
    const struct hit h = trace_closest_1(l.world, l.scratch, &q);
    double want = c->tolerance == -1 ? torus_crest(c) : c->t;
    double tolerance = c->tolerance == -1 ? 1e-8 : c->tolerance;
    tolerance = scale * tolerance + 64 * 0x1p-52 * move;
    if (want == MISS) {
        if (isfinite(h.b.t))
            fail_msg("%s (scale %g, move %g): hit at %.17g", c->name, scale, move, h.b.t);
    } else {
        if (!(fabs(h.b.t - scale * want) <= tolerance))
            fail_msg("%s (scale %g, move %g): t = %.17g, want %.17g", c->name, scale,
                     move, h.b.t, scale * want);
        struct interaction at;
        trace_interaction(l.world, &q.ray, &h, &at);
        assert_near(vec3_length(at.ng), 1, 1e-9); // finite and unit, also at an apex
        if (vec3_dot(c->n, c->n) > 0) {
            const double lost = move > 0 ? 1e-3 : 1e-6;
            if (!(vec3_length(vec3_sub(at.ng, c->n)) < lost))
                fail_msg("%s (scale %g, move %g): normal <%g,%g,%g>", c->name, scale,
                         move, at.ng.x, at.ng.y, at.ng.z);
        }
    }
    unload(&l);
}

static void as_written(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        check(&cases[i], 1, 0);
}

static void scaled(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        if (!(cases[i].flags & FIXED)) {
            check(&cases[i], 1e-5, 0);
            check(&cases[i], 1e5, 0);
        }
}

static void moved(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        if (!(cases[i].flags & (FIXED | STILL)))
            check(&cases[i], 1, 1e6);
}

// T22: all of 400 rays inside the silhouette of a small, far quadric hit.
static void far_quadric_is_whole(void **state)
{
    (void)state;
    static const double far[] = {1e6, 1e7};
    for (int k = 0; k < 2; k++) {
        char text[256];
        struct loaded l;
        snprintf(text, sizeof text,
                 "#version 3.7; global_settings { assumed_gamma 1 }\n"
                 "quadric { 100, 0, 0, -1 translate %g }",
                 far[k]);
        load(&l, text);
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
    load(&l, "#version 3.7; global_settings { assumed_gamma 1 }\n"
             "merge { box { <-2,-1,-2>, <2,0,2> } cylinder { 0, y, 1 } }");
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
            char text[256];
            struct loaded l;
            const double gap = gaps[g] * scales[s];
            snprintf(text, sizeof text,
                     "#version 3.7; global_settings { assumed_gamma 1 }\n"
                     "plane { y, 0 } disc { %.17g*y, y, %.17g }",
                     gap, scales[s]);
            load(&l, text);
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
    load(&l, "#version 3.7; global_settings { assumed_gamma 1 }\nsphere { 1e6, 1 }");
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
        "#version 3.7; global_settings { assumed_gamma 1 }\n"
        "#declare D = box { <0,-1,-1>, <2001,1,1> }\n"
        "#for (I, 1, 2000) #declare D = difference { object { D } sphere { <I, 0, -1>, "
        ".3 } } #end\n"
        "object { D }",
        "#version 3.7; global_settings { assumed_gamma 1 }\n"
        "difference { box { <0,-1,-1>, <2001,1,1> }\n"
        "#for (I, 1, 2000) sphere { <I, 0, -1>, .3 } #end }"};
    struct loaded l[2];
    for (int k = 0; k < 2; k++)
        load(&l[k], texts[k]);
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
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
