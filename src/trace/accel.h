#ifndef TRACE_ACCEL_H
#define TRACE_ACCEL_H

#include "trace/bvh8.h"
#include "trace/world.h"

// An object of the tree that is a bare sphere, copied so that most tests touch nothing
// else. Same arithmetic, hence same bits, as the shape's own.
struct accel_sphere {
    struct vec3 centre;
    double radius;  // 0: some other object
    unsigned flags; // of the object
};

// The shapes of which packets know the crossings, and how they take an object.
enum packet_shape {
    PACKET_NONE,
    PACKET_SPHERE,
    PACKET_BOX,
    PACKET_PLANE,
    PACKET_CYLINDER,
    PACKET_CONE,
    PACKET_QUADRIC,
    PACKET_OPEN_CYLINDER, // these are not solid to the eye, or to anything: no product
    PACKET_OPEN_CONE,
    PACKET_DISC,
    PACKET_TRIANGLE,
    PACKET_PRODUCT, // of objects: an intersection of such shapes and their complements
    PACKET_SPONGE   // of objects: an intersection of few solids less many spheres
};

// One world's boxes: over the finite objects, and over the leaves of each large object.
struct accel {
    struct bvh8 top;
    struct accel_sphere *sphere; // for each item of `top`
    double *ball[4];             // the same spheres' x, y, z and radius
    uint8_t *leaf_shape;         // enum packet_shape, per leaf
    uint8_t *object_shape;       // enum packet_shape, per object
    const struct packet_kernels *kernels;
    uint32_t *infinite;          // objects without finite bounds, in order
    uint32_t infinite_count;
    struct bvh8 *leaves;  // per object; item_count == 0: few leaves, tested in a row
    uint32_t **unbounded; // per object with a tree: its leaves without finite bounds
    uint32_t *unbounded_count;
    uint32_t **required; // per object: its required leaves
    uint32_t *required_count;
    uint32_t *base_inside;          // csg_node.base_inside of every node, packed
    uint32_t nodes_max, leaves_max; // of one object: what scratch must hold
};

enum { LARGE_OBJECT = 12 }; // leaves from which an object gets a tree of its own

struct accel *accel_build(struct arena *a, const struct world *w);

#endif
