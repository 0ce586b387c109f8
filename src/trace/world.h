#ifndef TRACE_WORLD_H
#define TRACE_WORLD_H

#include <stdbool.h>
#include <stdint.h>

#include "math/aabb.h"
#include "math/gamma.h"
#include "math/transform.h"
#include "scene/scene.h"

struct arena;
struct accel;
struct cutaway;
struct user_bound;

// The material of a leaf with inheritance resolved: what shading needs to know.
struct surface {
    const struct texture *texture;          // never NULL
    struct transform texture_transform;     // world from the texture's outer space
    const struct texture *interior_texture; // NULL: none
    struct transform interior_texture_transform;
    const struct interior *interior;     // never NULL; identity decides refraction
    unsigned flags;                      // OBJECT_*: visibility, double_illuminate, uv
    const struct photon_target *photons; // NULL: nothing was written
    bool opaque;                         // never lets light through
    bool wants_uv;                       // shading may look at uv coordinates
    bool in_contact; // faces lie in those of other clear objects (contact.h)
    bool parts;      // parts of the shape have textures of their own, or
    const struct cutaway *cutaway; // those of other parts of the object are seen
    uint32_t light_group;          // index+1 into world light groups; 0: none
    float importance;              // share of gathering rays that see it
};

// A shape placed in the world. `inverted`: an odd number of inversions lies on the
// path from the root, so its normal points the other way and inside is outside.
struct leaf {
    const struct shape_ops *ops;
    const void *shape;
    const struct transform *transform; // world from shape space; identity when absorbed
    double stretch; // how much longer the transform's inverse makes a coordinate at most
    struct aabb bounds; // world, of the bare shape
    uint32_t surface;   // index into world surfaces
    uint32_t object;    // index into world objects
    uint32_t node;      // its NODE_LEAF node, of a CSG object
    bool solid;         // false: a sheet, never inside, whatever `inverse` says
    bool bounded;       // the bare shape is (shape_is_bounded)
    bool required; // outside this leaf its object has nothing: it is bounded, and only
                   // intersections lie above it
    bool inverted;
    bool drawn;          // false: a clip; its boundaries only change states
    bool paired;         // faces lie in those of another object (face_pairs.h)
    uint32_t first_pair; // if paired: the first of the world's pairs that has this leaf
    double apart; // bounds how far its faces are from those they are in contact with
};

// The rounding, in shape space, of a point o + t d with coordinates of these sizes on its
// way there through the leaf's transform, which a chain of up to seven rotations made.
static inline double leaf_position_error(const struct leaf *l, double o, double t,
                                         double d)
{
    const double offset = vec3_max_abs(l->transform->offset);
    return GAMMA(32) * (o + 2 * offset + fabs(t) * d) * l->stretch;
}

enum node_op { NODE_LEAF, NODE_UNION, NODE_MERGE, NODE_INTERSECTION };

// One node of an object's CSG expression. Differences and inverses were pushed to
// the leaves (De Morgan), so only these operators are left. Children of node i
// are the nodes whose parent is i; the root is the first.
struct csg_node {
    enum node_op op;
    uint32_t parent; // index into world nodes; own index for the root
    uint32_t leaf;   // NODE_LEAF
    uint32_t child_count;
    uint32_t first_child; // children are contiguous and come after their parent
    uint32_t base_inside; // children inside (leaf: 1 if inverted) where no leaf's
                          // bounds hold the point
    struct aabb bounds;   // S-bounds: clipped by the parents'
};

// Whether a node is inside when `inside` of its children are (a leaf: when it is 1).
static inline bool node_is_inside(const struct csg_node *n, uint32_t inside)
{
    return n->op == NODE_INTERSECTION ? inside == n->child_count : inside > 0;
}

// What the BVH holds: one top-level object.
struct world_object {
    struct aabb bounds; // world; infinite objects are kept out of the BVH
    uint32_t first_leaf, leaf_count;
    uint32_t root, node_count; // its csg nodes
    bool is_csg;               // false: the single leaf stands alone, without a node
    bool opaque;               // every leaf is
    bool mixed;                // some are, some are not
    bool flat;                 // it may have flat faces
    bool clear_flat;           // some of them clear, that may lie in others' opaque ones
    bool may_coincide;         // it has these, or paired leaves (coincident.h)
    unsigned flags;            // visibility of the whole
    const struct object *source;
    const struct user_bound *bound; // bounded_by, its own and those of unions around it
    uint32_t bound_count;
};

// A face of a leaf that lies in one of another object, which is seen in its place: one earlier
// in the scene, or of a clear face an opaque one (face_pairs.h). Two clear ones are in contact:
// each has such a pair, and the earlier one is seen.
struct face_pair {
    uint32_t leaf, other; // a leaf, an object
    bool contact;
    double error;      // bounds how far the faces are apart
    struct aabb where; // what they have in common lies within
};

struct light_group {
    const struct light *const *light;
    uint32_t count;
    bool global_lights;
};

// The scene flattened for tracing; const while rendering.
struct world {
    struct arena *arena;
    const struct scene *scene;
    struct leaf *leaf;
    uint32_t leaf_count;
    struct csg_node *node;
    uint32_t node_count;
    struct world_object *object;
    uint32_t object_count;
    struct surface *surface;
    uint32_t surface_count;
    const struct light **light; // global lights in written order
    uint32_t light_count;
    struct light_group *light_group;
    uint32_t light_group_count;
    bool has_transparent;              // some surface is not opaque
    bool has_coincident;               // some object may_coincide
    bool has_contacts;                 // some faces of clear objects are in contact
    const struct face_pair *face_pair; // by leaf, then by object
    uint32_t face_pair_count;
    struct aabb bounds;  // of the finite objects
    struct accel *accel; // trace/accel.h
    // The same world with nothing to meet but the objects that are not wholly opaque, for
    // rays of which it is known that nothing opaque is on their way. NULL: none are.
    const struct world *clear;
    // The same with those that have something opaque, for rays of which it is asked whether
    // that is on their way.
    const struct world *dark;
};

// Splits unions, resolves inheritance, absorbs transforms, computes bounds.
struct world *world_build(struct arena *a, const struct scene *scene);

#endif
