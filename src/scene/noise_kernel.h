#ifndef SCENE_NOISE_KERNEL_H
#define SCENE_NOISE_KERNEL_H

#include <stdbool.h>
#include <stddef.h>

// Noise at eight points, compiled once per instruction set (math/lanes.h). The bits are
// those of scene/noise.h.
// A sum over octaves: the noise at scale * p, then lambda times that scale and so on, with
// weights that go down by omega.
struct noise_octaves {
    double scale, lambda, weight, omega;
    int count; // less than 1 is 1
    enum {
        OCTAVES_TURBULENCE, // noise_turbulence; the vectors of noise_dturbulence
        OCTAVES_FOLDED,     // distances from the middle; sizes of vectors
        OCTAVES_STRETCHED,  // clamped
    } kind;
};

// Bounds over eight boxes lo..hi, as noise_bounds but for roundings.
struct noise_bounds8 {
    double lo[8], hi[8], slope_lo[3][8], slope_hi[3][8];
};
typedef void noise_bounds_kernel(const double lo[3][8], const double hi[3][8],
                                 int generator, struct noise_bounds8 *out);
noise_bounds_kernel noise_bounds_base, noise_bounds_avx2, noise_bounds_avx512;

// A sum of the distances to the three nearest points of cells, clamped (crackle): bounds over
// eight boxes, and of the slopes if wanted. For a metric of at least 1 and an offset that is
// not negative, or a metric of 1 or 2. `twice`: 2 * metric where it is whole, else 0.
struct noise_cells_form {
    double metric, offset, form[3];
    int twice, wanted; // wanted: how many of the points have a say
};
typedef void noise_cells_bounds_kernel(const struct noise_cells_form *f,
                                       const double lo[3][8], const double hi[3][8],
                                       bool slopes, struct noise_bounds8 *out);
noise_cells_bounds_kernel noise_cells_bounds_base, noise_cells_bounds_avx2,
    noise_cells_bounds_avx512;

struct tape_kernels;    // scene/tape_kernel.h
struct surface_kernels; // scene/pigment_tape.h
// The three smallest of the squares (metric 2) or sums (metric 1) of the distances from
// points to the random points of the cells around (scene/patterns/cellular.h). Those after
// the first `count` may be too large. `place`, if not NULL: only the nearest point is wanted,
// and stored there, of equally near ones that of the cell which is first in lexical order.
// It is done for those of the points `lanes` that are not too far off, which it returns; if
// that is one alone, which is sooner done by itself, nothing is stored.
typedef unsigned noise_nearest_kernel(const double p[3][8], unsigned lanes, int metric,
                                      int count, double sum[3][8], double place[3][8]);
noise_nearest_kernel noise_nearest_base, noise_nearest_avx2, noise_nearest_avx512;

// det_pow or, `single`, det_pow_single of `count` numbers, a multiple of eight; out may be x.
typedef void noise_powers_kernel(const double *x, size_t count, double y, bool single,
                                 double *out);
noise_powers_kernel noise_powers_base, noise_powers_avx2, noise_powers_avx512;

// Rings around the first `count` wave sources (scene/patterns/rings.h).
struct noise_rings {
    int count;
    double frequency, phase;
    bool own_widths; // else all have the same
};
// The mean at eight points; what they add to normals n.
typedef void noise_rings_kernel(const double p[3][8], const struct noise_rings *r,
                                double out[8]);
typedef void noise_ring_slopes_kernel(const double p[3][8], const struct noise_rings *r,
                                      float amount, double n[3][8]);
noise_rings_kernel noise_rings_base, noise_rings_avx2, noise_rings_avx512;
noise_ring_slopes_kernel noise_ring_slopes_base, noise_ring_slopes_avx2,
    noise_ring_slopes_avx512;

// Samples of a grid that fills the unit cube, with linear steps between them; 0 outside
// (scene/patterns/density_file.c).
struct density_grid;
typedef void noise_grid_kernel(const struct density_grid *g, const double p[3][8],
                               double out[8]);
noise_grid_kernel noise_grid_base, noise_grid_avx2, noise_grid_avx512;

// Fractals (scene/patterns/fractal.h).
struct pattern;
enum fractal_kind { FRACTAL_MANDEL, FRACTAL_JULIA, FRACTAL_MAGNET };
typedef void noise_fractal_kernel(const struct pattern *p, enum fractal_kind kind,
                                  const double at[3][8], double out[8]);
noise_fractal_kernel noise_fractal_base, noise_fractal_avx2, noise_fractal_avx512;

struct noise_kernels {
    const char *name;
    // noise_value at scale * p.
    void (*value)(const double p[3][8], double scale, int generator, double out[8]);
    // noise_vector at scale * p.
    void (*vector)(const double p[3][8], double scale, double out[3][8]);
    void (*values)(const double p[3][8], const struct noise_octaves *o, int generator,
                   double out[8]);
    void (*vectors)(const double p[3][8], const struct noise_octaves *o,
                    double out[3][8]);
    noise_nearest_kernel *nearest;
    noise_powers_kernel *powers;
    noise_bounds_kernel *bounds;
    noise_cells_bounds_kernel *cells_bounds;
    // cycloidal of scene/pattern_math.h, and quick_pow.
    void (*cycloidal)(const double v[8], double out[8]);
    void (*sine)(const double v[8], double out[8]);                     // pattern_sine
    void (*atan2)(const double y[8], const double x[8], double out[8]); // quick_atan2
    void (*power)(const double x[8], double y, double out[8]);
    noise_rings_kernel *rings;
    noise_ring_slopes_kernel *ring_slopes;
    noise_grid_kernel *grid;
    noise_fractal_kernel *fractal;
    const struct tape_kernels *tapes;      // functions of the same instruction set
    const struct surface_kernels *surface; // likewise
};

extern const struct noise_kernels noise_kernels_base, noise_kernels_avx2,
    noise_kernels_avx512;

// The kernels of that name, "base", "avx2" or "avx512"; NULL: not of this build, or the
// machine cannot run them.
const struct noise_kernels *noise_kernels_find(const char *name);

// noise_turbulence and noise_dturbulence of eight points (scene/noise_packet.c).
void noise_turbulence8(const struct noise_kernels *k, const double p[3][8], double lambda,
                       double omega, int octaves, int generator, double out[8]);
void noise_dturbulence8(const struct noise_kernels *k, const double p[3][8],
                        double lambda, double omega, int octaves, double out[3][8]);

#endif
