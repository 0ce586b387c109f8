#ifndef SCENE_RAMP_LANES_H
#define SCENE_RAMP_LANES_H

// Between the entries of colour maps and pigment maps at eight values, for
// scene/surface_kernel.c.
#include "math/lanes_vec.h"
#include "scene/pigment_tape.h"

LANES_INLINE struct float8 blend8(struct float8 a, struct float8 b, struct real8 f)
{
    return f8_add(a, f8_of(r8_mul(f, r8_of_floats(f8_sub(b, a)))));
}

// The entries that the numbers in `index` tell; few: they are 0 to 7.
LANES_INLINE struct float8 pick8(const float *table, const int32_t index[8], bool few)
{
#if defined(__AVX2__)
    if (few)
        return (struct float8){_mm256_permutevar8x32_ps(
            _mm256_loadu_ps(table), _mm256_loadu_si256((const __m256i *)index))};
#else
    (void)few;
#endif
    float v[8];
    for (int i = 0; i < 8; i++)
        v[i] = table[index[i]];
    return f8_load(v);
}

LANES_INLINE void store_small8(int32_t out[8], struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm256_storeu_si256((__m256i *)out, _mm512_cvttpd_epi32(x.a));
#else
    double v[8];
    r8_store(v, x);
    for (int i = 0; i < 8; i++)
        out[i] = (int32_t)v[i];
#endif
}

// map_search at eight values: halving without branches, which would be hard to predict.
LANES_INLINE struct real8 search8(const float *key, uint32_t count, struct real8 v)
{
    double value[8], found[8];
    uint32_t first[8] = {0};
    r8_store(value, v);
    for (uint32_t left = count; left > 1; left -= left / 2)
        for (int i = 0; i < 8; i++) {
            const bool below = (double)key[first[i] + left / 2 - 1] < value[i];
            first[i] += below ? left / 2 : 0;
        }
    for (int i = 0; i < 8; i++)
        found[i] = first[i];
    return r8_load(found);
}

// The numbers of the first keys that are not below the values, the last for all above.
LANES_INLINE struct real8 first_key8(const float *key, uint32_t count, struct real8 v)
{
    const struct real8 one = r8_set(1), last = r8_set(count - 1);
    struct real8 n = r8_set(0);
    if (count > 32)
        n = search8(key, count, v);
    else
        for (uint32_t i = 0; i + 1 < count; i++)
            n = r8_add(n, r8_select(r8_lt(r8_set(key[i]), v), one, r8_set(0)));
    return r8_select(r8_le(r8_set(key[count - 1]), v), last, n);
}

// map_find by keys that ascend; few: at most eight, with room for eight. The fractions.
LANES_INLINE struct real8 between8(const float *key, uint32_t count, bool few,
                                   struct real8 v, int32_t above[8], int32_t below[8])
{
    const struct real8 one = r8_set(1), zero = r8_set(0), n = first_key8(key, count, v);
    store_small8(above, n);
    const struct real8 high = r8_of_floats(pick8(key, above, few));
    const struct mask8 alone = m8_or(r8_le(n, zero), r8_le(high, v));
    store_small8(below, r8_select(alone, n, r8_sub(n, one)));
    const struct real8 low = r8_of_floats(pick8(key, below, few));
    return r8_select(alone, zero, r8_div(r8_sub(v, low), r8_sub(high, low)));
}

LANES_INLINE void ramp_quick(const struct pigment_ramp *r, bool few, int channels,
                             struct real8 v, float out[5][8])
{
    int32_t above[8], below[8];
    const struct real8 f = between8(r->key, r->count, few, v, above, below);
    for (int k = 0; k < channels; k++)
        f8_store(out[k], blend8(pick8(r->channel[k], below, few),
                                pick8(r->channel[k], above, few), f));
}

#endif
