// Noise at eight points, compiled once per instruction set: ISA names it. Each expression
// is that of scene/noise.c, in the same order.
#include "scene/noise_kernel.h"

#include <float.h>
#include <stdint.h>

#include "math/lanes.h"
#include "scene/noise.h"
#include "scene/noise_tables.h"

#define PASTE_(a, b) a##b
#define PASTE(a, b)  PASTE_(a, b)
#define TEXT_(a)     #a
#define TEXT(a)      TEXT_(a)

#define NOISE_EDGE 1e-10
#define NOISE_FAR  4611686018427387904.0

// Cells and places in them; `row` leads to the table entries of the corners, whose bits
// 0, 1 and 2 say which side of x, y and z they are at.
struct lattice8 {
    struct real8 fx, fy, fz;
    const double *row[8][8]; // [corner][lane]
};

LANES_INLINE struct real8 split8(struct real8 v, double cell[8])
{
    v = r8_select(r8_lt(r8_abs(v), r8_set(NOISE_FAR)), v, r8_set(0));
    const struct real8 below =
        r8_select(r8_lt(v, r8_set(0)), r8_set(1 - NOISE_EDGE), r8_set(0));
    const struct real8 x = r8_sub(v, below);
    // Towards zero; a sum with 0 has no negative zero.
    const struct real8 t = r8_add(r8_copysign(r8_floor(r8_abs(x)), x), r8_set(0));
    r8_store(cell, t);
    return r8_sub(v, t);
}

static inline unsigned cell_of(double t) { return (unsigned)((int64_t)t + 10000) & 4095; }

static inline const double *corner(unsigned hash_xy, unsigned z)
{
    return noise_value_table + (noise_hash_table[hash_xy ^ z] & 255);
}

LANES_INLINE void lattice_of(struct vec8 p, double scale, struct lattice8 *l)
{
    double cx[8], cy[8], cz[8];
    const struct real8 s = r8_set(scale);
    l->fx = split8(r8_mul(s, p.x), cx);
    l->fy = split8(r8_mul(s, p.y), cy);
    l->fz = split8(r8_mul(s, p.z), cz);
    for (int i = 0; i < 8; i++) {
        const unsigned x = cell_of(cx[i]), y = cell_of(cy[i]), z = cell_of(cz[i]);
        const unsigned h0 = noise_hash_table[x], h1 = noise_hash_table[x + 1];
        const unsigned h00 = noise_hash_table[h0 ^ y], h10 = noise_hash_table[h1 ^ y];
        const unsigned h01 = noise_hash_table[h0 ^ (y + 1)];
        const unsigned h11 = noise_hash_table[h1 ^ (y + 1)];
        l->row[0][i] = corner(h00, z);
        l->row[1][i] = corner(h10, z);
        l->row[2][i] = corner(h01, z);
        l->row[3][i] = corner(h11, z);
        l->row[4][i] = corner(h00, z + 1);
        l->row[5][i] = corner(h10, z + 1);
        l->row[6][i] = corner(h01, z + 1);
        l->row[7][i] = corner(h11, z + 1);
    }
}

LANES_INLINE struct real8 smooth8(struct real8 u)
{
    return r8_mul(r8_mul(u, u), r8_sub(r8_set(3), r8_mul(r8_set(2), u)));
}

LANES_INLINE struct real8 blend8(const struct real8 t[4], struct real8 w, struct real8 dx,
                                 struct real8 dy, struct real8 dz)
{
    const struct real8 plane = r8_add(r8_mul(t[0], r8_set(0.5)), r8_mul(t[1], dx));
    return r8_mul(w, r8_add(r8_add(plane, r8_mul(t[2], dy)), r8_mul(t[3], dz)));
}

// What a corner counts and where the point is from it.
struct corner8 {
    struct real8 w, dx, dy, dz;
};

LANES_INLINE void corners_of(const struct lattice8 *l, struct corner8 out[8])
{
    const struct real8 one = r8_set(1);
    const struct real8 sx = smooth8(l->fx), sy = smooth8(l->fy), sz = smooth8(l->fz);
    const struct real8 wx[2] = {r8_sub(one, sx), sx}, wy[2] = {r8_sub(one, sy), sy},
                       wz[2] = {r8_sub(one, sz), sz};
    const struct real8 dx[2] = {l->fx, r8_sub(l->fx, one)},
                       dy[2] = {l->fy, r8_sub(l->fy, one)},
                       dz[2] = {l->fz, r8_sub(l->fz, one)};
#pragma GCC unroll 8
    for (int c = 0; c < 8; c++)
        out[c] = (struct corner8){r8_mul(r8_mul(wx[c & 1], wy[c >> 1 & 1]), wz[c >> 2]),
                                  dx[c & 1], dy[c >> 1 & 1], dz[c >> 2]};
}

LANES_INLINE struct real8 clamp8(struct real8 v)
{
    const struct real8 zero = r8_set(0), one = r8_set(1);
    return r8_select(r8_lt(v, zero), zero, r8_select(r8_lt(one, v), one, v));
}

LANES_INLINE struct real8 value_sum8(struct vec8 p, double scale)
{
    struct lattice8 l;
    struct corner8 k[8];
    struct real8 t[4];
    lattice_of(p, scale, &l);
    corners_of(&l, k);
    r8_load_rows(l.row[0], 0, t);
    struct real8 sum = blend8(t, k[0].w, k[0].dx, k[0].dy, k[0].dz);
#pragma GCC unroll 7
    for (int c = 1; c < 8; c++) {
        r8_load_rows(l.row[c], 0, t);
        sum = r8_add(sum, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
    }
    return sum;
}

// The gradient noise has no lanes.
static struct real8 perlin8(const double p[3][8], double scale)
{
    double v[8];
    for (int i = 0; i < 8; i++)
        v[i] = noise_value(vec3(scale * p[0][i], scale * p[1][i], scale * p[2][i]),
                           NOISE_PERLIN);
    return r8_load(v);
}

LANES_INLINE struct vec8 load8(const double p[3][8])
{
    return (struct vec8){r8_load(p[0]), r8_load(p[1]), r8_load(p[2])};
}

LANES_INLINE struct real8 value8(const double p[3][8], struct vec8 at, double scale,
                                 int generator)
{
    if (generator == NOISE_PERLIN)
        return perlin8(p, scale);
    const struct real8 sum = value_sum8(at, scale);
    return clamp8(generator == NOISE_RANGE_CORRECTED
                      ? r8_mul(r8_add(sum, r8_set(1.05242)), r8_set(0.48985582))
                      : r8_add(sum, r8_set(0.5)));
}

static void value(const double p[3][8], double scale, int generator, double out[8])
{
    r8_store(out, value8(p, load8(p), scale, generator));
}

LANES_INLINE struct vec8 vector8(struct vec8 p, double scale)
{
    // The order of noise_vector: it is not that of noise_value.
    static const int order[8] = {0, 1, 3, 2, 6, 7, 5, 4};
    struct lattice8 l;
    struct corner8 k[8];
    lattice_of(p, scale, &l);
    corners_of(&l, k);
    struct vec8 sum = {r8_set(0), r8_set(0), r8_set(0)};
#pragma GCC unroll 8
    for (int i = 0; i < 8; i++) {
        const int c = order[i];
        struct real8 t[4];
        r8_load_rows(l.row[c], 0, t);
        sum.x = r8_add(sum.x, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
        r8_load_rows(l.row[c], 4, t);
        sum.y = r8_add(sum.y, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
        r8_load_rows(l.row[c], 8, t);
        sum.z = r8_add(sum.z, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
    }
    return sum;
}

LANES_INLINE void store8(double out[3][8], struct vec8 v)
{
    r8_store(out[0], v.x);
    r8_store(out[1], v.y);
    r8_store(out[2], v.z);
}

static void vector(const double p[3][8], double scale, double out[3][8])
{
    store8(out, vector8(load8(p), scale));
}

// ---- octaves --------------------------------------------------------------------------

// What an octave adds, before its weight. Generators 2 and 3 are about a half.
LANES_INLINE struct real8 octave8(struct real8 n, int kind, bool centred, bool first)
{
    const struct real8 half = r8_set(0.5), two = r8_set(2);
    if (kind == OCTAVES_FOLDED) {
        if (!centred)
            return r8_abs(r8_sub(half, n));
        n = r8_abs(r8_sub(r8_set(1), r8_mul(two, n)));
        return r8_select(r8_lt(half, n), half, n);
    }
    if (!centred)
        return n;
    n = r8_sub(r8_mul(two, n), half);
    return kind == OCTAVES_STRETCHED || first ? clamp8(n) : n;
}

static void values(const double p[3][8], const struct noise_octaves *o, int generator,
                   double out[8])
{
    const bool centred = generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN;
    const struct vec8 at = load8(p);
    double scale = o->scale, weight = o->weight;
    struct real8 sum = r8_set(0);
    int i = 0;
    do {
        const struct real8 n = value8(p, at, scale, generator);
        sum = r8_add(sum, r8_mul(r8_set(weight), octave8(n, o->kind, centred, i == 0)));
        scale *= o->lambda;
        weight *= o->omega;
    } while (++i < o->count);
    r8_store(out, sum);
}

static void vectors(const double p[3][8], const struct noise_octaves *o, double out[3][8])
{
    const struct vec8 at = load8(p);
    double scale = o->scale, weight = o->weight;
    struct vec8 sum = {r8_set(0), r8_set(0), r8_set(0)};
    int i = 0;
    do {
        struct vec8 v = vector8(at, scale);
        if (o->kind == OCTAVES_FOLDED)
            v = (struct vec8){r8_abs(v.x), r8_abs(v.y), r8_abs(v.z)};
        sum = v8_mad(sum, r8_set(weight), v);
        scale *= o->lambda;
        weight *= o->omega;
    } while (++i < o->count);
    store8(out, sum);
}

// ---- random points of cells (scene/patterns/crackle.c) --------------------------------

enum { REACH = 2, SLABS = 2 * REACH + 1 };

struct cells8 {
    unsigned hash_xy[SLABS][SLABS], z[SLABS];
    struct vec8 at;
    struct real8 least[3][SLABS]; // by axis and slab: what a sum is at least
    struct real8 sum[3];          // ascending
    const double *cell;
    unsigned lanes;
    int metric, limit;
};

static inline unsigned wrapped(double v)
{
    return (unsigned)(fabs(v) < NOISE_FAR ? (int64_t)v : 0) & 4095;
}

LANES_INLINE void bound_slabs(struct cells8 *s, int axis, struct real8 at)
{
    for (int i = 0; i < SLABS; i++) {
        const double low = s->cell[axis] + (i - REACH);
        const struct real8 over = r8_sub(r8_set(low), at),
                           under = r8_sub(at, r8_set(low + 1)), zero = r8_set(0);
        const struct real8 e = r8_max(zero, r8_max(over, under));
        s->least[axis][i] = s->metric == 2 ? r8_mul(e, e) : e;
    }
}

LANES_INLINE void keep_smallest8(struct real8 d[3], struct real8 sum)
{
    const struct real8 second = r8_max(d[0], sum), third = r8_max(d[1], second);
    d[0] = r8_min(d[0], sum);
    d[1] = r8_min(d[1], second);
    d[2] = r8_min(d[2], third);
}

static void visit8(struct cells8 *s, int i, int j, int k)
{
    const struct real8 least =
        r8_add(r8_add(s->least[0][i], s->least[1][j]), s->least[2][k]);
    if (!(m8_bits(r8_lt(least, s->sum[s->limit])) & s->lanes))
        return;
    const unsigned n = noise_hash_table[s->hash_xy[i][j] ^ s->z[k]];
    const uint32_t *r = noise_random_table + n;
    const struct vec3 q = vec3(s->cell[0] + (i - REACH) + r[0] * 0x1p-32,
                               s->cell[1] + (j - REACH) + r[1] * 0x1p-32,
                               s->cell[2] + (k - REACH) + r[2] * 0x1p-32);
    const struct vec8 e = v8_sub(V8_SET(q), s->at);
    keep_smallest8(s->sum, s->metric == 2
                               ? v8_dot(e, e)
                               : r8_add(r8_add(r8_abs(e.x), r8_abs(e.y)), r8_abs(e.z)));
}

static void visit_far8(struct cells8 *s, int axis, int slab)
{
    if (!(m8_bits(r8_lt(s->least[axis][slab], s->sum[s->limit])) & s->lanes))
        return;
    for (int u = 1; u <= 3; u++)
        for (int v = 1; v <= 3; v++)
            visit8(s, axis == 0 ? slab : u,
                   axis == 1   ? slab
                   : axis == 0 ? u
                               : v,
                   axis == 2 ? slab : v);
}

static void nearest(const double p[3][8], const double cell[3], unsigned lanes,
                    int metric, int count, double sum[3][8])
{
    struct cells8 s = {.at = {r8_load(p[0]), r8_load(p[1]), r8_load(p[2])},
                       .cell = cell,
                       .lanes = lanes,
                       .metric = metric,
                       .limit = count - 1};
    for (int i = 0; i < SLABS; i++) {
        const unsigned hx = noise_hash_table[wrapped(cell[0] + (i - REACH))];
        for (int j = 0; j < SLABS; j++)
            s.hash_xy[i][j] = noise_hash_table[hx ^ wrapped(cell[1] + (j - REACH))];
        s.z[i] = wrapped(cell[2] + (i - REACH));
    }
    bound_slabs(&s, 0, s.at.x);
    bound_slabs(&s, 1, s.at.y);
    bound_slabs(&s, 2, s.at.z);
    s.sum[0] = s.sum[1] = s.sum[2] = r8_set(DBL_MAX);
    // Those that share more with the middle first.
    for (int away = 0; away <= 3; away++)
        for (int i = 1; i <= 3; i++)
            for (int j = 1; j <= 3; j++)
                for (int k = 1; k <= 3; k++)
                    if ((i != 2) + (j != 2) + (k != 2) == away)
                        visit8(&s, i, j, k);
    for (int axis = 0; axis < 3; axis++) {
        visit_far8(&s, axis, 0);
        visit_far8(&s, axis, SLABS - 1);
    }
    for (int k = 0; k < 3; k++)
        r8_store(sum[k], s.sum[k]);
}

const struct noise_kernels PASTE(noise_kernels_, ISA) = {TEXT(ISA), value,   vector,
                                                         values,    vectors, nearest,
                                                         PASTE(noise_bounds_, ISA)};
