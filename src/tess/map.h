#ifndef TESS_MAP_H
#define TESS_MAP_H

#include <stdbool.h>
#include <stdint.h>

#include "math/transform.h"
#include "scene/shape.h"

// A shape's drawn surface as pieces, each the image of the unit square, in shape space:
// points, areas and normals are those of the true surface, not of facets.
struct map_point {
    struct vec3 p;
    struct vec3 du, dv; // derivatives of p; zero or infinite at a pole
    struct vec3 n;      // unit, outwards (of a sheet: as the shape's own normal)
};

// The sides of the square that are one curve on the surface.
enum { MAP_WRAPS_U = 1, MAP_WRAPS_V = 2 }; // u = 0 and 1; v = 0 and 1

// One row a shape (maps.def). Pieces are numbered from 0.
struct tess_map {
    const struct shape_ops *ops;
    // How many pieces; 0: this one has no map (an unbounded quadric, a spindle torus).
    uint32_t (*count)(const void *shape);
    unsigned wraps; // MAP_WRAPS_*, of all pieces
    // 0 <= u, v <= 1.
    void (*at)(const void *shape, uint32_t piece, double u, double v,
               struct map_point *out);
    // The piece that a crossing of `intersect` lies on, and where; p in shape space.
    uint32_t (*locate)(const void *shape, const struct boundary *b, struct vec3 p,
                       double *u, double *v);
};

const struct tess_map *tess_map_find(const struct shape_ops *ops); // NULL: none

// A part of a piece's square.
struct map_part {
    uint32_t piece;
    double u0, v0, u1, v1;
};

// The area of the part's image in the world. Gauss' rule of 6 x 6 points in each of
// `panels` x `panels` parts: on analytic surfaces the error falls by about 2^12 for every
// doubling of the panels.
double tess_map_area(const struct tess_map *map, const void *shape,
                     const struct transform *t, const struct map_part *part, int panels);
// The part's share of the volume under the surface: the integral of p.n / 3, about the
// origin of the world. Summed over a closed surface it is the volume.
double tess_map_volume(const struct tess_map *map, const void *shape,
                       const struct transform *t, const struct map_part *part,
                       int panels);

// ---- between the maps ----------------------------------------------------------------
// The turn of (x, y) about the origin, 0 <= turn < 1.
double map_turn(double x, double y);

#define MAP(name) extern const struct tess_map name##_map;
#include "tess/maps.def"
#undef MAP

#endif
