#ifndef TRACE_ACCEL_H
#define TRACE_ACCEL_H

#include "math/bvh8.h"
#include "trace/world.h"

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
    PACKET_TORUS,
    PACKET_TRIANGLE,
    PACKET_MESH,
    PACKET_LANES,   // the shape takes eight rays itself
    PACKET_PRODUCT, // of objects: an intersection of such shapes and their complements
    PACKET_SPONGE,  // of objects: an intersection of few solids less many spheres
    PACKET_MERGE,   // of objects: a merge of such shapes and their complements
    PACKET_CLIPPED, // of objects: one such shape, clipped by what may be part of a product
    PACKET_CLIPPED_PRODUCT, // of objects: a product, clipped likewise
    PACKET_RING, // of objects: an intersection of a ring torus, or its complement, with what
                 // may be part of a product
    PACKET_CARVED, // of objects: an intersection of a PACKET_LANES with what may be part of a
                   // product (trace/packet_carve.h)
    PACKET_CSG     // of objects: other CSG of a few solids
};

// Whether a solid of that shape may be part of a PACKET_PRODUCT.
static inline bool packet_is_product_shape(unsigned shape)
{
    return shape >= PACKET_SPHERE && shape <= PACKET_QUADRIC;
}

// A sphere among the leaves of a large object, copied so that most tests touch nothing else.
struct accel_ball {
    struct vec3 centre;
    double radius; // 0: some other leaf
};

// An object of LARGE_OBJECT leaves or more has a tree of its own.
struct accel_large {
    struct bvh8 leaves;
    uint32_t *unbounded; // leaves without finite bounds
    uint32_t unbounded_count;
    uint32_t *required; // the required leaves
    uint32_t required_count;
    struct accel_ball
        *ball; // of a PACKET_SPONGE whose solids packets know, for each item
               // of `leaves`; else NULL
};

enum { PRODUCT_SPACES = 8 }; // transforms of a PACKET_PRODUCT that quick tests take

// A leaf of a PACKET_PRODUCT, with all that quick tests (trace/packet_quick.h) want.
struct product_part {
    struct vec3 centre; // this and the radius: of a sphere
    double radius;
    double at; // 2 i for leaf i of the object: its entry; its exit is 2 i + 1
    const void *shape;
    uint16_t leaf; // i
    uint8_t kind;  // enum packet_shape
    uint8_t space; // 0: the world's, k: that of accel_product.space[k - 1]
};

// Its parts: bounded solids in the world, which are most likely missed or cheap, other
// solids, complements.
struct accel_product {
    const struct product_part *part; // NULL: there are no quick tests
    // Of each space, as in product_part: the most that coordinates and radii of a part add up
    // to.
    double extent[1 + PRODUCT_SPACES];
    double least; // radius
    uint16_t world_solids, solids, count;
    uint16_t spaces;
    uint16_t
        space[PRODUCT_SPACES]; // a leaf that has the transform, from the object's first
};

// One world's boxes: over the finite objects, and over the leaves of each large object.
struct accel {
    struct bvh8 top;
    double *ball[4]; // x, y, z and radius of the items of `top` that are bare spheres,
                     // so that most tests touch nothing else; radius 0: another object
    uint8_t *leaf_shape;   // enum packet_shape, per leaf
    uint8_t *object_shape; // enum packet_shape, per object
    bool *plain; // per object: of a known shape, opaque, seen by all rays, no bounded_by
    struct accel_product *product; // per object; NULL: there are no products
    unsigned lone_flags;           // of all objects that are bare spheres
    bool lone_opaque;              // all of them are
    // Of a packet's lanes, how many a child of the root must hold on average; else they part.
    uint32_t together;
    uint32_t alone; // lanes that go on one by one when they are no more
    bool few;       // so few items, all cheap to miss, that the tree helps no packet
    unsigned flags; // of all objects
    const struct packet_kernels *kernels;
    uint32_t *infinite; // objects without finite bounds, in order
    uint32_t infinite_count;
    struct accel_large *large;
    uint32_t *large_of;             // per object; NULL: there are none
    uint32_t *base_inside;          // csg_node.base_inside of every node, packed
    uint32_t nodes_max, leaves_max; // of one object: what scratch must hold
};

enum {
    LARGE_OBJECT = 12,   // leaves from which an object gets a tree of its own
    PRODUCT_LEAVES = 32, // the most of a PACKET_PRODUCT
    CARVE_LEAVES = 8,    // the most of a PACKET_CARVED, the solid among them
    CSG_LEAVES = 32,     // the most of a PACKET_CSG
    CSG_NODES = 64       // and of its nodes
};

static inline const struct accel_large *
accel_large(const struct accel *a, const struct world_object *o, uint32_t object)
{
    return o->leaf_count < LARGE_OBJECT ? NULL : &a->large[a->large_of[object]];
}

struct accel *accel_build(struct arena *a, const struct world *w);
// Its parts: leaf_shape, object_shape and plain; then product.
void accel_classify(struct arena *a, const struct world *w, struct accel *accel);
void accel_list_products(struct arena *a, const struct world *w, struct accel *accel);
// The same of some objects; w->accel is there.
enum accel_part {
    ACCEL_WHOLE,
    ACCEL_CLEAR, // the objects that are not wholly opaque
    ACCEL_OPAQUE // those that have something opaque
};
struct accel *accel_build_part(struct arena *a, const struct world *w,
                               enum accel_part part);

#endif
