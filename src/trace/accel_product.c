// The parts of products in the order in which quick tests want them (trace/packet_quick.h).
#include "trace/accel.h"

#include <math.h>

#include "base/arena.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"

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

void accel_list_products(struct arena *a, const struct world *w, struct accel *accel)
{
    for (uint32_t i = 0; i < w->object_count; i++) {
        if (accel->object_shape[i] != PACKET_PRODUCT)
            continue;
        if (!accel->product)
            accel->product = arena_new_array(a, struct accel_product, w->object_count);
        accel->product[i] = product_of(a, w, accel, &w->object[i]);
    }
}
