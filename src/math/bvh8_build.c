// The building of a tree of boxes: the surface area heuristic over bins of the centres (Wald,
// "On fast construction of SAH-based bounding volume hierarchies", RT 2007), eight children
// gathered from binary cuts: the widest is cut first, or, of dear items that are not too many,
// the best of all ways.
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

#include "base/arena.h"
#include "base/memory.h"
#include "math/bvh8.h"
#include "math/next_float.h"

enum {
    BINS = 16,
    BINS_OF_FEW = 8, // of ranges of up to
    FEW = 32,        // items
    // Where to halve by count, so that the depth stays within BVH8_STACK: below this depth,
    DEPTH_BINNED = 24,
    // or, in a tree of two children, where so many levels just suffice for that.
    DEPTH_OF_CUTS = 44,
    BEST_MOST = 1 << 15 // items that are gathered in the best way: that takes time
};

// The error of a test in units of the half extent of the tree: rounding the moved
// origin, subtracting and multiplying cost at most 4 half-ulps of it (2^-24 each).
static const double PAD = 0x1p-21;

// A box as nodes have it: relative to the tree's origin, grown by its pad and rounded outwards,
// the upper side negated, so that a join takes the lesser of everything. What a box of a node
// is rounded to does not depend on whether the join or the rounding comes first.
struct box {
    _Alignas(16) float lo[4]; // [3] of either is 0
    float hi[4];
};

struct range {
    uint32_t first, count;
    struct box box;
    float area; // half of the box's surface
    bool whole; // a leaf: not to be split any more
};

struct builder {
    struct box *item; // what the tree is over, moved as it is sorted
    uint32_t *order;  // which item it is
    struct bvh8_node *node;
    uint32_t node_count, node_capacity;
    struct cut_node *cut; // of dear items that are gathered in the best way
    uint32_t cut_count;
    uint32_t leaf_items; // a leaf of no more is split only if that pays
    struct vec3 origin;
    double pad;
};

struct cut {
    int axis, bin, bins;
    float cost;
    float from[4], scale[4]; // of all axes: bin = (centre - from)*scale
    struct box near, far;    // of the items on either side
};

// The items of a range whose centres are in the same part of an axis.
struct bins {
    struct box box[BINS];
    uint32_t count[BINS];
};

static struct box empty_box(void)
{
    return (struct box){{INFINITY, INFINITY, INFINITY, 0},
                        {INFINITY, INFINITY, INFINITY, 0}};
}

#ifdef __SSE2__

static inline void widen(struct box *a, const struct box *b)
{
    _mm_store_ps(a->lo, _mm_min_ps(_mm_load_ps(b->lo), _mm_load_ps(a->lo)));
    _mm_store_ps(a->hi, _mm_min_ps(_mm_load_ps(b->hi), _mm_load_ps(a->hi)));
}

// Twice the centre.
static inline __m128 centre(const struct box *b)
{
    return _mm_sub_ps(_mm_load_ps(b->lo), _mm_load_ps(b->hi));
}

static inline void widen_by_centre(struct box *a, const struct box *b)
{
    const __m128 c = centre(b);
    _mm_store_ps(a->lo, _mm_min_ps(c, _mm_load_ps(a->lo)));
    _mm_store_ps(a->hi, _mm_min_ps(_mm_sub_ps(_mm_setzero_ps(), c), _mm_load_ps(a->hi)));
}

// Which bin of each axis a box is in.
static inline void bins_of(const struct cut *c, const struct box *b, int32_t out[4])
{
    const __m128 at =
        _mm_mul_ps(_mm_sub_ps(centre(b), _mm_loadu_ps(c->from)), _mm_loadu_ps(c->scale));
    const __m128 last = _mm_set1_ps((float)(c->bins - 1));
    const __m128 in = _mm_min_ps(_mm_max_ps(at, _mm_setzero_ps()), last);
    _mm_storeu_si128((__m128i *)out, _mm_cvttps_epi32(in));
}

#else

static inline float lesser(float a, float b) { return a < b ? a : b; }

static inline void widen(struct box *a, const struct box *b)
{
    for (int k = 0; k < 3; k++) {
        a->lo[k] = lesser(b->lo[k], a->lo[k]);
        a->hi[k] = lesser(b->hi[k], a->hi[k]);
    }
}

static inline void widen_by_centre(struct box *a, const struct box *b)
{
    for (int k = 0; k < 3; k++) {
        const float c = b->lo[k] - b->hi[k];
        a->lo[k] = lesser(c, a->lo[k]);
        a->hi[k] = lesser(0 - c, a->hi[k]);
    }
}

static inline void bins_of(const struct cut *c, const struct box *b, int32_t out[4])
{
    const float last = (float)(c->bins - 1);
    for (int k = 0; k < 3; k++) {
        float at = (b->lo[k] - b->hi[k] - c->from[k]) * c->scale[k];
        at = at > 0 ? at : 0;
        out[k] = (int32_t)(at < last ? at : last);
    }
}

#endif

static inline float half_area(const struct box *b)
{
    const float x = -b->hi[0] - b->lo[0], y = -b->hi[1] - b->lo[1],
                z = -b->hi[2] - b->lo[2];
    return x * y + y * z + z * x;
}

static struct box range_box(const struct builder *b, uint32_t first, uint32_t count)
{
    struct box box = empty_box();
    for (uint32_t i = first; i < first + count; i++)
        widen(&box, &b->item[i]);
    return box;
}

// The surface area heuristic over the bins of the centres along one axis.
static void try_axis(const struct bins *bins, int axis, struct cut *best)
{
    float area[BINS]; // behind each bin, itself included
    uint32_t behind[BINS], n = 0;
    struct box sum = empty_box();
    for (int i = best->bins - 1; i > 0; i--) {
        n += bins->count[i];
        widen(&sum, &bins->box[i]);
        behind[i] = n;
        area[i] = n ? half_area(&sum) : 0;
    }
    n = 0;
    sum = empty_box();
    for (int i = 0; i < best->bins - 1 && behind[i + 1]; i++) {
        if (!bins->count[i]) // the cut before it is the same
            continue;
        n += bins->count[i];
        widen(&sum, &bins->box[i]);
        const float cost =
            half_area(&sum) * (float)n + area[i + 1] * (float)behind[i + 1];
        if (cost < best->cost) {
            best->cost = cost;
            best->axis = axis;
            best->bin = i;
        }
    }
}

static void settle(struct cut *c, const struct bins *bins)
{
    c->near = c->far = empty_box();
    for (int i = 0; i < c->bins; i++)
        widen(i <= c->bin ? &c->near : &c->far, &bins->box[i]);
}

static void fill_bins(const struct box *item, uint32_t count, const struct cut *c,
                      struct bins bins[3])
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < c->bins; i++) {
            bins[axis].box[i] = empty_box();
            bins[axis].count[i] = 0;
        }
    for (uint32_t i = 0; i < count; i++) {
        int32_t k[4];
        bins_of(c, &item[i], k);
        for (int axis = 0; axis < 3; axis++) {
            widen(&bins[axis].box[k[axis]], &item[i]);
            bins[axis].count[k[axis]]++;
        }
    }
}

static bool find_cut(const struct builder *b, const struct range *r, struct cut *best)
{
    const struct box *item = b->item + r->first;
    struct box centres = empty_box();
    struct bins bins[3];
    for (uint32_t i = 0; i < r->count; i++)
        widen_by_centre(&centres, &item[i]);
    *best = (struct cut){.axis = -1, .cost = FLT_MAX};
    best->bins = r->count <= FEW && !b->cut ? BINS_OF_FEW : BINS;
    for (int axis = 0; axis < 3; axis++) {
        const float width = -centres.hi[axis] - centres.lo[axis];
        best->from[axis] = centres.lo[axis];
        best->scale[axis] = width > 0 ? (float)best->bins / width : 0;
    }
    fill_bins(item, r->count, best, bins);
    for (int axis = 0; axis < 3; axis++)
        if (best->scale[axis] > 0)
            try_axis(&bins[axis], axis, best);
    if (best->axis >= 0)
        settle(best, &bins[best->axis]);
    return best->axis >= 0;
}

// The near items to the front. The tree depends on the order of the scene alone.
static uint32_t partition(struct builder *b, const struct range *r, const struct cut *c)
{
    uint32_t i = r->first, end = r->first + r->count;
    while (i < end) {
        int32_t k[4];
        bins_of(c, &b->item[i], k);
        if (k[c->axis] <= c->bin) {
            i++;
            continue;
        }
        end--;
        const struct box box = b->item[i];
        const uint32_t order = b->order[i];
        b->item[i] = b->item[end];
        b->order[i] = b->order[end];
        b->item[end] = box;
        b->order[end] = order;
    }
    return i - r->first;
}

static bool split(struct builder *b, struct range *r, bool binned, struct range *rest)
{
    if (r->count <= 1)
        return false;
    uint32_t left = r->count / 2;
    struct cut c;
    const bool cut = binned && find_cut(b, r, &c);
    if (cut) {
        // A test of a box costs about as much as half a test of an object.
        if (r->count <= b->leaf_items &&
            c.cost + 0.5f * r->area >= r->area * (float)r->count)
            return false;
        left = partition(b, r, &c);
    } else if (r->count <= b->leaf_items) {
        return false;
    }
    *rest = (struct range){.first = r->first + left, .count = r->count - left};
    rest->box = cut ? c.far : range_box(b, rest->first, rest->count);
    rest->area = half_area(&rest->box);
    r->count = left;
    r->box = cut ? c.near : range_box(b, r->first, r->count);
    r->area = half_area(&r->box);
    return true;
}

static uint32_t new_node(struct builder *b)
{
    b->node = must_grow(b->node, b->node_count, &b->node_capacity, sizeof *b->node);
    struct bvh8_node *n = &b->node[b->node_count];
    for (int i = 0; i < 8; i++) {
        n->child[i] = BVH8_EMPTY;
        for (int axis = 0; axis < 3; axis++) {
            n->box[axis][i] = 1e30f;
            n->box[3 + axis][i] = -1e30f;
        }
    }
    return b->node_count++;
}

static void set_child(struct builder *b, uint32_t id, int i, const struct box *box,
                      int32_t child)
{
    struct bvh8_node *n = &b->node[id];
    for (int axis = 0; axis < 3; axis++) {
        n->box[axis][i] = box->lo[axis];
        n->box[3 + axis][i] = -box->hi[axis];
    }
    n->child[i] = child;
}

// ---- cheap items, or many: the widest box is cut first --------------------------------------

// Whether to split a range of a node that has `count`. Items that each are a leaf, and would fill
// one node, are better left to it than made nodes of few children.
static bool may_split(const struct range *r, uint32_t count, uint32_t leaf_items)
{
    return !r->whole && (leaf_items > 1 || r->count > 8 || count + r->count <= 9);
}

// The range with the largest box that may still be split; -1: none.
static int widest(const struct range *r, int count, uint32_t leaf_items)
{
    int best = -1;
    for (int i = 0; i < count; i++)
        if (may_split(&r[i], (uint32_t)count, leaf_items) &&
            (best < 0 || r[i].area > r[best].area))
            best = i;
    return best;
}

// The depth of the recursion is bounded: see DEPTH_BINNED.
static uint32_t make_node(struct builder *b, struct range all, uint32_t depth)
{
    struct range r[8] = {all};
    int n = 1;
    for (int i; n < 8 && (i = widest(r, n, b->leaf_items)) >= 0;) {
        if (split(b, &r[i], depth < DEPTH_BINNED, &r[n]))
            n++;
        else
            r[i].whole = true;
    }
    uint32_t id = new_node(b);
    for (int i = 0; i < n; i++) {
        int32_t child = r[i].count <= b->leaf_items
                            ? bvh8_leaf(r[i].first, r[i].count)
                            : (int32_t)make_node(b, r[i], depth + 1);
        set_child(b, id, i, &r[i].box, child);
    }
    return id;
}

// ---- dear items: the best of all ways to gather children ------------------------------------
//
// A tree costs a ray as much as the areas of its nodes are together. The least that follows from
// a binary tree is found from its leaves up (Pinto, "Adaptive collapsing on bounding volume
// hierarchies for ray-tracing", Eurographics 2010; Ylitie et al., "Efficient incoherent ray
// traversal on GPUs through compressed wide BVHs", HPG 2017).

struct cut_node {
    struct range r; // of one item: a leaf
    uint32_t half[2];
    // The least cost as at most k children of a node; how many of them are then of the first
    // half, 0: all is one child.
    float cost[9];
    uint8_t share[9];
};

static void find_costs(const struct builder *b, struct cut_node *n)
{
    const struct cut_node *one = &b->cut[n->half[0]], *other = &b->cut[n->half[1]];
    for (int k = 2; k <= 8; k++) {
        n->cost[k] = one->cost[1] + other->cost[k - 1];
        n->share[k] = 1;
        for (int i = 2; i < k; i++) {
            const float cost = one->cost[i] + other->cost[k - i];
            if (cost < n->cost[k]) {
                n->cost[k] = cost;
                n->share[k] = (uint8_t)i;
            }
        }
    }
    n->cost[1] = n->r.area + n->cost[8];
    for (int k = 2; k < 8; k++)
        if (n->cost[1] < n->cost[k]) {
            n->cost[k] = n->cost[1];
            n->share[k] = 0;
        }
}

// Whether halving `count` items until each is alone fits into that many levels.
static bool fits(uint32_t count, uint32_t levels)
{
    return levels >= 32 || count <= (uint32_t)1 << levels;
}

// The depth of the recursion is bounded: see DEPTH_OF_CUTS.
static uint32_t make_cuts(struct builder *b, struct range r, uint32_t depth)
{
    const uint32_t id = b->cut_count++;
    struct cut_node *n = &b->cut[id];
    *n = (struct cut_node){.r = r};
    struct range rest;
    if (split(b, &r,
              depth + 1 < DEPTH_OF_CUTS && fits(r.count, DEPTH_OF_CUTS - 1 - depth),
              &rest)) {
        n->half[0] = make_cuts(b, r, depth + 1);
        n->half[1] = make_cuts(b, rest, depth + 1);
        find_costs(b, n);
    }
    return id;
}

// Adds to the n children of a node what is at most `most` of them; returns how many it has.
static int gather(const struct builder *b, uint32_t cut, int most, uint32_t child[8],
                  int n)
{
    const struct cut_node *c = &b->cut[cut];
    const int share = c->share[most];
    if (!share) {
        child[n] = cut;
        return n + 1;
    }
    n = gather(b, c->half[0], share, child, n);
    return gather(b, c->half[1], most - share, child, n);
}

static uint32_t make_best_node(struct builder *b, uint32_t cut)
{
    uint32_t child[8];
    const int n = gather(b, cut, 8, child, 0);
    const uint32_t id = new_node(b);
    for (int i = 0; i < n; i++) {
        const struct range *r = &b->cut[child[i]].r;
        set_child(b, id, i, &r->box,
                  r->count == 1 ? bvh8_leaf(r->first, 1)
                                : (int32_t)make_best_node(b, child[i]));
    }
    return id;
}

static void make_best_tree(struct builder *b, struct range all)
{
    b->cut = must_align(16, 2 * (size_t)all.count - 1, sizeof *b->cut);
    make_best_node(b, make_cuts(b, all, 0));
    free(b->cut);
}

// ---- the tree -------------------------------------------------------------------------------

static float round_down(double v)
{
    float f = (float)v;
    return (double)f > v ? float_below(f) : f;
}

static struct box placed(const struct builder *b, const struct aabb *box)
{
    struct box out = {0};
    for (int axis = 0; axis < 3; axis++) {
        const double o = vec3_axis(b->origin, axis);
        out.lo[axis] = round_down(vec3_axis(box->min, axis) - o - b->pad);
        out.hi[axis] = round_down(-(vec3_axis(box->max, axis) - o + b->pad));
    }
    return out;
}

static struct vec3 middle(struct aabb b)
{
    return vec3(0.5 * b.min.x + 0.5 * b.max.x, 0.5 * b.min.y + 0.5 * b.max.y,
                0.5 * b.min.z + 0.5 * b.max.z);
}

struct bvh8 bvh8_build_of(struct arena *a, bvh8_box *box, const void *user,
                          struct aabb bounds, const uint32_t *index, uint32_t count,
                          uint32_t leaf_items)
{
    struct bvh8 t = {.bounds = aabb_empty(), .item_count = count};
    if (!count)
        return t;
    struct builder b = {.origin = middle(bounds), .leaf_items = leaf_items};
    b.item = must_align(16, count, sizeof *b.item);
    b.order = must_malloc(count, sizeof *b.order);
    b.pad = PAD * vec3_max_abs(vec3_sub(bounds.max, b.origin)) + FLT_MIN;
    for (uint32_t i = 0; i < count; i++) {
        const struct aabb whole = box(user, i);
        b.item[i] = placed(&b, &whole);
        b.order[i] = i;
    }
    struct range all = {.count = count, .box = range_box(&b, 0, count)};
    all.area = half_area(&all.box);
    if (leaf_items == 1 && count <= BEST_MOST)
        make_best_tree(&b, all);
    else
        make_node(&b, all, 0);
    free(b.item);
    t.origin = b.origin;
    t.node_count = b.node_count;
    t.node = arena_alloc_aligned(a, b.node_count * sizeof *t.node, 64);
    memcpy(t.node, b.node, b.node_count * sizeof *t.node);
    free(b.node);
    t.item = arena_new_array(a, uint32_t, count);
    for (uint32_t i = 0; i < count; i++)
        t.item[i] = index[b.order[i]];
    free(b.order);
    struct vec3 pad = vec3(b.pad, b.pad, b.pad);
    t.bounds = (struct aabb){vec3_sub(bounds.min, pad), vec3_add(bounds.max, pad)};
    return t;
}

static struct aabb box_at(const void *user, uint32_t i)
{
    return ((const struct aabb *)user)[i];
}

struct bvh8 bvh8_build(struct arena *a, const struct aabb *box, const uint32_t *index,
                       uint32_t count, uint32_t leaf_items)
{
    struct aabb bounds = aabb_empty();
    for (uint32_t i = 0; i < count; i++)
        bounds = aabb_join(bounds, box[i]);
    return bvh8_build_of(a, box_at, box, bounds, index, count, leaf_items);
}
