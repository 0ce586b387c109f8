// Noise at eight points, compiled once per instruction set: ISA names it. Each expression
// is that of scene/noise.c, in the same order.
#include "scene/noise_kernel.h"

#include <stdint.h>

#include "math/isa.h"
#include "math/lanes.h"
#include "math/quick_lanes.h"
#include "scene/noise.h"
#include "scene/noise_lattice.h"
#include "scene/noise_tables.h"
#include "scene/pattern_lanes.h"
#include "scene/pigment_tape.h"
#include "scene/tape_kernel.h"

LANES_INLINE struct real8 smooth8(struct real8 u)
{
    return r8_mul(r8_mul(u, u), r8_sub(r8_set(3), r8_mul(r8_set(2), u)));
}

LANES_INLINE struct real8 blend8(const struct real8 t[4], struct real8 w, struct real8 dx,
                                 struct real8 dy, struct real8 dz)
{
    const struct real8 plane = r8_add(t[0], r8_mul(t[1], dx));
    return r8_mul(w, r8_add(r8_add(plane, r8_mul(t[2], dy)), r8_mul(t[3], dz)));
}

// What a corner counts and where the point is from it.
struct corner8 {
    struct real8 w, dx, dy, dz;
};

LANES_INLINE void corners_of(const struct place8 *l, struct corner8 out[8])
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

// Of numbers.
LANES_INLINE struct real8 clamp8(struct real8 v)
{
    return r8_min(r8_max(v, r8_set(0)), r8_set(1));
}

LANES_INLINE struct real8 value_corners8(const struct place8 *p, const struct lattice8 *l,
                                         int cells)
{
    struct corner8 k[8];
    struct real8 t[4];
    corners_of(p, k);
    entries_of(l, cells, 0, 0, t);
    struct real8 sum = blend8(t, k[0].w, k[0].dx, k[0].dy, k[0].dz);
#pragma GCC unroll 7
    for (int c = 1; c < 8; c++) {
        entries_of(l, cells, c, 0, t);
        sum = r8_add(sum, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
    }
    return sum;
}

LANES_INLINE struct real8 value_sum8(const struct place8 *p)
{
    struct lattice8 l;
    lattice_of(p, &l);
    return l.cells == 1   ? value_corners8(p, &l, 1)
           : l.cells == 2 ? value_corners8(p, &l, 2)
           : l.cells      ? value_corners8(p, &l, l.cells)
                          : value_corners8(p, &l, 0);
}

LANES_INLINE struct real8 lattice_value8(const struct place8 *p, int generator)
{
    const struct real8 sum = value_sum8(p);
    return clamp8(generator == NOISE_RANGE_CORRECTED
                      ? r8_mul(r8_add(sum, r8_set(NOISE_CORRECTED_ADD)),
                               r8_set(NOISE_CORRECTED_SCALE))
                      : r8_add(sum, r8_set(0.5)));
}

LANES_INLINE struct vec8 load8(const double p[3][8])
{
    return (struct vec8){r8_load(p[0]), r8_load(p[1]), r8_load(p[2])};
}

// ---- generator 3 ----------------------------------------------------------------------

// Places in the cells of the gradients, seen from either side, and their numbers.
struct period8 {
    struct real8 r[2];
    uint32_t i[8];
};

LANES_INLINE struct period8 period8(struct real8 v)
{
    struct period8 s;
    double cell[8];
    v = r8_select(r8_lt(r8_abs(v), r8_set(NOISE_FAR / 4)), v, r8_set(0));
    const struct real8 t = r8_add(v, r8_set(10000000.023157213)), whole = r8_floor(t);
    s.r[0] = r8_sub(t, whole);
    s.r[1] = r8_sub(s.r[0], r8_set(1));
    r8_store(cell, whole);
    for (int i = 0; i < 8; i++)
        s.i[i] = (unsigned)(int64_t)cell[i] & (NOISE_GRADIENT_PERIOD - 1);
    return s;
}

LANES_INLINE struct real8 slope8(const uint32_t at[8], struct real8 x, struct real8 y,
                                 struct real8 z)
{
    const double *row[8];
    struct real8 g[4];
    for (int i = 0; i < 8; i++)
        row[i] = noise_gradient[at[i]];
    r8_load_rows(row, 0, g);
    return r8_add(r8_add(r8_mul(x, g[0]), r8_mul(y, g[1])), r8_mul(z, g[2]));
}

LANES_INLINE struct real8 lerp8(struct real8 t, struct real8 a, struct real8 b)
{
    return r8_add(a, r8_mul(t, r8_sub(b, a)));
}

static struct real8 gradient_noise8(struct vec8 p)
{
    const uint16_t *q = noise_permutation;
    const struct period8 x = period8(p.x), y = period8(p.y), z = period8(p.z);
    const struct real8 sx = smooth8(x.r[0]), sy = smooth8(y.r[0]), sz = smooth8(z.r[0]);
    uint32_t at[8][8]; // [corner][lane]
    for (int i = 0; i < 8; i++) {
        const unsigned y1 = (y.i[i] + 1) & (NOISE_GRADIENT_PERIOD - 1);
        const unsigned z1 = (z.i[i] + 1) & (NOISE_GRADIENT_PERIOD - 1);
        const unsigned x0 = q[x.i[i]], x1 = q[(x.i[i] + 1) & (NOISE_GRADIENT_PERIOD - 1)];
        const unsigned b[4] = {q[x0 + y.i[i]], q[x1 + y.i[i]], q[x0 + y1], q[x1 + y1]};
        for (int c = 0; c < 4; c++) {
            at[c][i] = b[c] + z.i[i];
            at[4 + c][i] = b[c] + z1;
        }
    }
    struct real8 plane[2];
#pragma GCC unroll 2
    for (int k = 0; k < 2; k++) {
        const uint32_t(*c)[8] = (const uint32_t(*)[8])at + 4 * k;
        const struct real8 a = lerp8(sx, slope8(c[0], x.r[0], y.r[0], z.r[k]),
                                     slope8(c[1], x.r[1], y.r[0], z.r[k]));
        const struct real8 b = lerp8(sx, slope8(c[2], x.r[0], y.r[1], z.r[k]),
                                     slope8(c[3], x.r[1], y.r[1], z.r[k]));
        plane[k] = lerp8(sy, a, b);
    }
    return lerp8(sz, plane[0], plane[1]);
}

LANES_INLINE struct real8 gradient_value8(struct vec8 p, double scale)
{
    const struct real8 s = r8_set(scale);
    const struct real8 n =
        gradient_noise8((struct vec8){r8_mul(s, p.x), r8_mul(s, p.y), r8_mul(s, p.z)});
    return clamp8(r8_mul(r8_set(0.5), r8_add(r8_mul(r8_set(1.59), n), r8_set(0.985))));
}

static void value(const double p[3][8], double scale, int generator, double out[8])
{
    const struct vec8 at = load8(p);
    struct place8 place;
    if (generator == NOISE_PERLIN) {
        r8_store(out, gradient_value8(at, scale));
        return;
    }
    place_of(at, scale, are_near(at, scale), &place);
    r8_store(out, lattice_value8(&place, generator));
}

// ---- vectors --------------------------------------------------------------------------

// The corners in the order of noise_vector: it is not that of noise_value.
static const int vector_order[8] = {0, 1, 3, 2, 6, 7, 5, 4};

// The second and third component begin four and eight entries further: rows of the table.
LANES_INLINE struct vec8 vector_corners8(const struct place8 *p, const struct lattice8 *l,
                                         int cells)
{
    struct corner8 k[8];
    corners_of(p, k);
    struct vec8 sum = {r8_set(0), r8_set(0), r8_set(0)};
#pragma GCC unroll 8
    for (int i = 0; i < 8; i++) {
        const int c = vector_order[i];
        struct real8 t[4];
        entries_of(l, cells, c, 0, t);
        sum.x = r8_add(sum.x, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
        entries_of(l, cells, c, 16, t);
        sum.y = r8_add(sum.y, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
        entries_of(l, cells, c, 32, t);
        sum.z = r8_add(sum.z, blend8(t, k[c].w, k[c].dx, k[c].dy, k[c].dz));
    }
    return sum;
}

#if defined(__AVX2__)
// Where the points are in several cells: the three components side by side, point by point,
// which takes no shuffles. Ways are doubled and weights halved, which rounds nothing and
// saves the halving of each first entry.
struct weights8 {
    double w[8][8], dx[2][8], dy[2][8], dz[2][8];
};

LANES_INLINE struct real8 twice8(struct real8 v) { return r8_add(v, v); }

LANES_INLINE __m256d times4(const double *fan, double v)
{
    return _mm256_mul_pd(_mm256_loadu_pd(fan), _mm256_set1_pd(v));
}

LANES_INLINE __m256d vector_point(const struct place8 *p, const struct weights8 *k,
                                  int lane)
{
    const unsigned z = (unsigned)p->number[2][lane];
    const double dx[2] = {k->dx[0][lane], k->dx[1][lane]},
                 dy[2] = {k->dy[0][lane], k->dy[1][lane]},
                 dz[2] = {k->dz[0][lane], k->dz[1][lane]};
    unsigned hash_xy[4];
    columns_of(p->number, lane, hash_xy);
    __m256d sum = _mm256_setzero_pd();
#pragma GCC unroll 8
    for (int i = 0; i < 8; i++) {
        const int c = vector_order[i];
        const double *fan = noise_fan_table[0] +
                            noise_corner_table[hash_xy[c & 3] ^ (z + (unsigned)(c >> 2))];
        __m256d t = _mm256_add_pd(_mm256_loadu_pd(fan), times4(fan + 4, dx[c & 1]));
        t = _mm256_add_pd(t, times4(fan + 8, dy[c >> 1 & 1]));
        t = _mm256_add_pd(t, times4(fan + 12, dz[c >> 2]));
        sum = _mm256_add_pd(sum, _mm256_mul_pd(_mm256_set1_pd(k->w[c][lane]), t));
    }
    return sum;
}

static __attribute__((noinline)) struct vec8 vector_points8(const struct place8 *p)
{
    struct corner8 k[8];
    struct weights8 w;
    double out[8][4];
    const double *row[8];
    struct real8 t[4];
    corners_of(p, k);
    for (int c = 0; c < 8; c++)
        r8_store(w.w[c], r8_mul(k[c].w, r8_set(0.5)));
    for (int i = 0; i < 2; i++) {
        r8_store(w.dx[i], twice8(k[i].dx));
        r8_store(w.dy[i], twice8(k[2 * i].dy));
        r8_store(w.dz[i], twice8(k[4 * i].dz));
    }
#pragma GCC unroll 1
    for (int i = 0; i < 8; i++) {
        _mm256_storeu_pd(out[i], vector_point(p, &w, i));
        row[i] = out[i];
    }
    r8_load_rows(row, 0, t);
    return (struct vec8){t[0], t[1], t[2]};
}

LANES_INLINE struct vec8 vector8(const struct place8 *p)
{
    if (key_changes(p->key))
        return vector_points8(p);
    struct lattice8 l;
    rows_of(p->number, 0, &l.cell_row[0][0], CELLS_MAX);
    return vector_corners8(p, &l, 1);
}
#else
LANES_INLINE struct vec8 vector8(const struct place8 *p)
{
    struct lattice8 l;
    lattice_of(p, &l);
    return l.cells == 1   ? vector_corners8(p, &l, 1)
           : l.cells == 2 ? vector_corners8(p, &l, 2)
           : l.cells      ? vector_corners8(p, &l, l.cells)
                          : vector_corners8(p, &l, 0);
}
#endif

LANES_INLINE void store8(double out[3][8], struct vec8 v)
{
    r8_store(out[0], v.x);
    r8_store(out[1], v.y);
    r8_store(out[2], v.z);
}

static void vector(const double p[3][8], double scale, double out[3][8])
{
    struct place8 place;
    const struct vec8 at = load8(p);
    place_of(at, scale, are_near(at, scale), &place);
    store8(out, vector8(&place));
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

// Places of the next octaves are found together: one alone would wait for each of its
// operations.
enum { AHEAD = 4 };

LANES_INLINE void look_ahead(struct vec8 at, double scale, double lambda, int left,
                             struct place8 out[AHEAD])
{
    const int count = left < 1 ? 1 : left < AHEAD ? left : AHEAD;
    double largest = fabs(scale), last = scale;
    for (int k = 1; k < count; k++) {
        last *= lambda;
        largest = larger(largest, fabs(last));
    }
    if (are_near(at, largest))
        for (int k = 0; k < count; k++, scale *= lambda)
            place_of(at, scale, true, &out[k]);
    else
        for (int k = 0; k < count; k++, scale *= lambda)
            place_of(at, scale, false, &out[k]);
}

static void values(const double p[3][8], const struct noise_octaves *o, int generator,
                   double out[8])
{
    const bool centred = generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN;
    const struct vec8 at = load8(p);
    struct place8 place[AHEAD];
    double scale = o->scale, weight = o->weight;
    struct real8 sum = r8_set(0);
    int i = 0;
    do {
        struct real8 n;
        if (generator == NOISE_PERLIN) {
            n = gradient_value8(at, scale);
        } else {
            if (i % AHEAD == 0)
                look_ahead(at, scale, o->lambda, o->count - i, place);
            n = lattice_value8(&place[i % AHEAD], generator);
        }
        sum = r8_add(sum, r8_mul(r8_set(weight), octave8(n, o->kind, centred, i == 0)));
        scale *= o->lambda;
        weight *= o->omega;
    } while (++i < o->count);
    r8_store(out, sum);
}

static void vectors(const double p[3][8], const struct noise_octaves *o, double out[3][8])
{
    const struct vec8 at = load8(p);
    struct place8 place[AHEAD];
    double scale = o->scale, weight = o->weight;
    struct vec8 sum = {r8_set(0), r8_set(0), r8_set(0)};
    int i = 0;
    do {
        if (i % AHEAD == 0)
            look_ahead(at, scale, o->lambda, o->count - i, place);
        struct vec8 v = vector8(&place[i % AHEAD]);
        if (o->kind == OCTAVES_FOLDED)
            v = (struct vec8){r8_abs(v.x), r8_abs(v.y), r8_abs(v.z)};
        sum = v8_mad(sum, r8_set(weight), v);
        scale *= o->lambda;
        weight *= o->omega;
    } while (++i < o->count);
    store8(out, sum);
}

// ---- elementary functions of patterns -------------------------------------------------

static void cycloidals(const double v[8], double out[8])
{
    r8_store(out, cycloidal8(r8_load(v)));
}

static void sines(const double v[8], double out[8])
{
    const struct real8 x = r8_load(v);
    struct real8 s, c;
    quick_sincos8(x, &s, &c);
    r8_store(out, s);
    const unsigned near = m8_bits(r8_lt(r8_abs(x), r8_set(QUICK_SINE_MOST)));
    for (unsigned bits = 255 & ~near; bits; bits &= bits - 1)
        out[__builtin_ctz(bits)] = det_sin(v[__builtin_ctz(bits)]);
}

static void angles(const double y[8], const double x[8], double out[8])
{
    r8_store(out, quick_atan2_8(r8_load(y), r8_load(x)));
}

static void powers(const double x[8], double y, double out[8]) { quick_pow8(x, y, out); }

const struct noise_kernels OF_ISA(noise_kernels_) = {ISA_TEXT,
                                                     value,
                                                     vector,
                                                     values,
                                                     vectors,
                                                     OF_ISA(noise_nearest_),
                                                     OF_ISA(noise_powers_),
                                                     OF_ISA(noise_bounds_),
                                                     OF_ISA(noise_cells_bounds_),
                                                     cycloidals,
                                                     sines,
                                                     angles,
                                                     powers,
                                                     OF_ISA(noise_rings_),
                                                     OF_ISA(noise_ring_slopes_),
                                                     OF_ISA(noise_grid_),
                                                     OF_ISA(noise_fractal_),
                                                     &OF_ISA(tape_kernels_),
                                                     &OF_ISA(surface_kernels_)};
