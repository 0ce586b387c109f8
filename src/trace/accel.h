#ifndef TRACE_ACCEL_H
#define TRACE_ACCEL_H

#include "trace/world.h"

// A binary tree of boxes over items, built by binned surface-area splits; leaves hold
// item numbers. The same input gives the same tree.
struct bvh_node {
    struct aabb bounds[2];
    uint32_t child[2]; // inner: node; leaf: first index into item
    uint32_t count[2]; // 0: child is a node, else items of a leaf
};

struct bvh {
    struct bvh_node *node; // node[0] is the root
    uint32_t node_count;
    uint32_t *item;
    uint32_t item_count; // 0: empty, no nodes
};

enum { BVH_STACK = 64 }; // deeper trees are split in the middle

struct bvh bvh_build(struct arena *a, const struct aabb *box, uint32_t count);

// One world's boxes: over the finite objects, and over the leaves of each large object.
struct accel {
    struct bvh top;
    uint32_t *infinite; // objects without finite bounds, in order
    uint32_t infinite_count;
    struct bvh *leaves;     // per object; item_count == 0: few leaves, tested in a row
    uint32_t **unbounded;   // per object with a tree: its leaves without finite bounds
    uint32_t *unbounded_count;
    uint32_t nodes_max, leaves_max; // of one object: what scratch must hold
};

enum { LARGE_OBJECT = 12 }; // leaves from which an object gets a tree of its own

struct accel *accel_build(struct arena *a, const struct world *w);

#endif
