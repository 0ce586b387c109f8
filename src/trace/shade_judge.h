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

// Two colours at a time; their transparency stays as it is.
static void judge(double working, double gamma, const float (*color)[4], uint32_t count,
                  float (*out)[4])
{
    const double exponent = 1 / gamma;
    for (uint32_t i = 0; i < count; i += 2) {
        const uint32_t second = i + 1 < count ? i + 1 : i;
        double c[8];
        for (int k = 0; k < 4; k++) {
            c[k] = (double)color[i][k];
            c[4 + k] = (double)color[second][k];
        }
        c[3] = c[7] = 0;
        const struct real8 v = r8_load(c);
        const struct mask8 below = r8_le(v, r8_set(0));
        struct real8 j = linear8(working, v, below);
        if (exponent != 1)
            j = r8_select(below, j,
                          r8_pow_single(r8_select(below, r8_set(1), j), exponent));
        float judged[8];
        f8_store(judged, f8_of(j));
        judged[3] = color[i][3];
        judged[7] = color[second][3];
        memcpy(out[second], judged + 4, 4 * sizeof *judged);
        memcpy(out[i], judged, 4 * sizeof *judged);
    }
}

#endif
