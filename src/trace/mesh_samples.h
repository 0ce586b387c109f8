#ifndef TRACE_MESH_SAMPLES_H
#define TRACE_MESH_SAMPLES_H

#include "trace/tracer.h"

// tracer_samples for a CAMERA_MESH: each is the mean of the rays that exist there.
void mesh_samples(struct tracer *t, const struct vec2 *position, uint32_t count,
                  float (*out)[4]);

#endif
