#ifndef TRACE_PHOTON_MAP_H
#define TRACE_PHOTON_MAP_H

#include <stdbool.h>
#include <stdint.h>

#include "math/color.h"
#include "math/vec.h"
#include "trace/photon_grid.h"
#include "trace/photon_search.h"

// Light that came to a point by way of mirrors and glass.
struct photon {
    float p[3], from[3]; // place; unit direction to where it came from
    struct rgb energy;
};

enum {
    PHOTONS_MOST = 1 << 26
}; // of a map, 3.7 GB with its tree: bounds what a spacing
    // of next to nothing can do

// Who gathers: the picture, or the rays of irradiance samples, of which hundreds make a mean
// and which need know less each.
enum photon_use { PHOTON_PICTURE, PHOTON_SAMPLE, PHOTON_USES };

// How far one gathers.
struct photon_range {
    double radius, step; // what it grows by where there are too few
    // By how much farther the last of as many as are wanted counts as being: that it is the
    // last makes a place look denser than it is, the more the fewer are wanted.
    double last;
    struct photon_grid grid; // once gathering may begin
};

// Photons in the order of a kd-tree (Jensen 2001, 7.3) whose ranges are halved, on the axis
// along which they are widest, down to eight.
struct photon_map {
    struct photon *photon;
    uint32_t count, capacity;
    struct photon_tree tree; // once it is made
    photon_search_fn *search;
    bool full; // there was no room for more
    struct photon_range range[PHOTON_USES];
};

// Room for what a search finds.
struct photon_near {
    enum photon_use use;
    uint32_t most, *photon;
    double *distance2;
    double likely2; // within which, squared, as many as wanted are likely; 0: not known
};

struct photon_near *photon_near_new(uint32_t most, enum photon_use use);
void photon_near_free(struct photon_near *near);

void photon_add(struct photon_map *m, const struct photon *p);
// Adds all of another map, in its order.
void photon_map_append(struct photon_map *m, const struct photon_map *from);
void photon_map_end(struct photon_map *m);
// Makes the tree, for a search; the order of the photons changes.
void photon_map_build(struct photon_map *m, photon_search_fn *search);

// At most near->most photons within `radius` of p, the nearest ones, into near->photon, in an
// order that depends on the map and p alone; returns how many. With a normal (not zero) a
// photon off its plane counts as farther (spec/lighting.md 11.5). *reach: the radius that
// holds them: of the farthest when there are `most`.
uint32_t photons_near(const struct photon_map *m, struct vec3 p, struct vec3 normal,
                      double radius, struct photon_near *near, double *reach);

// What gathering wants (spec/lighting.md 11.1).
struct photon_gather {
    uint32_t min, max;
    double expand_increase;
    uint32_t expand_min;
};
// The same with the radius of the map, grown where it holds too few photons; g: by use.
uint32_t photons_gather(const struct photon_map *m, const struct photon_gather *g,
                        struct vec3 p, struct vec3 normal, struct photon_near *near,
                        double *reach);
// Finds the radius of the picture from the photons themselves (spec/lighting.md 11.4);
// in_space: densities are per volume.
void photon_map_radius(struct photon_map *m, uint32_t max, bool in_space);
// Makes what gathering of a use needs, when its range but for the grid is known.
void photon_map_ready(struct photon_map *m, enum photon_use use);
// The same for rays of irradiance samples, once the range of the picture is known, which gathers
// `max` photons; returns how many such a ray gathers.
uint32_t photon_map_for_samples(struct photon_map *m, uint32_t max, bool in_space);

#endif
