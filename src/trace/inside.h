#ifndef TRACE_INSIDE_H
#define TRACE_INSIDE_H

#include "scene/texture.h"
#include "trace/tracer.h"

const struct inside *inside_push(struct arena *a, const struct inside *list,
                                 const struct interior *interior);
// The same for a ray that enters; neighbours share what was made last.
const struct inside *inside_enter(struct tracer *t, const struct inside *list,
                                  const struct interior *interior);
static inline const struct inside *inside_find(const struct inside *list,
                                               const struct interior *interior)
{
    while (list && list->interior != interior)
        list = list->outer;
    return list;
}
const struct inside *inside_remove(struct arena *a, const struct inside *list,
                                   const struct interior *interior);
// The interiors of all objects around p.
const struct inside *inside_at(struct arena *a, const struct world *w, struct vec3 p);

static inline double interior_ior(const struct interior *i)
{
    return i->ior > 0 ? i->ior : 1;
}
// How light fades over a way of length s through an interior (spec/lighting.md 6.4).
// Where fading is exponential, each channel is exp of its exponent.
bool interior_fades_exponentially(const struct interior *i);
double interior_fade_exponent(const struct interior *i, double s, float color);
struct rgb interior_fade(const struct interior *i, double s);

#endif
