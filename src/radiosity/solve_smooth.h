#ifndef RADIOSITY_SOLVE_SMOOTH_H
#define RADIOSITY_SOLVE_SMOOTH_H

#include "radiosity/solver.h"

// Takes noise out of what rays found. Elements beside each other on a surface see nearly
// the same, so a mean over some of them errs less than each; over how many, the two
// halves of the rays tell.
struct smoother {
    const struct radiosity_system *s;
    int threads;
    // Neighbour k of element i at 8 i + k; ELEMENT_NONE unless it and the one on the
    // other side exist, so that what rises evenly stays as it is. NULL: nothing is known
    // of neighbours.
    uint32_t *beside;
    double (*work[6])[3];
    double *sum; // of surfaces
    uint32_t surfaces;
};

// A solution's irradiance, and the part of it that elements emit.
struct light_part {
    double (*h)[3], (*h_emitted)[3];
};

void smoother_init(struct smoother *m, const struct radiosity_system *s, int threads);
void smoother_free(struct smoother *m);
// The mean of two independent halves, smoothed. Returns its estimated error: relative rms
// of the reflected light.
double smoother_mean(struct smoother *m, const struct light_part half[2],
                     const struct light_part *out);

#endif
