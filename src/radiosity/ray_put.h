#ifndef RADIOSITY_RAY_PUT_H
#define RADIOSITY_RAY_PUT_H

#include "radiosity/enclosure.h"
#include "trace/intersect.h"

// Ways to points of an emitter, which is no obstacle to itself, end this part before it.
static const double SHORT_OF_EMITTER = 1 - 1e-4;

// Where a ray leaves the error box of its point, on the side of the normal.
static inline struct vec3 point_lifted(const struct element_point *p)
{
    return vec3_mad(p->p, p->error, p->normal);
}

static inline void ray_put_from(struct ray_batch *b, struct vec3 o, struct vec3 d,
                                double t_max)
{
    const uint32_t i = b->count++;
    b->o[0][i] = o.x;
    b->o[1][i] = o.y;
    b->o[2][i] = o.z;
    b->d[0][i] = d.x;
    b->d[1][i] = d.y;
    b->d[2][i] = d.z;
    b->t_min[i] = 0;
    b->t_max[i] = t_max;
    b->hidden_by[i] = 0;
}

static inline void ray_put(struct ray_batch *b, const struct element_point *from,
                           struct vec3 d, double t_max)
{
    ray_put_from(b, point_lifted(from), d, t_max);
}

// From outside the error box of one point to outside that of the other.
static inline void ray_put_between(struct ray_batch *b, const struct element_point *from,
                                   const struct element_point *to)
{
    const struct vec3 o = point_lifted(from);
    ray_put_from(b, o, vec3_sub(point_lifted(to), o), 1);
}

#endif
