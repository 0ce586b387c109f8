#ifndef MATH_LANES_H
#define MATH_LANES_H

// Eight lanes of double or float in as many registers as the instruction set of the
// translation unit needs, by intrinsics or in plain C. Every operation rounds as the
// scalar one does; there is no fused multiply-add. A register more is a member more: the
// macros R1, R2, R3 (F1, F2 for floats) apply an operation to each.

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

#ifdef __SSE2__
#include <immintrin.h>
#endif

#define LANES_INLINE static inline __attribute__((always_inline))

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
struct real8 {
    __m512d a;
};
struct mask8 {
    __mmask8 a;
};
#define R1(f, x) {f((x).a)}
#define R2(f, x, y) {f((x).a, (y).a)}
#define R3(f, x, y, z) {f((x).a, (y).a, (z).a)}
#define R_LOAD(f, p) {f(p)}
#define R_STORE(f, p, x) f(p, (x).a)
#define P_SET _mm512_set1_pd
#define P_LOAD _mm512_loadu_pd
#define P_STORE _mm512_storeu_pd
#define P_ADD _mm512_add_pd
#define P_SUB _mm512_sub_pd
#define P_MUL _mm512_mul_pd
#define P_DIV _mm512_div_pd
#define P_MIN _mm512_min_pd
#define P_MAX _mm512_max_pd
#define P_SQRT _mm512_sqrt_pd
#define P_NEG(x) _mm512_xor_pd(x, _mm512_set1_pd(-0.0))
#define P_ABS _mm512_abs_pd
#define P_COPYSIGN(x, y) \
    _mm512_or_pd(_mm512_abs_pd(x), _mm512_and_pd(_mm512_set1_pd(-0.0), y))
#define P_LT(x, y) _mm512_cmp_pd_mask(x, y, _CMP_LT_OQ)
#define P_LE(x, y) _mm512_cmp_pd_mask(x, y, _CMP_LE_OQ)
#define P_EQ(x, y) _mm512_cmp_pd_mask(x, y, _CMP_EQ_OQ)
#define P_SELECT(m, x, y) _mm512_mask_blend_pd(m, y, x)
#define M_AND(x, y) (__mmask8)((x) & (y))
#define M_OR(x, y) (__mmask8)((x) | (y))
#define M_WITHOUT(x, y) (__mmask8)((x) & ~(y))
LANES_INLINE struct mask8 m8_of(unsigned bits) { return (struct mask8){(__mmask8)bits}; }
LANES_INLINE unsigned m8_bits(struct mask8 m) { return m.a; }
#elif defined(__AVX2__)
struct real8 {
    __m256d a, b;
};
struct mask8 {
    __m256d a, b;
};
#define R1(f, x) {f((x).a), f((x).b)}
#define R2(f, x, y) {f((x).a, (y).a), f((x).b, (y).b)}
#define R3(f, x, y, z) {f((x).a, (y).a, (z).a), f((x).b, (y).b, (z).b)}
#define R_LOAD(f, p) {f(p), f((p) + 4)}
#define R_STORE(f, p, x) f(p, (x).a), f((p) + 4, (x).b)
#define P_SET _mm256_set1_pd
#define P_LOAD _mm256_loadu_pd
#define P_STORE _mm256_storeu_pd
#define P_ADD _mm256_add_pd
#define P_SUB _mm256_sub_pd
#define P_MUL _mm256_mul_pd
#define P_DIV _mm256_div_pd
#define P_MIN _mm256_min_pd
#define P_MAX _mm256_max_pd
#define P_SQRT _mm256_sqrt_pd
#define P_NEG(x) _mm256_xor_pd(x, _mm256_set1_pd(-0.0))
#define P_ABS(x) _mm256_andnot_pd(_mm256_set1_pd(-0.0), x)
#define P_COPYSIGN(x, y) _mm256_or_pd(P_ABS(x), _mm256_and_pd(_mm256_set1_pd(-0.0), y))
#define P_LT(x, y) _mm256_cmp_pd(x, y, _CMP_LT_OQ)
#define P_LE(x, y) _mm256_cmp_pd(x, y, _CMP_LE_OQ)
#define P_EQ(x, y) _mm256_cmp_pd(x, y, _CMP_EQ_OQ)
#define P_SELECT(m, x, y) _mm256_blendv_pd(y, x, m)
#define M_AND _mm256_and_pd
#define M_OR _mm256_or_pd
#define M_WITHOUT(x, y) _mm256_andnot_pd(y, x)
LANES_INLINE struct mask8 m8_of(unsigned bits)
{
    const __m256i all = _mm256_set1_epi64x((long long)bits);
    const __m256i low = _mm256_setr_epi64x(1, 2, 4, 8);
    const __m256i high = _mm256_setr_epi64x(16, 32, 64, 128);
    return (struct mask8){
        _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(all, low), low)),
        _mm256_castsi256_pd(_mm256_cmpeq_epi64(_mm256_and_si256(all, high), high))};
}
LANES_INLINE unsigned m8_bits(struct mask8 m)
{
    return (unsigned)_mm256_movemask_pd(m.a) | (unsigned)_mm256_movemask_pd(m.b) << 4;
}
#elif defined(__SSE2__)
struct real8 {
    __m128d a, b, c, d;
};
struct mask8 {
    __m128d a, b, c, d;
};
#define R1(f, x) {f((x).a), f((x).b), f((x).c), f((x).d)}
#define R2(f, x, y) \
    {f((x).a, (y).a), f((x).b, (y).b), f((x).c, (y).c), f((x).d, (y).d)}
#define R3(f, x, y, z)                                                          \
    {f((x).a, (y).a, (z).a), f((x).b, (y).b, (z).b), f((x).c, (y).c, (z).c),    \
     f((x).d, (y).d, (z).d)}
#define R_LOAD(f, p) {f(p), f((p) + 2), f((p) + 4), f((p) + 6)}
#define R_STORE(f, p, x) \
    f(p, (x).a), f((p) + 2, (x).b), f((p) + 4, (x).c), f((p) + 6, (x).d)
#define P_SET _mm_set1_pd
#define P_LOAD _mm_loadu_pd
#define P_STORE _mm_storeu_pd
#define P_ADD _mm_add_pd
#define P_SUB _mm_sub_pd
#define P_MUL _mm_mul_pd
#define P_DIV _mm_div_pd
#define P_MIN _mm_min_pd
#define P_MAX _mm_max_pd
#define P_SQRT _mm_sqrt_pd
#define P_NEG(x) _mm_xor_pd(x, _mm_set1_pd(-0.0))
#define P_ABS(x) _mm_andnot_pd(_mm_set1_pd(-0.0), x)
#define P_COPYSIGN(x, y) _mm_or_pd(P_ABS(x), _mm_and_pd(_mm_set1_pd(-0.0), y))
#define P_LT _mm_cmplt_pd
#define P_LE _mm_cmple_pd
#define P_EQ _mm_cmpeq_pd
#define P_SELECT(m, x, y) _mm_or_pd(_mm_and_pd(m, x), _mm_andnot_pd(m, y))
#define M_AND _mm_and_pd
#define M_OR _mm_or_pd
#define M_WITHOUT(x, y) _mm_andnot_pd(y, x)
LANES_INLINE __m128d m2_of(unsigned bits)
{
    const __m128i k = _mm_setr_epi32(1, 1, 2, 2);
    return _mm_castsi128_pd(
        _mm_cmpeq_epi32(_mm_and_si128(_mm_set1_epi32((int)bits), k), k));
}
LANES_INLINE struct mask8 m8_of(unsigned bits)
{
    return (struct mask8){m2_of(bits), m2_of(bits >> 2), m2_of(bits >> 4),
                          m2_of(bits >> 6)};
}
LANES_INLINE unsigned m8_bits(struct mask8 m)
{
    return (unsigned)_mm_movemask_pd(m.a) | (unsigned)_mm_movemask_pd(m.b) << 2 |
           (unsigned)_mm_movemask_pd(m.c) << 4 | (unsigned)_mm_movemask_pd(m.d) << 6;
}
#else
#define LANES_PLAIN
struct real8 {
    double a, b, c, d, e, f, g, h;
};
struct mask8 {
    bool a, b, c, d, e, f, g, h;
};
#define R1(q, x) \
    {q((x).a), q((x).b), q((x).c), q((x).d), q((x).e), q((x).f), q((x).g), q((x).h)}
#define R2(q, x, y)                                                        \
    {q((x).a, (y).a), q((x).b, (y).b), q((x).c, (y).c), q((x).d, (y).d),   \
     q((x).e, (y).e), q((x).f, (y).f), q((x).g, (y).g), q((x).h, (y).h)}
#define R3(q, x, y, z)                                                            \
    {q((x).a, (y).a, (z).a), q((x).b, (y).b, (z).b), q((x).c, (y).c, (z).c),      \
     q((x).d, (y).d, (z).d), q((x).e, (y).e, (z).e), q((x).f, (y).f, (z).f),      \
     q((x).g, (y).g, (z).g), q((x).h, (y).h, (z).h)}
#define R_LOAD(q, p) \
    {q(p), q((p) + 1), q((p) + 2), q((p) + 3), q((p) + 4), q((p) + 5), q((p) + 6), \
     q((p) + 7)}
#define R_STORE(q, p, x)                                                          \
    q(p, (x).a), q((p) + 1, (x).b), q((p) + 2, (x).c), q((p) + 3, (x).d),         \
        q((p) + 4, (x).e), q((p) + 5, (x).f), q((p) + 6, (x).g), q((p) + 7, (x).h)
#define P_SET(x) (x)
#define P_LOAD(p) (*(p))
#define P_STORE(p, x) (*(p) = (x))
#define P_ADD(x, y) ((x) + (y))
#define P_SUB(x, y) ((x) - (y))
#define P_MUL(x, y) ((x) * (y))
#define P_DIV(x, y) ((x) / (y))
#define P_MIN(x, y) ((x) < (y) ? (x) : (y))
#define P_MAX(x, y) ((x) > (y) ? (x) : (y))
#define P_SQRT(x) sqrt(x)
#define P_NEG(x) (-(x))
#define P_ABS(x) fabs(x)
#define P_COPYSIGN(x, y) copysign(x, y)
#define P_LT(x, y) ((x) < (y))
#define P_LE(x, y) ((x) <= (y))
#define P_EQ(x, y) ((x) == (y))
#define P_SELECT(m, x, y) ((m) ? (x) : (y))
#define M_AND(x, y) ((x) && (y))
#define M_OR(x, y) ((x) || (y))
#define M_WITHOUT(x, y) ((x) && !(y))
LANES_INLINE struct mask8 m8_of(unsigned b)
{
    return (struct mask8){b & 1, b & 2, b & 4, b & 8, b & 16, b & 32, b & 64, b & 128};
}
LANES_INLINE unsigned m8_bits(struct mask8 m)
{
    return (unsigned)m.a | (unsigned)m.b << 1 | (unsigned)m.c << 2 | (unsigned)m.d << 3 |
           (unsigned)m.e << 4 | (unsigned)m.f << 5 | (unsigned)m.g << 6 |
           (unsigned)m.h << 7;
}
#endif

#define LANES_1(type, name, form, op) \
    LANES_INLINE struct type name(struct type x) { return (struct type)form(op, x); }
#define LANES_2(out, type, name, form, op)                      \
    LANES_INLINE struct out name(struct type x, struct type y) \
    {                                                           \
        return (struct out)form(op, x, y);                      \
    }
LANES_1(real8, r8_sqrt, R1, P_SQRT)
LANES_1(real8, r8_neg, R1, P_NEG)
LANES_1(real8, r8_abs, R1, P_ABS)
LANES_2(real8, real8, r8_add, R2, P_ADD)
LANES_2(real8, real8, r8_sub, R2, P_SUB)
LANES_2(real8, real8, r8_mul, R2, P_MUL)
LANES_2(real8, real8, r8_div, R2, P_DIV)
LANES_2(real8, real8, r8_min, R2, P_MIN) // x < y ? x : y
LANES_2(real8, real8, r8_max, R2, P_MAX) // x > y ? x : y
LANES_2(real8, real8, r8_copysign, R2, P_COPYSIGN) // |x| with the sign of y
LANES_2(mask8, real8, r8_lt, R2, P_LT)
LANES_2(mask8, real8, r8_le, R2, P_LE)
LANES_2(mask8, real8, r8_eq, R2, P_EQ)
LANES_2(mask8, mask8, m8_and, R2, M_AND)
LANES_2(mask8, mask8, m8_or, R2, M_OR)
LANES_2(mask8, mask8, m8_without, R2, M_WITHOUT) // x and not y
LANES_INLINE struct real8 r8_select(struct mask8 m, struct real8 x, struct real8 y)
{
    return (struct real8)R3(P_SELECT, m, x, y);
}
LANES_INLINE struct real8 r8_load(const double *p)
{
    return (struct real8)R_LOAD(P_LOAD, p);
}
LANES_INLINE void r8_store(double *p, struct real8 x) { R_STORE(P_STORE, p, x); }
#define P_SPREAD(p) P_SET(v)
LANES_INLINE struct real8 r8_set(double v)
{
    return (struct real8)R_LOAD(P_SPREAD, &v);
}

LANES_INLINE struct real8 r8_floor(struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct real8){
        _mm512_roundscale_pd(x.a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC)};
#elif defined(__AVX2__)
    return (struct real8)R1(_mm256_floor_pd, x);
#else
    double v[8];
    r8_store(v, x);
    for (int i = 0; i < 8; i++)
        v[i] = floor(v[i]);
    return r8_load(v);
#endif
}

// Eight pairs, turned.
LANES_INLINE void r8_load_pairs(const double *p, struct real8 *x, struct real8 *y)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    const __m512d a = _mm512_loadu_pd(p), b = _mm512_loadu_pd(p + 8);
    x->a = _mm512_permutex2var_pd(a, _mm512_setr_epi64(0, 2, 4, 6, 8, 10, 12, 14), b);
    y->a = _mm512_permutex2var_pd(a, _mm512_setr_epi64(1, 3, 5, 7, 9, 11, 13, 15), b);
#else
    double v[8], w[8];
    for (int i = 0; i < 8; i++) {
        v[i] = p[2 * i];
        w[i] = p[2 * i + 1];
    }
    *x = r8_load(v);
    *y = r8_load(w);
#endif
}

// Four neighbouring doubles past each of eight places, turned: out[k] holds the k-th of
// each.
LANES_INLINE void r8_load_rows(const double *const row[8], int past,
                               struct real8 out[4])
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define R_PAIR(i, j)                                                          \
    _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(row[i] + past)),       \
                       _mm256_loadu_pd(row[j] + past), 1)
    const __m512d a = R_PAIR(0, 2), b = R_PAIR(1, 3), c = R_PAIR(4, 6), d = R_PAIR(5, 7);
#undef R_PAIR
    const __m512d ab = _mm512_unpacklo_pd(a, b), cd = _mm512_unpacklo_pd(c, d);
    const __m512d ab1 = _mm512_unpackhi_pd(a, b), cd1 = _mm512_unpackhi_pd(c, d);
    out[0].a = _mm512_shuffle_f64x2(ab, cd, 0x88);
    out[1].a = _mm512_shuffle_f64x2(ab1, cd1, 0x88);
    out[2].a = _mm512_shuffle_f64x2(ab, cd, 0xdd);
    out[3].a = _mm512_shuffle_f64x2(ab1, cd1, 0xdd);
#elif defined(__AVX2__)
#define R_TURN(m, i)                                                                    \
    do {                                                                                \
        const __m256d a = _mm256_loadu_pd(row[i] + past), b = _mm256_loadu_pd(row[(i) + 1] + past);   \
        const __m256d c = _mm256_loadu_pd(row[(i) + 2] + past), d = _mm256_loadu_pd(row[(i) + 3] + past); \
        const __m256d ab = _mm256_unpacklo_pd(a, b), cd = _mm256_unpacklo_pd(c, d);     \
        const __m256d ab1 = _mm256_unpackhi_pd(a, b), cd1 = _mm256_unpackhi_pd(c, d);   \
        out[0].m = _mm256_permute2f128_pd(ab, cd, 0x20);                                \
        out[1].m = _mm256_permute2f128_pd(ab1, cd1, 0x20);                              \
        out[2].m = _mm256_permute2f128_pd(ab, cd, 0x31);                                \
        out[3].m = _mm256_permute2f128_pd(ab1, cd1, 0x31);                              \
    } while (0)
    R_TURN(a, 0);
    R_TURN(b, 4);
#undef R_TURN
#else
    double v[4][8];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 4; k++)
            v[k][i] = row[i][past + k];
    for (int k = 0; k < 4; k++)
        out[k] = r8_load(v[k]);
#endif
}

// ---- floats -------------------------------------------------------------------------

#if defined(__AVX__) || defined(__AVX2__)
struct float8 {
    __m256 a;
};
#define F2(f, x, y) {f((x).a, (y).a)}
#define Q_ADD _mm256_add_ps
#define Q_SUB _mm256_sub_ps
#define Q_MUL _mm256_mul_ps
#define Q_MIN _mm256_min_ps
#define Q_MAX _mm256_max_ps
LANES_INLINE struct float8 f8_load(const float *p)
{
    return (struct float8){_mm256_loadu_ps(p)};
}
LANES_INLINE void f8_store(float *p, struct float8 x) { _mm256_storeu_ps(p, x.a); }
LANES_INLINE struct float8 f8_set(float v) { return (struct float8){_mm256_set1_ps(v)}; }
LANES_INLINE unsigned f8_le(struct float8 x, struct float8 y)
{
    return (unsigned)_mm256_movemask_ps(_mm256_cmp_ps(x.a, y.a, _CMP_LE_OQ));
}
// x where x <= y, else big.
LANES_INLINE struct float8 f8_keep_le(struct float8 x, struct float8 y, float big)
{
    return (struct float8){_mm256_blendv_ps(_mm256_set1_ps(big), x.a,
                                            _mm256_cmp_ps(x.a, y.a, _CMP_LE_OQ))};
}
#elif defined(__SSE2__)
struct float8 {
    __m128 a, b;
};
#define F2(f, x, y) {f((x).a, (y).a), f((x).b, (y).b)}
#define Q_ADD _mm_add_ps
#define Q_SUB _mm_sub_ps
#define Q_MUL _mm_mul_ps
#define Q_MIN _mm_min_ps
#define Q_MAX _mm_max_ps
LANES_INLINE struct float8 f8_load(const float *p)
{
    return (struct float8){_mm_loadu_ps(p), _mm_loadu_ps(p + 4)};
}
LANES_INLINE void f8_store(float *p, struct float8 x)
{
    _mm_storeu_ps(p, x.a);
    _mm_storeu_ps(p + 4, x.b);
}
LANES_INLINE struct float8 f8_set(float v)
{
    return (struct float8){_mm_set1_ps(v), _mm_set1_ps(v)};
}
LANES_INLINE unsigned f8_le(struct float8 x, struct float8 y)
{
    return (unsigned)_mm_movemask_ps(_mm_cmple_ps(x.a, y.a)) |
           (unsigned)_mm_movemask_ps(_mm_cmple_ps(x.b, y.b)) << 4;
}
LANES_INLINE __m128 f4_keep_le(__m128 x, __m128 y, float big)
{
    const __m128 m = _mm_cmple_ps(x, y);
    return _mm_or_ps(_mm_and_ps(m, x), _mm_andnot_ps(m, _mm_set1_ps(big)));
}
LANES_INLINE struct float8 f8_keep_le(struct float8 x, struct float8 y, float big)
{
    return (struct float8){f4_keep_le(x.a, y.a, big), f4_keep_le(x.b, y.b, big)};
}
#else
struct float8 {
    float a, b, c, d, e, f, g, h;
};
#define F2 R2
#define Q_ADD P_ADD
#define Q_SUB P_SUB
#define Q_MUL P_MUL
#define Q_MIN P_MIN
#define Q_MAX P_MAX
LANES_INLINE struct float8 f8_load(const float *p)
{
    return (struct float8)R_LOAD(P_LOAD, p);
}
LANES_INLINE void f8_store(float *p, struct float8 x) { R_STORE(P_STORE, p, x); }
LANES_INLINE struct float8 f8_set(float v) { return (struct float8)R_LOAD(P_SPREAD, &v); }
LANES_INLINE unsigned f8_le(struct float8 x, struct float8 y)
{
    return m8_bits((struct mask8)R2(P_LE, x, y));
}
#define P_KEEP(x, y) ((x) <= (y) ? (x) : big)
LANES_INLINE struct float8 f8_keep_le(struct float8 x, struct float8 y, float big)
{
    return (struct float8)R2(P_KEEP, x, y);
}
#endif
LANES_2(float8, float8, f8_sub, F2, Q_SUB)
LANES_2(float8, float8, f8_mul, F2, Q_MUL)
LANES_2(float8, float8, f8_min, F2, Q_MIN)
LANES_2(float8, float8, f8_max, F2, Q_MAX)

// The least and the largest of the lanes.
LANES_INLINE void f8_range(struct float8 x, float *least, float *largest)
{
#if defined(__AVX__) || defined(__AVX2__)
    const __m128 p = _mm256_castps256_ps128(x.a), q = _mm256_extractf128_ps(x.a, 1);
    __m128 lo = _mm_min_ps(p, q), hi = _mm_max_ps(p, q);
    lo = _mm_min_ps(lo, _mm_movehl_ps(lo, lo));
    hi = _mm_max_ps(hi, _mm_movehl_ps(hi, hi));
    *least = _mm_cvtss_f32(_mm_min_ss(lo, _mm_movehdup_ps(lo)));
    *largest = _mm_cvtss_f32(_mm_max_ss(hi, _mm_movehdup_ps(hi)));
#else
    float v[8];
    f8_store(v, x);
    *least = *largest = v[0];
    for (int i = 1; i < 8; i++) {
        *least = v[i] < *least ? v[i] : *least;
        *largest = v[i] > *largest ? v[i] : *largest;
    }
#endif
}

LANES_INLINE void r8_store_floats(float *p, struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm256_storeu_ps(p, _mm512_cvtpd_ps(x.a));
#else
    double v[8];
    r8_store(v, x);
    for (int i = 0; i < 8; i++)
        p[i] = (float)v[i];
#endif
}

// Eight rows of four, turned: row i holds lane i of each.
LANES_INLINE void f8_store_rows(float *p, struct float8 x, struct float8 y,
                                struct float8 z, struct float8 w)
{
#if defined(__AVX__) || defined(__AVX2__)
    const __m256 xy0 = _mm256_unpacklo_ps(x.a, y.a), xy1 = _mm256_unpackhi_ps(x.a, y.a);
    const __m256 zw0 = _mm256_unpacklo_ps(z.a, w.a), zw1 = _mm256_unpackhi_ps(z.a, w.a);
    const __m256d xy[2] = {_mm256_castps_pd(xy0), _mm256_castps_pd(xy1)};
    const __m256d zw[2] = {_mm256_castps_pd(zw0), _mm256_castps_pd(zw1)};
    __m256 row[4]; // i and i + 4
    for (int i = 0; i < 2; i++) {
        row[2 * i] = _mm256_castpd_ps(_mm256_unpacklo_pd(xy[i], zw[i]));
        row[2 * i + 1] = _mm256_castpd_ps(_mm256_unpackhi_pd(xy[i], zw[i]));
    }
    for (int i = 0; i < 4; i++) {
        _mm_storeu_ps(p + 4 * i, _mm256_castps256_ps128(row[i]));
        _mm_storeu_ps(p + 16 + 4 * i, _mm256_extractf128_ps(row[i], 1));
    }
#else
    float v[4][8];
    f8_store(v[0], x);
    f8_store(v[1], y);
    f8_store(v[2], z);
    f8_store(v[3], w);
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 4; k++)
            p[4 * i + k] = v[k][i];
#endif
}

// Four numbers of each of eight rows, turned: lane i of each holds one of row i.
LANES_INLINE void f8_gather_rows(const float *const row[8], int past,
                                 struct float8 out[4])
{
#if defined(__AVX__) || defined(__AVX2__)
#define F_PAIR(i)                                                                        \
    _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[i] + past)),            \
                         _mm_loadu_ps(row[(i) + 4] + past), 1)
    const __m256 a = F_PAIR(0), b = F_PAIR(1), c = F_PAIR(2), d = F_PAIR(3);
#undef F_PAIR
    const __m256 ab0 = _mm256_unpacklo_ps(a, b), ab1 = _mm256_unpackhi_ps(a, b);
    const __m256 cd0 = _mm256_unpacklo_ps(c, d), cd1 = _mm256_unpackhi_ps(c, d);
    const __m256d ab[2] = {_mm256_castps_pd(ab0), _mm256_castps_pd(ab1)};
    const __m256d cd[2] = {_mm256_castps_pd(cd0), _mm256_castps_pd(cd1)};
    for (int i = 0; i < 2; i++) {
        out[2 * i].a = _mm256_castpd_ps(_mm256_unpacklo_pd(ab[i], cd[i]));
        out[2 * i + 1].a = _mm256_castpd_ps(_mm256_unpackhi_pd(ab[i], cd[i]));
    }
#else
    float v[4][8];
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 4; k++)
            v[k][i] = row[i][past + k];
    for (int k = 0; k < 4; k++)
        out[k] = f8_load(v[k]);
#endif
}

// v in the lanes of `bits`.
LANES_INLINE void u8_put(uint32_t p[8], unsigned bits, uint32_t v)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm256_mask_storeu_epi32(p, (__mmask8)bits, _mm256_set1_epi32((int)v));
#else
    for (; bits; bits &= bits - 1)
        p[__builtin_ctz(bits)] = v;
#endif
}

// x in the lanes of `bits`; all eight are written, so that they can be read at once.
LANES_INLINE void f8_put(float p[8], unsigned bits, struct float8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    _mm256_storeu_ps(p, _mm256_mask_blend_ps((__mmask8)bits, _mm256_loadu_ps(p), x.a));
#else
    float v[8];
    f8_store(v, x);
    for (; bits; bits &= bits - 1)
        p[__builtin_ctz(bits)] = v[__builtin_ctz(bits)];
#endif
}

// b in the lanes of `bits` that are `second`, a in the others of `bits`.
LANES_INLINE void b8_put(uint8_t p[8], unsigned bits, unsigned second, uint8_t a,
                         uint8_t b)
{
#if defined(__AVX512BW__) && defined(__AVX512VL__)
    _mm_mask_storeu_epi8(p, (__mmask16)bits,
                         _mm_mask_blend_epi8((__mmask16)second, _mm_set1_epi8((char)a),
                                             _mm_set1_epi8((char)b)));
#else
    for (; bits; bits &= bits - 1) {
        const int i = __builtin_ctz(bits);
        p[i] = second >> i & 1 ? b : a;
    }
#endif
}

// ---- points and directions ------------------------------------------------------------

struct vec8 {
    struct real8 x, y, z;
};
LANES_INLINE struct real8 v8_dot(struct vec8 a, struct vec8 b)
{
    return r8_add(r8_add(r8_mul(a.x, b.x), r8_mul(a.y, b.y)), r8_mul(a.z, b.z));
}
LANES_INLINE struct vec8 v8_sub(struct vec8 a, struct vec8 b)
{
    return (struct vec8){r8_sub(a.x, b.x), r8_sub(a.y, b.y), r8_sub(a.z, b.z)};
}
LANES_INLINE struct vec8 v8_mad(struct vec8 a, struct real8 s, struct vec8 b)
{
    return (struct vec8){r8_add(a.x, r8_mul(s, b.x)), r8_add(a.y, r8_mul(s, b.y)),
                         r8_add(a.z, r8_mul(s, b.z))};
}
LANES_INLINE struct real8 v8_max_abs(struct vec8 a)
{
    return r8_max(r8_abs(a.x), r8_max(r8_abs(a.y), r8_abs(a.z)));
}
#define V8_SET(v) ((struct vec8){r8_set((v).x), r8_set((v).y), r8_set((v).z)})

#endif
