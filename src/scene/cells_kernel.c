// The nearest random points of cells at eight points that share one, for
// scene/patterns/crackle.c; compiled once per instruction set: ISA names it.
#include <float.h>
#include <stdint.h>

#include "math/isa.h"
#include "math/lanes_vec.h"
#include "math/power_lanes.h"
#include "math/single_lanes.h"
#include "scene/noise_kernel.h"
#include "scene/noise_tables.h"
#include "scene/pattern_math.h"

// Below this a cell and the next are one apart.
#define CELLS_NEAR 0x1p50

enum { REACH = 2, SLABS = 2 * REACH + 1, ALL_SLABS = 3 };

// `shared`, below: all lanes are in the cell of the first.
struct cells8 {
    struct vec8 at, cell;
    unsigned column[SLABS][SLABS][8], z[SLABS][8]; // what they hash to, by lane
    double least[ALL_SLABS][SLABS][8]; // by axis and slab: what a sum is at least
    unsigned near[ALL_SLABS][SLABS];   // the lanes that a slab may be near enough for
    unsigned lanes;
};

// What was found; `place` and `rank` are those of the smallest sum.
struct found8 {
    struct real8 sum[3]; // ascending
    struct vec8 place;
    struct real8 rank;
};

static inline unsigned wrapped(double v)
{
    return (unsigned)(fabs(v) < NOISE_FAR ? (int64_t)v : 0) & 4095;
}

LANES_INLINE void bound_slabs(struct cells8 *s, int axis, struct real8 cell,
                              struct real8 at, int metric)
{
    for (int i = 0; i < SLABS; i++) {
        const struct real8 low = r8_add(cell, r8_set(i - REACH)), zero = r8_set(0);
        const struct real8 over = r8_sub(low, at),
                           under = r8_sub(at, r8_add(low, r8_set(1)));
        const struct real8 e = r8_max(zero, r8_max(over, under));
        r8_store(s->least[axis][i], metric == 2 ? r8_mul(e, e) : e);
    }
}

// Lanes where what is at least this counts; of equal sums, the place may.
LANES_INLINE unsigned counts(const struct cells8 *s, struct real8 least,
                             struct real8 most, bool place)
{
    return m8_bits(place ? r8_le(least, most) : r8_lt(least, most)) & s->lanes;
}

LANES_INLINE struct real8 most_of(const struct found8 *f, int count)
{
    return count == 1 ? f->sum[0] : count == 2 ? f->sum[1] : f->sum[2];
}

LANES_INLINE void keep8(struct found8 *f, struct real8 sum, struct vec8 q, int rank,
                        bool place)
{
    if (place) { // of equal ones that of the cell which is first in lexical order
        const struct mask8 nearer =
            m8_or(r8_lt(sum, f->sum[0]),
                  m8_and(r8_eq(sum, f->sum[0]), r8_lt(r8_set(rank), f->rank)));
        f->place = v8_select(nearer, q, f->place);
        f->rank = r8_select(nearer, r8_set(rank), f->rank);
        f->sum[0] = r8_min(f->sum[0], sum);
        return;
    }
    const struct real8 second = r8_max(f->sum[0], sum), third = r8_max(f->sum[1], second);
    f->sum[0] = r8_min(f->sum[0], sum);
    f->sum[1] = r8_min(f->sum[1], second);
    f->sum[2] = r8_min(f->sum[2], third);
}

// ---- the points of cells --------------------------------------------------------------

// Three random numbers from each place in their table on.
#if defined(__AVX2__)
LANES_INLINE struct real8 fraction8(__m256i r)
{
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
    const struct real8 whole = {_mm512_cvtepu32_pd(r)};
#else
    const __m256i half = _mm256_xor_si256(r, _mm256_set1_epi32(INT32_MIN));
    const struct real8 whole =
        r8_add((struct real8){_mm256_cvtepi32_pd(_mm256_castsi256_si128(half)),
                              _mm256_cvtepi32_pd(_mm256_extracti128_si256(half, 1))},
               r8_set(0x1p31));
#endif
    return r8_mul(whole, r8_set(0x1p-32));
}

LANES_INLINE struct vec8 random8(const unsigned n[8])
{
    __m256i row[4];
    for (int i = 0; i < 4; i++)
        row[i] = _mm256_inserti128_si256(
            _mm256_castsi128_si256(
                _mm_loadu_si128((const __m128i *)(noise_random_table + n[i]))),
            _mm_loadu_si128((const __m128i *)(noise_random_table + n[i + 4])), 1);
    const __m256i a = _mm256_unpacklo_epi32(row[0], row[1]),
                  b = _mm256_unpacklo_epi32(row[2], row[3]),
                  c = _mm256_unpackhi_epi32(row[0], row[1]),
                  d = _mm256_unpackhi_epi32(row[2], row[3]);
    return (struct vec8){fraction8(_mm256_unpacklo_epi64(a, b)),
                         fraction8(_mm256_unpackhi_epi64(a, b)),
                         fraction8(_mm256_unpacklo_epi64(c, d))};
}
#else
LANES_INLINE struct vec8 random8(const unsigned n[8])
{
    double v[3][8];
    for (int i = 0; i < 8; i++)
        for (int a = 0; a < 3; a++)
            v[a][i] = noise_random_table[n[i] + a] * 0x1p-32;
    return v8_load((const double(*)[8])v);
}
#endif

LANES_INLINE struct vec8 point8(const struct cells8 *s, int i, int j, int k, bool shared)
{
    const unsigned *column = s->column[i][j], *z = s->z[k];
    struct vec8 r;
    if (shared) {
        const uint32_t *t = noise_random_table + noise_hash_table[column[0] ^ z[0]];
        const struct vec3 one = vec3(t[0] * 0x1p-32, t[1] * 0x1p-32, t[2] * 0x1p-32);
        r = V8_SET(one);
    } else {
        unsigned n[8];
        for (int l = 0; l < 8; l++)
            n[l] = noise_hash_table[column[l] ^ z[l]];
        r = random8(n);
    }
    return (struct vec8){r8_add(r8_add(s->cell.x, r8_set(i - REACH)), r.x),
                         r8_add(r8_add(s->cell.y, r8_set(j - REACH)), r.y),
                         r8_add(r8_add(s->cell.z, r8_set(k - REACH)), r.z)};
}

// ---- the search -----------------------------------------------------------------------

LANES_INLINE void visit8(const struct cells8 *s, struct found8 *f,
                         const unsigned char at[3], int metric, int count, bool place,
                         bool shared)
{
    const int i = at[0], j = at[1], k = at[2];
    if (!(s->near[0][i] & s->near[1][j] & s->near[2][k]))
        return;
    const struct real8 least =
        r8_add(r8_add(r8_load(s->least[0][i]), r8_load(s->least[1][j])),
               r8_load(s->least[2][k]));
    if (!counts(s, least, most_of(f, count), place))
        return;
    const struct vec8 q = point8(s, i, j, k, shared), e = v8_sub(q, s->at);
    keep8(f,
          metric == 2 ? v8_dot(e, e)
                      : r8_add(r8_add(r8_abs(e.x), r8_abs(e.y)), r8_abs(e.z)),
          q, (i * SLABS + j) * SLABS + k, place);
}

LANES_INLINE void find_near(struct cells8 *s, const struct found8 *f, int count,
                            bool place)
{
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < SLABS; i++)
            s->near[a][i] = counts(s, r8_load(s->least[a][i]), most_of(f, count), place);
}

// Slabs around the middle, those that share more with it first.
static const unsigned char inner[27][3] = {
    {2, 2, 2}, {1, 2, 2}, {3, 2, 2}, {2, 1, 2}, {2, 3, 2}, {2, 2, 1}, {2, 2, 3},
    {1, 1, 2}, {1, 3, 2}, {3, 1, 2}, {3, 3, 2}, {1, 2, 1}, {1, 2, 3}, {3, 2, 1},
    {3, 2, 3}, {2, 1, 1}, {2, 1, 3}, {2, 3, 1}, {2, 3, 3}, {1, 1, 1}, {1, 1, 3},
    {1, 3, 1}, {1, 3, 3}, {3, 1, 1}, {3, 1, 3}, {3, 3, 1}, {3, 3, 3}};
enum { FACES_END = 7 };

LANES_INLINE void visit_far8(const struct cells8 *s, struct found8 *f, int axis, int slab,
                             int metric, int count, bool place, bool shared)
{
    if (!s->near[axis][slab])
        return;
    for (int u = 1; u <= 3; u++)
        for (int v = 1; v <= 3; v++) {
            unsigned char at[3];
            at[axis] = (unsigned char)slab;
            at[axis == 0] = (unsigned char)u;
            at[2 - (axis == 2)] = (unsigned char)v;
            visit8(s, f, at, metric, count, place, shared);
        }
}

// What the cells along x and y hash to and are numbered, from slab to slab.
struct numbers8 {
    unsigned x[SLABS][8], y[SLABS][8];
};

// What the columns along z of the slabs from..to hash to.
LANES_INLINE void hash_columns(struct cells8 *s, const struct numbers8 *n, int from,
                               int to, int lanes)
{
    for (int i = from; i <= to; i++)
        for (int j = from; j <= to; j++)
            for (int l = 0; l < lanes; l++)
                s->column[i][j][l] = noise_hash_table[n->x[i][l] ^ n->y[j][l]];
}

LANES_INLINE void search8(struct cells8 *s, const struct numbers8 *n, struct found8 *f,
                          int metric, int count, bool place, bool shared)
{
    bound_slabs(s, 0, s->cell.x, s->at.x, metric);
    bound_slabs(s, 1, s->cell.y, s->at.y, metric);
    bound_slabs(s, 2, s->cell.z, s->at.z, metric);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < SLABS; i++)
            s->near[a][i] = s->lanes;
    hash_columns(s, n, 1, SLABS - 2, shared ? 1 : 8);
    for (int i = 0; i < FACES_END; i++)
        visit8(s, f, inner[i], metric, count, place, shared);
    find_near(s, f, count, place);
    for (int i = FACES_END; i < 27; i++)
        visit8(s, f, inner[i], metric, count, place, shared);
    find_near(s, f, count, place);
    unsigned far = 0;
    for (int a = 0; a < 3; a++)
        far |= s->near[a][0] | s->near[a][SLABS - 1];
    if (!far)
        return;
    hash_columns(s, n, 0, SLABS - 1, shared ? 1 : 8);
    for (int axis = 0; axis < 3; axis++) {
        visit_far8(s, f, axis, 0, metric, count, place, shared);
        visit_far8(s, f, axis, SLABS - 1, metric, count, place, shared);
    }
}

LANES_INLINE void search_sums(struct cells8 *s, const struct numbers8 *n,
                              struct found8 *f, int metric, int count, bool place,
                              bool shared)
{
    if (metric == 2 && place)
        search8(s, n, f, 2, 1, true, shared);
    else if (metric == 2)
        search8(s, n, f, 2, count, false, shared);
    else if (place)
        search8(s, n, f, 1, 1, true, shared);
    else
        search8(s, n, f, 1, count, false, shared);
}

// By one cell, that of a lane.
static void search_shared(struct cells8 *s, int lane, struct found8 *f, int metric,
                          int count, bool place)
{
    struct numbers8 n;
    double cell[3][8];
    v8_store(cell, s->cell);
    for (int i = 0; i < SLABS; i++) {
        n.x[i][0] = noise_hash_table[wrapped(cell[0][lane] + (i - REACH))];
        n.y[i][0] = wrapped(cell[1][lane] + (i - REACH));
        s->z[i][0] = wrapped(cell[2][lane] + (i - REACH));
    }
    const struct vec3 one = vec3(cell[0][lane], cell[1][lane], cell[2][lane]);
    s->cell = f->place = V8_SET(one);
    search_sums(s, &n, f, metric, count, place, true);
}

// Each lane by its own; numbers of cells near enough that the next are one more.
static void search_scattered(struct cells8 *s, struct found8 *f, int metric, int count,
                             bool place)
{
    struct numbers8 n;
    double cell[3][8];
    v8_store(cell, s->cell);
    for (int l = 0; l < 8; l++) {
        const bool in = s->lanes >> l & 1;
        const int64_t x = in ? (int64_t)cell[0][l] : 0, y = in ? (int64_t)cell[1][l] : 0,
                      z = in ? (int64_t)cell[2][l] : 0;
        for (int i = 0; i < SLABS; i++) {
            n.x[i][l] = noise_hash_table[(unsigned)(x + i - REACH) & 4095];
            n.y[i][l] = (unsigned)(y + i - REACH) & 4095;
            s->z[i][l] = (unsigned)(z + i - REACH) & 4095;
        }
    }
    search_sums(s, &n, f, metric, count, place, false);
}

LANES_INLINE struct vec8 cells_of(struct vec8 at)
{
    const struct real8 edge = r8_set(PATTERN_EDGE);
    return (struct vec8){r8_floor(r8_sub(at.x, edge)), r8_floor(r8_sub(at.y, edge)),
                         r8_floor(r8_sub(at.z, edge))};
}

LANES_INLINE unsigned near_lanes(struct vec8 at)
{
    const struct real8 most = r8_set(CELLS_NEAR);
    return m8_bits(m8_and(m8_and(r8_lt(r8_abs(at.x), most), r8_lt(r8_abs(at.y), most)),
                          r8_lt(r8_abs(at.z), most)));
}

// Of `lanes` those in the cell of one of them.
LANES_INLINE unsigned sharing(struct vec8 c, unsigned lanes, int lane)
{
    double cell[3][8];
    v8_store(cell, c);
    const struct mask8 same = m8_and(
        m8_and(r8_eq(c.x, r8_set(cell[0][lane])), r8_eq(c.y, r8_set(cell[1][lane]))),
        r8_eq(c.z, r8_set(cell[2][lane])));
    return (lanes & m8_bits(same)) | 1u << lane; // no numbers are not the same
}

LANES_INLINE void keep_lanes(double to[3][8], struct mask8 m, const struct real8 v[3])
{
    for (int k = 0; k < 3; k++)
        r8_store(to[k], r8_select(m, v[k], r8_load(to[k])));
}

unsigned OF_ISA(noise_nearest_)(const double p[3][8], unsigned lanes, int metric,
                                int count, double sum[3][8], double place[3][8])
{
    const int first = __builtin_ctz(lanes);
    struct cells8 s; // not set to zero as a whole: it is large
    s.at = v8_load(p);
    s.cell = cells_of(s.at);
    const struct real8 far = r8_set(DBL_MAX);
    struct found8 f = {{far, far, far}, s.cell, r8_set(-1)};
    s.lanes = sharing(s.cell, lanes, first);
    const bool shared = s.lanes == lanes;
    if (!shared)
        s.lanes = lanes & near_lanes(s.at);
    if (!(s.lanes & (s.lanes - 1)))
        return 1u << first;
    if (shared)
        search_shared(&s, first, &f, metric, count, place != NULL);
    else
        search_scattered(&s, &f, metric, count, place != NULL);
    if (place)
        keep_lanes(place, m8_of(s.lanes),
                   (struct real8[]){f.place.x, f.place.y, f.place.z});
    else
        keep_lanes(sum, m8_of(s.lanes), f.sum);
    return s.lanes;
}

void OF_ISA(noise_powers_)(const double *x, size_t count, double y, bool single,
                           double *out)
{
    for (size_t i = 0; i < count; i += 8) {
        const struct real8 v = r8_load(x + i);
        r8_store(out + i, single ? r8_pow_single(v, y) : det_pow8(v, r8_set(y)));
    }
}
