#ifndef TESTS_STABILITY_LANES_H
#define TESTS_STABILITY_LANES_H

#include "loaded.h"
#include "scene/shape_kernels.h"

// A shape's eight rays against its own crossings of one line.

// The same text of a shape that lines only touch, so that nothing is met.
#define TOUCHED "poly { 2, <1,0,0,0, 0,0,0, 0,0,0> }" // a plane, twice

double lanes_unit(uint64_t *s); // in (0, 1)
// Side by side or in all directions, from outside or inside, some along an axis, some
// through the middle, some on a grid.
void lanes_random_rays(uint64_t *s, bool grid, struct shape_rays *r);
struct ray lanes_ray(const struct shape_rays *r, int l);
// Whether random rays meet the first leaf of l where its crossings are: bit by bit or as
// nearly as both know; with the same bits for instruction sets and for each ray alone.
void lanes_compare(const struct loaded *l, const char *text, bool any, int packets,
                   bool grid, bool bits);

#endif
