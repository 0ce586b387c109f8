// What finds the objects, and the leaves of large objects, near a ray.
#include "trace/accel.h"

#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"
#include "scene/shapes/sphere.h"
#include "trace/packet.h"

static void build_leaf_tree(struct arena *a, const struct world *w,
                            const struct world_object *o, struct accel_large *large)
{
    struct aabb *box = must_malloc(o->leaf_count, sizeof *box);
    uint32_t *leaf = must_malloc(o->leaf_count, sizeof *leaf);
    uint32_t n = 0, infinite = 0;
    for (uint32_t i = 0; i < o->leaf_count; i++)
        infinite += !aabb_is_finite(w->leaf[o->first_leaf + i].bounds) &&
                    !aabb_is_empty(w->leaf[o->first_leaf + i].bounds);
    large->unbounded = arena_new_array(a, uint32_t, infinite + 1);
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
        if (aabb_is_empty(w->leaf[i].bounds))
            continue;
        if (aabb_is_finite(w->leaf[i].bounds)) {
            box[n] = w->leaf[i].bounds;
            leaf[n++] = i;
        } else {
            large->unbounded[large->unbounded_count++] = i;
        }
    }
    large->leaves = bvh8_build(a, box, leaf, n, BVH8_CHEAP_ITEMS);
    free(box);
    free(leaf);
}

static void list_required(struct arena *a, const struct world *w,
                          const struct world_object *o, struct accel_large *large)
{
    for (uint32_t i = 0; i < o->leaf_count; i++)
        large->required_count += w->leaf[o->first_leaf + i].required;
    uint32_t *list = arena_new_array(a, uint32_t, large->required_count + 1);
    large->required = list;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (w->leaf[i].required)
            *list++ = i;
}

static void list_balls(struct arena *a, const struct world *w, const struct accel *accel,
                       struct accel_large *large)
{
    for (uint32_t i = 0; i < large->required_count; i++) {
        const enum packet_shape shape = accel->leaf_shape[large->required[i]];
        if (shape == PACKET_NONE || shape > PACKET_CONE)
            return;
    }
    const uint32_t count = large->leaves.item_count;
    large->ball = arena_new_array(a, struct accel_ball, count + 1);
    for (uint32_t i = 0; i < count; i++) {
        const struct leaf *l = &w->leaf[large->leaves.item[i]];
        const struct sphere *s = l->shape;
        if (l->inverted)
            large->ball[i] = (struct accel_ball){s->centre, s->radius};
    }
}

static void build_large(struct arena *a, const struct world *w, struct accel *accel)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->object_count; i++)
        count += w->object[i].leaf_count >= LARGE_OBJECT;
    if (!count)
        return;
    accel->large = arena_new_array(a, struct accel_large, count);
    accel->large_of = arena_new_array(a, uint32_t, w->object_count);
    count = 0;
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct world_object *o = &w->object[i];
        if (o->leaf_count < LARGE_OBJECT)
            continue;
        struct accel_large *large = &accel->large[count];
        accel->large_of[i] = count++;
        build_leaf_tree(a, w, o, large);
        list_required(a, w, o, large);
        if (accel->object_shape[i] == PACKET_SPONGE)
            list_balls(a, w, accel, large);
    }
}

// The sphere that is all of an object; NULL: it is something else.
static const struct sphere *lone_sphere(const struct world *w, uint32_t object)
{
    const struct world_object *o = &w->object[object];
    const struct leaf *l = &w->leaf[o->first_leaf];
    return o->is_csg || l->ops != &sphere_ops || !l->transform->identity || !l->drawn ||
                   o->bound_count
               ? NULL
               : l->shape;
}

static void list_lone_spheres(struct arena *a, const struct world *w, struct accel *accel)
{
    const uint32_t n = accel->top.item_count;
    for (int k = 0; k < 4; k++) // a block of eight may begin at the last
        accel->ball[k] = arena_new_array(a, double, n + 8);
    accel->lone_opaque = true;
    for (uint32_t i = 0; i < n; i++) {
        const struct sphere *s = lone_sphere(w, accel->top.item[i]);
        if (!s)
            continue;
        accel->lone_flags |= w->object[accel->top.item[i]].flags;
        accel->lone_opaque &= w->object[accel->top.item[i]].opaque;
        accel->ball[0][i] = s->centre.x;
        accel->ball[1][i] = s->centre.y;
        accel->ball[2][i] = s->centre.z;
        accel->ball[3][i] = s->radius;
    }
}

static bool is_of_part(const struct world *w, const struct world_object *o,
                       enum accel_part part)
{
    if (o->opaque || part == ACCEL_WHOLE)
        return part != ACCEL_CLEAR;
    bool any = part == ACCEL_CLEAR;
    for (uint32_t i = 0; i < o->leaf_count && !any; i++)
        any = w->surface[w->leaf[o->first_leaf + i].surface].opaque;
    return any;
}

static void build_top(struct arena *a, const struct world *w, struct accel *accel,
                      enum accel_part part)
{
    struct aabb *box = must_malloc(w->object_count + 1, sizeof *box);
    uint32_t *object = must_malloc(w->object_count + 1, sizeof *object);
    uint32_t n = 0, infinite = 0, balls = 0;
    for (uint32_t i = 0; i < w->object_count; i++)
        infinite += !aabb_is_finite(w->object[i].bounds);
    accel->infinite = arena_new_array(a, uint32_t, infinite + 1);
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct world_object *o = &w->object[i];
        if (aabb_is_empty(o->bounds) || !is_of_part(w, o, part))
            continue;
        if (aabb_is_finite(o->bounds)) {
            box[n] = aabb_pad(o->bounds);
            object[n++] = i;
            balls += lone_sphere(w, i) != NULL;
        } else {
            accel->infinite[accel->infinite_count++] = i;
        }
    }
    // One ray meets eight spheres at once, but other objects as fast as eight rays do.
    const bool mostly_balls = 2 * balls > n;
    accel->together = mostly_balls ? 4 : 2;
    accel->alone = mostly_balls ? 2 : 1;
    accel->top =
        bvh8_build(a, box, object, n, mostly_balls ? BVH8_CHEAP_ITEMS : BVH8_DEAR_ITEMS);
    free(box);
    free(object);
}

// Objects that packets miss about as soon as a tree would.
static bool is_few(const struct accel *accel)
{
    enum { FEW = 2 };
    for (uint32_t i = 0; i < accel->top.item_count; i++) {
        const unsigned shape = accel->object_shape[accel->top.item[i]];
        const bool simple = shape >= PACKET_SPHERE && shape <= PACKET_CYLINDER;
        if (!simple && shape != PACKET_PRODUCT && shape != PACKET_SPONGE)
            return false;
    }
    return accel->top.item_count <= FEW;
}

struct accel *accel_build(struct arena *a, const struct world *w)
{
    struct accel *accel = arena_new_struct(a, struct accel);
    accel->base_inside = arena_new_array(a, uint32_t, w->node_count + 1);
    for (uint32_t i = 0; i < w->node_count; i++)
        accel->base_inside[i] = w->node[i].base_inside;
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct world_object *o = &w->object[i];
        accel->flags |= o->flags;
        if (o->node_count > accel->nodes_max)
            accel->nodes_max = o->node_count;
        if (o->leaf_count > accel->leaves_max)
            accel->leaves_max = o->leaf_count;
    }
    accel_classify(a, w, accel);
    accel_list_products(a, w, accel);
    build_large(a, w, accel);
    build_top(a, w, accel, ACCEL_WHOLE);
    list_lone_spheres(a, w, accel);
    accel->few = is_few(accel);
    accel->kernels = packet_kernels_choose();
    return accel;
}

struct accel *accel_build_part(struct arena *a, const struct world *w,
                               enum accel_part part)
{
    struct accel *accel = arena_new_struct(a, struct accel);
    *accel = *w->accel;
    accel->infinite_count = 0;
    accel->lone_flags = 0;
    build_top(a, w, accel, part);
    list_lone_spheres(a, w, accel);
    accel->few = is_few(accel);
    return accel;
}
