// What finds the objects, and the leaves of large objects, near a ray.
#include "trace/accel.h"

#include <math.h>
#include <stdlib.h>

#include "base/arena.h"
#include "base/memory.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/isosurface_open.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/revolve.h"
#include "scene/shapes/sphere.h"
#include "scene/shapes/torus.h"
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

static enum packet_shape shape_of_leaf(const struct leaf *l)
{
    if (l->ops == &sphere_ops)
        return PACKET_SPHERE;
    if (l->ops == &box_ops)
        return PACKET_BOX;
    if (l->ops == &plane_ops)
        return PACKET_PLANE;
    if (l->ops == &cylinder_ops)
        return ((const struct cylinder *)l->shape)->open ? PACKET_OPEN_CYLINDER
                                                         : PACKET_CYLINDER;
    if (l->ops == &cone_ops)
        return ((const struct cone *)l->shape)->open ? PACKET_OPEN_CONE : PACKET_CONE;
    if (l->ops == &quadric_ops)
        return PACKET_QUADRIC;
    if (l->ops == &disc_ops)
        return PACKET_DISC;
    if (l->ops == &torus_ops)
        return PACKET_TORUS;
    if (l->ops == &triangle_ops || l->ops == &smooth_triangle_ops)
        return PACKET_TRIANGLE;
    if (l->ops == &mesh_ops || l->ops == &mesh2_ops)
        return PACKET_MESH;
    if (shape_has_lanes(l->ops, l->shape))
        return PACKET_LANES;
    return PACKET_NONE;
}

static bool has_intersections_only(const struct world *w, const struct world_object *o)
{
    if (!o->is_csg)
        return false;
    for (uint32_t i = o->root; i < o->root + o->node_count; i++)
        if (w->node[i].op != NODE_LEAF && w->node[i].op != NODE_INTERSECTION)
            return false;
    return true;
}

static bool is_intersection(const struct world *w, const struct world_object *o)
{
    if (!has_intersections_only(w, o))
        return false;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (!w->leaf[i].drawn)
            return false;
    return true;
}

static bool is_product(const struct accel *accel, const struct world_object *o)
{
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (!packet_is_product_shape(accel->leaf_shape[i]))
            return false;
    return o->leaf_count <= PRODUCT_LEAVES;
}

// Whether every boundary of these shapes is drawn; others may be open, so that what they
// show first does not tell where they are inside.
static bool is_closed(const struct leaf *l)
{
    const struct shape_ops *ops = l->ops;
    if (ops == &isosurface_ops)
        return !isosurface_is_open(l->shape);
    if (ops == &lathe_ops || ops == &sor_ops)
        return revolve_is_closed(l->shape); // both begin with one
    return ops == &blob_ops || ops == &text_ops || ops == &poly_ops ||
           ops == &cubic_ops || ops == &quartic_ops || ops == &polynomial_ops ||
           ops == &ovus_ops || ops == &superellipsoid_ops || ops == &sphere_sweep_ops;
}

static bool is_carved(const struct world *w, const struct accel *accel,
                      const struct world_object *o)
{
    uint32_t solids = 0;
    bool shown = false, closed = false; // a cut's own face; the solid
    bool drawn = false;                 // the solid
    if (!has_intersections_only(w, o) || o->leaf_count > CARVE_LEAVES)
        return false;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
        const struct leaf *l = &w->leaf[i];
        const bool solid = accel->leaf_shape[i] == PACKET_LANES;
        if (!solid && !packet_is_product_shape(accel->leaf_shape[i]))
            return false;
        solids += solid;
        shown |= !solid && l->drawn;
        closed |= solid && is_closed(l);
        drawn |= solid && l->drawn;
    }
    return solids == 1 && (drawn ? closed || !shown : shown);
}

static bool is_merge(const struct world *w, const struct accel *accel,
                     const struct world_object *o)
{
    if (!o->is_csg || w->node[o->root].op != NODE_MERGE ||
        o->node_count != o->leaf_count + 1 || !is_product(accel, o))
        return false;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (!w->leaf[i].drawn)
            return false;
    return true;
}

static bool is_ring(const struct world *w, const struct accel *accel,
                    const struct world_object *o)
{
    uint32_t rings = 0;
    if (!has_intersections_only(w, o) || o->leaf_count > PRODUCT_LEAVES)
        return false;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
        const struct leaf *l = &w->leaf[i];
        if (packet_is_product_shape(accel->leaf_shape[i]))
            continue;
        const struct torus *t = l->shape;
        if (accel->leaf_shape[i] != PACKET_TORUS || !l->drawn || !(t->major > t->minor))
            return false;
        rings++;
    }
    return rings == 1;
}

// Whether packets know all that the sweep takes the bounds of a leaf's crossings for.
static bool has_known_bounds(const struct leaf *l, unsigned shape)
{
    return packet_is_product_shape(shape) ||
           (l->transform->identity && shape >= PACKET_SPHERE && shape <= PACKET_TRIANGLE);
}

// PACKET_CLIPPED, PACKET_CLIPPED_PRODUCT, or PACKET_NONE: neither.
static enum packet_shape clipped_shape(const struct world *w, const struct accel *accel,
                                       const struct world_object *o)
{
    uint32_t clips = 0, shown = 0;
    bool known = true, product = true;
    if (!has_intersections_only(w, o))
        return PACKET_NONE;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
        const struct leaf *l = &w->leaf[i];
        const unsigned shape = accel->leaf_shape[i];
        if (!l->drawn) {
            if (l->inverted || !packet_is_product_shape(shape))
                return PACKET_NONE;
            clips++;
            continue;
        }
        shown++;
        known = known && has_known_bounds(l, shape);
        product = product && packet_is_product_shape(shape);
    }
    if (clips && shown == 1 && known)
        return PACKET_CLIPPED;
    return clips && product && shown <= PRODUCT_LEAVES ? PACKET_CLIPPED_PRODUCT
                                                       : PACKET_NONE;
}

static bool is_packet_csg(const struct world *w, const struct world_object *o)
{
    if (!o->is_csg || o->leaf_count > CSG_LEAVES || o->node_count > CSG_NODES)
        return false;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++)
        if (!w->leaf[i].solid)
            return false;
    return true;
}

static bool is_sponge(const struct world *w, const struct world_object *o)
{
    uint32_t solids = 0;
    for (uint32_t i = o->first_leaf; i < o->first_leaf + o->leaf_count; i++) {
        const struct leaf *l = &w->leaf[i];
        const bool ball = l->ops == &sphere_ops && l->transform->identity;
        if (l->inverted ? !ball : !l->required || !(l->ops->flags & SHAPE_CONVEX))
            return false;
        solids += !l->inverted;
    }
    return solids > 0 && solids <= STAB_SOLIDS && o->leaf_count >= LARGE_OBJECT;
}

static void classify(struct arena *a, const struct world *w, struct accel *accel)
{
    accel->leaf_shape = arena_new_array(a, uint8_t, w->leaf_count + 1);
    accel->object_shape = arena_new_array(a, uint8_t, w->object_count + 1);
    accel->plain = arena_new_array(a, bool, w->object_count + 1);
    for (uint32_t i = 0; i < w->leaf_count; i++)
        accel->leaf_shape[i] = (uint8_t)shape_of_leaf(&w->leaf[i]);
    for (uint32_t i = 0; i < w->object_count; i++) {
        const struct world_object *o = &w->object[i];
        if (!o->is_csg && w->leaf[o->first_leaf].drawn)
            accel->object_shape[i] = accel->leaf_shape[o->first_leaf];
        else if (is_intersection(w, o) && is_sponge(w, o))
            accel->object_shape[i] = PACKET_SPONGE;
        else if (is_intersection(w, o) && is_product(accel, o))
            accel->object_shape[i] = PACKET_PRODUCT;
        else if (is_carved(w, accel, o))
            accel->object_shape[i] = PACKET_CARVED;
        else if (is_merge(w, accel, o))
            accel->object_shape[i] = PACKET_MERGE;
        else if (is_ring(w, accel, o))
            accel->object_shape[i] = PACKET_RING;
        else
            accel->object_shape[i] = (uint8_t)clipped_shape(w, accel, o);
        if (accel->object_shape[i] == PACKET_NONE && is_packet_csg(w, o))
            accel->object_shape[i] = PACKET_CSG;
        accel->plain[i] = accel->object_shape[i] != PACKET_NONE && o->opaque &&
                          !o->bound_count &&
                          !(o->flags & (OBJECT_NO_IMAGE | OBJECT_NO_REFLECTION |
                                        OBJECT_NO_SHADOW | OBJECT_NO_RADIOSITY));
    }
}

// Adds what a leaf in a space has. Of cones and quadrics the bounds of each crossing are
// known.
static void leaf_adds(const struct leaf *l, unsigned shape, uint32_t space,
                      struct accel_product *x)
{
    double extent = 0, radius = INFINITY;
    if (shape == PACKET_SPHERE) {
        const struct sphere *s = l->shape;
        radius = s->radius;
        extent = 2 * vec3_max_abs(s->centre) + radius;
    } else if (shape == PACKET_BOX) {
        const struct box *s = l->shape;
        extent = fmax(vec3_max_abs(s->min), vec3_max_abs(s->max));
    } else if (shape == PACKET_CYLINDER) {
        const struct cylinder *s = l->shape;
        radius = s->radius;
        extent = vec3_max_abs(s->frame.origin) + s->length + radius;
    } else if (shape == PACKET_PLANE) {
        extent = vec3_max_abs(((const struct plane *)l->shape)->point);
    }
    x->extent[space] = fmax(x->extent[space], extent);
    x->least = fmin(x->least, radius);
}

// The space of leaf i of the object, as in product_part; more than PRODUCT_SPACES: it is one
// too many.
static uint32_t space_of(const struct world *w, const struct world_object *o, uint32_t i,
                         struct accel_product *x)
{
    const struct leaf *l = &w->leaf[o->first_leaf + i];
    if (l->transform->identity)
        return 0;
    for (uint32_t k = 0; k < x->spaces; k++)
        if (w->leaf[o->first_leaf + x->space[k]].transform == l->transform)
            return k + 1;
    if (x->spaces < PRODUCT_SPACES)
        x->space[x->spaces] = (uint16_t)i;
    return ++x->spaces;
}

static struct product_part part_of(const struct leaf *l, uint32_t i, uint8_t shape,
                                   uint32_t space)
{
    struct product_part part = {.at = 2. * i,
                                .shape = l->shape,
                                .leaf = (uint16_t)i,
                                .kind = shape,
                                .space = (uint8_t)space};
    if (shape == PACKET_SPHERE) {
        const struct sphere *s = l->shape;
        part.centre = s->centre;
        part.radius = s->radius;
    }
    return part;
}

// The order of parts.
enum { WORLD_SOLIDS, MOVED_SOLIDS, PLANES, COMPLEMENTS, GROUPS };

static uint32_t group_of(const struct leaf *l, unsigned shape, uint32_t space)
{
    if (l->inverted)
        return COMPLEMENTS;
    if (shape == PACKET_PLANE)
        return PLANES;
    return space ? MOVED_SOLIDS : WORLD_SOLIDS;
}

static struct accel_product product_of(struct arena *a, const struct world *w,
                                       const struct accel *accel,
                                       const struct world_object *o)
{
    struct accel_product x = {.least = INFINITY, .count = (uint16_t)o->leaf_count};
    uint32_t space[PRODUCT_LEAVES], n = 0;
    for (uint32_t i = 0; i < o->leaf_count; i++) {
        space[i] = space_of(w, o, i, &x);
        if (space[i] > PRODUCT_SPACES)
            return (struct accel_product){.part = NULL};
        leaf_adds(&w->leaf[o->first_leaf + i], accel->leaf_shape[o->first_leaf + i],
                  space[i], &x);
    }
    struct product_part *part = arena_new_array(a, struct product_part, o->leaf_count);
    for (uint32_t group = 0; group < GROUPS; group++) {
        for (uint32_t i = 0; i < o->leaf_count; i++) {
            const struct leaf *l = &w->leaf[o->first_leaf + i];
            const uint8_t shape = accel->leaf_shape[o->first_leaf + i];
            if (group_of(l, shape, space[i]) == group)
                part[n++] = part_of(l, i, shape, space[i]);
        }
        if (group == WORLD_SOLIDS)
            x.world_solids = (uint16_t)n;
        if (group == PLANES)
            x.solids = (uint16_t)n;
    }
    x.part = part;
    return x;
}

static void list_products(struct arena *a, const struct world *w, struct accel *accel)
{
    for (uint32_t i = 0; i < w->object_count; i++) {
        if (accel->object_shape[i] != PACKET_PRODUCT)
            continue;
        if (!accel->product)
            accel->product = arena_new_array(a, struct accel_product, w->object_count);
        accel->product[i] = product_of(a, w, accel, &w->object[i]);
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
    classify(a, w, accel);
    list_products(a, w, accel);
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
