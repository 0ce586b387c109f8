#ifndef TRACE_PHOTON_MAP_H
#define TRACE_PHOTON_MAP_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"

// Light that came to a point by way of mirrors and glass.
struct photon {
    float p[3], from[3]; // place; unit direction to where it came from
    struct rgb energy;
};

// Photons as a balanced kd-tree (Jensen 2001, 7.3): the middle of a range splits it, on the
// axis along which the range is widest.
enum { PHOTONS_MOST = 1 << 26 }; // of a map, 2.4 GB: bounds what a spacing of next to
                                 // nothing can do

struct photon_map {
    struct photon *photon;
    uint8_t *axis; // of each, once the tree is made
    struct photon_box *box; // of larger ranges, likewise
    uint32_t count, capacity;
    bool full;           // there was no room for more
    double radius, step; // to gather in; what it grows by where there are too few
};

struct photon_near {
    double distance2; // as the search measures it
    uint32_t photon;
};

void photon_add(struct photon_map *m, const struct photon *p);
// Adds all of another map, in its order.
void photon_map_append(struct photon_map *m, const struct photon_map *from);
void photon_map_end(struct photon_map *m);
// Makes the tree; the order of the photons changes.
void photon_map_build(struct photon_map *m);

// At most `most` photons within `radius` of p, the nearest ones, into near; returns how many.
// With a normal (not zero) a photon off its plane counts as farther (spec/lighting.md 11.5).
// *reach: the radius that holds them: of the farthest when there are `most`.
uint32_t photons_near(const struct photon_map *m, struct vec3 p, struct vec3 normal,
                      double radius, uint32_t most, struct photon_near *near,
                      double *reach);

// What gathering wants (spec/lighting.md 11.1).
struct photon_gather {
    uint32_t min, max;
    double expand_increase;
    uint32_t expand_min;
};
// The same with the radius of the map, grown where it holds too few photons.
uint32_t photons_gather(const struct photon_map *m, const struct photon_gather *g,
                        struct vec3 p, struct vec3 normal, struct photon_near *near,
                        double *reach);
// Finds the radius from the photons themselves (spec/lighting.md 11.4); in_space: densities
// are per volume.
void photon_map_radius(struct photon_map *m, uint32_t max, bool in_space);

#endif
