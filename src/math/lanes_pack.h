#ifndef MATH_LANES_PACK_H
#define MATH_LANES_PACK_H

// Lanes from and to places that are not their own.
#include "math/lanes.h"

// p[at[i]] in lane i. Not by way of an array: vectors wait that are read behind scalar stores.
LANES_INLINE struct real8 r8_load_at(const double *p, const uint32_t at[8])
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct real8){_mm512_setr_pd(p[at[0]], p[at[1]], p[at[2]], p[at[3]], p[at[4]],
                                         p[at[5]], p[at[6]], p[at[7]])};
#elif defined(__AVX2__)
    return (struct real8){_mm256_setr_pd(p[at[0]], p[at[1]], p[at[2]], p[at[3]]),
                          _mm256_setr_pd(p[at[4]], p[at[5]], p[at[6]], p[at[7]])};
#elif defined(__SSE2__)
    return (struct real8){
        _mm_setr_pd(p[at[0]], p[at[1]]), _mm_setr_pd(p[at[2]], p[at[3]]),
        _mm_setr_pd(p[at[4]], p[at[5]]), _mm_setr_pd(p[at[6]], p[at[7]])};
#else
    return (struct real8){p[at[0]], p[at[1]], p[at[2]], p[at[3]],
                          p[at[4]], p[at[5]], p[at[6]], p[at[7]]};
#endif
}

// The lanes of `bits` one behind the other; there is room for eight.
LANES_INLINE void r8_pack(double *p, unsigned bits, struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm512_storeu_pd(p, _mm512_maskz_compress_pd((__mmask8)bits, x.a));
#else
    double v[8];
    if (bits == 255) {
        r8_store(p, x);
        return;
    }
    r8_store(v, x);
    for (; bits; bits &= bits - 1)
        *p++ = v[__builtin_ctz(bits)];
#endif
}

LANES_INLINE void f8_pack(float *p, unsigned bits, struct float8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm256_storeu_ps(p, _mm256_maskz_compress_ps((__mmask8)bits, x.a));
#else
    float v[8];
    if (bits == 255) {
        f8_store(p, x);
        return;
    }
    f8_store(v, x);
    for (; bits; bits &= bits - 1)
        *p++ = v[__builtin_ctz(bits)];
#endif
}

#endif
