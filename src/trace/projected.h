#ifndef TRACE_PROJECTED_H
#define TRACE_PROJECTED_H

#include "math/vec.h"
#include "scene/object.h"
#include "trace/tracer.h"

// An object that a light shines through (spec/lighting.md 8.5). It is not part of the world:
// every leaf is tested whose box a ray meets.
struct window;
const struct window *window_new(struct arena *a, const struct object *o);
// The distance to its nearest surface; INFINITY: none.
double window_hit(const struct window *w, struct vec3 origin, struct vec3 d);
// Whether the ray meets the window before *t_max, which is there from now on.
bool window_met(const struct window *w, struct vec3 origin, struct vec3 d, double *t_max);

// How much of the lamp's light comes through its window along the rays that stand in `near`.
void window_factors_near(struct tracer *t, const struct lamp *lamp, uint32_t count,
                         struct rgb *out);
// Leaves those shadow rays of simple surfaces, from `first` on, that meet the lamp's window
// before the lamp, and has them end there; their number with all before. Where the lamp's light
// throws no shadows it is added at once.
uint32_t window_take(struct tracer *t, const struct lamp *lamp, uint32_t first,
                     uint32_t end);

#endif
