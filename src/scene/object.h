#ifndef SCENE_OBJECT_H
#define SCENE_OBJECT_H

#include <stdbool.h>
#include <stdint.h>

#include "base/source.h"
#include "math/transform.h"
#include "scene/shape.h"

struct arena;
struct texture;
struct interior;
struct light;
struct photon_target;

enum object_kind { OBJECT_SHAPE, OBJECT_CSG, OBJECT_LIGHT };
enum csg_op { CSG_UNION, CSG_MERGE, CSG_INTERSECTION, CSG_DIFFERENCE };

enum object_flags {
    OBJECT_NO_SHADOW = 1 << 0,
    OBJECT_NO_IMAGE = 1 << 1,
    OBJECT_NO_REFLECTION = 1 << 2,
    OBJECT_NO_RADIOSITY = 1 << 3,
    OBJECT_DOUBLE_ILLUMINATE = 1 << 4,
    OBJECT_HOLLOW = 1 << 5,
    OBJECT_HOLLOW_SET = 1 << 6, // `hollow` was written: the parent does not change it
    OBJECT_CUTAWAY = 1 << 7,
    OBJECT_UV_MAPPING = 1 << 8,
    OBJECT_INVERSE = 1 << 9,
    OBJECT_NO_SPLIT = 1 << 10, // split_union off
    OBJECT_STURM = 1 << 11,
};

// A texture or interior as attached to an object, with the transforms written
// after it (in the space outside the object's own `transform`).
struct attached_texture {
    const struct texture *texture;     // NULL: none
    const struct transform *transform; // never NULL
};

// One node of the scene tree. Immutable once built and shared, never copied:
// `object { A translate x }` is a new node that holds A's parts and a longer
// transform (a few hundred bytes), whatever A is.
struct object {
    enum object_kind kind;
    // Of the tree below, clips and looks_like included: levels (0 for a leaf) and
    // leaves, counted as often as they are used.
    uint32_t depth, leaves;
    struct span where;

    // OBJECT_SHAPE
    const struct shape_ops *ops;
    const void *shape;

    // OBJECT_CSG. A difference keeps its children as written; the second and
    // later are taken inverted.
    enum csg_op op;
    const struct object *const *child;
    uint32_t child_count;

    // OBJECT_LIGHT (a light_source inside a union or on top level)
    const struct light *light;

    const struct transform *transform; // everything inside -> outside of this node
    struct attached_texture texture;   // outermost space of this node
    struct attached_texture interior_texture;
    const struct interior *interior; // NULL: inherit
    unsigned flags;                  // enum object_flags
    float importance; // share of the rays that gather light which see it; 0: inherit
    const struct photon_target *photons; // NULL: inherit

    // Clips and bounds, each in the outermost space of this node; a point must
    // be inside all clips. Bounds only cull rays (they never change a picture
    // when they enclose the object).
    const struct object *const *clip;
    uint32_t clip_count;
    const struct object *const *bound;
    uint32_t bound_count;

    const struct light *const *group_light; // light_group; NULL: none
    uint32_t group_light_count;
    bool group_global_lights;
};

// What the tracer's tables and stacks hold. A loop that doubles a union asks for more.
enum { OBJECT_DEPTH_MAX = 20000, OBJECT_LEAVES_MAX = 1 << 26 };

// Counts an object inside o.
static inline void object_hold(struct object *o, const struct object *inner)
{
    if (inner && o->depth <= inner->depth)
        o->depth = inner->depth + 1;
    const uint32_t more = inner ? inner->leaves : 0;
    o->leaves = more > UINT32_MAX - o->leaves ? UINT32_MAX : o->leaves + more;
}

// first, then second: kept in the arena, or `first` itself if the second is the identity.
const struct transform *transform_join(struct arena *a, const struct transform *first,
                                       const struct transform *second);
struct object *object_new_shape(struct arena *a, const struct shape_ops *ops,
                                const void *shape, struct span where);
struct object *object_new_csg(struct arena *a, enum csg_op op,
                              const struct object *const *child, uint32_t count,
                              struct span where);
// A shallow copy to modify before it is shared.
struct object *object_copy(struct arena *a, const struct object *o);
// Composes t after what is there: shape, textures, clips and bounds move with it.
void object_transform(struct arena *a, struct object *o, const struct transform *t);
// Bounds in the outermost space of the node, clips and CSG considered.
struct aabb object_bounds(const struct object *o);
// Inside as the language defines it (clips count, bounded_by does not).
bool object_inside(const struct object *o, struct vec3 p);
bool object_is_solid(const struct object *o); // false: a sheet somewhere in it
void object_print(const struct object *o, FILE *out, int indent); // --dump-csg

#endif
