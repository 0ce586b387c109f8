#ifndef TRACE_SHADE_JUDGE_H
#define TRACE_SHADE_JUDGE_H

// Colours as anti-aliasing judges their differences, by the curve of spec/lighting.md 2.2.
#include <float.h>

#include "math/near_lanes.h"
#include "trace/shade_lanes.h"

// What scene numbers of gamma `working` (0: none, < 0: sRGB) mean; normal.
LANES_INLINE struct float8 linear8(float working, struct float8 v)
{
    if (working < 0)
        return f8_select(
            f8_le(v, f8_set(0.04045f)), f8_mul(v, f8_set(1 / 12.92f)),
            near_pow8(f8_mul(f8_add(v, f8_set(0.055f)), f8_set(1 / 1.055f)), 2.4f));
    return working == 0 || working == 1 ? v : near_pow8(v, working);
}

LANES_INLINE struct float8 judge8(float working, float exponent, struct float8 v)
{
    const struct float8 least = f8_set(FLT_MIN), most = f8_set(FLT_MAX);
    const unsigned none = 255 & ~f8_le(least, v); // NaN too
    struct float8 x = f8_min(f8_select(none, f8_set(1), v), most);
    x = linear8(working, x);
    if (exponent != 1)
        x = near_pow8(f8_max(x, least), exponent);
    return f8_select(none, f8_set(0), x);
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
            f8_store(out[k] + i, judge8((float)working, (float)(1 / gamma), c[k]));
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
