#ifndef TRACE_SHADE_PLACE_H
#define TRACE_SHADE_PLACE_H

// Points and normals of eight hits: trace_interaction and the shapes' `surface`, in lanes
// where all eight hit the same leaf (or are bare spheres), with the same bits.

#include "math/gamma.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/mesh.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/sphere.h"
#include "scene/shapes/torus.h"
#include "scene/shapes/triangle.h"
#include "trace/shade_kernel.h"
#include "trace/shade_lanes.h"

struct place8 {
    struct vec8 p, ng, ns;
    struct real8 error;
    double uv[2][8]; // by place_each alone
};

// What is known of the hits of a group.
struct place_rays {
    struct vec8 d;
    struct real8 dt, part;
    struct real8 size; // of the coordinates of o + t d
    const struct hit_batch *hit;
    const uint32_t *ray; // of each lane
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
    for (int i = 0; i < 3; i++) {
        const double sum = fabs(m->m[i][0]) + fabs(m->m[i][1]) + fabs(m->m[i][2]);
        most = sum > most ? sum : most; // fmax is a call
    }
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

LANES_INLINE void place_cone(const struct cone *c, struct real8 part, struct place8 *x)
{
    const struct frame *f = &c->frame;
    const struct vec8 v = v8_sub(x->p, V8_SET(f->origin));
    const struct real8 qx = v8_dot(V8_SET(f->e1), v), qy = v8_dot(V8_SET(f->e2), v);
    const struct mask8 side = r8_eq(part, r8_set(CONE_SIDE)),
                       top = r8_eq(part, r8_set(CONE_TOP));
    const struct real8 length = r8_sqrt(r8_add(r8_mul(qx, qx), r8_mul(qy, qy)));
    const struct mask8 off_axis = r8_lt(r8_set(0), length);
    const struct real8 none = r8_set(0);
    const struct real8 ux = r8_select(off_axis, r8_div(qx, length), none);
    const struct real8 uy = r8_select(off_axis, r8_div(qy, length), none);
    const struct real8 uz =
        r8_select(off_axis, r8_set(-c->slope), r8_set(c->slope > 0 ? -1 : 1));
    const struct vec8 up = V8_SET(f->e3);
    x->ng = v8_normalize(
        v8_select(side, frame8(f, ux, uy, uz), v8_select(top, up, v8_neg(up))));
}

LANES_INLINE void place_quadric(const struct quadric *s, struct place8 *x)
{
    const struct vec8 q = v8_sub(x->p, V8_SET(s->centre));
    const struct real8 half = r8_set(0.5), two = r8_set(2);
    const struct real8 xy = r8_set(s->xy), xz = r8_set(s->xz), yz = r8_set(s->yz);
    const struct vec8 mixed = {r8_add(r8_mul(xy, q.y), r8_mul(xz, q.z)),
                               r8_add(r8_mul(xy, q.x), r8_mul(yz, q.z)),
                               r8_add(r8_mul(xz, q.x), r8_mul(yz, q.y))};
    const struct vec8 m = {r8_add(r8_mul(r8_set(s->xx), q.x), r8_mul(half, mixed.x)),
                           r8_add(r8_mul(r8_set(s->yy), q.y), r8_mul(half, mixed.y)),
                           r8_add(r8_mul(r8_set(s->zz), q.z), r8_mul(half, mixed.z))};
    const struct vec8 n = v8_normalize(
        v8_add((struct vec8){r8_mul(two, m.x), r8_mul(two, m.y), r8_mul(two, m.z)},
               V8_SET(s->linear)));
    const struct mask8 tip = r8_eq(v8_dot(n, n), r8_set(0));
    x->ng = v8_select(tip, V8_SET(vec3(1, 0, 0)), n);
}

LANES_INLINE void place_torus(const struct torus *s, struct place8 *x)
{
    const struct vec8 p = x->p;
    const struct real8 none = r8_set(0);
    const struct real8 rho = r8_sqrt(r8_add(r8_mul(p.x, p.x), r8_mul(p.z, p.z)));
    const struct real8 k =
        r8_select(r8_lt(none, rho), r8_div(r8_set(s->major), rho), none);
    const struct real8 kx = r8_mul(k, p.x), kz = r8_mul(k, p.z);
    struct vec8 n = {r8_sub(p.x, kx), p.y, r8_sub(p.z, kz)};
    // on_inner_sheet
    const struct real8 half = r8_sub(r8_set(s->minor * s->minor), r8_mul(p.y, p.y));
    const struct mask8 hollow =
        m8_and(r8_lt(r8_set(s->major * s->major), half), r8_lt(r8_mul(rho, rho), half));
    n = v8_select(
        hollow,
        (struct vec8){r8_sub(r8_neg(p.x), kx), r8_neg(p.y), r8_sub(r8_neg(p.z), kz)}, n);
    const struct mask8 flat = r8_eq(v8_dot(n, n), none);
    x->ng = v8_normalize(v8_select(flat, V8_SET(vec3(0, 1, 0)), n));
}

LANES_INLINE void place_disc(const struct disc *s, struct place8 *x)
{
    const struct vec8 n = V8_SET(s->normal);
    const struct real8 off = v8_dot(n, v8_sub(x->p, V8_SET(s->centre)));
    x->p = v8_mad(x->p, r8_neg(off), n);
    x->ng = n;
}

// Sets the shading normal as well.
LANES_INLINE void place_triangle(const struct triangle *s, const struct place_rays *r,
                                 struct place8 *x)
{
    x->ng = x->ns = V8_SET(s->face);
    if (!s->smooth)
        return;
    double at[2][8];
    for (int i = 0; i < 8; i++) {
        at[0][i] = r->hit->u[r->ray[i]];
        at[1][i] = r->hit->v[r->ray[i]];
    }
    const struct real8 u = r8_load(at[0]), v = r8_load(at[1]);
    const struct real8 w = r8_sub(r8_sub(r8_set(1), u), v);
    const struct vec8 a = V8_SET(s->n[0]), b = V8_SET(s->n[1]), c = V8_SET(s->n[2]);
    const struct vec8 n = {
        r8_add(r8_mul(w, a.x), r8_add(r8_mul(u, b.x), r8_mul(v, c.x))),
        r8_add(r8_mul(w, a.y), r8_add(r8_mul(u, b.y), r8_mul(v, c.y))),
        r8_add(r8_mul(w, a.z), r8_add(r8_mul(u, b.z), r8_mul(v, c.z)))};
    x->ns = v8_select(r8_lt(r8_set(0), v8_dot(n, n)), v8_normalize(n), x->ns);
}

LANES_INLINE void place_lane(double to[3][8], int lane, struct vec3 v)
{
    to[0][lane] = v.x;
    to[1][lane] = v.y;
    to[2][lane] = v.z;
}

// The face that a lane met; what met another leaf counts as face 0.
LANES_INLINE uint32_t place_face(const struct mesh *m, const struct place_rays *r, int i)
{
    const double part = r->hit->part[r->ray[i]];
    return part >= 0 && part < m->face_count ? (uint32_t)part : 0;
}

// Shading normals of the faces that have some.
static void place_mesh_smooth(const struct mesh *m, const struct place_rays *r,
                              struct place8 *x)
{
    double n[3][3][8] = {{{0}}}, at[2][8];
    for (int i = 0; i < 8; i++) {
        const uint32_t *normal = m->face_normal[place_face(m, r, i)];
        at[0][i] = r->hit->u[r->ray[i]];
        at[1][i] = r->hit->v[r->ray[i]];
        for (int c = 0; c < 3 && normal[0] != UINT32_MAX; c++)
            place_lane(n[c], i, m->normal[normal[c]]);
    }
    const struct real8 u = r8_load(at[0]), v = r8_load(at[1]);
    const struct real8 w[3] = {r8_sub(r8_sub(r8_set(1), u), v), u, v};
    struct vec8 sum = V8_SET(vec3(0, 0, 0));
    for (int c = 0; c < 3; c++)
        sum = v8_mad(sum, w[c], v8_load((const double(*)[8])n[c]));
    x->ns = v8_select(r8_lt(r8_set(0), v8_dot(sum, sum)), v8_normalize(sum), x->ns);
}

// Sets the shading normal as well. Returns whether that is another one.
static bool place_mesh(const struct mesh *m, const struct place_rays *r, struct place8 *x)
{
    double q[3][3][8];
    for (int i = 0; i < 8; i++) {
        struct vec3 p[3];
        mesh_corners(m, place_face(m, r, i), p);
        for (int c = 0; c < 3; c++)
            place_lane(q[c], i, p[c]);
    }
    const struct vec8 o = v8_load((const double(*)[8])q[0]);
    const struct vec8 a = v8_sub(v8_load((const double(*)[8])q[2]), o),
                      b = v8_sub(v8_load((const double(*)[8])q[1]), o);
    x->ng = x->ns =
        v8_normalize((struct vec8){r8_sub(r8_mul(a.y, b.z), r8_mul(a.z, b.y)),
                                   r8_sub(r8_mul(a.z, b.x), r8_mul(a.x, b.z)),
                                   r8_sub(r8_mul(a.x, b.y), r8_mul(a.y, b.x))});
    if (m->face_normal)
        place_mesh_smooth(m, r, x);
    return m->face_normal != NULL;
}

// By the shape's own rule, one of the lanes after the other; all others become the first.
static void place_alone(const struct leaf *l, const struct place_rays *r, unsigned lanes,
                        struct place8 *x)
{
    const int first = __builtin_ctz(lanes);
    double from[3][8], p[3][8], ng[3][8], ns[3][8];
    v8_store(from, x->p);
    for (int i = first; i < 8; i++) {
        if (!(lanes >> i & 1))
            continue;
        const struct hit hit = hit_batch_at(r->hit, r->ray[i]);
        const struct vec3 at = {from[0][i], from[1][i], from[2][i]};
        struct surface_point s = {.p = at};
        l->ops->surface(l->shape, &hit.b, at, &s);
        const unsigned to = i == first ? 255 & ~(lanes & (lanes - 1)) : 1u << i;
        for (unsigned m = to; m; m &= m - 1) {
            place_lane(p, __builtin_ctz(m), s.p);
            place_lane(ng, __builtin_ctz(m), s.ng);
            place_lane(ns, __builtin_ctz(m), s.ns);
        }
    }
    x->p = v8_load((const double(*)[8])p);
    x->ng = v8_load((const double(*)[8])ng);
    x->ns = v8_load((const double(*)[8])ns);
}

// In the space of the shape, which has no more to say of lanes left out; *smooth: ns is not ng.
LANES_INLINE void place_shape(const struct leaf *l, const struct place_rays *r,
                              unsigned lanes, struct place8 *x, bool *smooth)
{
    const struct shape_ops *ops = l->ops;
    const void *shape = l->shape;
    *smooth = false;
    if (ops == &sphere_ops) {
        const struct sphere *s = shape;
        place_sphere(V8_SET(s->centre), r8_set(s->radius), x);
    } else if (ops == &box_ops) {
        place_box(shape, r->part, x);
    } else if (ops == &plane_ops) {
        place_plane(shape, x);
    } else if (ops == &cylinder_ops) {
        place_cylinder(shape, r->part, x);
    } else if (ops == &cone_ops) {
        place_cone(shape, r->part, x);
    } else if (ops == &quadric_ops) {
        place_quadric(shape, x);
    } else if (ops == &torus_ops) {
        place_torus(shape, x);
    } else if (ops == &disc_ops) {
        place_disc(shape, x);
    } else if (ops == &triangle_ops || ops == &smooth_triangle_ops) {
        place_triangle(shape, r, x);
        *smooth = ((const struct triangle *)shape)->smooth;
    } else if (ops == &mesh_ops || ops == &mesh2_ops) {
        *smooth = place_mesh(shape, r, x);
    } else {
        place_alone(l, r, lanes, x);
        *smooth = true;
    }
}

LANES_INLINE struct real8 place_error_of(const struct leaf *l, const struct place_rays *r,
                                         struct vec8 ng)
{
    return r8_add(r8_mul(r->dt, r8_abs(v8_dot(r->d, ng))), place_error(l, r->size));
}

// The lanes hit this leaf.
static void place_leaf(const struct leaf *l, const struct place_rays *r, unsigned lanes,
                       struct place8 *x)
{
    const bool moved = !l->transform->identity;
    const struct transform *m = l->transform;
    bool smooth;
    if (moved)
        x->p = v8_row_times(v8_sub(x->p, V8_SET(m->offset)), &m->inverse);
    place_shape(l, r, lanes, x, &smooth);
    if (moved) {
        x->p = v8_add(v8_row_times(x->p, &m->linear), V8_SET(m->offset));
        x->ng = v8_normalize(v8_times_column(&m->inverse, x->ng));
        if (smooth)
            x->ns = v8_normalize(v8_times_column(&m->inverse, x->ns));
    }
    if (l->inverted) {
        x->ng = v8_neg(x->ng);
        if (smooth)
            x->ns = v8_neg(x->ns);
    }
    if (!smooth)
        x->ns = x->ng;
    x->error = place_error_of(l, r, x->ng);
}

// All lanes hit spheres that stand where they are written.
LANES_INLINE bool place_spheres(const struct leaf *const leaf[8],
                                const struct place_rays *r, struct place8 *x)
{
    const double *ball[8];
    unsigned inverted = 0;
    for (int i = 0; i < 8; i++) {
        if (leaf[i]->ops != &sphere_ops || !leaf[i]->transform->identity)
            return false;
        const struct sphere *s = leaf[i]->shape;
        ball[i] = &s->centre.x;
        inverted |= (unsigned)leaf[i]->inverted << i;
    }
    struct real8 s[4];
    r8_load_rows(ball, 0, s);
    place_sphere((struct vec8){s[0], s[1], s[2]}, s[3], x);
    x->ns = x->ng = v8_select(m8_of(inverted), v8_neg(x->ng), x->ng);
    x->error = place_error_of(leaf[0], r, x->ng);
    return true;
}

// Lane by lane, with what uv_mapping sees.
static void place_each(struct tracer *t, const struct simple_group *g, struct place8 *x)
{
    double p[3][8], ng[3][8], ns[3][8], error[8];
    for (int i = 0; i < 8; i++) {
        const uint32_t k = g->ray[i];
        const struct ray ray = ray_batch_line(t->rays, k);
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

// Leaf by leaf.
static void place_mixed(const struct leaf *const leaf[8], const struct place_rays *r,
                        unsigned live, struct place8 *x)
{
    const struct vec8 p = x->p;
    for (unsigned left = 255; left;) {
        const struct leaf *l = leaf[__builtin_ctz(left)];
        struct place8 y;
        y.p = p;
        unsigned bits = 0;
        for (unsigned i = 0; i < 8; i++)
            bits |= (unsigned)(leaf[i] == l) << i;
        place_leaf(l, r, bits & live, &y); // the lanes left out are copies of the first
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
