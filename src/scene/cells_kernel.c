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

// Past this a coordinate is near the end of the integers.
#define NOISE_FAR 4611686018427387904.0

enum { REACH = 2, SLABS = 2 * REACH + 1, ALL_SLABS = 3 };

struct cells8 {
    struct vec8 at;
    const double *cell;
    unsigned hash_xy[SLABS][SLABS], z[SLABS];
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

LANES_INLINE void bound_slabs(struct cells8 *s, int axis, struct real8 at, int metric)
{
    for (int i = 0; i < SLABS; i++) {
        const double low = s->cell[axis] + (i - REACH);
        const struct real8 over = r8_sub(r8_set(low), at),
                           under = r8_sub(at, r8_set(low + 1)), zero = r8_set(0);
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

LANES_INLINE void keep8(struct found8 *f, struct real8 sum, struct vec3 q, int rank,
                        bool place)
{
    if (place) { // of equal ones that of the cell which is first in lexical order
        const struct mask8 nearer =
            m8_or(r8_lt(sum, f->sum[0]),
                  m8_and(r8_eq(sum, f->sum[0]), r8_lt(r8_set(rank), f->rank)));
        f->place = v8_select(nearer, V8_SET(q), f->place);
        f->rank = r8_select(nearer, r8_set(rank), f->rank);
        f->sum[0] = r8_min(f->sum[0], sum);
        return;
    }
    const struct real8 second = r8_max(f->sum[0], sum), third = r8_max(f->sum[1], second);
    f->sum[0] = r8_min(f->sum[0], sum);
    f->sum[1] = r8_min(f->sum[1], second);
    f->sum[2] = r8_min(f->sum[2], third);
}

LANES_INLINE void visit8(const struct cells8 *s, struct found8 *f,
                         const unsigned char at[3], int metric, int count, bool place)
{
    const int i = at[0], j = at[1], k = at[2];
    if (!(s->near[0][i] & s->near[1][j] & s->near[2][k]))
        return;
    const struct real8 least =
        r8_add(r8_add(r8_load(s->least[0][i]), r8_load(s->least[1][j])),
               r8_load(s->least[2][k]));
    if (!counts(s, least, most_of(f, count), place))
        return;
    const unsigned n = noise_hash_table[s->hash_xy[i][j] ^ s->z[k]];
    const uint32_t *r = noise_random_table + n;
    const struct vec3 q = vec3(s->cell[0] + (i - REACH) + r[0] * 0x1p-32,
                               s->cell[1] + (j - REACH) + r[1] * 0x1p-32,
                               s->cell[2] + (k - REACH) + r[2] * 0x1p-32);
    const struct vec8 e = v8_sub(V8_SET(q), s->at);
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
                             int metric, int count, bool place)
{
    if (!s->near[axis][slab])
        return;
    for (int u = 1; u <= 3; u++)
        for (int v = 1; v <= 3; v++) {
            unsigned char at[3];
            at[axis] = (unsigned char)slab;
            at[axis == 0] = (unsigned char)u;
            at[2 - (axis == 2)] = (unsigned char)v;
            visit8(s, f, at, metric, count, place);
        }
}

LANES_INLINE void search8(struct cells8 *s, struct found8 *f, int metric, int count,
                          bool place)
{
    bound_slabs(s, 0, s->at.x, metric);
    bound_slabs(s, 1, s->at.y, metric);
    bound_slabs(s, 2, s->at.z, metric);
    for (int a = 0; a < 3; a++)
        for (int i = 0; i < SLABS; i++)
            s->near[a][i] = s->lanes;
    for (int i = 0; i < FACES_END; i++)
        visit8(s, f, inner[i], metric, count, place);
    find_near(s, f, count, place);
    for (int i = FACES_END; i < 27; i++)
        visit8(s, f, inner[i], metric, count, place);
    find_near(s, f, count, place);
    for (int axis = 0; axis < 3; axis++) {
        visit_far8(s, f, axis, 0, metric, count, place);
        visit_far8(s, f, axis, SLABS - 1, metric, count, place);
    }
}

static void search_places(struct cells8 *s, struct found8 *f, int metric)
{
    if (metric == 2)
        search8(s, f, 2, 1, true);
    else
        search8(s, f, 1, 1, true);
}

static void search_sums(struct cells8 *s, struct found8 *f, int metric, int count)
{
    if (metric == 2)
        search8(s, f, 2, count, false);
    else
        search8(s, f, 1, count, false);
}

// Of `lanes` those in the cell of the first.
LANES_INLINE unsigned sharing(const double p[3][8], unsigned lanes, double cell[3])
{
    const int first = __builtin_ctz(lanes);
    for (int a = 0; a < 3; a++) {
        const struct real8 c = r8_floor(r8_sub(r8_load(p[a]), r8_set(PATTERN_EDGE)));
        cell[a] = floor(p[a][first] - PATTERN_EDGE);
        lanes &= m8_bits(r8_eq(c, r8_set(cell[a])));
    }
    return lanes | 1u << first; // no numbers are not the same
}

LANES_INLINE void keep_lanes(double to[3][8], struct mask8 m, const struct real8 v[3])
{
    for (int k = 0; k < 3; k++)
        r8_store(to[k], r8_select(m, v[k], r8_load(to[k])));
}

unsigned OF_ISA(noise_nearest_)(const double p[3][8], unsigned lanes, int metric,
                                int count, double sum[3][8], double place[3][8])
{
    double cell[3];
    lanes = sharing(p, lanes, cell);
    if (!(lanes & (lanes - 1)))
        return lanes;
    struct cells8 s;
    s.at = v8_load(p), s.cell = cell, s.lanes = lanes;
    const struct real8 far = r8_set(DBL_MAX);
    struct found8 f = {
        {far, far, far}, {r8_set(cell[0]), r8_set(cell[1]), r8_set(cell[2])}, r8_set(-1)};
    for (int i = 0; i < SLABS; i++) {
        const unsigned hx = noise_hash_table[wrapped(cell[0] + (i - REACH))];
        for (int j = 0; j < SLABS; j++)
            s.hash_xy[i][j] = noise_hash_table[hx ^ wrapped(cell[1] + (j - REACH))];
        s.z[i] = wrapped(cell[2] + (i - REACH));
    }
    if (place) {
        search_places(&s, &f, metric);
        keep_lanes(place, m8_of(lanes),
                   (struct real8[]){f.place.x, f.place.y, f.place.z});
    } else {
        search_sums(&s, &f, metric, count);
        keep_lanes(sum, m8_of(lanes), f.sum);
    }
    return lanes;
}

void OF_ISA(noise_powers_)(const double *x, size_t count, double y, bool single,
                           double *out)
{
    for (size_t i = 0; i < count; i += 8) {
        const struct real8 v = r8_load(x + i);
        r8_store(out + i, single ? r8_pow_single(v, y) : det_pow8(v, r8_set(y)));
    }
}
