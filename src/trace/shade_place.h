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

LANES_INLINE void place_box(const struct box *b, const uint32_t part[8], struct place8 *x)
{
    const double face[6] = {b->min.x, b->max.x, b->min.y, b->max.y, b->min.z, b->max.z};
    double p[3][8], n[3][8] = {{0}};
    v8_store(p, x->p);
    for (int i = 0; i < 8; i++) {
        p[part[i] / 2][i] = face[part[i]];
        n[part[i] / 2][i] = part[i] & 1 ? 1 : -1;
    }
    x->p = v8_load((const double(*)[8])p);
    x->ng = v8_load((const double(*)[8])n);
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

LANES_INLINE void place_cylinder(const struct cylinder *c, const uint32_t part[8],
                                 struct place8 *x)
{
    const struct frame *f = &c->frame;
    const struct vec8 v = v8_sub(x->p, V8_SET(f->origin));
    struct real8 qx = v8_dot(V8_SET(f->e1), v), qy = v8_dot(V8_SET(f->e2), v),
                 qz = v8_dot(V8_SET(f->e3), v);
    unsigned side_bits = 0, top_bits = 0;
    for (int i = 0; i < 8; i++) {
        side_bits |= (unsigned)(part[i] == CYLINDER_SIDE) << i;
        top_bits |= (unsigned)(part[i] == CYLINDER_TOP) << i;
    }
    const struct mask8 side = m8_of(side_bits), top = m8_of(top_bits);
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
LANES_INLINE bool place_leaf(const struct leaf *l, const uint32_t part[8],
                             struct place8 *x)
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
        x->p =
            v8_add(v8_row_times(x->p, &l->transform->linear), V8_SET(l->transform->offset));
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

// One lane after the other.
static void place_each(struct tracer *t, const struct simple_group *g, struct place8 *x)
{
    double p[3][8], ng[3][8], ns[3][8], error[8];
    for (int i = 0; i < 8; i++) {
        const uint32_t k = g->ray[i];
        if (i && k == g->ray[0]) { // a lane that is not live
            for (int a = 0; a < 3; a++) {
                p[a][i] = p[a][0];
                ng[a][i] = ng[a][0];
                ns[a][i] = ns[a][0];
            }
            error[i] = error[0];
            continue;
        }
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
    }
    x->p = v8_load((const double(*)[8])p);
    x->ng = v8_load((const double(*)[8])ng);
    x->ns = v8_load((const double(*)[8])ns);
    x->error = r8_load(error);
}

#endif
