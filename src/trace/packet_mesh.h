#ifndef TRACE_PACKET_MESH_H
#define TRACE_PACKET_MESH_H

// Eight rays and a mesh that stands alone, as mesh_closest: of equal hits the first face.
#include "scene/shapes/mesh.h"
#include "trace/packet_objects.h"
#include "trace/packet_tree.h"

enum {
    MESH_FEW = 2,  // lanes that go on from a node one by one
    MESH_SMALL = 2 // faces that are tried without a way through the tree
};

struct mesh8 {
    const struct mesh *m;
    const struct eight *e;
    struct shear8 shear;
    struct real8 o_max;
    struct tree_lanes at;
    double t[8], dt[8], u[8], v[8];
    uint32_t face[8]; // UINT32_MAX: nothing nearer than t yet
    unsigned found;
};

static void mesh8_found(struct mesh8 *v, unsigned lanes, uint32_t face)
{
    v->found |= lanes;
    for (unsigned m = lanes; m; m &= m - 1)
        v->face[__builtin_ctz(m)] = face;
    tree_limit(&v->at, lanes, v->t, v->e->p->mode == SWEEP_OPAQUE);
}

static void mesh8_face(struct mesh8 *v, unsigned lanes, uint32_t face)
{
    struct vec3 p[3];
    mesh_corners(v->m, face, p);
    const struct cross8 x = cross8_corners(p, &v->shear, v->o_max);
    lanes &= m8_bits(x.met);
    if (!lanes)
        return;
    const struct real8 best = r8_load(v->t), t = x.t[0];
    lanes &= m8_bits(m8_and(r8_lt(v->e->t_min, t), r8_lt(t, v->e->t_max)));
    unsigned nearer = lanes & m8_bits(r8_lt(t, best));
    for (unsigned m = lanes & m8_bits(r8_eq(t, best)); m; m &= m - 1)
        if (face < v->face[__builtin_ctz(m)])
            nearer |= m & -m;
    if (!nearer)
        return;
    const struct mask8 in = m8_of(nearer);
    r8_store(v->t, r8_select(in, t, best));
    r8_store(v->dt, r8_select(in, x.dt[0], r8_load(v->dt)));
    r8_store(v->u, r8_select(in, x.u, r8_load(v->u)));
    r8_store(v->v, r8_select(in, x.v, r8_load(v->v)));
    mesh8_found(v, nearer, face);
}

// One ray's way on from a node of the tree. Its faces are tested as those of a packet: that
// costs no more than one triangle_meet, which the ray would have to be made ready for.
static void mesh8_lane(struct mesh8 *v, int lane, int32_t child)
{
    const struct bvh8 *tree = &v->m->tree;
    struct bvh8_ray r = tree_lane(&v->at, lane);
    const struct tree_ray8 way = tree_ray8_of(&r);
    struct bvh8_entry stack[BVH8_STACK];
    uint32_t depth = 1;
    stack[0] = (struct bvh8_entry){child, 0};
    while (depth) {
        const struct bvh8_entry at = stack[--depth];
        if (at.t > r.t_far * BVH8_SLACK)
            continue;
        if (at.child >= 0) {
            depth = push_children(&tree->node[at.child], &r, &way, stack, depth);
            continue;
        }
        const uint32_t first = bvh8_leaf_first(at.child), n = bvh8_leaf_count(at.child);
        for (uint32_t i = first; i < first + n; i++)
            mesh8_face(v, 1u << lane, tree->item[i]);
        r.t_far = v->at.t_far[lane];
    }
}

static void mesh8_traverse(struct mesh8 *v, unsigned lanes)
{
    const struct bvh8 *tree = &v->m->tree;
    if (v->m->face_count <= MESH_SMALL) {
        for (uint32_t i = 0; i < v->m->face_count; i++)
            mesh8_face(v, lanes, i);
        return;
    }
    struct tree8 way = tree8_of(&v->at, lanes);
    const bool any = v->e->p->mode == SWEEP_OPAQUE;
    struct packet_entry stack[BVH8_STACK];
    uint32_t depth = 1, met = 0;
    f8_store(stack[0].near, f8_set(0));
    stack[0].child = 0;
    while (depth) {
        const struct packet_entry *top = &stack[--depth];
        const int32_t child = top->child;
        way.far = f8_load(v->at.t_far);
        unsigned bits = f8_le(f8_load(top->near), f8_mul(way.far, f8_set(BVH8_SLACK)));
        if (!bits)
            continue;
        if (child >= 0 && __builtin_popcount(bits) <= MESH_FEW) {
            for (; bits; bits &= bits - 1)
                mesh8_lane(v, __builtin_ctz(bits), child);
            continue;
        }
        if (child >= 0) {
            v->e->p->s->stats.node_visits++;
            depth = push_children8(&tree->node[child], &way, stack, depth, any, &met);
            continue;
        }
        const uint32_t first = bvh8_leaf_first(child), n = bvh8_leaf_count(child);
        for (uint32_t i = first; i < first + n; i++)
            mesh8_face(v, bits, tree->item[i]);
        if (any && !(lanes & ~v->found))
            return;
    }
}

static unsigned mesh8(struct eight *e, unsigned bits, uint32_t object)
{
    struct packet *p = e->p;
    const uint32_t leaf = p->w->object[object].first_leaf;
    const struct leaf *l = &p->w->leaf[leaf];
    struct ray8 own;
    const struct ray8 *ray = leaf_ray(l, &e->ray, &own);
    struct mesh8 v;
    v.m = l->shape;
    v.e = e;
    v.o_max = ray->o_max;
    v.found = 0;
    if (!v.m->tree.node)
        return 0;
    const struct real8 one = r8_set(1);
    const struct vec8 inverse = {r8_div(one, ray->d.x), r8_div(one, ray->d.y),
                                 r8_div(one, ray->d.z)};
    bits = tree_begin(&v.m->tree, ray->o, ray->d, inverse, e->t_min,
                      r8_min(e->t_max, r8_load(p->t)), bits, &v.at);
    if (!bits)
        return 0;
    v.shear = shear8_of(ray);
    for (int i = 0; i < 8; i++) {
        v.t[i] = p->t[i];
        v.face[i] = UINT32_MAX;
    }
    mesh8_traverse(&v, bits);
    const unsigned won = v.found ? take(e, v.found, r8_load(v.t), object, leaf) : 0;
    p->whole |= won;
    for (unsigned m = won; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        p->dt[i] = v.dt[i];
        p->u[i] = v.u[i];
        p->v[i] = v.v[i];
        p->part[i] = v.face[i];
        p->crossing[i] = CROSS_TOUCH;
    }
    return won;
}

#endif
