#ifndef TRACE_PACKET_LIST_H
#define TRACE_PACKET_LIST_H

// All crossings of eight rays with objects that packets know, on one walk of the tree.
#include "trace/packet_any.h"
#include "trace/packet_tree.h"

// Keeps a crossing in the order of t; of equal ones, that declared first is first.
static void list_put(struct crossings8 *c, int lane, double t, uint32_t leaf)
{
    uint32_t k = c->count[lane];
    double *const at = c->t[lane];
    if (k == CROSSINGS) {
        c->left |= 1u << lane;
        return;
    }
    c->count[lane]++;
    for (; k && (at[k - 1] > t || (at[k - 1] == t && c->leaf[lane][k - 1] > leaf)); k--) {
        at[k] = at[k - 1];
        c->leaf[lane][k] = c->leaf[lane][k - 1];
    }
    at[k] = t;
    c->leaf[lane][k] = leaf;
}

// An object's crossings one after the other: each ray goes on from the last. Lanes that
// the kernels hand to the one-ray form are left.
static void list_object(struct eight *e, unsigned bits, uint32_t object,
                        struct crossings8 *c)
{
    struct packet *p = e->p;
    const struct real8 t_min = e->t_min;
    while (bits) {
        r8_store(p->t, r8_set(INFINITY));
        u8_put(p->object, 255, UINT32_MAX);
        bits = try_eight(e, bits, object) & ~p->searching;
        e->t_min = r8_select(m8_of(bits), r8_load(p->t), e->t_min);
        for (unsigned m = bits; m; m &= m - 1) {
            const int i = __builtin_ctz(m);
            list_put(c, i, p->t[i], p->leaf[i]);
        }
    }
    e->t_min = t_min;
    c->left |= p->searching;
}

// Item i of the tree, as try_item.
static void list_item(struct eight *e, unsigned bits, uint32_t i, struct crossings8 *c)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    const uint32_t object = a->top.item[i];
    const struct sphere ball = {.centre =
                                    vec3(a->ball[0][i], a->ball[1][i], a->ball[2][i]),
                                .radius = a->ball[3][i]};
    if (!(ball.radius > 0)) {
        list_object(e, bits, object, c);
        return;
    }
    p->s->stats.leaf_tests++;
    bits = seeing(p, p->w->object[object].flags, bits);
    const struct span8 x = span8_sphere(&ball, &e->ray);
    bits &= m8_bits(x.met);
    if (!bits)
        return;
    const uint32_t leaf = p->w->object[object].first_leaf;
    double t[2][8];
    r8_store(t[0], x.in);
    r8_store(t[1], x.out);
    const unsigned in =
        bits & m8_bits(m8_and(r8_lt(e->t_min, x.in), r8_lt(x.in, e->t_max)));
    const unsigned out =
        bits & m8_bits(m8_and(r8_lt(e->t_min, x.out), r8_lt(x.out, e->t_max)));
    for (unsigned m = in | out; m; m &= m - 1) {
        const int k = __builtin_ctz(m);
        if (in >> k & 1)
            list_put(c, k, t[0][k], leaf);
        if (out >> k & 1)
            list_put(c, k, t[1][k], leaf);
    }
}

static void list_leaf(struct eight *e, unsigned bits, int32_t child, struct crossings8 *c)
{
    const uint32_t first = bvh8_leaf_first(child), n = bvh8_leaf_count(child);
    e->boxed = n == 1;
    for (uint32_t i = first; i < first + n; i++)
        list_item(e, bits, i, c);
    e->boxed = false;
}

// One lane on its own, below a child of the tree: its ray meets eight boxes at once.
static void list_alone(struct eight *e, int lane, int32_t child, struct crossings8 *c)
{
    const struct bvh8 *tree = &e->p->w->accel->top;
    const struct bvh8_ray r = tree_lane(&e->p->top, lane);
    const struct tree_ray8 v = tree_ray8_of(&r);
    struct bvh8_entry stack[BVH8_STACK];
    uint32_t depth = 0;
    stack[depth++] = (struct bvh8_entry){child, 0};
    while (depth) {
        const int32_t at = stack[--depth].child;
        if (at < 0) {
            list_leaf(e, 1u << lane, at, c);
            continue;
        }
        e->p->s->stats.node_visits++;
        depth = push_children(&tree->node[at], &r, &v, stack, depth);
    }
}

static void list_traverse(struct eight *e, unsigned lanes, struct crossings8 *c)
{
    enum { ALONE = 2 }; // lanes that go on one by one
    struct packet *p = e->p;
    const struct bvh8 *tree = &p->w->accel->top;
    struct tree8 v = tree8_of(&p->top, lanes);
    v.far = f8_load(p->top.t_far);
    const struct float8 far = f8_mul(v.far, f8_set(BVH8_SLACK));
    struct packet_entry stack[BVH8_STACK];
    uint32_t depth = 1, met_lanes = 0;
    f8_store(stack[0].near, f8_set(0));
    stack[0].child = 0;
    while (depth) {
        const struct packet_entry *top = &stack[--depth];
        const int32_t child = top->child;
        unsigned bits = f8_le(f8_load(top->near), far) & lanes;
        if (child >= 0 && __builtin_popcount(bits) <= ALONE) {
            for (; bits; bits &= bits - 1)
                list_alone(e, __builtin_ctz(bits), child, c);
        } else if (child < 0) {
            list_leaf(e, bits, child, c);
        } else {
            p->s->stats.node_visits++;
            depth =
                push_children8(&tree->node[child], &v, stack, depth, false, &met_lanes);
        }
    }
}

// p->alive says which rays.
static void list_all(struct eight *e, struct crossings8 *c)
{
    struct packet *p = e->p;
    const struct accel *a = p->w->accel;
    for (uint32_t i = 0; i < a->infinite_count; i++)
        list_object(e, p->alive, a->infinite[i], c);
    if (!a->top.node)
        return;
    if (a->few) {
        for (uint32_t i = 0; i < a->top.item_count; i++)
            list_item(e, p->alive, i, c);
        return;
    }
    const unsigned lanes = tree_begin(&a->top, e->ray.o, e->ray.d, e->inverse, e->t_min,
                                      e->t_max, p->alive, &p->top);
    if (lanes)
        list_traverse(e, lanes, c);
}

#endif
