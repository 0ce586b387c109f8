#ifndef MATH_LANES_GATHER_H
#define MATH_LANES_GATHER_H

#include "math/lanes.h"

// Numbers of eight places, which are whole and below 2^31.
LANES_INLINE struct real8 r8_gather(const double *p, struct real8 at)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct real8){_mm512_i32gather_pd(_mm512_cvttpd_epi32(at.a), p, 8)};
#elif defined(__AVX2__)
    return (struct real8){_mm256_i32gather_pd(p, _mm256_cvttpd_epi32(at.a), 8),
                          _mm256_i32gather_pd(p, _mm256_cvttpd_epi32(at.b), 8)};
#else
    double i[8], v[8];
    r8_store(i, at);
    for (int k = 0; k < 8; k++)
        v[k] = p[(int32_t)i[k]];
    return r8_load(v);
#endif
}

// Of a table of 16, by indices below 16.
LANES_INLINE struct real8 r8_lookup16(const double *table, struct real8 at)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct real8){_mm512_permutex2var_pd(
        _mm512_loadu_pd(table), _mm512_cvttpd_epi64(at.a), _mm512_loadu_pd(table + 8))};
#else
    return r8_gather(table, at);
#endif
}

// The same of floats: those, and those behind them.
#if defined(__AVX2__)
LANES_INLINE void r4_gather_floats(const float *p, __m256d at, __m256d *x, __m256d *y)
{
    const __m256i v = _mm256_i32gather_epi64((const long long *)(const void *)p,
                                             _mm256_cvttpd_epi32(at), 4);
    const __m256i turned =
        _mm256_permutevar8x32_epi32(v, _mm256_setr_epi32(0, 2, 4, 6, 1, 3, 5, 7));
    const __m256 f = _mm256_castsi256_ps(turned);
    *x = _mm256_cvtps_pd(_mm256_castps256_ps128(f));
    *y = _mm256_cvtps_pd(_mm256_extractf128_ps(f, 1));
}
#endif
LANES_INLINE void r8_gather_floats(const float *p, struct real8 at, struct real8 *x,
                                   struct real8 *y)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    const __m512i v = _mm512_i32gather_epi64(_mm512_cvttpd_epi32(at.a), p, 4);
    x->a = _mm512_cvtps_pd(_mm256_castsi256_ps(_mm512_cvtepi64_epi32(v)));
    y->a = _mm512_cvtps_pd(
        _mm256_castsi256_ps(_mm512_cvtepi64_epi32(_mm512_srli_epi64(v, 32))));
#elif defined(__AVX2__)
    r4_gather_floats(p, at.a, &x->a, &y->a);
    r4_gather_floats(p, at.b, &x->b, &y->b);
#else
    double i[8], v[8], w[8];
    r8_store(i, at);
    for (int k = 0; k < 8; k++) {
        const float *from = p + (int32_t)i[k];
        v[k] = from[0];
        w[k] = from[1];
    }
    *x = r8_load(v);
    *y = r8_load(w);
#endif
}

#endif
