#ifndef TRACE_PACKET_OBJECTS_H
#define TRACE_PACKET_OBJECTS_H

// Eight rays and one object.
#include <string.h>

#include "trace/packet.h"
#include "trace/packet_cross.h"
#include "trace/packet_product.h"
#include "trace/packet_torus.h"

struct eight {
    struct packet *p;
    struct ray8 ray;
    struct vec8 inverse; // 1 / d; infinite along a plane
    struct real8 t_min, t_max;
    struct shear8 shear; // for triangles, if `sheared`
    bool sheared;
    bool boxed; // the object's box alone has just been met, in the tree
};

// Lanes of `bits` that may see an object of these flags.
LANES_INLINE unsigned seeing(const struct packet *p, unsigned flags, unsigned bits)
{
    if (!(flags & p->hidden_any))
        return bits;
    for (unsigned m = bits; m; m &= m - 1) {
        const int lane = __builtin_ctz(m);
        if (flags & p->rays->hidden_by[p->first + (uint32_t)lane])
            bits &= ~(1u << lane);
    }
    return bits;
}

// Takes t where it is wanted and nearer (of equal ones the object declared first); the leaf is
// to be set.
LANES_INLINE unsigned take_nearer(struct eight *e, unsigned bits, struct real8 t,
                                  uint32_t object)
{
    struct packet *p = e->p;
    const struct real8 best = r8_load(p->t);
    bits &= m8_bits(m8_and(r8_lt(e->t_min, t), r8_lt(t, e->t_max)));
    const unsigned nearer = bits & m8_bits(r8_lt(t, best));
    unsigned won = nearer;
    for (unsigned m = bits & m8_bits(r8_eq(t, best)); m; m &= m - 1)
        if (object < p->object[__builtin_ctz(m)])
            won |= m & -m;
    if (!won)
        return 0;
    p->whole &= ~won;
    r8_store(p->t, r8_select(m8_of(won), t, best));
    u8_put(p->object, won, object);
    return won;
}

LANES_INLINE unsigned take(struct eight *e, unsigned bits, struct real8 t,
                           uint32_t object, uint32_t leaf)
{
    const unsigned won = take_nearer(e, bits, t, object);
    if (won)
        u8_put(e->p->leaf, won, leaf);
    return won;
}

LANES_INLINE struct real8 transformed(struct vec8 v, const struct mat3 *m, int j)
{
    return r8_add(
        r8_add(r8_mul(v.x, r8_set(m->m[0][j])), r8_mul(v.y, r8_set(m->m[1][j]))),
        r8_mul(v.z, r8_set(m->m[2][j])));
}

// The rays in the space before a transform, as transform_inverse_ray.
static struct ray8 local_ray(const struct transform *t, const struct ray8 *ray)
{
    const struct mat3 *m = &t->inverse;
    const struct vec8 o = v8_sub(ray->o, V8_SET(t->offset));
    return ray8_of(
        (struct vec8){transformed(o, m, 0), transformed(o, m, 1), transformed(o, m, 2)},
        (struct vec8){transformed(ray->d, m, 0), transformed(ray->d, m, 1),
                      transformed(ray->d, m, 2)});
}

// The rays as a leaf's shape sees them.
LANES_INLINE const struct ray8 *leaf_ray(const struct leaf *l, const struct ray8 *ray,
                                         struct ray8 *own)
{
    if (l->transform->identity)
        return ray;
    *own = local_ray(l->transform, ray);
    return own;
}

static struct cross8 cross8_triangle(struct eight *e, const struct triangle *s,
                                     const struct ray8 *ray)
{
    if (s->degenerate)
        return cross8_none();
    if (ray != &e->ray) {
        const struct shear8 shear = shear8_of(ray);
        return cross8_corners(s->p, &shear, ray->o_max);
    }
    if (!e->sheared) {
        e->shear = shear8_of(ray);
        e->sheared = true;
    }
    return cross8_corners(s->p, &e->shear, ray->o_max);
}

// All that the eight lines, in the leaf's space, have in common with it, or the first two
// crossings behind t_min.
static struct cross8 leaf_cross(struct eight *e, uint32_t leaf, const struct ray8 *ray)
{
    const struct leaf *l = &e->p->w->leaf[leaf];
    switch ((enum packet_shape)e->p->w->accel->leaf_shape[leaf]) {
    case PACKET_SPHERE: return cross8_sphere(l->shape, ray);
    case PACKET_BOX: return cross8_box(l->shape, ray);
    case PACKET_PLANE: return cross8_plane(l->shape, ray);
    case PACKET_CYLINDER:
    case PACKET_OPEN_CYLINDER: return cross8_cylinder(l->shape, ray);
    case PACKET_CONE:
    case PACKET_OPEN_CONE: return cross8_cone(l->shape, ray);
    case PACKET_DISC: return cross8_disc(l->shape, ray);
    case PACKET_QUADRIC: return cross8_quadric(l->shape, ray);
    case PACKET_TORUS: return cross8_torus(l->shape, ray, e->t_min);
    case PACKET_TRIANGLE: return cross8_triangle(e, l->shape, ray);
    default: return cross8_none();
    }
}

// All lanes or none.
LANES_INLINE unsigned lanes_if(bool all) { return all ? 255 : 0; }

// Keeps the boundaries of `won` in full: those of `first` in x->t[0], else in x->t[1].
// inverted: lanes whose leaf is a complement.
LANES_INLINE void keep(struct packet *p, const struct cross8 *x, struct mask8 first,
                       unsigned won, unsigned inverted)
{
    const struct mask8 m = m8_of(won);
    r8_store(p->dt, r8_select(m, r8_select(first, x->dt[0], x->dt[1]), r8_load(p->dt)));
    r8_store(p->part,
             r8_select(m, r8_select(first, x->part[0], x->part[1]), r8_load(p->part)));
    r8_store(p->u, r8_select(m, x->u, r8_load(p->u)));
    r8_store(p->v, r8_select(m, x->v, r8_load(p->v)));
    p->whole |= won;
    const unsigned leaves = (m8_bits(x->enters) ^ m8_bits(first)) ^ inverted;
    if (x->sheet)
        b8_put(p->crossing, won, 0, CROSS_TOUCH, CROSS_TOUCH);
    else
        b8_put(p->crossing, won, leaves, CROSS_ENTER, CROSS_EXIT);
}

static unsigned lone_cross(struct eight *e, unsigned bits, uint32_t object, uint32_t leaf,
                           const struct ray8 *ray)
{
    const struct cross8 x = leaf_cross(e, leaf, ray);
    const unsigned odd = bits & m8_bits(x.odd);
    const struct mask8 first = m8_and(x.drawn[0], r8_lt(e->t_min, x.t[0]));
    const unsigned met = bits & m8_bits(m8_and(x.met, m8_or(first, x.drawn[1])));
    const unsigned won =
        met ? take(e, met, r8_select(first, x.t[0], x.t[1]), object, leaf) : 0;
    if (won && e->p->mode == SWEEP_CLOSEST)
        keep(e->p, &x, first, won, lanes_if(e->p->w->leaf[leaf].inverted));
    return odd ? won | packet_try_object(e->p, odd, object) : won;
}

// A bare plane: most rays of most scenes meet one, or pass it by.
static unsigned plane8(struct eight *e, unsigned bits, uint32_t object)
{
    const uint32_t leaf = e->p->w->object[object].first_leaf;
    const struct leaf *l = &e->p->w->leaf[leaf];
    struct ray8 own;
    const struct ray8 *ray = leaf_ray(l, &e->ray, &own);
    const struct plane *s = l->shape;
    if (e->p->mode != SWEEP_CLOSEST) {
        // Rays that go away from it meet it behind them: no division tells that.
        const struct vec8 n = V8_SET(s->normal), to = v8_sub(V8_SET(s->point), ray->o);
        const struct real8 t = r8_mul(v8_dot(n, to), v8_dot(n, ray->d)), zero = r8_set(0);
        bits &= ~m8_bits(m8_and(r8_lt(t, zero), r8_le(zero, e->t_min)));
        if (!bits)
            return 0;
    }
    const struct cross8 x = cross8_plane(s, ray);
    const unsigned won = take(e, bits & m8_bits(x.met), x.t[0], object, leaf);
    if (won && e->p->mode == SWEEP_CLOSEST) // nothing is left to do for the boundary
        keep(e->p, &x, m8_of(255), won, lanes_if(l->inverted));
    return won;
}

static unsigned lone(struct eight *e, unsigned bits, uint32_t object)
{
    const struct world *w = e->p->w;
    const uint32_t leaf = w->object[object].first_leaf;
    const struct leaf *l = &w->leaf[leaf];
    struct ray8 own;
    const enum packet_shape shape = w->accel->leaf_shape[leaf];
    const struct ray8 *ray = leaf_ray(l, &e->ray, &own);
    struct span8 x;
    switch (shape) { // no error bound is computed
    case PACKET_SPHERE: x = span8_sphere(l->shape, ray); break;
    case PACKET_BOX: x = span8_box(l->shape, ray); break;
    case PACKET_CYLINDER: x = span8_cylinder(l->shape, ray); break;
    default: return lone_cross(e, bits, object, leaf, ray);
    }
    bits &= m8_bits(x.met);
    if (!bits)
        return 0;
    const struct real8 t = r8_select(r8_lt(e->t_min, x.in), x.in, x.out);
    return take(e, bits, t, object, leaf);
}

// The lanes that meet the box on t_min to `far`, as box_meets.
LANES_INLINE unsigned box_lanes_between(const struct eight *e, const struct aabb *b,
                                        struct real8 near, struct real8 far)
{
    const struct real8 grow = r8_set(1 + BOX_SLACK);
#pragma GCC unroll 3
    for (int a = 0; a < 3; a++) {
        const struct real8 o = a == 0 ? e->ray.o.x : a == 1 ? e->ray.o.y : e->ray.o.z;
        const struct real8 inv = a == 0   ? e->inverse.x
                                 : a == 1 ? e->inverse.y
                                          : e->inverse.z;
        const struct real8 t0 = r8_mul(r8_sub(r8_set(vec3_axis(b->min, a)), o), inv);
        const struct real8 t1 = r8_mul(r8_sub(r8_set(vec3_axis(b->max, a)), o), inv);
        const struct mask8 back = r8_lt(inv, r8_set(0));
        near = r8_max(r8_select(back, t1, t0), near); // NaN: the origin in a face
        far = r8_min(r8_mul(r8_select(back, t0, t1), grow), far);
    }
    return m8_bits(r8_le(near, far));
}

LANES_INLINE unsigned box_lanes_to(const struct eight *e, const struct aabb *b,
                                   struct real8 far)
{
    return box_lanes_between(e, b, e->t_min, far);
}

// The lanes that meet the box before their nearest hit, or with it.
LANES_INLINE unsigned box_lanes(const struct eight *e, const struct aabb *b)
{
    const struct real8 t = r8_load(e->p->t);
    const struct real8 far = r8_add(t, r8_mul(r8_abs(t), r8_set(BOX_SLACK)));
    return box_lanes_to(e, b, r8_min(e->t_max, far));
}

// The lines' spans in a convex shape, with their errors; odd: lanes for the sweep.
LANES_INLINE struct span8 shape_span(const struct leaf *l, enum packet_shape shape,
                                     const struct ray8 *ray, struct mask8 *odd)
{
    *odd = m8_of(0);
    switch (shape) {
    case PACKET_SPHERE: return span8_sphere(l->shape, ray);
    case PACKET_BOX: return span8_box(l->shape, ray);
    case PACKET_CYLINDER: return span8_cylinder(l->shape, ray);
    case PACKET_CONE: return span8_cone(l->shape, ray, odd);
    case PACKET_QUADRIC: return span8_quadric(l->shape, ray, odd);
    default: return span8_plane(l->shape, ray);
    }
}

// dt and no less than moved_error of trace/sweep.c; ends at infinity stay as they are. dt allows
// for a place that is off by GAMMA(8) of the origin's size and `extent`, which counts where
// moved_error asks for the slope: where the share of the origin's size alone is above 64.
LANES_INLINE struct real8 moved8_by(const struct leaf *l, const struct ray8 *ray,
                                    const struct ray8 *own, struct real8 extent,
                                    struct real8 t, struct real8 dt)
{
    const double unit = GAMMA(32) / GAMMA(8) * (1 + 0x1p-18) * l->stretch;
    const struct real8 size =
        r8_add(r8_add(ray->o_max, r8_set(2 * vec3_max_abs(l->transform->offset))),
               r8_mul(r8_abs(t), v8_max_abs(ray->d)));
    const struct real8 error = r8_mul(r8_set(unit), size),
                       o_max = r8_add(own->o_max, r8_set(0x1p-900)),
                       most = r8_div(error, o_max);
    const struct real8 share =
        r8_select(r8_le(most, r8_set(65)), most, r8_div(error, r8_add(o_max, extent)));
    const struct mask8 finite = r8_lt(r8_abs(t), r8_set(INFINITY));
    return r8_select(finite, r8_add(dt, r8_mul(dt, share)), dt);
}

LANES_INLINE struct real8 moved8(const struct leaf *l, const struct ray8 *ray,
                                 const struct ray8 *own, struct real8 t, struct real8 dt)
{
    return moved8_by(l, ray, own, r8_set(0), t, dt);
}

// The same of a torus.
static struct real8 torus_error(const struct leaf *l, const struct ray8 *ray,
                                const struct ray8 *own, struct real8 t, struct real8 dt)
{
    if (l->transform->identity)
        return dt;
    const struct torus *s = l->shape;
    const struct vec8 p = v8_mad(own->o, t, own->d), d = own->d;
    const struct real8 rho = r8_sqrt(r8_add(r8_mul(p.x, p.x), r8_mul(p.z, p.z)));
    const struct real8 w = r8_sub(rho, r8_set(s->major));
    const struct real8 radial =
        r8_div(r8_mul(w, r8_add(r8_mul(p.x, d.x), r8_mul(p.z, d.z))), rho);
    const struct real8 slope = r8_div(r8_abs(r8_add(radial, r8_mul(p.y, d.y))),
                                      r8_sqrt(r8_add(r8_mul(w, w), r8_mul(p.y, p.y))));
    const struct real8 size =
        r8_add(r8_add(ray->o_max, r8_set(2 * vec3_max_abs(l->transform->offset))),
               r8_mul(r8_abs(t), v8_max_abs(ray->d)));
    const double unit = GAMMA(32) * (1 + 0x1p-18) * l->stretch;
    return r8_add(dt, r8_div(r8_mul(r8_set(unit), size),
                             r8_max(slope, r8_mul(r8_set(GAMMA(12)), v8_max_abs(d)))));
}

// What dt allows for besides the origin's size, of shapes where that is known.
LANES_INLINE double own_extent(const struct leaf *l, enum packet_shape shape)
{
    if (shape == PACKET_SPHERE)
        return ((const struct sphere *)l->shape)->radius;
    if (shape == PACKET_PLANE)
        return vec3_max_abs(((const struct plane *)l->shape)->point);
    if (shape == PACKET_BOX) {
        const struct box *b = l->shape;
        return larger(vec3_max_abs(b->min), vec3_max_abs(b->max));
    }
    if (shape != PACKET_CYLINDER)
        return 0;
    const struct cylinder *c = l->shape;
    return vec3_max_abs(c->frame.origin) + c->length + c->radius;
}

// The same of a convex leaf, seen by the rays of its own space. Where a line hardly enters a
// round shape, dt is less than what the slope alone would give.
LANES_INLINE struct span8 leaf_span(const struct eight *e, const struct leaf *l,
                                    enum packet_shape shape, const struct ray8 *own,
                                    struct mask8 *odd)
{
    struct span8 x = shape_span(l, shape, own, odd);
    if (l->transform->identity)
        return x;
    const struct mask8 deep =
        r8_le(r8_mul(r8_set(2), r8_add(x.in_e, x.out_e)), r8_sub(x.out, x.in));
    const struct real8 extent = r8_select(deep, r8_set(own_extent(l, shape)), r8_set(0));
    x.in_e = moved8_by(l, &e->ray, own, extent, x.in, x.in_e);
    x.out_e = moved8_by(l, &e->ray, own, extent, x.out, x.out_e);
    return x;
}

// Takes a CSG object's crossings: 2 i for the entry of its leaf i, 2 i + 1 for its exit.
static unsigned take_leaves(struct eight *e, unsigned found, struct real8 t,
                            struct real8 at, uint32_t object)
{
    const unsigned won = found ? take_nearer(e, found, t, object) : 0;
    if (!won || e->p->mode != SWEEP_CLOSEST)
        return won;
    const uint32_t first_leaf = e->p->w->object[object].first_leaf;
    double which[8];
    r8_store(which, at);
    for (unsigned i = 0; i < 8; i++) { // at is -1 or more
        const uint32_t leaf = first_leaf + ((uint32_t)(int32_t)which[i] >> 1);
        e->p->leaf[i] = won >> i & 1 ? leaf : e->p->leaf[i];
    }
    return won;
}

// The spans of the drawn leaves that are complements, or of those that are not; returns the
// lanes that can still meet the object. merge: of what lies outside the object.
static unsigned exact_leaves(struct eight *e, struct product *x, bool complements,
                             bool merge, const struct world_object *o, unsigned bits)
{
    const struct world *w = e->p->w;
    for (uint32_t i = 0; i < o->leaf_count && bits; i++) {
        const struct leaf *l = &w->leaf[o->first_leaf + i];
        if ((l->inverted != merge) != complements || !l->drawn)
            continue;
        const enum packet_shape shape = w->accel->leaf_shape[o->first_leaf + i];
        struct mask8 odd;
        struct ray8 own;
        const struct span8 s = leaf_span(e, l, shape, leaf_ray(l, &e->ray, &own), &odd);
        x->unsure = m8_or(x->unsure, odd);
        bits &= product_add(x, i, complements, shape != PACKET_PLANE, &s);
    }
    return bits;
}

// ---- hits -----------------------------------------------------------------------------------

// Lanes whose t is one of the crossings become whole; not those whose hit is of another
// making.
LANES_INLINE void complete(struct packet *p, const struct cross8 *x, unsigned lanes,
                           unsigned inverted)
{
    const struct real8 t = r8_load(p->t);
    const struct mask8 first = m8_and(x->drawn[0], r8_eq(t, x->t[0]));
    const struct mask8 second = m8_and(x->drawn[1], r8_eq(t, x->t[1]));
    const unsigned met = lanes & m8_bits(m8_and(x->met, m8_or(first, second)));
    keep(p, x, first, met, inverted);
}

// Spheres, in each lane another. Returns the lanes that hit something else.
static unsigned complete_balls(struct eight *e, unsigned lanes)
{
    static const double none[4];
    struct packet *p = e->p;
    const double *ball[8] = {none, none, none, none, none, none, none, none};
    unsigned balls = 0, inverted = 0;
    for (unsigned m = lanes; m; m &= m - 1) {
        const int lane = __builtin_ctz(m);
        const struct leaf *l = &p->w->leaf[p->leaf[lane]];
        if (l->ops != &sphere_ops || !l->transform->identity)
            continue;
        ball[lane] = &((const struct sphere *)l->shape)->centre.x;
        balls |= m & -m;
        inverted |= l->inverted ? m & -m : 0;
    }
    if (!(balls & (balls - 1)))
        return lanes;
    struct real8 s[4];
    r8_load_rows(ball, 0, s);
    const struct cross8 c = cross8_ball((struct vec8){s[0], s[1], s[2]}, s[3], &e->ray);
    complete(p, &c, balls, inverted);
    return lanes & ~balls;
}

// Those of `lanes`, which are some, that hit the leaf that the first of them hits.
LANES_INLINE unsigned lanes_alike(const struct packet *p, unsigned lanes)
{
    const uint32_t leaf = p->leaf[__builtin_ctz(lanes)];
    unsigned alike = 0;
    for (unsigned i = 0; i < 8; i++)
        alike |= (unsigned)(p->leaf[i] == leaf) << i;
    return lanes & alike;
}

// The simplest shapes' kernels find t and the leaf only. What most rays of a packet hit is
// one leaf, whose boundaries are made for all at once.
static void complete_all(struct eight *e, unsigned lanes)
{
    struct packet *p = e->p;
    if (lanes && lanes_alike(p, lanes) != lanes)
        lanes = complete_balls(e, lanes);
    while (lanes) {
        const uint32_t leaf = p->leaf[__builtin_ctz(lanes)];
        const unsigned same = lanes_alike(p, lanes);
        const struct leaf *l = &p->w->leaf[leaf];
        struct ray8 own;
        const struct cross8 x = leaf_cross(e, leaf, leaf_ray(l, &e->ray, &own));
        complete(p, &x, same, lanes_if(l->inverted));
        lanes &= ~same;
    }
}

// The boundary of a lane that the one-ray form has found.
static void hit_alone(struct packet *p, int lane, const struct hit_batch *out)
{
    const uint32_t i = p->first + (uint32_t)lane;
    const struct boundary b =
        packet_lane_known(p, lane) ? p->search[lane].b : packet_lane_hit(p, lane);
    hit_batch_put(out, i, &b);
}

static void hits(struct eight *e, const struct hit_batch *out)
{
    struct packet *p = e->p;
    const uint32_t first = p->first;
    const struct real8 t = r8_load(p->t);
    const unsigned met = p->alive & m8_bits(r8_lt(t, r8_set(INFINITY)));
    unsigned alone = 0;
    r8_store(out->t + first, t);
    if (!met)
        return;
    for (unsigned m = met & p->searching; m; m &= m - 1) {
        const int lane = __builtin_ctz(m);
        if (packet_lane_known(p, lane))
            alone |= m & -m;
        else if (!(p->whole >> lane & 1) && !p->w->object[p->object[lane]].is_csg)
            p->leaf[lane] = p->w->object[p->object[lane]].first_leaf;
    }
    complete_all(e, met & ~alone & ~p->whole);
    r8_store(out->dt + first, r8_load(p->dt));
    r8_store(out->part + first, r8_load(p->part));
    r8_store(out->u + first, r8_load(p->u));
    r8_store(out->v + first, r8_load(p->v));
    memcpy(out->leaf + first, p->leaf, sizeof p->leaf);
    memcpy(out->crossing + first, p->crossing, sizeof p->crossing);
    alone |= met & ~p->whole;
    for (unsigned m = alone; m; m &= m - 1)
        hit_alone(p, __builtin_ctz(m), out);
}

#endif
