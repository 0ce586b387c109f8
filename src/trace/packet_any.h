#ifndef TRACE_PACKET_ANY_H
#define TRACE_PACKET_ANY_H

// Eight rays and one object, whatever it is: the kernel of its kind, or the one-ray form.
#include "trace/packet_bound.h"
#include "trace/packet_carve.h"
#include "trace/packet_clip.h"
#include "trace/packet_csg.h"
#include "trace/packet_mesh.h"
#include "trace/packet_parts.h"
#include "trace/packet_ring.h"
#include "trace/packet_sponge.h"

// An object that nothing hides from the rays.
LANES_INLINE unsigned try_shape(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    const enum packet_shape shape = a->object_shape[object];
    if (shape == PACKET_PRODUCT)
        return product(e, bits, object);
    if (shape == PACKET_CSG)
        return csg8(e, bits, object);
    if (shape == PACKET_MERGE)
        return merge8(e, bits, object);
    if (shape == PACKET_CLIPPED || shape == PACKET_CLIPPED_PRODUCT)
        return clipped(e, bits, object, shape == PACKET_CLIPPED_PRODUCT);
    if (shape == PACKET_RING)
        return ring_product(e, bits, object);
    if (shape == PACKET_MESH)
        return mesh8(e, bits, object);
    if (shape == PACKET_LANES)
        return lanes8(e, bits, object);
    if (shape == PACKET_CARVED)
        return carved8(e, bits, object);
    if (shape == PACKET_SPONGE)
        return accel_large(a, &p->w->object[object], object)->ball
                   ? sponge(e, bits, object)
                   : packet_try_object(p, bits, object);
    p->s->stats.leaf_tests++;
    if (shape == PACKET_PLANE)
        return plane8(e, bits, object);
    return lone(e, bits, object);
}

static unsigned try_eight(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    if (!a->plain[object]) {
        const struct world_object *o = &p->w->object[object];
        const enum packet_shape shape = a->object_shape[object];
        if (shape == PACKET_NONE)
            return packet_try_object(p, bits, object);
        bits = seeing(p, o->flags, bits);
        if (o->bound_count)
            bits = within_bounds(e, bits, o);
        if (!bits)
            return 0;
        const bool knows_mixed = shape == PACKET_CARVED || shape == PACKET_CSG;
        if (p->mode == SWEEP_OPAQUE && !o->opaque && (!o->mixed || !knows_mixed))
            return o->mixed ? packet_try_object(p, bits, object) : 0;
    }
    return try_shape(e, bits, object);
}

// Item i of the tree: a bare sphere stands in the tree's own list, so that most tests
// touch nothing else.
static unsigned try_item(struct eight *e, unsigned bits, uint32_t i)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    if (!(a->ball[3][i] > 0))
        return try_eight(e, bits, a->top.item[i]);
    const struct sphere ball = {.centre =
                                    vec3(a->ball[0][i], a->ball[1][i], a->ball[2][i]),
                                .radius = a->ball[3][i]};
    p->s->stats.leaf_tests++;
    const struct span8 x = span8_sphere(&ball, &e->ray);
    bits &= m8_bits(x.met);
    if (!bits)
        return 0;
    const uint32_t object = a->top.item[i];
    const struct world_object *o = &p->w->object[object];
    if ((a->lone_flags & p->hidden_any) || (p->mode == SWEEP_OPAQUE && !a->lone_opaque)) {
        bits = seeing(p, o->flags, bits);
        if (p->mode == SWEEP_OPAQUE && !o->opaque)
            return 0;
    }
    const struct real8 t = r8_select(r8_lt(e->t_min, x.in), x.in, x.out);
    return take(e, bits, t, object, o->first_leaf);
}

#endif
