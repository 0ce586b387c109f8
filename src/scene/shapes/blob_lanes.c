// Eight rays and a blob, compiled once per instruction set: the components are met side by
// side, by the operations of blob_walk.c; then each ray goes on with the few that it meets in
// its range, and the quartics of all are solved together.
#include <math.h>

#include "math/polynomial_lanes.h"
#include "scene/shapes/blob.h"
#include "scene/shapes/lanes.h"

// Components that a ray may meet; a ray with more goes alone.
enum { MET = 64 };

struct lines {
    struct vec8 o, d; // |d| = 1
    struct real8 shift, length, noise, start, stop;
    struct real8 sum; // of peaks: the field is never above
    uint32_t count[8];
    struct blob_stretch at[8][MET];
};

// The part of the axis of a cylinder's piece; returns the lanes that are in it somewhere.
LANES_INLINE unsigned clip(const struct blob_component *c, struct real8 along,
                           struct real8 slope, struct real8 *lo, struct real8 *hi)
{
    const struct real8 low = r8_set(c->kind == PART_BASE       ? -HUGE_VAL
                                    : c->kind == PART_STRAIGHT ? 0
                                                               : c->length);
    const struct real8 high = r8_set(c->kind == PART_BASE       ? 0
                                     : c->kind == PART_STRAIGHT ? c->length
                                                                : HUGE_VAL);
    const struct mask8 across = r8_eq(slope, r8_set(0));
    const struct real8 t0 = r8_div(r8_sub(low, along), slope);
    const struct real8 t1 = r8_div(r8_sub(high, along), slope);
    *lo = r8_select(across, *lo, r8_max(*lo, r8_min(t0, t1)));
    *hi = r8_select(across, *hi, r8_min(*hi, r8_max(t0, t1)));
    const unsigned beside =
        m8_bits(m8_without(across, m8_and(r8_le(low, along), r8_lt(along, high))));
    return m8_bits(r8_lt(*lo, *hi)) & ~beside;
}

// Of `lanes`: those that may come within a component's reach.
LANES_INLINE unsigned near_lanes(const struct lines *x, const struct blob_reach *r,
                                 unsigned lanes)
{
    static const double surely = 1 - 0x1p-40; // far more than rounding
    const struct vec8 v = v8_sub(V8_SET(r->c), x->o);
    const struct real8 along = v8_dot(v, x->d),
                       beyond =
                           r8_sub(r8_mul(r8_set(surely), v8_dot(v, v)), r8_set(r->r2));
    return lanes & ~m8_bits(r8_lt(r8_mul(along, along), beyond));
}

// Component i, as stretch_of of blob_walk.c.
static void add_component(struct lines *x, const struct blob *s, uint32_t i,
                          unsigned lanes)
{
    const struct blob_component *c = &s->at[i];
    struct vec8 o = x->o, d = x->d;
    lanes = near_lanes(x, &s->reach[i], lanes);
    if (!lanes)
        return;
    const struct vec8 axis = V8_SET(c->axis);
    if (!c->transform.identity) {
        o = v8_inverse_point(&c->transform, o);
        d = v8_row_times(d, &c->transform.inverse);
    }
    struct vec8 v = v8_sub(o, V8_SET(c->c));
    struct real8 along = r8_set(0), slope = along;
    if (c->kind != PART_BALL) {
        along = v8_dot(v, axis);
        slope = v8_dot(d, axis);
    }
    if (c->kind == PART_STRAIGHT) {
        v = v8_mad(v, r8_neg(along), axis);
        d = v8_mad(d, r8_neg(slope), axis);
    } else if (c->kind == PART_APEX) {
        v = v8_mad(v, r8_set(-c->length), axis);
    }
    const double r2 = c->r * c->r;
    const struct real8 zero = r8_set(0), a = v8_dot(d, d), b = v8_dot(v, d);
    const struct real8 at = r8_select(r8_lt(zero, a), r8_div(r8_neg(b), a), zero);
    const struct vec8 near = v8_mad(v, at, d);
    const struct real8 rest = r8_sub(r8_set(r2), v8_dot(near, near));
    lanes &= m8_bits(r8_lt(zero, rest));
    if (!lanes)
        return;
    const struct real8 reach = r8_sqrt(r8_div(rest, a));
    struct real8 lo = r8_sub(at, reach), hi = r8_add(at, reach);
    if (c->kind != PART_BALL)
        lanes &= clip(c, along, slope, &lo, &hi);
    lanes &= m8_bits(m8_and(r8_le(x->start, hi), r8_le(lo, x->stop)));
    if (!lanes)
        return;
    const struct real8 top = r8_div(rest, r8_set(r2));
    const struct real8 peak = c->s > 0 ? r8_mul(r8_mul(r8_set(c->s), top), top) : zero;
    x->sum = r8_add(x->sum, r8_select(m8_of(lanes), peak, zero));
    double each[6][8];
    const struct real8 of[6] = {lo, hi, top, at, r8_div(r8_neg(a), r8_set(r2)), peak};
    for (int k = 0; k < 6; k++)
        r8_store(each[k], of[k]);
    for (; lanes; lanes &= lanes - 1) {
        const int l = __builtin_ctz(lanes);
        const uint32_t k = x->count[l]++;
        if (k < MET)
            x->at[l][k] =
                (struct blob_stretch){each[0][l], each[1][l], c->s,      each[2][l],
                                      each[3][l], each[4][l], each[5][l]};
    }
}

// The children of a node whose boxes lines pass through in their ranges: which lines.
static void meet_boxes(const struct lines *x, const struct bvh8 *tree,
                       const struct bvh8_node *n, unsigned lanes, unsigned met[8])
{
    const struct vec8 o = v8_sub(x->o, V8_SET(tree->origin));
    for (int k = 0; k < 8; k++) {
        struct real8 lo = x->start, hi = x->stop;
        met[k] = 0;
        if (n->child[k] == BVH8_EMPTY)
            continue;
        lanes_slab(o.x, x->d.x, (double)n->box[0][k], (double)n->box[3][k], &lo, &hi);
        lanes_slab(o.y, x->d.y, (double)n->box[1][k], (double)n->box[4][k], &lo, &hi);
        lanes_slab(o.z, x->d.z, (double)n->box[2][k], (double)n->box[5][k], &lo, &hi);
        met[k] = lanes & m8_bits(r8_le(lo, hi));
    }
}

// A lane looks at what its own line is near, whatever the others do.
static void walk_tree(struct lines *x, const struct blob *b, unsigned lanes)
{
    struct {
        int32_t child;
        unsigned lanes;
    } stack[BVH8_STACK];
    uint32_t depth = 1;
    stack[0].child = 0;
    stack[0].lanes = lanes;
    while (depth) {
        const int32_t child = stack[--depth].child;
        unsigned here = stack[depth].lanes, met[8];
        if (child < 0) {
            const uint32_t first = bvh8_leaf_first(child);
            for (uint32_t k = first; k < first + bvh8_leaf_count(child); k++)
                add_component(x, b, b->tree.item[k], here);
            continue;
        }
        const struct bvh8_node *n = &b->tree.node[child];
        meet_boxes(x, &b->tree, n, here, met);
        for (int k = 0; k < 8; k++)
            if (met[k]) {
                stack[depth].child = n->child[k];
                stack[depth++].lanes = met[k];
            }
    }
}

static void set_up(struct lines *x, const struct blob *b, const struct shape_rays *rays)
{
    const struct vec8 o = v8_load(rays->o), d = v8_load(rays->d);
    const struct vec3 first = transform_point(&b->at[0].transform, b->at[0].c);
    x->length = r8_sqrt(v8_dot(d, d));
    const struct real8 scale = r8_div(r8_set(1), x->length);
    x->d = (struct vec8){r8_mul(scale, d.x), r8_mul(scale, d.y), r8_mul(scale, d.z)};
    x->shift = v8_dot(v8_sub(V8_SET(first), o), x->d);
    x->noise = r8_mul(
        r8_set(GAMMA(8)),
        r8_add(r8_add(r8_abs(x->shift), r8_set(vec3_max_abs(first))), v8_max_abs(o)));
    x->o = v8_mad(o, x->shift, x->d);
    x->start = r8_sub(r8_mul(r8_load(rays->t_min), x->length), x->shift);
    x->stop = r8_sub(r8_mul(r8_load(rays->t_max), x->length), x->shift);
    x->sum = r8_set(0);
    for (int i = 0; i < 8; i++)
        x->count[i] = 0;
}

// The walks of eight rays, and where each is.
struct walks {
    struct blob_walk walk[8];
    struct blob_piece piece[8];
    struct boundary first[8];
    double end[8][2 * MET];
};

// Takes `lanes` over their pieces.
static void walk_over8(struct walks *x, unsigned lanes)
{
    enum { N = 4 };
    double c[N + 1][8] = {{0}}, lo[8] = {0}, hi[8] = {0}, sign[8] = {0},
                 rounding[8] = {0}, lost[8] = {0}, t[8], dt[8];
    struct real8 c8[N + 1];
    for (unsigned left = lanes; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const struct blob_walk *w = &x->walk[i];
        const struct blob_piece *p = &x->piece[i];
        for (int k = 0; k <= N; k++)
            c[k][i] = p->c[k];
        const bool whole = w->start <= p->m - p->half;
        lo[i] = whole ? -p->half : w->start - p->m;
        hi[i] = p->half;
        sign[i] = whole && w->known ? w->in ? 1 : -1 : 0;
        rounding[i] = p->rounding * ROUNDOFF;
        lost[i] = p->lost;
    }
    for (int k = 0; k <= N; k++)
        c8[k] = r8_load(c[k]);
    const struct brackets8 r = poly8_isolate(c8, N, r8_load(lo), r8_load(hi),
                                             r8_load(sign), lanes, 0, false, NULL);
    if (r.found) {
        const struct real8 root = poly8_refine(c8, N, &r, r.found);
        const struct real8 error =
            r8_add(r8_mul(r8_load(rounding), poly8_size(c8, N, root)), r8_load(lost));
        r8_store(t, root);
        r8_store(dt, poly8_root_error(c8, N, root, error));
    }
    r8_store(sign, r.sign);
    for (unsigned left = lanes; left; left &= left - 1) {
        const int i = __builtin_ctz(left);
        const struct blob_line *l = &x->walk[i].line;
        if (r.found >> i & 1 && dt[i] < INFINITY &&
            (x->piece[i].m + t[i] + l->shift) / l->length > l->t_min)
            blob_walk_to(&x->walk[i], &x->piece[i], sign[i] > 0, t[i], dt[i]);
        else if ((r.found | r.unsure) >> i & 1)
            blob_walk_over(&x->walk[i], &x->piece[i]);
        else
            blob_walk_past(&x->walk[i], sign[i] > 0);
    }
}

unsigned OF_ISA(blob_closest8_)(const struct blob *s, const struct shape_rays *rays,
                                unsigned lanes, struct shape_hits *out, unsigned *odd)
{
    struct lines x;
    struct walks w;
    double shift[8], length[8], noise[8];
    *odd = 0;
    set_up(&x, s, rays);
    if (s->tree.node)
        walk_tree(&x, s, lanes);
    else
        for (uint32_t i = 0; i < s->count; i++)
            add_component(&x, s, i, lanes);
    for (int i = 0; i < 8; i++)
        *odd |= x.count[i] > MET ? lanes & 1u << i : 0;
    lanes &= ~*odd;
    lanes &= m8_bits(r8_le(r8_set(s->threshold * (1 - 0x1p-30)), x.sum));
    if (!lanes)
        return 0;
    r8_store(shift, x.shift);
    r8_store(length, x.length);
    r8_store(noise, x.noise);
    for (unsigned left = lanes; left; left &= left - 1) {
        const int l = __builtin_ctz(left);
        const struct blob_line line = {rays->t_min[l], rays->t_max[l], shift[l],
                                       length[l], noise[l]};
        blob_walk_begin(&w.walk[l], s, &line, x.at[l], x.count[l], w.end[l], &w.first[l]);
    }
    for (unsigned on = lanes; on;) {
        for (unsigned left = on; left; left &= left - 1) {
            const int l = __builtin_ctz(left);
            if (!blob_walk_next(&w.walk[l], &w.piece[l]))
                on &= ~(1u << l);
        }
        if (on)
            walk_over8(&w, on);
    }
    unsigned met = 0;
    for (; lanes; lanes &= lanes - 1) {
        const int l = __builtin_ctz(lanes);
        if (!w.walk[l].found || !(w.first[l].t <= rays->t_max[l]))
            continue;
        shape_hits_put(out, l, &w.first[l]);
        met |= 1u << l;
    }
    return met;
}
