#ifndef SCENE_NOISE_LATTICE_H
#define SCENE_NOISE_LATTICE_H

#include <stdint.h>

#include "math/lanes.h"
#include "math/larger.h"
#include "scene/noise.h"
#include "scene/noise_tables.h"

// The lattice of noise: which cells eight points are in, and the table entries of the
// corners of these.

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
enum { CELLS_MAX = 4 };
typedef __m512i keys8;
#elif defined(__AVX2__)
enum { CELLS_MAX = 2 };
typedef struct {
    __m256i a, b;
} keys8;
#else
enum { CELLS_MAX = 2 };
typedef struct {
    uint64_t a[8];
} keys8;
#endif

// Places in the cells, and the numbers of the cells by axis, 0 to 4095. Lanes with the
// same key are in the same cell.
struct place8 {
    struct real8 fx, fy, fz;
    uint64_t number[3][8];
    keys8 key;
};

// `row` leads to the table entries of the corners, whose bits 0, 1 and 2 say which side of
// x, y and z they are at. Neighbouring points are mostly in few cells: then there is one
// set of rows a cell, and the lanes that are in it.
struct lattice8 {
    int cells; // 0: more than CELLS_MAX, rows by lane
    struct mask8 in[CELLS_MAX];
    const double *cell_row[8][CELLS_MAX]; // [corner][cell]
    const double *row[8][8];              // [corner][lane]
};

// Towards zero.
LANES_INLINE struct real8 whole8(struct real8 x)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    return (struct real8){
        _mm512_roundscale_pd(x.a, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC)};
#else
    return r8_copysign(r8_floor(r8_abs(x)), x);
#endif
}

// `near`: |v| < PLACE_NEAR in all lanes.
#define PLACE_NEAR 0x1p50

LANES_INLINE struct real8 split8(struct real8 v, bool near, struct real8 *cell)
{
    if (!near)
        v = r8_select(r8_lt(r8_abs(v), r8_set(NOISE_FAR)), v, r8_set(0));
    const struct real8 below =
        r8_select(r8_lt(v, r8_set(0)), r8_set(1 - NOISE_EDGE), r8_set(0));
    *cell = whole8(r8_sub(v, below));
    return r8_sub(v, *cell);
}

#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
// 10000 cells further, modulo 4096. Near: the last bits of a sum that rounds to whole
// numbers.
LANES_INLINE __m512i number8(struct real8 cell, bool near, uint64_t out[8])
{
    const __m512i sum =
        near
            ? _mm512_castpd_si512(_mm512_add_pd(cell.a, _mm512_set1_pd(0x1.8p52 + 10000)))
            : _mm512_add_epi64(_mm512_cvttpd_epi64(cell.a), _mm512_set1_epi64(10000));
    const __m512i n = _mm512_and_si512(sum, _mm512_set1_epi64(4095));
    _mm512_storeu_si512(out, n);
    return n;
}

LANES_INLINE void number_cells(struct vec8 cell, bool near, struct place8 *p)
{
    const __m512i x = number8(cell.x, near, p->number[0]),
                  y = number8(cell.y, near, p->number[1]),
                  z = number8(cell.z, near, p->number[2]);
    p->key = _mm512_or_si512(
        _mm512_or_si512(_mm512_slli_epi64(x, 24), _mm512_slli_epi64(y, 12)), z);
}

// How often the key changes from lane to lane, around: at least the number of cells where
// there are several.
LANES_INLINE int key_changes(keys8 k)
{
    return __builtin_popcount(_mm512_cmpneq_epi64_mask(k, _mm512_alignr_epi64(k, k, 1)));
}

LANES_INLINE unsigned key_lanes(const struct place8 *p, int lane)
{
    return _mm512_cmpeq_epi64_mask(
        p->key, _mm512_permutexvar_epi64(_mm512_set1_epi64(lane), p->key));
}
#elif defined(__AVX2__)
// As above.
LANES_INLINE keys8 number8(struct real8 cell, bool near, uint64_t out[8])
{
    const __m256d more = _mm256_set1_pd(0x1.8p52 + 10000);
    const __m256i mask = _mm256_set1_epi64x(4095);
    keys8 n = {_mm256_and_si256(mask, _mm256_castpd_si256(_mm256_add_pd(cell.a, more))),
               _mm256_and_si256(mask, _mm256_castpd_si256(_mm256_add_pd(cell.b, more)))};
    if (!near) {
        double c[8];
        r8_store(c, cell);
        for (int i = 0; i < 8; i++)
            out[i] = (uint64_t)((int64_t)c[i] + 10000) & 4095;
        n.a = _mm256_loadu_si256((const __m256i *)out);
        n.b = _mm256_loadu_si256((const __m256i *)(out + 4));
    }
    _mm256_storeu_si256((__m256i *)out, n.a);
    _mm256_storeu_si256((__m256i *)(out + 4), n.b);
    return n;
}

LANES_INLINE __m256i key4(__m256i x, __m256i y, __m256i z)
{
    return _mm256_or_si256(
        _mm256_or_si256(_mm256_slli_epi64(x, 24), _mm256_slli_epi64(y, 12)), z);
}

LANES_INLINE void number_cells(struct vec8 cell, bool near, struct place8 *p)
{
    const keys8 x = number8(cell.x, near, p->number[0]),
                y = number8(cell.y, near, p->number[1]),
                z = number8(cell.z, near, p->number[2]);
    p->key = (keys8){key4(x.a, y.a, z.a), key4(x.b, y.b, z.b)};
}

LANES_INLINE unsigned same_keys(keys8 k, __m256i a, __m256i b)
{
    const __m256d in_a = _mm256_castsi256_pd(_mm256_cmpeq_epi64(k.a, a));
    const __m256d in_b = _mm256_castsi256_pd(_mm256_cmpeq_epi64(k.b, b));
    return (unsigned)_mm256_movemask_pd(in_a) | (unsigned)_mm256_movemask_pd(in_b) << 4;
}

LANES_INLINE int key_changes(keys8 k)
{
    const __m256i middle = _mm256_permute2x128_si256(k.a, k.b, 0x21); // 2 3 4 5
    const __m256i ends = _mm256_permute2x128_si256(k.b, k.a, 0x21);   // 6 7 0 1
    return __builtin_popcount(255 & ~same_keys(k, _mm256_alignr_epi8(middle, k.a, 8),
                                               _mm256_alignr_epi8(ends, k.b, 8)));
}

LANES_INLINE unsigned key_lanes(const struct place8 *p, int lane)
{
    const long long x = (long long)p->number[0][lane], y = (long long)p->number[1][lane],
                    z = (long long)p->number[2][lane];
    const __m256i k = _mm256_set1_epi64x(x << 24 | y << 12 | z);
    return same_keys(p->key, k, k);
}
#else
LANES_INLINE void number_cells(struct vec8 cell, bool near, struct place8 *p)
{
    (void)near;
    double c[3][8];
    r8_store(c[0], cell.x);
    r8_store(c[1], cell.y);
    r8_store(c[2], cell.z);
    for (int i = 0; i < 8; i++) {
        for (int a = 0; a < 3; a++)
            p->number[a][i] = (uint64_t)((int64_t)c[a][i] + 10000) & 4095;
        p->key.a[i] = p->number[0][i] << 24 | p->number[1][i] << 12 | p->number[2][i];
    }
}

LANES_INLINE int key_changes(keys8 k)
{
    int n = 0;
    for (int i = 0; i < 8; i++)
        n += k.a[i] != k.a[(i + 1) % 8];
    return n;
}

LANES_INLINE unsigned key_lanes(const struct place8 *p, int lane)
{
    unsigned bits = 0;
    for (int i = 0; i < 8; i++)
        bits |= (unsigned)(p->key.a[i] == p->key.a[lane]) << i;
    return bits;
}
#endif

LANES_INLINE void place_of(struct vec8 p, double scale, bool near, struct place8 *out)
{
    struct vec8 cell;
    const struct real8 s = r8_set(scale);
    out->fx = split8(r8_mul(s, p.x), near, &cell.x);
    out->fy = split8(r8_mul(s, p.y), near, &cell.y);
    out->fz = split8(r8_mul(s, p.z), near, &cell.z);
    number_cells(cell, near, out);
}

// Whether all points stay near, even times `scale`.
LANES_INLINE bool are_near(struct vec8 p, double scale)
{
    const struct real8 least = r8_set(PLACE_NEAR / larger(1, fabs(scale)));
    return m8_bits(m8_and(m8_and(r8_lt(r8_abs(p.x), least), r8_lt(r8_abs(p.y), least)),
                          r8_lt(r8_abs(p.z), least))) == 255;
}

static inline const double *corner(unsigned hash_xy, unsigned z)
{
    return noise_row_table[0] + noise_corner_table[hash_xy ^ z];
}

// What the columns of a cell's corners along z hash to.
LANES_INLINE void columns_of(const uint64_t number[3][8], int lane, unsigned hash_xy[4])
{
    const uint32_t x = (uint32_t)number[0][lane], y = (uint32_t)number[1][lane];
    const unsigned h0 = noise_hash_table[x], h1 = noise_hash_table[x + 1];
    hash_xy[0] = noise_hash_table[h0 ^ y];
    hash_xy[1] = noise_hash_table[h1 ^ y];
    hash_xy[2] = noise_hash_table[h0 ^ (y + 1)];
    hash_xy[3] = noise_hash_table[h1 ^ (y + 1)];
}

// The rows of the corners of a cell; one every `step`.
LANES_INLINE void rows_of(const uint64_t number[3][8], int lane, const double **row,
                          int step)
{
    const unsigned z = (unsigned)number[2][lane];
    unsigned hash_xy[4];
    columns_of(number, lane, hash_xy);
#pragma GCC unroll 8
    for (int c = 0; c < 8; c++)
        row[c * step] = corner(hash_xy[c & 3], z + (unsigned)(c >> 2));
}

LANES_INLINE void lattice_of(const struct place8 *p, struct lattice8 *l)
{
    l->cells = 0;
    if (key_changes(p->key) > CELLS_MAX) {
        for (int i = 0; i < 8; i++)
            rows_of(p->number, i, &l->row[0][i], 8);
        return;
    }
    for (unsigned left = 255; left;) {
        const int i = __builtin_ctz(left);
        const unsigned in = key_lanes(p, i);
        l->in[l->cells] = m8_of(in);
        rows_of(p->number, i, &l->cell_row[0][l->cells++], CELLS_MAX);
        left &= ~in;
    }
}

// Entries past..past + 3 of the rows of a corner; `cells` as in the lattice.
LANES_INLINE void entries_of(const struct lattice8 *l, int cells, int corner, int past,
                             struct real8 t[4])
{
    if (!cells) {
        r8_load_rows(l->row[corner], past, t);
        return;
    }
#pragma GCC unroll 4
    for (int k = 0; k < 4; k++) {
        t[k] = r8_set(l->cell_row[corner][0][past + k]);
        for (int i = 1; i < cells; i++)
            t[k] = r8_select(l->in[i], r8_set(l->cell_row[corner][i][past + k]), t[k]);
    }
}

#endif
