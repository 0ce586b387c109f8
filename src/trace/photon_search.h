#ifndef TRACE_PHOTON_SEARCH_H
#define TRACE_PHOTON_SEARCH_H

#include <stdbool.h>
#include <stdint.h>

// The nearest photons, eight at a time: what the search of an instruction set reads and
// writes (photon_kernel.c). photon_map.h is what others use.

// Places of eight photons that follow each other in the map; NaN: there is none.
struct photon_leaf {
    float p[3][8];
};

// Boxes of eight leaves or nodes that follow each other; nothing lies in those from +inf
// to -inf.
struct photon_node {
    float low[3][8], high[3][8];
};

enum { PHOTON_LEVELS = 9 }; // 8^9 leaves hold more than PHOTONS_MOST

// Node i of a level has the children 8 i to 8 i + 7 of the level below, those of level 0
// leaves; the last level has one node.
struct photon_tree {
    struct photon_leaf *leaf;
    struct photon_node *level[PHOTON_LEVELS];
    uint32_t levels;
};

struct photon_search {
    const struct photon_tree *tree;
    double p[3], n[3];
    bool flat;     // n is not zero
    double limit2; // finite; as the search measures distances, not farther
    uint32_t most; // not 0
    // Found so far, with room for 2 most + 16.
    double *distance2;
    uint32_t *photon;
    uint32_t count;
};

// Leaves at most `most` photons, the nearest; limit2 is the distance of the farthest where
// there are so many.
typedef void photon_search_fn(struct photon_search *s);
extern photon_search_fn photon_search_base, photon_search_avx2, photon_search_avx512;

#endif
