// Bounds of patterns and pigments as functions: random boxes of many sizes must hold the
// values of points in them, slopes the differences of two, with every instruction set; and
// bounds of small boxes must be small where the pattern is continuous.

#include "random.h"
#include "test.h"

#include "base/arena.h"
#include "scene/noise_kernel.h"
#include "scene/pattern_function.h"
#include "scene/tape_build.h"

static double between(double a, double b) { return a + (b - a) * random_unit(); }

static bool is(const struct pattern_ops *ops, const char *keyword)
{
    return strcmp(ops->keyword, keyword) == 0;
}

// ---- patterns -------------------------------------------------------------------------

static const struct rgbft colors[] = {{0.1f, 0.9f, 0, 0, 0},
                                      {0.7f, 0.2f, 0.5f, 0.3f, 0},
                                      {0.7f, 0.2f, 1.5f, 0, 0.2f},
                                      {0, 1, 0.25f, 0, 0}};
static const float keys[] = {0.1f, 0.4f, 0.4f, 0.9f};
static const struct color_map colours = {4, keys, colors};
static const struct pattern bozo = {
    .ops = &bozo_pattern_ops, .frequency = 1, .noise_generator = 2};
static const struct pigment colored = {
    .kind = PIGMENT_COLORS, .pattern = &bozo, .colors = &colours};
static const struct pigment plain = {.kind = PIGMENT_SOLID,
                                     .color = {0.2f, 0.4f, 0.9f, 0, 0}};
static const struct pigment *const entries[] = {&plain, &colored, &plain};
static const float steps[] = {0, 0.5f, 1};
static const struct pigment_map mixed = {3, steps, entries};

static const struct turbulence moved = {{0.6, 0.4, 0.9}, 4, 2.2f, 0.6f};

static const struct warp *warp_of(unsigned turn)
{
    static struct warp w[2];
    memset(w, 0, sizeof w);
    w[0].next = turn % 3 == 0 ? &w[1] : NULL;
    w[1].kind = WARP_TRANSFORM;
    const struct transform turned = transform_rotate(vec3(20, 70, -40)),
                           stretched = transform_scale(vec3(2, 0.7, 1.3));
    w[1].transform = transform_then(&turned, &stretched);
    w[0].kind = (enum warp_kind)(turn % (WARP_CUBIC + 1));
    w[0].transform = transform_translate(vec3(0.3, -4, 2));
    w[0].turbulence = (struct turbulence){{0.3, 0.2, 0.1}, 5, 2, 0.5f};
    w[0].repeat = vec3(w[0].kind == WARP_REPEAT || turn % 2 ? 1.5 : 0, 0, 0);
    w[0].offset = vec3(0, 0.2, 0.1);
    w[0].flip = vec3(turn % 2, 0, 1);
    w[0].centre = vec3(0.2, 0.4, -0.3);
    w[0].radius = 1.2;
    w[0].strength = 1.5;
    w[0].falloff = 2;
    w[0].inverse = turn % 5 == 0;
    w[0].uncertainty = vec3(turn % 7 == 0 ? 0.3 : 0, 0, 0);
    w[0].orientation = turn % 4 ? vec3(0, 0, 1) : vec3(0.5, 0.2, 0.8);
    w[0].dist_exp = turn % 3 * 0.5;
    w[0].major_radius = 0.6;
    w[0].distance = 0.4;
    return w;
}

static const struct tape *halved(struct arena *a)
{
    struct tape_builder *b = tape_builder_new(a);
    const uint32_t sum =
        tape_binary(b, TAPE_ADD, tape_argument(b, 0), tape_argument(b, 1));
    const uint32_t v = tape_binary(b, TAPE_MULTIPLY, sum, tape_constant(b, 0.5));
    return tape_finish(b, a, 3, &v, 1);
}

static struct pattern variant(struct arena *a, const struct pattern_ops *ops,
                              unsigned turn)
{
    static const struct vec3 form[] = {{1, 0, 0}, {-1, 1, 0}, {0.2, -0.3, 0.4}};
    static const float metric[] = {2, 2, 1, 3, 1.7f, 0.8f};
    struct pattern p = {0};
    pattern_set_kind(&p, ops);
    p.noise_generator = 1 + (int)(turn % 3);
    if (turn % 4 == 1)
        p.turbulence = &moved;
    if (turn % 5 > 2)
        p.warps = warp_of(turn / 5);
    if (turn % 3 == 1)
        p.wave = (enum wave)(turn / 3 % 6);
    p.exponent = turn % 2 ? 1.5f : 0.6f;
    if (ops->frequency != 0) {
        p.phase = turn % 4 ? 0 : 0.3f;
        p.frequency = turn % 7 ? 1 : turn % 2 ? 3 : -1.5f;
    }
    p.function = tape_at;
    p.function_data = halved(a);
    p.pigment = turn % 2 ? &colored : &plain;
    if (is(ops, "crackle")) {
        p.vector = form[turn / 2 % 3];
        p.metric = metric[turn / 3 % 6];
        p.offset = turn % 4 ? 0 : 0.2f;
        p.solid = turn % 7 == 0;
    }
    if (is(ops, "gradient"))
        p.vector = vec3_normalize(vec3(1, turn % 2, 0.3));
    if (is(ops, "tiling"))
        p.integer[0] = 1 + (int)(turn % 27);
    if (is(ops, "pavement")) {
        p.integer[0] = 3 + (int)(turn % 3 == 0) + 3 * (int)(turn % 3 == 1);
        p.integer[1] = p.integer[2] = 1;
        assert_null(ops->finish(&p, a));
    }
    if (is(ops, "julia") || is(ops, "mandel") || is(ops, "magnet")) {
        p.integer[0] = 15;
        p.integer[1] = 1 + (int)(turn % 2);
        p.vector = vec3(0.35, 0.28, 0);
    }
    if (is(ops, "spiral1") || is(ops, "spiral2"))
        p.integer[0] = 1 + (int)(turn % 4);
    return p;
}

// ---- boxes ------------------------------------------------------------------------------

struct lot {
    struct tape_range8 box[3];
};

static struct lot random_boxes(unsigned turn, double size)
{
    struct lot b;
    const double reach = turn % 5 ? 2.5 : 40;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < TAPE_LANES; l++) {
            double at = between(-reach, reach);
            if (turn % 6 == 0 && l % 2) // across planes of the lattice
                at = floor(at) - size * random_unit();
            if (turn % 9 == 0 && k == 1)
                at = floor(at);
            b.box[k].lo[l] = at;
            b.box[k].hi[l] = turn % 11 ? at + size * random_unit() : at;
        }
    return b;
}

static struct interval side(const struct tape_range8 *r, int lane)
{
    return interval(r->lo[lane], r->hi[lane]);
}

struct given {
    const struct tape_extern *f;
    const void *data;
    const char *name;
    unsigned turn;
};

static void hold(const struct given *g, const struct lot *b, int lane,
                 const struct interval *out, const struct interval *partial,
                 const char *by)
{
    double first[3] = {0}, from[TAPE_WIDTH_MAX] = {0};
    for (int n = 0; n < 12; n++) {
        double at[3], v[TAPE_WIDTH_MAX];
        for (int k = 0; k < 3; k++) {
            const struct interval s = side(&b->box[k], lane);
            at[k] = n == 0 ? s.lo : n == 1 ? s.hi : fmin(between(s.lo, s.hi), s.hi);
        }
        g->f->value(g->data, at, v);
        for (int i = 0; i < g->f->width; i++) {
            if (!(out[i].lo <= v[i] && v[i] <= out[i].hi) && !interval_is_whole(out[i]))
                fail_msg(
                    "%s %u (%s): %.17g at %.17g %.17g %.17g is not in %.17g .. %.17g",
                    g->name, g->turn, by, v[i], at[0], at[1], at[2], out[i].lo,
                    out[i].hi);
            struct interval way = interval_point(0);
            for (int k = 0; k < 3; k++)
                way = interval_add(way,
                                   interval_multiply(partial[3 * i + k],
                                                     interval_point(at[k] - first[k])));
            const bool single =
                g->f->width > 1 || strcmp(g->name, "pigment_pattern") == 0;
            const double slack = single ? 2e-6 : 1e-7, rise = v[i] - from[i];
            if (n > 0 && !(way.lo - slack <= rise && rise <= way.hi + slack))
                fail_msg("%s %u (%s): rises by %.17g, bounds are %.17g .. %.17g", g->name,
                         g->turn, by, rise, way.lo, way.hi);
            if (n == 0)
                from[i] = v[i];
        }
        if (n == 0)
            memcpy(first, at, sizeof first);
    }
}

static double check_boxes(const struct given *g, const struct lot *b)
{
    static const char *const names[] = {"base", "avx2", "avx512"};
    struct interval in[3], out[TAPE_WIDTH_MAX], partial[3 * TAPE_WIDTH_MAX];
    double widths = 0;
    for (int l = 0; l < TAPE_LANES; l++) {
        for (int k = 0; k < 3; k++)
            in[k] = side(&b->box[k], l);
        g->f->bounds(g->data, in, out, partial);
        hold(g, b, l, out, partial, "one");
        widths += interval_width(out[0]);
        g->f->bounds(g->data, in, out, NULL);
        hold(g, b, l, out, partial, "values alone");
    }
    for (int n = 0; n < 3; n++) {
        const struct noise_kernels *k = noise_kernels_find(names[n]);
        struct tape_range8 out8[TAPE_WIDTH_MAX], partial8[3 * TAPE_WIDTH_MAX];
        if (!k || !g->f->bounds8(k, g->data, b->box, out8, partial8))
            continue;
        for (int l = 0; l < TAPE_LANES; l++) {
            for (int i = 0; i < g->f->width; i++)
                out[i] = side(&out8[i], l);
            for (int i = 0; i < 3 * g->f->width; i++)
                partial[i] = side(&partial8[i], l);
            hold(g, b, l, out, partial, names[n]);
        }
    }
    return widths / TAPE_LANES;
}

static double random_size(void) { return pow(2, between(-34, 2)); }

static void every_pattern(void **state)
{
    (void)state;
    for (size_t i = 0; i < pattern_count; i++)
        for (unsigned turn = 0; turn < 60; turn++) {
            struct arena *a = arena_new(4096);
            const struct pattern p = variant(a, pattern_table[i], turn);
            const struct given g = {&pattern_extern, pattern_function(a, a, &p),
                                    p.ops->keyword, turn};
            for (unsigned n = 0; n < 3; n++) {
                const struct lot b = random_boxes(turn + 7 * n, random_size());
                check_boxes(&g, &b);
            }
            arena_free(a);
        }
}

static void every_pigment(void **state)
{
    (void)state;
    for (size_t i = 0; i < pattern_count; i++)
        for (unsigned turn = 0; turn < 30; turn++) {
            struct arena *a = arena_new(4096);
            const struct pattern p = variant(a, pattern_table[i], turn);
            const struct pigment q = {.kind = turn % 3 == 0   ? PIGMENT_MAP
                                              : turn % 7 == 1 ? PIGMENT_AVERAGE
                                                              : PIGMENT_COLORS,
                                      .pattern = &p,
                                      .colors = &colours,
                                      .map = &mixed};
            const struct given g = {&pigment_extern, pigment_function(a, a, &q),
                                    p.ops->keyword, turn};
            for (unsigned n = 0; n < 3; n++) {
                const struct lot b = random_boxes(turn + 7 * n, random_size());
                check_boxes(&g, &b);
            }
            arena_free(a);
        }
}

// Nothing useful is known of these; bounds of sums of octaves and rings cost more than
// samples do.
static bool is_opaque(const struct pattern_ops *ops)
{
    static const char *const names[] = {
        "agate",      "density_file", "granite",  "julia",   "magnet",
        "mandel",     "object",       "pavement", "ripples", "tiling",
        "triangular", "waves",        "wrinkles"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        if (is(ops, names[i]))
            return true;
    return false;
}

static void small_boxes_have_small_bounds(void **state)
{
    (void)state;
    for (size_t i = 0; i < pattern_count; i++) {
        struct arena *a = arena_new(4096);
        struct pattern p = variant(a, pattern_table[i], 0);
        p.warps = NULL;
        p.turbulence = NULL;
        p.frequency = p.ops->frequency;
        p.phase = 0;
        p.solid = false;
        p.metric = 2;
        const struct given g = {&pattern_extern, pattern_function(a, a, &p),
                                p.ops->keyword, 0};
        assert_int_equal(g.f->opaque(g.data), is_opaque(p.ops));
        double width = 0;
        for (unsigned n = 1; n <= 40 && !is_opaque(p.ops); n++) {
            struct lot b = random_boxes(0, 0.0);
            for (int k = 0; k < 3; k++)
                for (int l = 0; l < TAPE_LANES; l++) {
                    b.box[k].lo[l] = between(-2, 2);
                    b.box[k].hi[l] = b.box[k].lo[l] + 1e-4;
                }
            width += check_boxes(&g, &b) / 40;
        }
        if (!(width < 0.02))
            fail_msg("%s: boxes of 1e-4 have bounds %g wide", p.ops->keyword, width);
        arena_free(a);
    }
}

static bool function_is_opaque(const struct pattern_ops *ops, const struct turbulence *t)
{
    struct arena *a = arena_new(4096);
    struct pattern p = variant(a, ops, 0);
    p.turbulence = t;
    const bool opaque = pattern_extern.opaque(pattern_function(a, a, &p));
    arena_free(a);
    return opaque;
}

// Turbulence is octaves, too, unless the function asks for nothing that it moves.
static void turbulence_is_opaque(void **state)
{
    (void)state;
    const struct pattern_ops *const ops[] = {&bozo_pattern_ops,    &checker_pattern_ops,
                                             &crackle_pattern_ops, &marble_pattern_ops,
                                             &spiral1_pattern_ops, &wood_pattern_ops};
    for (size_t i = 0; i < sizeof ops / sizeof ops[0]; i++) {
        assert_false(function_is_opaque(ops[i], NULL));
        assert_true(function_is_opaque(ops[i], &moved));
    }
    static const struct turbulence up = {{0, 0.4, 0}, 4, 2.2f, 0.6f};
    assert_false(function_is_opaque(&cylindrical_pattern_ops, &up));
    assert_true(function_is_opaque(&spherical_pattern_ops, &up));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pattern),
        cmocka_unit_test(every_pigment),
        cmocka_unit_test(small_boxes_have_small_bounds),
        cmocka_unit_test(turbulence_is_opaque),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
