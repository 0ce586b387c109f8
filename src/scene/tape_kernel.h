#ifndef SCENE_TAPE_KERNEL_H
#define SCENE_TAPE_KERNEL_H

#include "scene/tape.h"

// Tapes of x, y, z at eight places at once, compiled once per instruction set
// (math/lanes.h) with the same bits. Only tapes that fit: tape_has_lanes.
struct tape_kernels {
    // out[0] at eight points: within the bounds that tape_bounds gives there, not always
    // the bits of tape_run (sines are computed to a few roundings).
    void (*values)(const struct tape *t, const double at[3][8], double out[8]);
    // The bits of tape_run, of tapes that fit and call no others: tape_is_flat.
    void (*exact)(const struct tape *t, const double at[3][8], double out[8]);
    // As tape_bounds_packet.
    void (*bounds)(const struct tape *t, const struct tape_boxes *in, bool slopes,
                   struct tape_slopes *out);
    // Eight boxes of points that move with one speed d each: slopes[0] are bounds of the
    // derivative along it.
    void (*along)(const struct tape *t, const struct tape_boxes *in, const double d[3][8],
                  struct tape_slopes *out);
    const struct noise_kernels *noise; // for the patterns and pigments that tapes call
};

extern const struct tape_kernels tape_kernels_base, tape_kernels_avx2,
    tape_kernels_avx512;

enum { TAPE_LANE_REGISTERS_MAX = 256 };
bool tape_has_lanes(const struct tape *t);
bool tape_is_flat(const struct tape *t);

// Whether the machine can run what the build has for it.
const struct tape_kernels *tape_kernels_best(void);

#endif
