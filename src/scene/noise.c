// Noise and turbulence (spec/textures 1 and 2).

#include "scene/noise.h"

#include <stdbool.h>
#include <string.h>

#include "scene/noise_tables.h"

// The cell of a point. Corners are named by their side of x and y: 00, 10, 01, 11.
struct lattice {
    unsigned z0, z1;               // of the cell, 0..4095, and of the next
    double fx, fy, fz, jx, jy, jz; // way from its first corner, and from its last
    unsigned h00, h10, h01, h11;   // hashes of x and y
    double w00, w10, w01, w11;     // weights by x and y
    double tz, sz;                 // weights of z0 and z1
};

static inline double clamp01(double v) { return v < 0 ? 0 : v > 1 ? 1 : v; }

static inline double split(double v, unsigned *cell)
{
    if (!(fabs(v) < NOISE_FAR))
        v = 0;
    int64_t t = (int64_t)(v - (v < 0 ? 1 - NOISE_EDGE : 0));
    *cell = (unsigned)(t + 10000) & 4095;
    return v - (double)t;
}

static inline double smooth(double u) { return u * u * (3 - 2 * u); }

static inline struct lattice lattice_of(struct vec3 p)
{
    struct lattice l;
    unsigned x, y;
    l.fx = split(p.x, &x);
    l.fy = split(p.y, &y);
    l.fz = split(p.z, &l.z0);
    l.z1 = l.z0 + 1;
    l.jx = l.fx - 1;
    l.jy = l.fy - 1;
    l.jz = l.fz - 1;
    const unsigned h0 = noise_hash_table[x], h1 = noise_hash_table[x + 1];
    l.h00 = noise_hash_table[h0 ^ y];
    l.h10 = noise_hash_table[h1 ^ y];
    l.h01 = noise_hash_table[h0 ^ (y + 1)];
    l.h11 = noise_hash_table[h1 ^ (y + 1)];
    const double sx = smooth(l.fx), sy = smooth(l.fy), tx = 1 - sx, ty = 1 - sy;
    l.w00 = tx * ty;
    l.w10 = sx * ty;
    l.w01 = tx * sy;
    l.w11 = sx * sy;
    l.sz = smooth(l.fz);
    l.tz = 1 - l.sz;
    return l;
}

// Where the table entries of a corner of the cell begin.
static inline unsigned place_of(unsigned hash_xy, unsigned z)
{
    return noise_hash_table[hash_xy ^ z] & 255;
}

static inline const double *corner(unsigned hash_xy, unsigned z)
{
    return noise_value_table + place_of(hash_xy, z);
}

static inline double blend(const double *t, double w, double dx, double dy, double dz)
{
    return w * (t[0] * 0.5 + t[1] * dx + t[2] * dy + t[3] * dz);
}

static inline double value_sum(struct vec3 p)
{
    const struct lattice l = lattice_of(p);
    double sum = blend(corner(l.h00, l.z0), l.w00 * l.tz, l.fx, l.fy, l.fz);
    sum += blend(corner(l.h10, l.z0), l.w10 * l.tz, l.jx, l.fy, l.fz);
    sum += blend(corner(l.h01, l.z0), l.w01 * l.tz, l.fx, l.jy, l.fz);
    sum += blend(corner(l.h11, l.z0), l.w11 * l.tz, l.jx, l.jy, l.fz);
    sum += blend(corner(l.h00, l.z1), l.w00 * l.sz, l.fx, l.fy, l.jz);
    sum += blend(corner(l.h10, l.z1), l.w10 * l.sz, l.jx, l.fy, l.jz);
    sum += blend(corner(l.h01, l.z1), l.w01 * l.sz, l.fx, l.jy, l.jz);
    sum += blend(corner(l.h11, l.z1), l.w11 * l.sz, l.jx, l.jy, l.jz);
    return sum;
}

// x and y of a vector side by side, which many processors compute at once.
typedef double pair __attribute__((vector_size(16)));
struct vector_sum {
    pair xy;
    double z;
};

static inline pair pair_at(const double *p)
{
    pair v;
    memcpy(&v, p, sizeof v);
    return v;
}

// blend of the entries of each component.
static inline void add_corner(struct vector_sum *sum, unsigned at, double w, double dx,
                              double dy, double dz)
{
    const double *t = noise_fan_table[at];
    sum->xy += w * (pair_at(t) * 0.5 + pair_at(t + 4) * dx + pair_at(t + 8) * dy +
                    pair_at(t + 12) * dz);
    sum->z += w * (t[2] * 0.5 + t[6] * dx + t[10] * dy + t[14] * dz);
}

struct vec3 noise_vector(struct vec3 p)
{
    const struct lattice l = lattice_of(p);
    // This order of corners is not the one of value_sum: the last bit depends on it.
    struct vector_sum sum = {{0, 0}, 0};
    add_corner(&sum, place_of(l.h00, l.z0), l.w00 * l.tz, l.fx, l.fy, l.fz);
    add_corner(&sum, place_of(l.h10, l.z0), l.w10 * l.tz, l.jx, l.fy, l.fz);
    add_corner(&sum, place_of(l.h11, l.z0), l.w11 * l.tz, l.jx, l.jy, l.fz);
    add_corner(&sum, place_of(l.h01, l.z0), l.w01 * l.tz, l.fx, l.jy, l.fz);
    add_corner(&sum, place_of(l.h01, l.z1), l.w01 * l.sz, l.fx, l.jy, l.jz);
    add_corner(&sum, place_of(l.h11, l.z1), l.w11 * l.sz, l.jx, l.jy, l.jz);
    add_corner(&sum, place_of(l.h10, l.z1), l.w10 * l.sz, l.jx, l.fy, l.jz);
    add_corner(&sum, place_of(l.h00, l.z1), l.w00 * l.sz, l.fx, l.fy, l.jz);
    return vec3(sum.xy[0], sum.xy[1], sum.z);
}

// Perlin, "An Image Synthesizer", 1985, with the table sizes of the scene language.
struct period {
    unsigned i0, i1;
    double r0, r1;
};

static inline struct period period_of(double v)
{
    struct period s;
    if (!(fabs(v) < NOISE_FAR / 4))
        v = 0;
    double t = v + 10000000.023157213, whole = floor(t);
    s.i0 = (unsigned)(int64_t)whole & (NOISE_GRADIENT_PERIOD - 1);
    s.i1 = (s.i0 + 1) & (NOISE_GRADIENT_PERIOD - 1);
    s.r0 = t - whole;
    s.r1 = s.r0 - 1;
    return s;
}

static inline double slope_at(unsigned i, double x, double y, double z)
{
    const double *g = noise_gradient[i];
    return x * g[0] + y * g[1] + z * g[2];
}

static inline double lerp(double t, double a, double b) { return a + t * (b - a); }

static double gradient_noise(struct vec3 p)
{
    const struct period x = period_of(p.x), y = period_of(p.y), z = period_of(p.z);
    const uint16_t *q = noise_permutation;
    const unsigned i = q[x.i0], j = q[x.i1];
    const unsigned b00 = q[i + y.i0], b10 = q[j + y.i0];
    const unsigned b01 = q[i + y.i1], b11 = q[j + y.i1];
    const double sx = smooth(x.r0), sy = smooth(y.r0), sz = smooth(z.r0);
    double a = lerp(sx, slope_at(b00 + z.i0, x.r0, y.r0, z.r0),
                    slope_at(b10 + z.i0, x.r1, y.r0, z.r0));
    double b = lerp(sx, slope_at(b01 + z.i0, x.r0, y.r1, z.r0),
                    slope_at(b11 + z.i0, x.r1, y.r1, z.r0));
    double c = lerp(sy, a, b);
    a = lerp(sx, slope_at(b00 + z.i1, x.r0, y.r0, z.r1),
             slope_at(b10 + z.i1, x.r1, y.r0, z.r1));
    b = lerp(sx, slope_at(b01 + z.i1, x.r0, y.r1, z.r1),
             slope_at(b11 + z.i1, x.r1, y.r1, z.r1));
    return lerp(sz, c, lerp(sy, a, b));
}

double noise_value(struct vec3 p, int generator)
{
    if (generator == NOISE_RANGE_CORRECTED)
        return clamp01((value_sum(p) + NOISE_CORRECTED_ADD) * NOISE_CORRECTED_SCALE);
    if (generator == NOISE_PERLIN)
        return clamp01(0.5 * (1.59 * gradient_noise(p) + 0.985));
    return clamp01(value_sum(p) + 0.5);
}

double noise_turbulence(struct vec3 p, double lambda, double omega, int octaves,
                        int generator)
{
    const bool signed_noise =
        generator == NOISE_RANGE_CORRECTED || generator == NOISE_PERLIN;
    double sum = noise_value(p, generator);
    if (signed_noise)
        sum = clamp01(2 * sum - 0.5); // later octaves are not clamped
    double l = lambda, o = omega;
    for (int i = 2; i <= octaves; i++) {
        double n = noise_value(vec3_scale(l, p), generator);
        sum += o * (signed_noise ? 2 * n - 0.5 : n);
        l *= lambda;
        o *= omega;
    }
    return sum;
}

struct vec3 noise_dturbulence(struct vec3 p, double lambda, double omega, int octaves)
{
    struct vec3 sum = noise_vector(p);
    double l = lambda, o = omega;
    for (int i = 2; i <= octaves; i++) {
        sum = vec3_mad(sum, o, noise_vector(vec3_scale(l, p)));
        l *= lambda;
        o *= omega;
    }
    return sum;
}

unsigned noise_hash(int64_t x, int64_t y, int64_t z)
{
    const unsigned hx = noise_hash_table[x & 4095];
    const unsigned hy = noise_hash_table[hx ^ (unsigned)(y & 4095)];
    return noise_hash_table[hy ^ (unsigned)(z & 4095)];
}

double noise_random(unsigned index)
{
    return noise_random_table[index % NOISE_RANDOM_COUNT] * 0x1p-32;
}

static int64_t cell_number(double v) { return fabs(v) < NOISE_FAR ? (int64_t)v : 0; }

unsigned noise_cell_hash(double x, double y, double z)
{
    return noise_hash(cell_number(x), cell_number(y), cell_number(z));
}

struct vec3 noise_cell_point(double x, double y, double z)
{
    const unsigned n = noise_cell_hash(x, y, z);
    return vec3(x + noise_random(n), y + noise_random(n + 1), z + noise_random(n + 2));
}

struct vec3 noise_wave_source(int i)
{
    if (i < NOISE_WAVE_COUNT) {
        const double *w = noise_wave_table[i];
        return vec3(w[0], w[1], w[2]);
    }
    return vec3_normalize(noise_vector(vec3(i, 0, 0)));
}

double noise_wave_frequency(int i)
{
    if (i < NOISE_WAVE_COUNT)
        return noise_wave_table[i][3];
    uint32_t s = NOISE_WAVE_SEED;
    unsigned drawn = 0;
    for (int k = 0; k <= i; k++)
        drawn = noise_draw(&s);
    return drawn * NOISE_WAVE_STEP + 0.01;
}
