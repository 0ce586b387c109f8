#ifndef TRACE_CARVE_H
#define TRACE_CARVE_H

#include "trace/scratch.h"

// A solid whose shape takes eight rays itself (shape_ops.closest8), intersected with simple
// ones or their complements: half spaces, boxes, what is cut off or clipped. The simple ones
// are met first; they leave stretches of the ray on which all of them are inside, and the
// solid's first crossing on such a stretch is all that has to be found of it.

enum { CARVE_LEAVES = 8 }; // at most, the solid among them

struct carve_hits {
    struct boundary b[8]; // of the lanes that meet the object
    unsigned unsure;      // lanes where crossings are too near each other: for sweep_object
};

// As sweep_object, for the lanes of ray[8]; limit[i]: where lane i's nearest hit lies. Where
// mode is SWEEP_OPAQUE the object is opaque.
unsigned carve(const struct world *w, struct trace_scratch *s, uint32_t object,
               const struct ray *ray, const double *limit, unsigned lanes,
               enum sweep_mode mode, struct carve_hits *out);

#endif
