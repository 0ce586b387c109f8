// The internal functions have the reference's values; and what every tape promises
// (scene/tape.h), tried on each internal function and each operation.
#include "test.h"

#include <stdlib.h>

#include "base/arena.h"
#include "eval/internal.h"
#include "scene/noise_kernel.h"
#include "scene/pattern.h"
#include "scene/tape_kernel.h"

static const struct {
    int number;
    double value, argument[3 + INTERNAL_PARAMETERS_MAX];
} rows[] = {
#define VALUE(number, value, ...) {number, value, {__VA_ARGS__}},
#include "internal_values.def"
#undef VALUE
};

enum { ROWS = sizeof rows / sizeof *rows, BOXES = 60, POINTS = 16 };

static const struct pattern_defaults defaults = {.noise_generator = 2};

// With the parameters as arguments.
static struct tape *general(struct arena *a, int number)
{
    const struct internal_function *f = internal_function(number);
    struct tape_builder *b = tape_builder_new(a);
    uint32_t in[3 + INTERNAL_PARAMETERS_MAX];
    for (int i = 0; i < 3 + f->parameters; i++)
        in[i] = tape_argument(b, i);
    const uint32_t out = internal_build(b, f, in, &defaults);
    struct tape *t = tape_finish(b, a, 3 + f->parameters, &out, 1);
    assert_non_null(t);
    return t;
}

// With the parameters of a row as constants.
static struct tape *special(struct arena *a, size_t row)
{
    const struct internal_function *f = internal_function(rows[row].number);
    struct tape_builder *b = tape_builder_new(a);
    uint32_t in[3 + INTERNAL_PARAMETERS_MAX];
    for (int i = 0; i < 3 + f->parameters; i++)
        in[i] = i < 3 ? tape_argument(b, i) : tape_constant(b, rows[row].argument[i]);
    const uint32_t out = internal_build(b, f, in, &defaults);
    struct tape *t = tape_finish(b, a, 3, &out, 1);
    assert_non_null(t);
    return t;
}

static void check_values(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    int wrong = 0, seen = 0;
    for (size_t i = 0; i < ROWS; i++) {
        const double want = rows[i].value;
        double got[2];
        tape_run(general(a, rows[i].number), rows[i].argument, &got[0]);
        tape_run(special(a, i), rows[i].argument, &got[1]);
        seen += rows[i].number == (int)(i ? rows[i - 1].number : -1) ? 0 : 1;
        for (int k = 0; k < 2; k++) {
            if (fabs(got[k] - want) <= 2e-13 * (1 + fabs(want)))
                continue;
            print_message("%d %s: got %.15f, want %.15f\n", rows[i].number,
                          internal_function(rows[i].number)->name, got[k], want);
            wrong++;
        }
    }
    assert_int_equal(wrong, 0);
    assert_int_equal(seen, 79);
    arena_free(a);
}

static void check_numbers(void **state)
{
    (void)state;
    assert_null(internal_function(79));
    assert_null(internal_function(-1));
    assert_null(internal_function(nan("")));
    assert_int_equal(internal_function(0)->parameters, 5);
    assert_string_equal(internal_function(61.9)->name, "sphere");
    assert_string_equal(internal_function(78)->name, "noise_generator");
}

// ---- promises of a tape -------------------------------------------------------------

static double uniform(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

struct box {
    struct interval side[3];
    struct interval v, d[3];
};

static double in_side(struct interval s, uint64_t *seed)
{
    const double u = uniform(seed);
    return u < 0.1 ? s.lo : u > 0.9 ? s.hi : fmin(s.lo + u * (s.hi - s.lo), s.hi);
}

static struct box random_box(const struct tape *t, double size, uint64_t *seed)
{
    static const double width[] = {0, 1e-9, 1e-3, 0.1, 1, 4};
    struct box b;
    struct tape_slope in[3] = {0};
    for (int i = 0; i < 3; i++) {
        const double w = width[(int)(6 * uniform(seed))] * size;
        double lo = 2 * size * (2 * uniform(seed) - 1);
        if (uniform(seed) < 0.1)
            lo = 0;
        b.side[i] = interval(lo, lo + w);
        in[i].v = b.side[i];
        in[i].d[i] = interval_point(1);
    }
    const struct tape_slope s = tape_bounds_slope(t, in, 3);
    b.v = tape_bounds(t, b.side);
    assert_true(b.v.lo == s.v.lo && b.v.hi == s.v.hi);
    memcpy(b.d, s.d, sizeof b.d);
    return b;
}

static bool holds(struct interval a, double v)
{
    return interval_has(a, v) || (isnan(v) && interval_is_whole(a));
}

static void check_eight(const struct tape *t, const char *name,
                        const double (*in)[TAPE_LANES], const double out[TAPE_LANES])
{
    for (int l = 0; l < TAPE_LANES; l++) {
        double one;
        tape_run(t, (const double[]){in[0][l], in[1][l], in[2][l]}, &one);
        if (memcmp(&one, &out[l], sizeof one) && !(isnan(one) && isnan(out[l])))
            fail_msg("%s(%a, %a, %a): eight points give %.17g, one %.17g", name, in[0][l],
                     in[1][l], in[2][l], out[l], one);
    }
}

// Eight points at once are the same bits as one, with every instruction set that is there.
static void check_packet(const struct tape *t, const char *name,
                         const double (*in)[TAPE_LANES])
{
    static const char *const isa[] = {"base", "avx2", "avx512"};
    double out[1][TAPE_LANES];
    tape_run_packet(t, in, out);
    check_eight(t, name, in, out[0]);
    for (int i = 0; i < 3 && tape_is_flat(t); i++) {
        const struct noise_kernels *k = noise_kernels_find(isa[i]);
        if (!k)
            continue;
        k->tapes->exact(t, in, out[0]);
        check_eight(t, name, in, out[0]);
    }
}

// The mean slope between two points of the box is one of its slopes, up to the rounding of
// the two values.
static void check_slope(const struct tape *t, const char *name, const struct box *b,
                        int i, uint64_t *seed)
{
    double p[3], q[3], fp, fq;
    for (int k = 0; k < 3; k++)
        p[k] = q[k] = in_side(b->side[k], seed);
    q[i] = in_side(b->side[i], seed);
    // Generator 3 of the noise adds 1e7 to its coordinates: steps of 2e-9 and its octaves'.
    const bool steps =
        strstr(name, "noise") || strstr(name, "_mf") || strstr(name, "ridge");
    if (fabs(p[i] - q[i]) <= (steps ? 1e-5 : 0))
        return;
    tape_run(t, p, &fp);
    tape_run(t, q, &fq);
    const double slope = (fq - fp) / (q[i] - p[i]);
    const double size = fmax(fabs(p[i]), fabs(q[i]));
    const double rounding = (steps ? 1e-7 : 1e-12) *
                            (1 + fabs(fp) + interval_size(b->d[i]) * (size + 1e4)) /
                            fabs(q[i] - p[i]);
    if (isfinite(rounding) &&
        !(slope >= b->d[i].lo - rounding && slope <= b->d[i].hi + rounding))
        fail_msg("%s: slope %d is %.17g between (%.17g %.17g %.17g) and %.17g, not in "
                 "%.17g .. %.17g",
                 name, i, slope, p[0], p[1], p[2], q[i], b->d[i].lo, b->d[i].hi);
}

static void check_gradient(const struct tape *t, const char *name, const struct box *b,
                           const double p[3])
{
    double g[3], v;
    tape_run(t, p, &v);
    const double w = tape_gradient(t, p, 3, g);
    if (memcmp(&v, &w, sizeof v) && !(isnan(v) && isnan(w)))
        fail_msg("%s: with slopes %.17g, without %.17g", name, w, v);
    for (int i = 0; i < 3 && !tape_is_opaque(t); i++) {
        const double slack =
            1e-9 * (1 + fabs(g[i])) + 1e-5 * (strstr(name, "_mf") != NULL);
        if (isfinite(g[i]) && !(g[i] >= b->d[i].lo - slack && g[i] <= b->d[i].hi + slack))
            fail_msg("%s: slope %d is %.17g, not in %.17g .. %.17g", name, i, g[i],
                     b->d[i].lo, b->d[i].hi);
    }
}

// The boxes with the bounds that lanes have for them.
static void bound_in_lanes(const struct tape *t, const struct box b[TAPE_LANES],
                           struct box out[TAPE_LANES])
{
    struct tape_boxes in;
    struct tape_slopes r;
    memcpy(out, b, TAPE_LANES * sizeof *out);
    for (int l = 0; l < TAPE_LANES; l++)
        for (int i = 0; i < 3; i++) {
            in.lo[i][l] = b[l].side[i].lo;
            in.hi[i][l] = b[l].side[i].hi;
        }
    tape_bounds_packet(t, &in, true, &r);
    for (int l = 0; l < TAPE_LANES; l++) {
        out[l].v = interval(r.lo[l], r.hi[l]);
        for (int i = 0; i < 3; i++)
            out[l].d[i] = interval(r.slope_lo[i][l], r.slope_hi[i][l]);
    }
}

static void check_box(const struct tape *t, const char *name, const struct box *b,
                      uint64_t *seed)
{
    double in[3][TAPE_LANES];
    for (int k = 0; k < POINTS; k++) {
        double p[3], v;
        for (int i = 0; i < 3; i++)
            in[i][k % TAPE_LANES] = p[i] = in_side(b->side[i], seed);
        tape_run(t, p, &v);
        if (!holds(b->v, v))
            fail_msg("%s: (%.17g %.17g %.17g) gives %.17g, not in %.17g .. %.17g", name,
                     p[0], p[1], p[2], v, b->v.lo, b->v.hi);
        check_gradient(t, name, b, p);
        check_slope(t, name, b, k % 3, seed);
    }
    check_packet(t, name, (const double(*)[TAPE_LANES])in);
}

static void check_tape(const struct tape *t, const char *name, double size, uint64_t seed)
{
    for (int n = 0; n < BOXES; n += TAPE_LANES) {
        struct box b[TAPE_LANES], in_lanes[TAPE_LANES];
        for (int l = 0; l < TAPE_LANES; l++)
            b[l] = random_box(t, size, &seed);
        bound_in_lanes(t, b, in_lanes);
        for (int l = 0; l < TAPE_LANES; l++) {
            check_box(t, name, &b[l], &seed);
            check_box(t, name, &in_lanes[l], &seed);
        }
    }
}

static void internals_keep_promises(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    for (size_t i = 0; i < ROWS; i++) {
        char name[64];
        snprintf(name, sizeof name, "f_%s", internal_function(rows[i].number)->name);
        check_tape(special(a, i), name, 1, 1000 + i);
    }
    arena_free(a);
}

// Sines and cosines of what is tiny, huge, next to a quarter turn, or no number.
static void waves_are_the_same_in_lanes(void **state)
{
    (void)state;
    static const double quarter = 1.57079632679489661923;
    static const double odd[] = {
        0.0, -0.0, 0x1p20, 0x1.0000000000001p20, 1e300, -1e300, 5e-324, HUGE_VAL, NAN};
    struct arena *a = arena_new(1 << 16);
    const enum tape_op op[] = {TAPE_SIN, TAPE_COS};
    uint64_t seed = 5;
    for (int i = 0; i < 2; i++) {
        struct tape_builder *b = tape_builder_new(a);
        const uint32_t out = tape_unary(b, op[i], tape_argument(b, 0));
        const struct tape *t = tape_finish(b, a, 3, &out, 1);
        for (int n = 0; n < 5000; n++) {
            double in[3][TAPE_LANES] = {{0}};
            for (int l = 0; l < TAPE_LANES; l++) {
                const double u = 2 * uniform(&seed) - 1;
                const double turns = floor(exp2(22 * uniform(&seed)));
                in[0][l] = n % 4 == 0   ? odd[(n + l) % 9]
                           : n % 4 == 1 ? u * exp2(60 * uniform(&seed) - 30)
                           : n % 4 == 2 ? quarter * turns * (1 + u * 0x1p-50)
                                        : 20 * u;
            }
            check_packet(t, i ? "cos" : "sin", (const double(*)[TAPE_LANES])in);
        }
    }
    arena_free(a);
}

static void operations_keep_promises(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        enum tape_op op;
    } unary[] =
        {
#define UNARY(name, value, derivative) {#name, TAPE_##name},
#define BINARY(name, value, by_a, by_b)
#include "scene/tape.def"
#undef UNARY
#undef BINARY
        },
      binary[] = {
#define UNARY(name, value, derivative)
#define BINARY(name, value, by_a, by_b) {#name, TAPE_##name},
#include "scene/tape.def"
#undef UNARY
#undef BINARY
      };
    static const double sizes[] = {1e-3, 0.4, 3, 100};
    struct arena *a = arena_new(1 << 16);
    for (size_t i = 0; i < sizeof unary / sizeof *unary; i++)
        for (int k = 0; k < 4; k++) {
            struct tape_builder *b = tape_builder_new(a);
            const uint32_t out = tape_unary(b, unary[i].op, tape_argument(b, 1));
            check_tape(tape_finish(b, a, 3, &out, 1), unary[i].name, sizes[k], i + 7);
        }
    for (size_t i = 0; i < sizeof binary / sizeof *binary; i++)
        for (int k = 0; k < 12; k++) {
            struct tape_builder *b = tape_builder_new(a);
            // Two arguments, or a constant on one side.
            const uint32_t x = k / 4 == 1 ? tape_constant(b, 2.5) : tape_argument(b, 0);
            const uint32_t y = k / 4 == 2 ? tape_constant(b, 2.5) : tape_argument(b, 2);
            const uint32_t out = tape_binary(b, binary[i].op, x, y);
            check_tape(tape_finish(b, a, 3, &out, 1), binary[i].name, sizes[k % 4],
                       i + 70);
        }
    static const double exponents[] = {-2, -1.5, -0.5, 0.4, 0.5, 1, 1.5, 3, 10, 7.25};
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++)
        for (int k = 0; k < 8; k++) {
            struct tape_builder *b = tape_builder_new(a);
            const uint32_t x = tape_argument(b, 1);
            const uint32_t size = k < 4 ? x : tape_unary(b, TAPE_ABS, x);
            const uint32_t y = tape_constant(b, exponents[i]);
            const uint32_t out = tape_binary(b, TAPE_POW, size, y);
            check_tape(tape_finish(b, a, 3, &out, 1), "power", sizes[k % 4], i + 700);
        }
    struct tape_builder *b = tape_builder_new(a);
    const uint32_t x = tape_argument(b, 0), y = tape_argument(b, 1);
    const uint32_t out = tape_select(b, x, y, tape_constant(b, 3), tape_argument(b, 2));
    check_tape(tape_finish(b, a, 3, &out, 1), "SELECT", 1, 3);
    arena_free(a);
}

// ---- building -----------------------------------------------------------------------

// Equal parts are one step, constants none, and what nothing needs is gone.
static void code_is_shared(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct tape_builder *b = tape_builder_new(a);
    const uint32_t x = tape_argument(b, 0), y = tape_argument(b, 1);
    const uint32_t p = tape_binary(b, TAPE_ADD, x, y), q = tape_binary(b, TAPE_ADD, y, x);
    assert_int_equal(p, q);
    tape_unary(b, TAPE_SIN, p);
    const uint32_t k = tape_binary(b, TAPE_MULTIPLY, tape_constant(b, 3),
                                   tape_unary(b, TAPE_SQRT, tape_constant(b, 4)));
    double six;
    assert_true(tape_is_constant(b, k, &six) && six == 6);
    const uint32_t out = tape_binary(b, TAPE_MULTIPLY, p, k);
    const struct tape *t = tape_finish(b, a, 2, &out, 1);
    assert_int_equal(tape_length(t), 2);
    double v;
    tape_run(t, (const double[]){1, 2}, &v);
    assert_true(v == 18);
    arena_free(a);
}

// f(n) = f(n-1)(x) + f(n-1)(x + 1): twice the steps each time, until they are called.
static void code_does_not_explode(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    const struct tape *t = NULL;
    for (int n = 0; n < 18; n++) {
        struct tape_builder *b = tape_builder_new(a);
        const uint32_t x = tape_argument(b, 0);
        uint32_t l = x, r = tape_unary(b, TAPE_SIN, x);
        if (t) {
            const uint32_t shifted = tape_binary(b, TAPE_ADD, x, tape_constant(b, n));
            tape_call(b, t, &x, &l);
            tape_call(b, t, &shifted, &r);
        }
        const uint32_t out = tape_binary(b, TAPE_ADD, l, r);
        t = tape_finish(b, a, 1, &out, 1);
        assert_non_null(t);
        assert_true(tape_length(t) < 3 * TAPE_INLINE_MAX);
    }
    const struct interval box = interval(0.5, 0.500001);
    double v;
    tape_run(t, &box.lo, &v);
    assert_true(interval_has(tape_bounds(t, &box), v));
    arena_free(a);
}

static const struct tape *loop_of(struct arena *a, bool product, bool fixed)
{
    struct tape_builder *inner = tape_builder_new(a), *b = tape_builder_new(a);
    // k * x + 1
    const uint32_t kx = tape_binary(inner, TAPE_MULTIPLY, tape_argument(inner, 0),
                                    tape_argument(inner, 1));
    const uint32_t term = tape_binary(inner, TAPE_ADD, kx, tape_constant(inner, 1));
    const struct tape *body = tape_finish(inner, a, 2, &term, 1);
    const uint32_t x = tape_argument(b, 0);
    const uint32_t to = fixed ? tape_constant(b, 4) : tape_argument(b, 1);
    const uint32_t out = tape_loop(b, product, body, tape_constant(b, 1), to, &x, 1);
    return tape_finish(b, a, 3, &out, 1);
}

static void loops_count(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    for (int product = 0; product < 2; product++) {
        double fixed, free, none, g[3];
        const struct tape *t = loop_of(a, product, false);
        const double in[] = {0.5, 4, 0}, out[] = {0.5, 0, 0};
        tape_run(loop_of(a, product, true), in, &fixed);
        tape_run(t, in, &free);
        tape_run(t, out, &none);
        assert_true(fixed == free);
        assert_true(fixed == (product ? 1.5 * 2 * 2.5 * 3 : 9));
        assert_true(none == product);
        tape_gradient(t, in, 3, g);
        // d/dx of the product is the product times the sum of k / (1 + k x).
        const double want = product ? fixed * (1 / 1.5 + 2 / 2. + 3 / 2.5 + 4 / 3.) : 10;
        assert_near(g[0], want, 1e-13 * want);
        const struct interval box[] = {{0.4, 0.6}, {4, 4}, {0, 0}};
        assert_true(interval_has(tape_bounds(t, box), fixed));
        assert_true(interval_width(tape_bounds(t, box)) < (product ? 20 : 3));
    }
    arena_free(a);
}

// (angle modulo a turn - pi)^2 - 1 is positive on both sides of the cut, where the angle
// jumps from pi to -pi and the remainder from a turn to nothing.
static void jumps_are_passed(void **state)
{
    (void)state;
    struct arena *a = arena_new(1 << 16);
    struct tape_builder *b = tape_builder_new(a);
    const double turn = 6.283185307179586;
    const uint32_t angle =
        tape_binary(b, TAPE_ATAN2, tape_argument(b, 1), tape_argument(b, 0));
    const uint32_t twice = tape_binary(b, TAPE_MULTIPLY, angle, tape_constant(b, 2));
    const uint32_t rest = tape_binary(b, TAPE_MOD, twice, tape_constant(b, turn));
    const uint32_t saw = tape_select(
        b, rest, tape_binary(b, TAPE_ADD, rest, tape_constant(b, turn)), rest, rest);
    const uint32_t off = tape_binary(b, TAPE_SUBTRACT, saw, tape_constant(b, turn / 2));
    const uint32_t out = tape_binary(b, TAPE_SUBTRACT, tape_unary(b, TAPE_SQUARE, off),
                                     tape_constant(b, 1));
    const struct tape *t = tape_finish(b, a, 3, &out, 1);
    const struct interval box[2][3] = {{{-1.1, -1}, {-0.1, 0.1}, {0, 0}},
                                       {{1, 1.1}, {-0.1, 0.1}, {0, 0}}};
    for (int i = 0; i < 2; i++) {
        struct tape_slope in[3] = {0};
        for (int k = 0; k < 3; k++) {
            in[k].v = box[i][k];
            in[k].d[k] = interval_point(1);
        }
        assert_true(tape_bounds(t, box[i]).lo > 0);
        const struct tape_slope s = tape_bounds_slope(t, in, 3);
        assert_true(s.v.lo > 0 && interval_is_whole(s.d[1]));
        for (double y = -0.1; y < 0.1; y += 0.01) {
            double v;
            tape_run(t, (const double[]){box[i][0].lo, y, 0}, &v);
            assert_true(interval_has(s.v, v));
        }
    }
    arena_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(check_values),
        cmocka_unit_test(check_numbers),
        cmocka_unit_test(internals_keep_promises),
        cmocka_unit_test(operations_keep_promises),
        cmocka_unit_test(waves_are_the_same_in_lanes),
        cmocka_unit_test(code_is_shared),
        cmocka_unit_test(code_does_not_explode),
        cmocka_unit_test(loops_count),
        cmocka_unit_test(jumps_are_passed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
