// Which of the packets' kernels takes a leaf or an object.
#include "trace/accel.h"

#include "base/arena.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/isosurface_open.h"
#include "scene/shapes/revolve.h"
#include "scene/shapes/torus.h"
#include "trace/packet.h"
#include "trace/scratch.h"

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

// An intersection all of whose parts are drawn.
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

void accel_classify(struct arena *a, const struct world *w, struct accel *accel)
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
