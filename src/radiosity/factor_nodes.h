#ifndef RADIOSITY_FACTOR_NODES_H
#define RADIOSITY_FACTOR_NODES_H

#include "radiosity/form_factor.h"

enum { NODES_SIDE = 4, NODES_MOST = NODES_SIDE * NODES_SIDE, PIECE_SIDE = 4 };

// Points of an element; the weights sum to its area.
struct element_nodes {
    uint32_t element, count;
    struct element_point at[NODES_MOST];
    double weight[NODES_MOST];
};

// Polygons of an element, of the parts that exist; times scale their areas sum to its.
struct element_pieces {
    uint32_t element, count;
    struct vec3 corner[PIECE_SIDE * PIECE_SIDE][4], normal[PIECE_SIDE * PIECE_SIDE];
    double scale;
};

struct node_cache;
struct node_cache *node_cache_new(void);

// Valid until the next call for another element.
const struct element_nodes *nodes_of(struct factor_state *s, uint32_t element);
const struct element_pieces *pieces_of(struct factor_state *s, uint32_t element);

// F from a to b by the points of both; for elements further apart than they are large.
double nodes_factor(struct factor_state *s, uint32_t a, uint32_t b);

#endif
