#ifndef TRACE_WORLD_BUILD_H
#define TRACE_WORLD_BUILD_H

// How the files world*.c make a world of a scene; nobody else includes this.
#include "trace/cutaway.h"
#include "trace/user_bounds.h"
#include "trace/world.h"

// What a node takes from the nodes above it, in world space.
struct context {
    struct transform world;        // from the space outside the node
    struct placed_texture texture; // inherited; NULL: none yet
    struct placed_texture interior_texture;
    struct interior *interior;
    const struct photon_target *photons;
    unsigned flags; // OR of the flags above
    bool inverted, drawn;
    bool interior_given; // false: the scene says nothing of an interior
    uint32_t light_group;
    float importance;
    const struct user_bound *bound; // of unions that were split
    uint32_t bound_count;
    const struct outer_clip *clips; // of those, too
};

// What clips a union that was split clips each of its children.
struct outer_clip {
    const struct object *object;
    struct context context;
    const struct outer_clip *next;
};

// A node waiting to be flattened into its slot. A stack rather than recursion: trees may
// be thousands of levels deep.
struct pending {
    const struct object *object;
    struct context context;
    uint32_t node;
};

struct vector {
    void *at;
    uint32_t count, capacity;
    size_t size;
};

// n new members, all zero, at the end.
void *world_build_add(struct vector *v, uint32_t n);

struct build {
    struct arena *arena;
    const struct scene *scene;
    struct vector leaf, node, object, surface, light, group, group_parent, pending;
    const struct transform *transform;              // the last one stored
    const struct interior *plain[2];                // of opaque surfaces; [1]: hollow
    const struct attached_texture *default_texture; // of the top-level object at hand
    bool has_transparent;
    // The top-level object at hand, for cutaway_textures; made when one needs it.
    const struct object *top;
    const struct context *top_context;
    const struct cutaway *cutaway;
};

// world.c: an object that stands for itself, or the children of a union that is split.
void world_build_top(struct build *b, const struct object *o, const struct context *c);

// world_light.c: a light of the scene or of the group at hand, and what it looks like.
void world_build_light(struct build *b, const struct object *o, const struct context *c);
// Lights below a node that is flattened whole, in written order.
void world_build_lights_below(struct build *b, const struct object *o,
                              const struct context *c);
// A light group's lights are children of it and are added when they are met.
struct context world_build_group(struct build *b, const struct object *o,
                                 const struct context *c);
// The lights of a group shine on the groups within it, too.
void world_build_join_groups(struct build *b);

// world_leaf.c: the context inside node o, for its children or its shape.
struct context world_build_enter(struct build *b, const struct object *o,
                                 const struct context *c);
// Its index.
uint32_t world_build_leaf(struct build *b, const struct object *o,
                          const struct context *c);

// world_flatten.c: the nodes and leaves of an object with the clips of unions around it.
void world_build_flatten(struct build *b, uint32_t root, const struct object *o,
                         const struct context *c);
// The clips of a union that is split, before those around it.
const struct outer_clip *world_build_join_clips(struct build *b, const struct object *o,
                                                const struct context *c);
// Marks the leaves without which there is nothing of the object.
void world_build_mark_required(struct build *b, uint32_t root, uint32_t first_leaf);
struct csg_node *world_build_node(struct build *b, uint32_t i);

#endif
