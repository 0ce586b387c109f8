#ifndef MATH_BVH8_H
#define MATH_BVH8_H

#include <stdbool.h>
#include <stdint.h>

#include "math/aabb.h"

struct arena;

// A tree of boxes with eight children per node. Boxes are single precision, relative
// to `origin` and grown so far that no rounding of the test can miss one.
struct bvh8_node {
    float box[6][8];  // min x y z, max x y z
    int32_t child[8]; // >= 0: node; BVH8_EMPTY; else a leaf, see bvh8_leaf_*
};

enum { BVH8_EMPTY = -1, BVH8_LEAF_MAX = 8, BVH8_STACK = 320 };

// Items that a leaf need not be split for: where a test of one costs little more than that
// of its box, and where it costs much more.
enum { BVH8_CHEAP_ITEMS = 4, BVH8_DEAR_ITEMS = 1 };

// The error of a test of boxes as a relative error of a t.
#define BVH8_SLACK (1 + 0x1p-20f)

struct bvh8 {
    struct bvh8_node *node; // NULL: no boxes
    uint32_t node_count;
    uint32_t *item; // the caller's indices, leaf by leaf
    uint32_t item_count;
    struct vec3 origin;
    struct aabb bounds; // of everything, in double
};

// index[i] is what stands for box[i]. The same input gives the same tree.
struct bvh8 bvh8_build(struct arena *a, const struct aabb *box, const uint32_t *index,
                       uint32_t count, uint32_t leaf_items);

// The same of boxes that are worked out when asked for: box(user, i) of index[i]; `bounds`
// holds them all.
typedef struct aabb bvh8_box(const void *user, uint32_t i);
struct bvh8 bvh8_build_of(struct arena *a, bvh8_box *box, const void *user,
                          struct aabb bounds, const uint32_t *index, uint32_t count,
                          uint32_t leaf_items);

static inline int32_t bvh8_leaf(uint32_t first, uint32_t count)
{
    return -2 - (int32_t)(first * BVH8_LEAF_MAX + count - 1);
}
static inline uint32_t bvh8_leaf_first(int32_t child)
{
    return (uint32_t)(-2 - child) / BVH8_LEAF_MAX;
}
static inline uint32_t bvh8_leaf_count(int32_t child)
{
    return (uint32_t)(-2 - child) % BVH8_LEAF_MAX + 1;
}

// A stretch of a ray in the tree's terms: the origin moved to the tree, and t scaled so
// that the largest component of the direction is 1.
struct bvh8_ray {
    float o[3], inverse[3];
    int negative[3]; // 3 where the direction is negative, else 0
    float t_far;
    double t_begin, scale;
};

// False: the stretch t_min..t_max (either may be infinite) misses everything.
bool bvh8_ray_begin(const struct bvh8 *b, const struct ray *ray, double t_min,
                    double t_max, struct bvh8_ray *out);
// Boxes that begin beyond t are of no interest any more.
void bvh8_ray_limit(struct bvh8_ray *r, double t);

struct bvh8_entry {
    int32_t child;
    float t;
};

struct bvh8_walk {
    struct bvh8_entry stack[BVH8_STACK];
    uint32_t depth;
    uint64_t visits;
};

void bvh8_walk_begin(struct bvh8_walk *w, const struct bvh8 *b);
// The next leaf near the ray, roughly front to back; false when there is none.
bool bvh8_walk_next(struct bvh8_walk *w, const struct bvh8 *b, const struct bvh8_ray *r,
                    uint32_t *first, uint32_t *count);
// The next leaf whose box holds p (an offset from b->origin); the same walk.
bool bvh8_walk_point(struct bvh8_walk *w, const struct bvh8 *b, const float p[3],
                     uint32_t *first, uint32_t *count);

// The next leaf whose box meets the box lo..hi (from b->origin); the same walk.
bool bvh8_walk_box(struct bvh8_walk *w, const struct bvh8 *b, const float lo[3],
                   const float hi[3], uint32_t *first, uint32_t *count);

#endif
