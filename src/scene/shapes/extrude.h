#ifndef SCENE_SHAPES_EXTRUDE_H
#define SCENE_SHAPES_EXTRUDE_H

#include <stdbool.h>
#include <stdint.h>

#include "math/vec.h"
#include "scene/boundary.h"
#include "scene/shapes/outline.h"

// A plane outline swept along the third axis from low to high: coordinates (u, v, h).
// Parts: EXTRUDE_LOW and EXTRUDE_HIGH are the caps, EXTRUDE_WALL + i the wall of segment i.
enum { EXTRUDE_LOW, EXTRUDE_HIGH, EXTRUDE_WALL };

struct extrude_ray {
    double o[3], d[3]; // in (u, v, h)
};

// Appends the crossings of the whole line, ascending and alternating. b->u is +1 or -1:
// the sign that turns (v', -u') of the wall outward; b->v the segment's parameter. The
// caps of an open extrusion are not drawn.
void extrude_intersect(const struct outline *o, double low, double high, bool open,
                       const struct extrude_ray *ray, struct boundary_list *out);

// The same outline swept towards the origin: at height h it is h times as large (conic.c).
void conic_intersect(const struct outline *o, double low, double high, bool open,
                     const struct extrude_ray *ray, struct boundary_list *out);
bool conic_inside(const struct outline *o, double low, double high, const double p[3]);
struct vec3 conic_normal(const struct outline *o, const struct boundary *b);

// The crossing of an extrusion's or a conic sweep's wall with a ray, from outside, at the
// parameter w of segment i. False: it is nowhere.
struct boundary extrude_wall(const struct outline *o, const struct extrude_ray *r,
                             uint32_t i, double w);
bool conic_wall(const struct outline *o, double low, double high,
                const struct extrude_ray *r, uint32_t i, double w, struct boundary *out);

// Where a ray is between the heights low and high.
struct extrude_slab {
    double t[2], dt; // entry and exit
    uint32_t part[2];
    bool always; // the whole line; t means nothing
};
// False: nowhere.
bool extrude_slab_of(const struct extrude_ray *r, double low, double high,
                     struct extrude_slab *s);
void extrude_add_cap(struct boundary_list *out, const struct extrude_slab *s, int which,
                     bool open);
// Sorted crossings of walls from `from` on, the line starting inside them if `in`, become
// those of the solid within the slab.
void extrude_clip(const struct extrude_slab *s, bool open, bool in, uint32_t from,
                  struct boundary_list *out);

// The outward normal of a crossing, in (u, v, h), not normalised.
struct vec3 extrude_normal(const struct outline *o, const struct boundary *b);

// Sorts the crossings from index `from` on by t.
void boundary_list_sort(struct boundary_list *l, uint32_t from);
// Several solids' crossings, sorted: keeps those of their union.
void boundary_list_merge(struct boundary_list *l, uint32_t from);

#endif
