#ifndef SCENE_TAPE_BUILDER_H
#define SCENE_TAPE_BUILDER_H

#include "scene/tape_build.h"

// What the parts of building share.

struct tape_builder {
    struct arena *work;
    struct tape_node *node;
    uint32_t count, capacity;
    uint32_t *slot; // open addressing, number of the node + 1
    uint32_t slots;
    bool failed;
};

// The node, an equal one if there is one already.
uint32_t tape_add_node(struct tape_builder *b, const struct tape_node *n);

#endif
