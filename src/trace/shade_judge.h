#ifndef TRACE_SHADE_JUDGE_H
#define TRACE_SHADE_JUDGE_H

// Colours as anti-aliasing judges their differences, by the curve of spec/lighting.md 2.2.
#include "trace/shade_lanes.h"

// What scene numbers of gamma `working` (0: none, < 0: sRGB) mean; below 0: 0. There 1 is
// what powers are made of, for their sake.
LANES_INLINE struct real8 linear8(double working, struct real8 v, struct mask8 below)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    if (working < 0) {
        const struct real8 power = r8_pow_single(
            r8_select(below, one, r8_div(r8_add(v, r8_set(0.055)), r8_set(1.055))), 2.4);
        v = r8_select(r8_lt(v, r8_set(0.04045)), r8_div(v, r8_set(12.92)), power);
    } else if (working != 0 && working != 1) {
        v = r8_pow_single(r8_select(below, one, v), working);
    }
    return r8_select(below, zero, v);
}

LANES_INLINE struct real8 judge8(double working, double exponent, struct real8 v)
{
    const struct mask8 below = r8_le(v, r8_set(0));
    const struct real8 x = linear8(working, v, below);
    if (exponent == 1)
        return x;
    return r8_select(below, x, r8_pow_single(r8_select(below, r8_set(1), x), exponent));
}

// Eight colours at a time; their transparency stays as it is.
static void judge(double working, double gamma, const float (*color)[4], uint32_t count,
                  float *const out[4])
{
    for (uint32_t i = 0; i < count; i += 8) {
        const uint32_t n = count - i < 8 ? count - i : 8;
        struct float8 c[4];
        // Skies and backgrounds: all are what the one before them is.
        if (i && memcmp(color[i - 1], color[i], n * sizeof *color) == 0) {
            for (int k = 0; k < 4; k++)
                f8_store(out[k] + i, f8_set(out[k][i - 1]));
            continue;
        }
        float last[8][4];
        for (uint32_t k = 0; n < 8 && k < 8; k++)
            memcpy(last[k], color[i + (k < n ? k : 0)], sizeof last[k]);
        f8_load_rows(n < 8 ? last[0] : color[i], c);
        for (int k = 0; k < 3; k++)
            f8_store(out[k] + i, f8_of(judge8(working, 1 / gamma, r8_of_floats(c[k]))));
        f8_store(out[3] + i, c[3]);
    }
}

static unsigned differ(float *const judged[4], uint32_t p, uint32_t q, float threshold)
{
    struct float8 sum = f8_set(0);
    for (int k = 0; k < 4; k++) {
        const struct float8 d = f8_sub(f8_load(judged[k] + p), f8_load(judged[k] + q));
        sum = f8_add(sum, f8_max(d, f8_sub(f8_set(0), d)));
    }
    return f8_le(f8_set(threshold), sum);
}

#endif
