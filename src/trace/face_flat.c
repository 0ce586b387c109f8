// Flat faces of boxes, planes, discs and triangles, and the ends of cylinders and cones.
#include "trace/face.h"

#include <math.h>
#include <string.h>

#include "scene/shape.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/disc.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/triangle.h"

static struct flat_face *add(struct faces *f, struct vec3 normal, uint32_t corners)
{
    struct face *x = faces_add(f);
    x->flat = true;
    x->plane.normal = normal;
    x->plane.corners = corners;
    return &x->plane;
}

// ---- faces of shapes, in their own space ----------------------------------------------

static void box_faces(const void *shape, struct faces *out)
{
    const struct box *b = shape;
    const double side[2][3] = {{b->min.x, b->min.y, b->min.z},
                               {b->max.x, b->max.y, b->max.z}};
    for (int k = 0; k < 6; k++) {
        const int axis = k >> 1, end = k & 1, u = (axis + 1) % 3, v = (axis + 2) % 3;
        double n[3] = {0}, p[3];
        n[axis] = end ? 1 : -1;
        struct flat_face *f = add(out, vec3(n[0], n[1], n[2]), 4);
        for (int c = 0; c < 4; c++) {
            p[axis] = side[end][axis];
            p[u] = side[c == 1 || c == 2][u];
            p[v] = side[c >> 1][v];
            f->corner[c] = vec3(p[0], p[1], p[2]);
        }
    }
}

static void plane_faces(const void *shape, struct faces *out)
{
    const struct plane *p = shape;
    add(out, p->normal, 0)->corner[0] = p->point;
}

// Of half the width r around a centre.
static void square(struct faces *out, struct vec3 centre, struct vec3 normal, double r)
{
    const struct frame g = frame_around(centre, normal);
    struct flat_face *f = add(out, normal, 4);
    for (int c = 0; c < 4; c++)
        f->corner[c] = vec3_add(
            centre, frame_vector(&g, c == 1 || c == 2 ? r : -r, c >> 1 ? r : -r, 0));
}

static void disc_faces(const void *shape, struct faces *out)
{
    const struct disc *d = shape;
    square(out, d->centre, d->normal, d->radius);
    out->at[out->count - 1].sheet = true;
}

static void ends(const struct frame *f, double length, double r0, double r1,
                 struct faces *out)
{
    square(out, f->origin, vec3_neg(f->e3), r0);
    square(out, vec3_mad(f->origin, length, f->e3), f->e3, r1);
}

static void cylinder_faces(const void *shape, struct faces *out)
{
    const struct cylinder *c = shape;
    if (!c->open)
        ends(&c->frame, c->length, c->radius, c->radius, out);
}

static void cone_faces(const void *shape, struct faces *out)
{
    const struct cone *c = shape;
    if (!c->open)
        ends(&c->frame, c->length, c->r0, c->r1, out);
}

static void triangle_faces(const void *shape, struct faces *out)
{
    const struct triangle *t = shape;
    if (t->degenerate)
        return;
    struct flat_face *f = add(out, t->face, 3);
    memcpy(f->corner, t->p, sizeof t->p);
    out->at[out->count - 1].sheet = true;
}

static const struct {
    const struct shape_ops *ops;
    void (*faces)(const void *shape, struct faces *out);
} kinds[] = {
    {&box_ops, box_faces},
    {&plane_ops, plane_faces},
    {&disc_ops, disc_faces},
    {&cylinder_ops, cylinder_faces},
    {&cone_ops, cone_faces},
    {&triangle_ops, triangle_faces},
    {&smooth_triangle_ops, triangle_faces},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

// ---- in the world -----------------------------------------------------------------------

// The key is made of the plane's point nearest to the origin and of the normal, whichever
// way it points: equal for faces in one plane but for some of their errors.
static void place(const struct leaf *l, struct face *x)
{
    struct flat_face *const f = &x->plane;
    const struct transform *t = l->transform;
    const uint32_t points = f->corners ? f->corners : 1;
    double size = 0;
    for (uint32_t c = 0; c < points; c++) {
        if (!t->identity)
            f->corner[c] = transform_point(t, f->corner[c]);
        size = fmax(size, vec3_max_abs(f->corner[c]));
    }
    if (!t->identity)
        f->normal = vec3_normalize(transform_normal(t, f->normal));
    if (l->inverted)
        f->normal = vec3_neg(f->normal);
    x->error = GAMMA(64) * (size + 2 * vec3_max_abs(t->offset));
    const double across = vec3_dot(f->normal, face_odd);
    x->key = vec3_dot(f->normal, f->corner[0]) * across + across * across;
}

void flat_faces(const struct leaf *l, struct faces *out)
{
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].ops == l->ops) {
            const uint32_t first = out->count;
            kinds[k].faces(l->shape, out);
            for (uint32_t i = first; i < out->count; i++)
                place(l, &out->at[i]);
            return;
        }
}

struct aabb flat_face_box(const struct flat_face *f, double error)
{
    if (!f->corners)
        return aabb_infinite();
    const struct vec3 e = vec3(error, error, error);
    struct aabb box = aabb_empty();
    for (uint32_t c = 0; c < f->corners; c++) {
        box = aabb_add(box, vec3_sub(f->corner[c], e));
        box = aabb_add(box, vec3_add(f->corner[c], e));
    }
    return box;
}

// ---- pairs ------------------------------------------------------------------------------

// Whether a line along a side of f has all of g beyond it, or no more than its edge.
static bool parted_by_side(const struct flat_face *f, const struct flat_face *g,
                           double error)
{
    for (uint32_t i = 0; i < f->corners; i++) {
        const struct vec3 a = f->corner[i], b = f->corner[(i + 1) % f->corners];
        const struct vec3 along = vec3_sub(b, a);
        const struct vec3 inward = vec3_cross(f->normal, along);
        const double length = vec3_length(inward);
        // The third corner tells which way the corners go around.
        const double sign =
            vec3_dot(inward, vec3_sub(f->corner[(i + 2) % f->corners], a)) < 0 ? -1 : 1;
        bool all = true;
        for (uint32_t k = 0; k < g->corners && all; k++)
            all = sign * vec3_dot(inward, vec3_sub(g->corner[k], a)) <= error * length;
        if (all)
            return true;
    }
    return false;
}

static bool in_plane(const struct flat_face *f, const struct flat_face *g, double error)
{
    for (uint32_t k = 0; k < (g->corners ? g->corners : 1); k++)
        if (!(fabs(vec3_dot(f->normal, vec3_sub(g->corner[k], f->corner[0]))) <= error))
            return false;
    return true;
}

bool flat_faces_coincide(const struct face *x, const struct face *y)
{
    const struct flat_face *const f = &x->plane, *const g = &y->plane;
    const double error = x->error + y->error, turn = vec3_dot(f->normal, g->normal);
    if (turn < 0 && !x->sheet && !y->sheet && !(x->clear && y->clear))
        return false;
    // Of two planes the normals themselves are compared; a finite face has its corners.
    if (!f->corners && !g->corners && !(fabs(turn) >= 1 - GAMMA(64)))
        return false;
    if (!in_plane(g->corners ? f : g, g->corners ? g : f, error))
        return false;
    if (f->corners && g->corners)
        return in_plane(g, f, error) && !parted_by_side(f, g, error) &&
               !parted_by_side(g, f, error);
    return true;
}
