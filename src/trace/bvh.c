#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "trace/accel.h"

enum { BINS = 16, LEAF_MAX = 4, DEPTH_SAH = 40 };

struct builder {
    const struct aabb *box;
    struct vec3 *center;
    uint32_t *item;
    struct bvh_node *node;
    uint32_t node_count;
};

struct bin {
    struct aabb box;
    uint32_t count;
};

static int bin_of(double c, double lo, double scale)
{
    const int i = (int)((c - lo) * scale);
    return i < 0 ? 0 : i >= BINS ? BINS - 1 : i;
}

// The cheapest split of the items along one axis: returns the cost, *bin the last bin of
// the left side.
static double best_on_axis(const struct builder *b, uint32_t first, uint32_t count, int axis,
                           double lo, double scale, int *bin)
{
    struct bin bins[BINS];
    for (int i = 0; i < BINS; i++)
        bins[i] = (struct bin){aabb_empty(), 0};
    for (uint32_t i = first; i < first + count; i++) {
        struct bin *k = &bins[bin_of(vec3_axis(b->center[b->item[i]], axis), lo, scale)];
        k->box = aabb_join(k->box, b->box[b->item[i]]);
        k->count++;
    }
    double right[BINS];
    struct aabb box = aabb_empty();
    uint32_t n = 0;
    for (int i = BINS - 1; i > 0; i--) {
        box = aabb_join(box, bins[i].box);
        n += bins[i].count;
        right[i] = n ? n * aabb_half_area(box) : INFINITY;
    }
    double best = INFINITY;
    box = aabb_empty();
    n = 0;
    for (int i = 0; i < BINS - 1; i++) {
        box = aabb_join(box, bins[i].box);
        n += bins[i].count;
        const double cost = n ? n * aabb_half_area(box) + right[i + 1] : INFINITY;
        if (cost < best) {
            best = cost;
            *bin = i;
        }
    }
    return best;
}

static void swap_items(uint32_t *a, uint32_t *b)
{
    const uint32_t t = *a;
    *a = *b;
    *b = t;
}

// Splits [first, first + count) and returns how many go left.
static uint32_t split(struct builder *b, uint32_t first, uint32_t count, int depth)
{
    struct aabb centers = aabb_empty();
    for (uint32_t i = first; i < first + count; i++)
        centers = aabb_add(centers, b->center[b->item[i]]);
    double best = INFINITY, lo = 0, scale = 0;
    int axis = -1, bin = 0;
    for (int a = 0; a < 3 && depth < DEPTH_SAH; a++) {
        const double l = vec3_axis(centers.min, a), size = vec3_axis(centers.max, a) - l;
        int k = 0;
        if (!(size > 0))
            continue;
        const double cost = best_on_axis(b, first, count, a, l, BINS / size, &k);
        if (cost < best) {
            best = cost;
            axis = a;
            bin = k;
            lo = l;
            scale = BINS / size;
        }
    }
    if (axis < 0)
        return count / 2;
    uint32_t i = first, j = first + count;
    while (i < j) {
        if (bin_of(vec3_axis(b->center[b->item[i]], axis), lo, scale) <= bin)
            i++;
        else
            swap_items(&b->item[i], &b->item[--j]);
    }
    const uint32_t left = i - first;
    return left == 0 || left == count ? count / 2 : left;
}

static uint32_t build_node(struct builder *b, uint32_t first, uint32_t count, int depth)
{
    const uint32_t index = b->node_count++;
    const uint32_t left = split(b, first, count, depth);
    const uint32_t begin[2] = {first, first + left}, n[2] = {left, count - left};
    for (int k = 0; k < 2; k++) {
        struct aabb box = aabb_empty();
        for (uint32_t i = begin[k]; i < begin[k] + n[k]; i++)
            box = aabb_join(box, b->box[b->item[i]]);
        b->node[index].bounds[k] = box;
        b->node[index].count[k] = n[k] <= LEAF_MAX ? n[k] : 0;
        b->node[index].child[k] = begin[k];
        if (n[k] > LEAF_MAX) {
            const uint32_t child = build_node(b, begin[k], n[k], depth + 1);
            b->node[index].child[k] = child;
        }
    }
    return index;
}

struct bvh bvh_build(struct arena *a, const struct aabb *box, uint32_t count)
{
    struct bvh out = {.item_count = count};
    if (count == 0)
        return out;
    struct builder b = {.box = box};
    b.center = malloc(count * sizeof *b.center);
    b.item = arena_new_array(a, uint32_t, count);
    b.node = arena_new_array(a, struct bvh_node, count);
    if (!b.center)
        abort();
    for (uint32_t i = 0; i < count; i++) {
        b.item[i] = i;
        b.center[i] = vec3_scale(0.5, vec3_add(box[i].min, box[i].max));
    }
    build_node(&b, 0, count, 0);
    free(b.center);
    out.node = b.node;
    out.node_count = b.node_count;
    out.item = b.item;
    return out;
}

// ---- a world's boxes --------------------------------------------------------------

static void build_leaf_tree(struct arena *a, const struct world *w, struct accel *accel,
                            uint32_t object)
{
    const struct world_object *o = &w->object[object];
    struct aabb *box = malloc(o->leaf_count * sizeof *box);
    uint32_t *leaf = malloc(o->leaf_count * sizeof *leaf);
    if (!box || !leaf)
        abort();
    uint32_t n = 0, infinite = 0;
    for (uint32_t i = 0; i < o->leaf_count; i++)
        infinite += !aabb_is_finite(w->leaf[o->first_leaf + i].bounds) &&
                    !aabb_is_empty(w->leaf[o->first_leaf + i].bounds);
    accel->unbounded[object] = arena_new_array(a, uint32_t, infinite + 1);
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
        if (aabb_is_empty(w->leaf[i].bounds))
            continue;
        if (aabb_is_finite(w->leaf[i].bounds)) {
            box[n] = w->leaf[i].bounds;
            leaf[n++] = i;
        } else {
            accel->unbounded[object][accel->unbounded_count[object]++] = i;
        }
    }
    struct bvh tree = bvh_build(a, box, n);
    for (uint32_t i = 0; i < n; i++)
        tree.item[i] = leaf[tree.item[i]];
    accel->leaves[object] = tree;
    free(box);
    free(leaf);
}

struct accel *accel_build(struct arena *a, const struct world *w)
{
    struct accel *accel = arena_new_struct(a, struct accel);
    struct aabb *box = malloc((w->object_count + 1) * sizeof *box);
    uint32_t *object = malloc((w->object_count + 1) * sizeof *object);
    if (!box || !object)
        abort();
    accel->infinite = arena_new_array(a, uint32_t, w->object_count + 1);
    accel->leaves = arena_new_array(a, struct bvh, w->object_count + 1);
    accel->unbounded = arena_new_array(a, uint32_t *, w->object_count + 1);
    accel->unbounded_count = arena_new_array(a, uint32_t, w->object_count + 1);
    uint32_t n = 0;
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct world_object *o = &w->object[i];
        if (o->node_count > accel->nodes_max)
            accel->nodes_max = o->node_count;
        if (o->leaf_count > accel->leaves_max)
            accel->leaves_max = o->leaf_count;
        if (o->leaf_count >= LARGE_OBJECT)
            build_leaf_tree(a, w, accel, i);
        if (aabb_is_empty(o->bounds))
            continue;
        if (aabb_is_finite(o->bounds)) {
            box[n] = aabb_pad(o->bounds);
            object[n++] = i;
        } else {
            accel->infinite[accel->infinite_count++] = i;
        }
    }
    accel->top = bvh_build(a, box, n);
    for (uint32_t i = 0; i < n; i++)
        accel->top.item[i] = object[accel->top.item[i]];
    free(box);
    free(object);
    return accel;
}
