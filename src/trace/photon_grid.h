#ifndef TRACE_PHOTON_GRID_H
#define TRACE_PHOTON_GRID_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "math/vec.h"

// What is known of the photons around places: where there are none, and how far the last search
// in a cell had to go. It spares searches and shortens them; what they find does not depend on it.

struct photon_grid {
    double low[3], cells_per_unit;
    uint32_t count[3]; // of cells along the axes; 0: there is no grid
    uint8_t *near;     // by cell: a photon may lie within the widest radius
    // By cell and the axis that the normal is nearest to: 0 nothing, 1 that the radius holds
    // too few, else how much shorter the distance is that holds as many as are wanted.
    _Atomic uint8_t *seen;
    uint32_t radius_bits; // of the radius squared, as distances are kept
};

// places: `count` of them, `stride` bytes apart, each of three floats. wide: the widest
// radius that is searched in; radius: the one searched first.
void photon_grid_build(struct photon_grid *g, const float *places, uint32_t count,
                       size_t stride, double radius, double wide);
void photon_grid_end(struct photon_grid *g);

enum {
    PHOTON_PLACE_EMPTY = -1,  // no photon lies within the widest radius
    PHOTON_PLACE_UNKNOWN = -2 // there is no grid
};
// The number under which a place is remembered.
int32_t photon_grid_place(const struct photon_grid *g, struct vec3 p, struct vec3 normal);

struct photon_hint {
    bool sparse;    // the radius held too few
    double likely2; // a distance, squared, that held enough; 0: not known
};
struct photon_hint photon_grid_recall(const struct photon_grid *g, int32_t place);
void photon_grid_remember(const struct photon_grid *g, int32_t place,
                          struct photon_hint hint);

#endif
