#ifndef TRACE_SHADE_PLACE_H
#define TRACE_SHADE_PLACE_H

// Points and normals of eight hits: trace_interaction and the shapes' `surface`, in lanes
// where all eight hit the same leaf (or are bare spheres), with the same bits.

#include "math/gamma.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/sphere.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

struct place8 {
    struct vec8 p, ng, ns;
    struct real8 error;
    double uv[2][8]; // by place_each alone
};

LANES_INLINE void place_sphere(struct vec8 centre, struct real8 radius, struct place8 *x)
{
    x->ng = v8_normalize(v8_sub(x->p, centre));
    x->p = v8_mad(centre, radius, x->ng);
}

LANES_INLINE void place_plane(const struct plane *s, struct place8 *x)
{
    const struct vec8 n = V8_SET(s->normal);
    const struct real8 off = v8_dot(n, v8_sub(x->p, V8_SET(s->point)));
    x->p = v8_mad(x->p, r8_neg(off), n);
    x->ng = n;
}

// On a face across one axis: sides 2 axis and 2 axis + 1.
LANES_INLINE void place_side(struct real8 part, int axis, double min, double max,
                             struct real8 *p, struct real8 *n)
{
    const struct mask8 low = r8_eq(part, r8_set(2 * axis)),
                       high = r8_eq(part, r8_set(2 * axis + 1));
    *p = r8_select(low, r8_set(min), r8_select(high, r8_set(max), *p));
    *n = r8_select(low, r8_set(-1), r8_select(high, r8_set(1), r8_set(0)));
}

LANES_INLINE void place_box(const struct box *b, struct real8 part, struct place8 *x)
{
    place_side(part, 0, b->min.x, b->max.x, &x->p.x, &x->ng.x);
    place_side(part, 1, b->min.y, b->max.y, &x->p.y, &x->ng.y);
    place_side(part, 2, b->min.z, b->max.z, &x->p.z, &x->ng.z);
}

LANES_INLINE struct vec8 frame8(const struct frame *f, struct real8 x, struct real8 y,
                                struct real8 z)
{
#define FRAME_AXIS(a)                                                                    \
    r8_add(r8_add(r8_mul(r8_set(f->e1.a), x), r8_mul(r8_set(f->e2.a), y)),               \
           r8_mul(r8_set(f->e3.a), z))
    return (struct vec8){FRAME_AXIS(x), FRAME_AXIS(y), FRAME_AXIS(z)};
#undef FRAME_AXIS
}

LANES_INLINE void place_cylinder(const struct cylinder *c, struct real8 part,
                                 struct place8 *x)
{
    const struct frame *f = &c->frame;
    const struct vec8 v = v8_sub(x->p, V8_SET(f->origin));
    struct real8 qx = v8_dot(V8_SET(f->e1), v), qy = v8_dot(V8_SET(f->e2), v),
                 qz = v8_dot(V8_SET(f->e3), v);
    const struct mask8 side = r8_eq(part, r8_set(CYLINDER_SIDE)),
                       top = r8_eq(part, r8_set(CYLINDER_TOP));
    const struct real8 length = r8_sqrt(r8_add(r8_mul(qx, qx), r8_mul(qy, qy)));
    const struct mask8 off_axis = r8_lt(r8_set(0), length);
    const struct real8 ux = r8_select(off_axis, r8_div(qx, length), r8_set(1));
    const struct real8 uy = r8_select(off_axis, r8_div(qy, length), r8_set(0));
    const struct vec8 up = V8_SET(f->e3);
    x->ng = v8_select(side, frame8(f, ux, uy, r8_set(0)), v8_select(top, up, v8_neg(up)));
    x->ng = v8_normalize(x->ng);
    qx = r8_select(side, r8_mul(r8_set(c->radius), ux), qx);
    qy = r8_select(side, r8_mul(r8_set(c->radius), uy), qy);
    qz = r8_select(side, qz, r8_select(top, r8_set(c->length), r8_set(0)));
    x->p = v8_add(V8_SET(f->origin), frame8(f, qx, qy, qz));
}

// How far a transform can stretch a rounding error, as in trace/intersect.c.
static double place_stretch(const struct mat3 *m)
{
    double most = 0;
    for (int i = 0; i < 3; i++)
        most = fmax(most, fabs(m->m[i][0]) + fabs(m->m[i][1]) + fabs(m->m[i][2]));
    return most;
}

LANES_INLINE struct real8 place_error(const struct leaf *l, struct real8 size)
{
    const struct transform *t = l->transform;
    if (t->identity)
        return r8_mul(r8_set(GAMMA(32)), size);
    size = r8_add(size, r8_set(vec3_max_abs(t->offset)));
    return r8_mul(
        r8_mul(r8_set(GAMMA(32)), size),
        r8_set(fmax(1, place_stretch(&t->linear) * place_stretch(&t->inverse))));
}

// All lanes hit this leaf; false: its shape has no lanes.
LANES_INLINE bool place_leaf(const struct leaf *l, struct real8 part, struct place8 *x)
{
    const bool moved = !l->transform->identity;
    const struct shape_ops *ops = l->ops;
    if (ops != &sphere_ops && ops != &box_ops && ops != &plane_ops &&
        ops != &cylinder_ops)
        return false;
    if (moved)
        x->p = v8_row_times(v8_sub(x->p, V8_SET(l->transform->offset)),
                            &l->transform->inverse);
    if (ops == &sphere_ops) {
        const struct sphere *s = l->shape;
        place_sphere(V8_SET(s->centre), r8_set(s->radius), x);
    } else if (ops == &box_ops) {
        place_box(l->shape, part, x);
    } else if (ops == &plane_ops) {
        place_plane(l->shape, x);
    } else {
        place_cylinder(l->shape, part, x);
    }
    if (moved) {
        x->p = v8_add(v8_row_times(x->p, &l->transform->linear),
                      V8_SET(l->transform->offset));
        x->ng = v8_normalize(v8_times_column(&l->transform->inverse, x->ng));
    }
    if (l->inverted)
        x->ng = v8_neg(x->ng);
    return true;
}

// All lanes hit spheres that stand where they are written.
LANES_INLINE bool place_spheres(const struct leaf *const leaf[8], struct place8 *x)
{
    double centre[3][8], radius[8];
    unsigned inverted = 0;
    for (int i = 0; i < 8; i++) {
        if (leaf[i]->ops != &sphere_ops || !leaf[i]->transform->identity)
            return false;
        const struct sphere *s = leaf[i]->shape;
        centre[0][i] = s->centre.x;
        centre[1][i] = s->centre.y;
        centre[2][i] = s->centre.z;
        radius[i] = s->radius;
        inverted |= (unsigned)leaf[i]->inverted << i;
    }
    place_sphere(v8_load((const double(*)[8])centre), r8_load(radius), x);
    x->ng = v8_select(m8_of(inverted), v8_neg(x->ng), x->ng);
    return true;
}

// The lanes of `bits`, one after the other.
static void place_each(struct tracer *t, const struct simple_group *g, unsigned bits,
                       struct place8 *x)
{
    double p[3][8] = {{0}}, ng[3][8] = {{0}}, ns[3][8] = {{0}}, error[8] = {0};
    for (unsigned m = bits; m; m &= m - 1) {
        const int i = __builtin_ctz(m);
        const uint32_t k = g->ray[i];
        const struct ray_batch *b = t->rays;
        const struct ray ray = {{b->o[0][k], b->o[1][k], b->o[2][k]},
                                {b->d[0][k], b->d[1][k], b->d[2][k]},
                                0,
                                INFINITY};
        struct interaction at;
        const struct hit hit = hit_batch_at(t->hit, k);
        trace_interaction(t->job->world, &ray, &hit, &at);
        p[0][i] = at.p.x, p[1][i] = at.p.y, p[2][i] = at.p.z;
        ng[0][i] = at.ng.x, ng[1][i] = at.ng.y, ng[2][i] = at.ng.z;
        ns[0][i] = at.ns.x, ns[1][i] = at.ns.y, ns[2][i] = at.ns.z;
        error[i] = at.error;
        x->uv[0][i] = at.uv.u;
        x->uv[1][i] = at.uv.v;
    }
    x->p = v8_load((const double(*)[8])p);
    x->ng = v8_load((const double(*)[8])ng);
    x->ns = v8_load((const double(*)[8])ns);
    x->error = r8_load(error);
}

// What is known of the hits of a group.
struct place_rays {
    struct vec8 d;
    struct real8 dt, part;
    struct real8 size; // of the coordinates of o + t d
};

LANES_INLINE struct real8 place_error_of(const struct leaf *l, const struct place_rays *r,
                                         struct vec8 ng)
{
    return r8_add(r8_mul(r->dt, r8_abs(v8_dot(r->d, ng))), place_error(l, r->size));
}

// Leaf by leaf.
static void place_mixed(struct tracer *t, const struct leaf *const leaf[8],
                        const struct simple_group *g, const struct place_rays *r,
                        struct place8 *x)
{
    const struct vec8 p = x->p;
    for (unsigned left = 255; left;) {
        const struct leaf *l = leaf[__builtin_ctz(left)];
        struct place8 y = {.p = p};
        unsigned bits = 0;
        for (unsigned i = 0; i < 8; i++)
            bits |= (unsigned)(leaf[i] == l) << i;
        if (place_leaf(l, r->part, &y)) {
            y.ns = y.ng;
            y.error = place_error_of(l, r, y.ng);
        } else {
            place_each(t, g, bits, &y);
        }
        const struct mask8 m = m8_of(bits);
        const bool first = left == 255;
        x->p = first ? y.p : v8_select(m, y.p, x->p);
        x->ng = first ? y.ng : v8_select(m, y.ng, x->ng);
        x->ns = first ? y.ns : v8_select(m, y.ns, x->ns);
        x->error = first ? y.error : r8_select(m, y.error, x->error);
        left &= ~bits;
    }
}

#endif
