#ifndef API_PROBE_H
#define API_PROBE_H

#include <stdbool.h>

#include "math/vec.h"

struct object;

// What trace() of the language asks: single rays at single objects, while the scene
// is still being read. Each object is compiled once.
struct probe;

struct probe *probe_new(void);
void probe_free(struct probe *p);
// As eval_options.trace; `user` is the probe.
bool probe_trace(void *user, const struct object *o, struct vec3 from, struct vec3 d,
                 struct vec3 *hit, struct vec3 *normal);

#endif
