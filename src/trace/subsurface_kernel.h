#ifndef TRACE_SUBSURFACE_KERNEL_H
#define TRACE_SUBSURFACE_KERNEL_H

#include <stdint.h>

// One colour channel of a material; lengths in mm.
struct sss_channel {
    double albedo, sigma_s, sigma_t, sigma_tr;
    double z_real, z_virtual; // depths of the dipole's two lights
};

// What trace/subsurface.c compiles once per instruction set, as trace/packet.h. Arrays have
// room for seven more.
struct subsurface_kernels {
    // The albedos that give half spaces these colours; a: of mean_reflectance.
    void (*albedos)(const double color[8], double a, double out[8]);
    // What comes out at distances, given squared, from where light comes in.
    void (*dipoles)(const struct sss_channel *c, const double *r2, uint32_t count,
                    double *out);
    // Directions, even over the sphere where (u, v) are over the unit square, turned.
    void (*ways)(const double *u, const double *v, double by_u, double by_v,
                 uint32_t count, double *const d[3]);
};

extern const struct subsurface_kernels subsurface_kernels_base, subsurface_kernels_avx2,
    subsurface_kernels_avx512;

// The directions in which places are looked for where light comes in, neighbours beside each
// other: Halton's points of the unit square. index: the number of each in their own order,
// in which what they find is added up.
struct subsurface_plan {
    const struct subsurface_kernels *kernels;
    const double *u, *v;
    const uint32_t *index;
};

#endif
