#ifndef TRACE_INSIDE_H
#define TRACE_INSIDE_H

#include "scene/texture.h"
#include "trace/tracer.h"

// The list for a ray that enters an interior; neighbours share what was made last.
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

// The objects that may be around points of a box: mostly a few without end.
struct objects_around {
    uint32_t object[16], count;
    bool many; // more than that
};
struct objects_around objects_around(const struct world *w, struct aabb box);
// inside_at for points of the box.
const struct inside *inside_among(struct arena *a, const struct world *w,
                                  const struct objects_around *few, struct vec3 p);

static inline double interior_ior(const struct interior *i)
{
    return i->ior > 0 ? i->ior : 1;
}
// How light fades over a way of length s through an interior (spec/lighting.md 6.4).
// Where fading is exponential, each channel is exp of its exponent, at out[0], out[step] and
// out[2 step].
static inline bool interior_fades_exponentially(const struct interior *i)
{
    static const double exponential_from = 1000; // powers at and above mean exp
    return i->fade_power >= exponential_from;
}
static inline void interior_fade_exponents(const struct interior *i, double s,
                                           double *out, int step)
{
    const double way = s / i->fade_distance;
    out[0] = -(1 - (double)i->fade_color.r) * way;
    out[step] = -(1 - (double)i->fade_color.g) * way;
    out[2 * step] = -(1 - (double)i->fade_color.b) * way;
}
struct rgb interior_fade(const struct interior *i, double s);

#endif
