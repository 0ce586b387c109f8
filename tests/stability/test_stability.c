// Cases in which ray tracers fail, with the true answers (research/csg-raytracing.md,
// part 3; the numbers are its). Each object is written as a scene text, traced by one ray,
// and traced again with the whole case scaled by 1e-5 and 1e5 and moved by 1e6: the answer
// must scale and move with it.
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
#define ANY_NORMAL {0, 0, 0}
#define BOX "box { -1, 1 }"
#define BALL "sphere { 0, 1 }"
#define ROD "cylinder { -z, z, 1 }"

static const struct ray_case cases[] = {
    // coincidence
    {"T01 coplanar pocket", "difference { " BOX " box { <-.5,-.5,-1>, <.5,.5,0> } }",
     {.1, .2, -5}, {0, 0, 1}, 5, {0, 0, -1}, 1e-12, 0},
    {"T02 drilled box", "difference { " BOX " cylinder { -z, z, .9 } }",
     {0, 0, -5}, {0, 0, 1}, MISS, ANY_NORMAL, 0, 0},
    {"T02 drilled box, turned",
     "difference { " BOX " cylinder { -z, z, .9 } rotate <0, 180, 45> }",
     {.1, .3, -5}, {0, 0, 1}, MISS, ANY_NORMAL, 0, 0},
    {"T03 box minus itself", "difference { " BOX " " BOX " }",
     {.1, .2, -5}, {0, 0, 1}, MISS, ANY_NORMAL, 0, 0},
    {"T03 ball minus itself", "difference { " BALL " " BALL " }",
     {.1, .2, -5}, {0, 0, 1}, MISS, ANY_NORMAL, 0, 0},
    {"T03 cylinder minus itself", "difference { " ROD " " ROD " }",
     {.1, .2, -5}, {0, 0, 1}, MISS, ANY_NORMAL, 0, 0},
    {"T03 turned box minus itself",
     "difference { " BOX " " BOX " rotate <10, 20, 30> }",
     {.1, .2, -5}, {0, 0, 1}, MISS, ANY_NORMAL, 0, 0},
    {"T04 merge of equal boxes", "merge { " BOX " " BOX " }",
     {.1, .2, -5}, {0, 0, 1}, 4, {0, 0, -1}, 1e-12, 0},
    {"T04 merge of equal balls", "merge { " BALL " " BALL " }",
     {.1, .2, -5}, {0, 0, 1}, 4.0253205655191035, {.1, .2, -.97467943448089633}, 1e-12, 0},
    {"T05 intersection of equal cylinders", "intersection { " ROD " " ROD " }",
     {.1, .2, -5}, {0, 0, 1}, 4, {0, 0, -1}, 1e-12, 0},
    {"T06 shared face of a merge is gone",
     "merge { box { <-1,-1,-1>, <1,1,0> } box { <-1,-1,0>, <1,1,1> } }",
     {.1, .2, -.5}, {0, 0, 1}, 1.5, ANY_NORMAL, 1e-12, 0},
    {"T10 touching balls, outside in",
     "merge { sphere { 0, 1 } sphere { 2*x, 1 } }",
     {-5, 0, 0}, {1, 0, 0}, 4, {-1, 0, 0}, 1e-12, 0},
    {"T10 touching balls, from inside",
     "merge { sphere { 0, 1 } sphere { 2*x, 1 } }",
     {0, 0, 0}, {1, 0, 0}, 3, ANY_NORMAL, 1e-9, 0},

    // grazing
    {"T11 ball just inside the edge", BALL,
     {-5, 1 - 1e-12, 0}, {1, 0, 0}, 5 - 1.414213562e-6, ANY_NORMAL, 1e-8, FIXED},
    {"T12 torus crest 1e-3", "torus { 1, .25 }", {-3, .24975, .1}, {1, 0, 0},
     1.9938857, ANY_NORMAL, -1, FIXED},
    {"T12 torus crest 1e-7", "torus { 1, .25 }", {-3, .25 * (1 - 1e-7), .1}, {1, 0, 0},
     0, ANY_NORMAL, -1, FIXED},
    {"T12 torus crest 1e-8", "torus { 1, .25 }", {-3, .25 * (1 - 1e-8), .1}, {1, 0, 0},
     0, ANY_NORMAL, -1, FIXED},
    {"T12 torus crest 1e-10", "torus { 1, .25 }", {-3, .25 * (1 - 1e-10), .1}, {1, 0, 0},
     0, ANY_NORMAL, -1, FIXED},
    {"T12 torus crest 1e-13", "torus { 1, .25 }", {-3, .25 * (1 - 1e-13), .1}, {1, 0, 0},
     0, ANY_NORMAL, -1, FIXED},
    {"T15 horn torus near the axis", "torus { 1, 1 }", {.001, 5, 0}, {0, -1, 0},
     5 - .04470458, ANY_NORMAL, 1e-6, 0},
    {"T16 torus in its plane", "torus { 1, .25 }", {-5, 0, 0}, {1, 0, 0},
     3.75, {-1, 0, 0}, 1e-12, 0},
    {"T17 inside the cylinder's edge", "cylinder { -y, y, 1 }", {.999999, -5, 0}, {0, 1, 0},
     4, {0, -1, 0}, 1e-12, STILL},
    {"T18 cone apex on the axis", "cone { 0, 0, y, 1 }", {0, -1, 0}, {0, 1, 0},
     1, ANY_NORMAL, 1e-9, 0},
    {"T18 cone cap from inside", "cone { 0, 0, y, 1 }", {0, .5, 0}, {0, 1, 0},
     .5, {0, 1, 0}, 1e-12, 0},
    {"T20 beside the box face", BOX, {-5, 1 + 1e-10, 0}, {1, 0, 0}, MISS, ANY_NORMAL, 0, FIXED},
    {"T20 box corner", BOX, {-5, -5, -5}, {1, 1, 1}, 4 * 1.7320508075688772, ANY_NORMAL,
     1e-12, 0},

    // magnitude
    {"T21 quadric at 1e7",
     "quadric { 1, 0, 0, -1 translate 1e7*<.7312345, .4567891, .8123457> }",
     {7312345 - 5 / 3.7416573867739413, 4567891 - 10 / 3.7416573867739413,
      8123457 - 15 / 3.7416573867739413}, {1, 2, 3}, 4, ANY_NORMAL, 1e-8, FIXED},
    {"T22 small quadric far away", "quadric { 100, 0, 0, -1 translate 1e6 }",
     {1e6 + .09, 1e6 + .03, 1e6 - 5}, {0, 0, 1}, 5 - .0316227766, ANY_NORMAL, 1e-8, FIXED},
    {"T23 far camera", BALL, {.5, 0, -1e7}, {0, 0, 1}, 1e7 - .8660254037844386, ANY_NORMAL,
     1e-8, FIXED},
    {"T24 ball from 1.1e7", BALL, {0, 0, -1.1e7}, {0, 0, 1}, 1.1e7 - 1, {0, 0, -1}, 1e-8, FIXED},
    {"T24 thin cylinder from 1.1e4", "cylinder { -y, y, 1e-3 }", {0, 0, -1.1e4}, {0, 0, 1},
     1.1e4 - 1e-3, {0, 0, -1}, 1e-9, FIXED},
    {"T24 box from 1.1e7", BOX, {.1, .2, -1.1e7}, {0, 0, 1}, 1.1e7 - 1, {0, 0, -1}, 1e-8, FIXED},
    {"T25 tiny ball", "sphere { 0, .99e-5 }", {0, 0, -5}, {0, 0, 1}, 5 - .99e-5, {0, 0, -1},
     1e-14, FIXED},
    {"T25 tiny torus", "torus { 1e-4, 2e-5 }", {1e-4, 5, 0}, {0, -1, 0}, 5 - 2e-5, {0, 1, 0},
     1e-12, FIXED},
    {"T26 huge torus", "torus { 1e6, 1 }", {1e6, 5, 0}, {0, -1, 0}, 4, {0, 1, 0}, 1e-7, FIXED},
    {"T27 quadric with tiny coefficients", "quadric { 1e-12, 0, 0, -1e-12 }",
     {.1, .2, -5}, {0, 0, 1}, 4.0253205655191035, ANY_NORMAL, 1e-12, 0},
    {"T27 quadric with huge coefficients", "quadric { 1e150, 0, 0, -1e150 }",
     {.1, .2, -5}, {0, 0, 1}, 4.0253205655191035, ANY_NORMAL, 1e-12, 0},
    {"T28 nearly parabolic", "quadric { <1,0,1>, 0, -y, 0 }", {.5, -1, 0}, {1e-9, 1, 0},
     1.25 + 1.25e-9, ANY_NORMAL, 1e-12, FIXED},

    // structure
    {"T37 inverse of the inverse", "sphere { 0, 1 inverse inverse }", {.1, .2, -5}, {0, 0, 1},
     4.0253205655191035, {.1, .2, -.97467943448089633}, 1e-12, 0},
    {"T37 inverse ball from its centre", "sphere { 0, 1 inverse }", {0, 0, 0}, {0, 0, 1},
     1, {0, 0, -1}, 1e-12, 0},
    {"T37 difference of a difference",
     "difference { " BALL " difference { box { -2, 2 } plane { z, 0 inverse } } }",
     {.1, .2, 5}, {0, 0, -1}, 4.0253205655191035, ANY_NORMAL, 1e-12, 0},
    {"T38 slab of two planes", "intersection { plane { z, 1 } plane { -z, 1 } }",
     {0, 0, -5}, {0, 0, 1}, 4, {0, 0, -1}, 1e-12, 0},
    {"T38 half space minus a ball", "difference { plane { z, 0 } " BALL " }",
     {.1, .2, 5}, {0, 0, -1}, 5.9746794344808963, {-.1, -.2, .97467943448089633}, 1e-12, 0},
    {"T38 hyperboloid between planes",
     "intersection { quadric { <1,1,-1>, 0, 0, -1 } plane { z, 1 } plane { -z, 1 } }",
     {-5, .1, .2}, {1, 0, 0}, 3.9851108433251216, ANY_NORMAL, 1e-9, 0},
    {"T39 inverted quadric in a difference",
     "difference { sphere { 0, 2 } quadric { <1,0,1>, 0, 0, -.25 } }",
     {1, 0, -5}, {0, 0, 1}, 5 - 1.7320508075688772, ANY_NORMAL, 1e-12, 0},
    {"T39 paraboloid in a cylinder",
     "intersection { quadric { <1,0,1>, 0, -y, -.5 } cylinder { -y, y, .75 } }",
     {0, -5, 0}, {0, 1, 0}, 4.5, {0, -1, 0}, 1e-12, 0},
    {"T42 a clip leaves a hole",
     "sphere { 0, 1 clipped_by { plane { -z, 0 } } }",
     {.1, .2, -5}, {0, 0, 1}, 5.9746794344808963, ANY_NORMAL, 1e-12, 0},
    {"open cylinder shows its inside wall", "cylinder { -y, y, 1 open }",
     {0, 5, 0}, {.3, -1, 0}, 5 * 1.0440306508910550, ANY_NORMAL, -2, FIXED},
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

static void print_diag(void *user, const struct diag *d) { diag_print(stdout, user, d, DIAG_TEXT, false); }

static void load(struct loaded *l, const char *text)
{
    struct source_map *sources;
    l->arena = arena_new(1 << 16);
    sources = arena_new_struct(l->arena, struct source_map);
    source_map_init(sources, l->arena);
    uint32_t file = source_add(sources, "case.scn", text, strlen(text), (struct span){0});
    struct diag_sink sink = {.emit = print_diag, .user = sources};
    const struct eval_options options = {.image_width = 1, .image_height = 1, .input_name = "case"};
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
    double tolerance = c->tolerance == -1 ? 1e-8 : c->tolerance == -2 ? 1e-9 : c->tolerance;
    if (c->tolerance == -2) // the wall at x = 1
        want = vec3_length(c->d) / c->d.x;
    tolerance = scale * tolerance + 64 * 0x1p-52 * move;
    if (want == MISS) {
        if (isfinite(h.b.t))
            fail_msg("%s (scale %g, move %g): hit at %.17g", c->name, scale, move, h.b.t);
    } else {
        if (!(fabs(h.b.t - scale * want) <= tolerance))
            fail_msg("%s (scale %g, move %g): t = %.17g, want %.17g", c->name, scale, move,
                     h.b.t, scale * want);
        struct interaction at;
        trace_interaction(l.world, &q.ray, &h, &at);
        assert_near(vec3_length(at.ng), 1, 1e-9); // finite and unit, also at an apex
        if (vec3_dot(c->n, c->n) > 0) {
            const double lost = move > 0 ? 1e-3 : 1e-6;
            if (!(vec3_length(vec3_sub(at.ng, c->n)) < lost))
                fail_msg("%s (scale %g, move %g): normal <%g,%g,%g>", c->name, scale, move,
                         at.ng.x, at.ng.y, at.ng.z);
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
        snprintf(text, sizeof text, "#version 3.7; global_settings { assumed_gamma 1 }\n"
                 "quadric { 100, 0, 0, -1 translate %g }", far[k]);
        load(&l, text);
        for (int i = 0; i < 400; i++) {
            const double r = .095 * sqrt((i + .5) / 400), a = 2.399963 * i;
            const struct ray_query q = {
                .ray = {vec3(far[k] + r * cos(a), far[k] + r * sin(a), far[k] - 5),
                        {0, 0, 1}, 0, HUGE_VAL}};
            assert_near(trace_closest_1(l.world, l.scratch, &q).b.t, 5 - sqrt(.01 - r * r),
                        1e-6);
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
            snprintf(text, sizeof text, "#version 3.7; global_settings { assumed_gamma 1 }\n"
                     "plane { y, 0 } disc { %.17g*y, y, %.17g }", gap, scales[s]);
            load(&l, text);
            struct ray_query q = {.ray = {vec3_scale(scales[s], vec3(.3, -5, .2)),
                                          {0, 1, 0}, 0, HUGE_VAL}};
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
        struct ray_query q = {
            .ray = {vec3(1e6 + r * cos(a), 1e6 + r * sin(a), 1e6 - 5), {0, 0, 1}, 0, HUGE_VAL}};
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
        "#for (I, 1, 2000) #declare D = difference { object { D } sphere { <I, 0, -1>, .3 } } #end\n"
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
