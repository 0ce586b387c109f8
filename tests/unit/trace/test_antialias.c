#include "test.h"

#include "base/arena.h"
#include "math/elementary.h"
#include "math/isa.h"
#include "trace/antialias.h"
#include "trace/packet.h"
#include "trace/shade_kernel.h"

// A hard edge across an 8 x 8 picture of a 4 x 4 wall, as POV-Ray 3.7 renders it with
// each method (linear values, five digits).
static const float values_031[8][8] = {
    {0.050004f, 0.050004f, 0.130007f, 0.850004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.689998f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.289998f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.770001f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.530007f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.130007f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.609995f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.209995f, 0.850004f,
     0.850004f},
};
static const float values_032[8][8] = {
    {0.050004f, 0.050004f, 0.130007f, 0.850004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.689998f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.289998f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.450004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.530007f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.289998f, 0.850004f,
     0.850004f},
};
static const float values_033[8][8] = {
    {0.050004f, 0.050004f, 0.209995f, 0.850004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.689998f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.370001f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.689998f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.530007f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.530007f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.209995f, 0.850004f,
     0.850004f},
};
static const float values_034[8][8] = {
    {0.050004f, 0.050004f, 0.212497f, 0.837507f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.624994f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.300008f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.087495f, 0.762493f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.474998f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.137499f, 0.812497f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.600000f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.274998f, 0.850004f,
     0.850004f},
};
static const float values_035[8][8] = {
    {0.050004f, 0.050004f, 0.190631f, 0.846876f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.643748f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.318746f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.071870f, 0.778119f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.443748f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.146868f, 0.834379f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.587503f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.268757f, 0.850004f,
     0.850004f},
};
static const float values_036[8][8] = {
    {0.050004f, 0.050004f, 0.250004f, 0.650004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.450004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.450004f, 0.850004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.250004f, 0.650004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.450004f, 0.850004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.250004f, 0.650004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.450004f, 0.850004f,
     0.850004f},
    {0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.050004f, 0.450004f, 0.850004f,
     0.850004f},
};

static void edge(void *user, const struct vec2 *position, uint32_t count, float (*out)[4])
{
    (void)user;
    for (uint32_t i = 0; i < count; i++) {
        const double x = 4 * (position[i].u / 8 - 0.5), y = 4 * (0.5 - position[i].v / 8);
        const float c = x * 0.9 + y * 0.37 - 0.13 < 0 ? 0.05f : 0.85f;
        out[i][0] = out[i][1] = out[i][2] = c;
        out[i][3] = 0;
    }
}

static void check(int method, int depth, double jitter, const float (*want)[8])
{
    static const double tolerance = 6e-4; // halves of the reference files' last digit
    struct jitter_tables tables;
    jitter_tables_init(&tables);
    struct render_settings s = {.width = 8,
                                .height = 8,
                                .antialias = method,
                                .aa_threshold = 0.3,
                                .aa_depth = depth,
                                .aa_gamma = 2.5,
                                .aa_jitter = jitter > 0,
                                .aa_jitter_amount = jitter};
    const struct antialias a = {.settings = &s,
                                .jitter = &tables,
                                .working = 1,
                                .judge = shade_kernels_base.judge,
                                .differ = shade_kernels_base.differ,
                                .sample = edge};
    float out[64][4];
    antialias_block(&a, 0, 0, 8, 8, out);
    for (int y = 0; y < 8; y++)
        for (int x = 0; x < 8; x++)
            assert_near(out[8 * y + x][0], want[y][x], tolerance);
}

struct counts {
    uint32_t own, borrowed;
};

static void edge_counted(void *user, const struct vec2 *position, uint32_t count,
                         float (*out)[4])
{
    struct counts *c = user;
    c->own += count;
    edge(NULL, position, count, out);
}

static void edge_borrowed(void *user, const struct vec2 *position, uint32_t count,
                          float (*out)[4])
{
    struct counts *c = user;
    c->borrowed += count;
    edge(NULL, position, count, out);
}

// Blocks of 4 x 4 pixels, in the order of their numbers or the other way round.
static struct counts in_blocks(const struct antialias_seams *seams,
                               const struct render_settings *s, bool back,
                               float (*out)[16][4])
{
    struct jitter_tables tables;
    jitter_tables_init(&tables);
    struct counts counts = {0, 0};
    struct antialias a = {.settings = s,
                          .jitter = &tables,
                          .working = 1,
                          .judge = shade_kernels_base.judge,
                          .differ = shade_kernels_base.differ,
                          .sample = edge_counted,
                          .borrow = edge_borrowed,
                          .user = &counts,
                          .seams = seams};
    for (int k = 0; k < 4; k++) {
        a.block = (uint32_t)(back ? 3 - k : k);
        const struct render_tile t = render_tile_at(s, a.block);
        antialias_block(&a, t.x0, t.y0, t.x1, t.y1, out[a.block]);
        if (seams)
            antialias_seams_known(seams, a.block);
    }
    return counts;
}

static void seams_save_samples_and_change_nothing(void **state)
{
    (void)state;
    const struct render_settings s = {.width = 8,
                                      .height = 8,
                                      .col_end = 8,
                                      .row_end = 8,
                                      .tile_size = 4,
                                      .antialias = 1,
                                      .aa_threshold = 0.3,
                                      .aa_depth = 3,
                                      .aa_gamma = 2.5,
                                      .aa_jitter = true,
                                      .aa_jitter_amount = 1};
    float alone[4][16][4], out[4][16][4];
    const uint32_t all = in_blocks(NULL, &s, false, alone).own;
    for (int back = 0; back < 2; back++) {
        struct arena *arena = arena_new(1024);
        struct antialias_seams seams;
        antialias_seams_init(&seams, arena, &s);
        const struct counts counts = in_blocks(&seams, &s, back, out);
        const uint32_t shared = 16; // four sides of four pixels
        assert_memory_equal(out, alone, sizeof out);
        assert_int_equal(counts.own, all - shared);
        assert_int_equal(counts.borrowed, back ? shared : 0);
        arena_free(arena);
    }
}

static void method_1_plain(void **state)
{
    (void)state;
    check(1, 3, 0, values_031);
}
static void method_1_jitter(void **state)
{
    (void)state;
    check(1, 3, 1, values_032);
}
static void method_1_depth(void **state)
{
    (void)state;
    check(1, 2, 0.5, values_033);
}
static void method_2_plain(void **state)
{
    (void)state;
    check(2, 3, 0, values_034);
}
static void method_2_jitter(void **state)
{
    (void)state;
    check(2, 4, 1, values_035);
}
static void method_2_depth(void **state)
{
    (void)state;
    check(2, 1, 0, values_036);
}

static void shuffle_is_the_noise_permutation(void **state)
{
    (void)state;
    static const uint16_t first[] = {2291, 2574, 3654, 1557, 1196, 3388, 2637, 1820};
    struct jitter_tables t;
    jitter_tables_init(&t);
    for (int i = 0; i < 8; i++) {
        assert_int_equal(t.shuffle[i], first[i]);
        assert_int_equal(t.shuffle[4096 + i], first[i]);
    }
}

// The curve by powers one by one.
static float judged(double working, double gamma, double v)
{
    if (v <= 0)
        return 0;
    if (working < 0)
        v = v < 0.04045 ? v / 12.92 : det_pow_single((v + 0.055) / 1.055, 2.4);
    else if (working != 0 && working != 1)
        v = det_pow_single(v, working);
    return (float)(gamma == 1 ? v : det_pow_single(v, 1 / gamma));
}

static void colors_are_judged_by_the_curve(void **state)
{
    (void)state;
    enum { COUNT = 1001 }; // an odd one: the last stands alone
    static const double working[] = {-1, 0, 1, 2.2}, gamma[] = {1, 2.5};
    const struct shade_kernels *const kernels[] = {
        &shade_kernels_base, ISA_NAMED(packet_kernels_choose()->name, shade_kernels)};
    static float color[COUNT][4], out[2][4][COUNT + 8];
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 4; k++)
            color[i][k] = i % 5 == k ? 0 : (float)((k * 37 + i * 11) % 4001 - 100) / 1900;
    for (int c = 0; c < 8; c++) {
        const double w = working[c & 3], g = gamma[c >> 2];
        for (int k = 0; k < 2; k++) {
            float *const channel[4] = {out[k][0], out[k][1], out[k][2], out[k][3]};
            kernels[k]->judge(w, g, (const float(*)[4])color, COUNT, channel);
        }
        for (int i = 0; i < COUNT; i++) {
            for (int k = 0; k < 3; k++) {
                const float want = judged(w, g, (double)color[i][k]);
                assert_true(out[0][k][i] == out[1][k][i]);
                assert_true(fabsf(out[0][k][i] - want) <= want * 0x1p-19f);
            }
            assert_true(out[0][3][i] == color[i][3] && out[1][3][i] == color[i][3]);
        }
    }
}

static void colors_differ_by_the_sum_over_channels(void **state)
{
    (void)state;
    enum { COUNT = 40 };
    const struct shade_kernels *const kernels[] = {
        &shade_kernels_base, ISA_NAMED(packet_kernels_choose()->name, shade_kernels)};
    float judged[4][COUNT];
    float *const channel[4] = {judged[0], judged[1], judged[2], judged[3]};
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 4; k++)
            judged[k][i] = (float)((k * 37 + i * i * 11) % 64) / 160;
    judged[0][3] = NAN;
    for (uint32_t p = 0; p < COUNT - 8; p++) {
        for (uint32_t q = 0; q < COUNT - 8; q++) {
            unsigned want = 0;
            float threshold = 0.3f;
            for (uint32_t i = 0; i < 8; i++) {
                float sum = 0;
                for (int k = 0; k < 4; k++)
                    sum += fabsf(judged[k][p + i] - judged[k][q + i]);
                threshold = i == 0 && p % 2 ? sum : threshold; // equal ones count
                want |= (unsigned)(sum >= threshold) << i;
            }
            for (int k = 0; k < 2; k++)
                assert_int_equal(kernels[k]->differ(channel, p, q, threshold), want);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(method_1_plain),
        cmocka_unit_test(method_1_jitter),
        cmocka_unit_test(method_1_depth),
        cmocka_unit_test(method_2_plain),
        cmocka_unit_test(method_2_jitter),
        cmocka_unit_test(method_2_depth),
        cmocka_unit_test(seams_save_samples_and_change_nothing),
        cmocka_unit_test(colors_are_judged_by_the_curve),
        cmocka_unit_test(colors_differ_by_the_sum_over_channels),
        cmocka_unit_test(shuffle_is_the_noise_permutation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
