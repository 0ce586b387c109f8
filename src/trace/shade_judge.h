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
                  float (*out)[4])
{
    for (uint32_t i = 0; i < count; i += 8) {
        const uint32_t n = count - i < 8 ? count - i : 8;
        // Skies and backgrounds: all are what the one before them is.
        if (i && memcmp(color[i - 1], color[i], n * sizeof *color) == 0) {
            for (uint32_t k = i; k < i + n; k++)
                memcpy(out[k], out[i - 1], sizeof *out);
            continue;
        }
        float judged[3][8];
        for (int c = 0; c < 3; c++) {
            double v[8];
            for (uint32_t k = 0; k < 8; k++)
                v[k] = (double)color[i + (k < n ? k : 0)][c];
            f8_store(judged[c], f8_of(judge8(working, 1 / gamma, r8_load(v))));
        }
        for (uint32_t k = 0; k < n; k++) {
            const float j[4] = {judged[0][k], judged[1][k], judged[2][k],
                                color[i + k][3]};
            memcpy(out[i + k], j, sizeof j);
        }
    }
}

#endif
