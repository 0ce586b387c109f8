#ifndef MATH_LANES_VEC_H
#define MATH_LANES_VEC_H

// Points, directions, transforms and colours in lanes: each operation is that of the one
// point of math/vec.h and math/transform.h, with the same bits.

#include "math/lanes.h"
#include "math/transform.h"

#if defined(__AVX__)
#define Q_SPREAD _mm256_add_ps
#define Q_DIV    _mm256_div_ps
#elif defined(__SSE2__)
#define Q_SPREAD _mm_add_ps
#define Q_DIV    _mm_div_ps
#else
#define Q_SPREAD P_ADD
#define Q_DIV    P_DIV
#endif
LANES_2(float8, float8, f8_add, F2, Q_SPREAD)
LANES_2(float8, float8, f8_div, F2, Q_DIV)
#undef Q_SPREAD

LANES_INLINE struct float8 f8_of(struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct float8){_mm512_cvtpd_ps(x.a)};
#elif defined(__AVX2__)
    return (struct float8){_mm256_set_m128(_mm256_cvtpd_ps(x.b), _mm256_cvtpd_ps(x.a))};
#elif defined(__SSE2__)
    return (struct float8){_mm_movelh_ps(_mm_cvtpd_ps(x.a), _mm_cvtpd_ps(x.b)),
                           _mm_movelh_ps(_mm_cvtpd_ps(x.c), _mm_cvtpd_ps(x.d))};
#else
    float v[8];
    r8_store_floats(v, x);
    return f8_load(v);
#endif
}

// x in the lanes `bits`, else y.
LANES_INLINE struct float8 f8_select(unsigned bits, struct float8 x, struct float8 y)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct float8){_mm256_mask_blend_ps((__mmask8)bits, y.a, x.a)};
#elif defined(__AVX2__)
    const __m256i lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
    const __m256i in =
        _mm256_cmpeq_epi32(_mm256_and_si256(_mm256_set1_epi32((int)bits), lane), lane);
    return (struct float8){_mm256_blendv_ps(y.a, x.a, _mm256_castsi256_ps(in))};
#else
    float a[8], b[8];
    f8_store(a, x);
    f8_store(b, y);
    for (int i = 0; i < 8; i++)
        b[i] = bits >> i & 1 ? a[i] : b[i];
    return f8_load(b);
#endif
}

// Eight rows of four, turned: as f8_store_rows puts them.
LANES_INLINE void f8_load_rows(const float *p, struct float8 out[4])
{
    const float *row[8];
    for (int i = 0; i < 8; i++)
        row[i] = p + 4 * i;
    f8_gather_rows(row, 0, out);
}

// The doubles of floats.
LANES_INLINE struct real8 r8_of_floats(struct float8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct real8){_mm512_cvtps_pd(x.a)};
#elif defined(__AVX2__)
    return (struct real8){_mm256_cvtps_pd(_mm256_castps256_ps128(x.a)),
                          _mm256_cvtps_pd(_mm256_extractf128_ps(x.a, 1))};
#else
    float f[8];
    double v[8];
    f8_store(f, x);
    for (int i = 0; i < 8; i++)
        v[i] = f[i];
    return r8_load(v);
#endif
}

LANES_INLINE struct vec8 v8_load(const double v[3][8])
{
    return (struct vec8){r8_load(v[0]), r8_load(v[1]), r8_load(v[2])};
}
LANES_INLINE void v8_store(double v[3][8], struct vec8 x)
{
    r8_store(v[0], x.x);
    r8_store(v[1], x.y);
    r8_store(v[2], x.z);
}
LANES_INLINE struct vec8 v8_add(struct vec8 a, struct vec8 b)
{
    return (struct vec8){r8_add(a.x, b.x), r8_add(a.y, b.y), r8_add(a.z, b.z)};
}
LANES_INLINE struct vec8 v8_neg(struct vec8 a)
{
    return (struct vec8){r8_neg(a.x), r8_neg(a.y), r8_neg(a.z)};
}
LANES_INLINE struct vec8 v8_select(struct mask8 m, struct vec8 a, struct vec8 b)
{
    return (struct vec8){r8_select(m, a.x, b.x), r8_select(m, a.y, b.y),
                         r8_select(m, a.z, b.z)};
}
// As vec3_normalize.
LANES_INLINE struct vec8 v8_normalize(struct vec8 a)
{
    const struct real8 l = r8_sqrt(v8_dot(a, a));
    const struct mask8 some = r8_lt(r8_set(0), l);
    const struct vec8 u = {r8_div(a.x, l), r8_div(a.y, l), r8_div(a.z, l)};
    return v8_select(some, u, a);
}
// As row_times and times_column of math/transform.c, which points and normals go through.
LANES_INLINE struct real8 v8_times(struct vec8 v, double x, double y, double z)
{
    return r8_add(r8_add(r8_mul(v.x, r8_set(x)), r8_mul(v.y, r8_set(y))),
                  r8_mul(v.z, r8_set(z)));
}
LANES_INLINE struct vec8 v8_row_times(struct vec8 v, const struct mat3 *m)
{
    return (struct vec8){v8_times(v, m->m[0][0], m->m[1][0], m->m[2][0]),
                         v8_times(v, m->m[0][1], m->m[1][1], m->m[2][1]),
                         v8_times(v, m->m[0][2], m->m[1][2], m->m[2][2])};
}
LANES_INLINE struct vec8 v8_times_column(const struct mat3 *m, struct vec8 v)
{
    return (struct vec8){v8_times(v, m->m[0][0], m->m[0][1], m->m[0][2]),
                         v8_times(v, m->m[1][0], m->m[1][1], m->m[1][2]),
                         v8_times(v, m->m[2][0], m->m[2][1], m->m[2][2])};
}
LANES_INLINE struct vec8 v8_inverse_point(const struct transform *t, struct vec8 p)
{
    return t->identity ? p : v8_row_times(v8_sub(p, V8_SET(t->offset)), &t->inverse);
}
LANES_INLINE struct vec8 v8_inverse_normal(const struct transform *t, struct vec8 n)
{
    return t->identity ? n : v8_times_column(&t->linear, n);
}
LANES_INLINE struct vec8 v8_normal(const struct transform *t, struct vec8 n)
{
    return t->identity ? n : v8_times_column(&t->inverse, n);
}

#endif
