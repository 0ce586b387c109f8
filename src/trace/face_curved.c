// Curved faces: of quadrics (spheres, cylinders, cones among them) by their equation, of tori
// by centre, axis and radii; all others are only known from those of the same declared shape.
#include "trace/face.h"

#include <math.h>
#include <string.h>

#include "math/gamma.h"
#include "scene/shape.h"
#include "scene/shapes/box.h"
#include "scene/shapes/cone.h"
#include "scene/shapes/cylinder.h"
#include "scene/shapes/poly.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/sphere.h"
#include "scene/shapes/torus.h"
#include "scene/shapes/triangle.h"

// ---- of shapes, in their own space ----------------------------------------------------

// x.x - turn (axis.x)^2
static void form_around(struct curved_face *f, struct vec3 axis, double turn)
{
    f->form[0] = 1 - turn * axis.x * axis.x;
    f->form[1] = 1 - turn * axis.y * axis.y;
    f->form[2] = 1 - turn * axis.z * axis.z;
    f->form[3] = -turn * axis.x * axis.y;
    f->form[4] = -turn * axis.x * axis.z;
    f->form[5] = -turn * axis.y * axis.z;
}

static void sphere_face(const void *shape, struct curved_face *f)
{
    const struct sphere *s = shape;
    f->origin = s->centre;
    form_around(f, f->origin, 0);
    f->value = -s->radius * s->radius;
}

static void cylinder_face(const void *shape, struct curved_face *f)
{
    const struct cylinder *s = shape;
    f->origin = s->frame.origin;
    form_around(f, s->frame.e3, 1);
    f->value = -s->radius * s->radius;
}

static void cone_face(const void *shape, struct curved_face *f)
{
    const struct cone *s = shape;
    f->origin = s->frame.origin;
    form_around(f, s->frame.e3, 1 + s->slope * s->slope);
    f->gradient = vec3_scale(-2 * s->r0 * s->slope, s->frame.e3);
    f->value = -s->r0 * s->r0;
}

static void quadric_face(const void *shape, struct curved_face *f)
{
    const struct quadric *s = shape;
    const double form[] = {s->xx, s->yy, s->zz, .5 * s->xy, .5 * s->xz, .5 * s->yz};
    f->origin = s->centre;
    memcpy(f->form, form, sizeof form);
    f->gradient = s->linear;
    f->value = s->constant;
}

static void torus_face(const void *shape, struct curved_face *f)
{
    const struct torus *s = shape;
    f->kind = &torus_ops;
    form_around(f, f->origin, 0);
    f->value = -s->major * s->major - s->minor * s->minor;
    f->more[0] = s->minor / (s->major + s->minor);
}

// A poly of the second order is a quadric about the origin.
static bool poly_face(const struct leaf *l, struct curved_face *f)
{
    const struct poly *s = l->shape;
    if ((l->ops != &poly_ops && l->ops != &polynomial_ops) || s->order != 2)
        return false;
    const double *c = s->coefficient; // of xx, xy, xz, x, yy, yz, y, zz, z, 1
    const double form[] = {c[0], c[4], c[7], .5 * c[1], .5 * c[2], .5 * c[5]};
    memcpy(f->form, form, sizeof form);
    f->gradient = vec3(c[3], c[6], c[8]);
    f->value = c[9];
    return true;
}

static const struct {
    const struct shape_ops *ops;
    void (*face)(const void *shape, struct curved_face *f); // NULL: it has none
} kinds[] = {
    {&sphere_ops, sphere_face}, {&cylinder_ops, cylinder_face},
    {&cone_ops, cone_face},     {&quadric_ops, quadric_face},
    {&torus_ops, torus_face},   {&box_ops, NULL},
    {&plane_ops, NULL},         {&disc_ops, NULL},
    {&triangle_ops, NULL},      {&smooth_triangle_ops, NULL},
};
enum { KINDS = sizeof kinds / sizeof *kinds };

// Whether the leaf has such a face.
static bool shape_face(const struct leaf *l, struct curved_face *f)
{
    for (int k = 0; k < KINDS; k++)
        if (kinds[k].ops == l->ops) {
            if (kinds[k].face)
                kinds[k].face(l->shape, f);
            return kinds[k].face != NULL;
        }
    if (poly_face(l, f))
        return true;
    const struct aabb box = l->ops->bounds(l->shape);
    f->kind = l->shape;
    form_around(f, f->origin, 0);
    f->value = -1;
    if (aabb_is_finite(box))
        f->own = vec3_dot(face_odd, vec3_sub(box.max, box.min));
    return true;
}

// ---- in the world -----------------------------------------------------------------------

static struct vec3 row(const struct mat3 *m, int i)
{
    return vec3(m->m[i][0], m->m[i][1], m->m[i][2]);
}

static struct vec3 times(const double form[6], struct vec3 v)
{
    return vec3(form[0] * v.x + form[3] * v.y + form[4] * v.z,
                form[3] * v.x + form[1] * v.y + form[5] * v.z,
                form[4] * v.x + form[5] * v.y + form[2] * v.z);
}

static void transform_form(const struct transform *t, double form[6])
{
    static const int place[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    double moved[6];
    for (int k = 0; k < 6; k++)
        moved[k] = vec3_dot(row(&t->inverse, place[k][0]),
                            times(form, row(&t->inverse, place[k][1])));
    memcpy(form, moved, sizeof moved);
}

// What the form does not tell: which way a torus lies, how a shape is turned.
static void place_more(const struct transform *t, double scale, struct curved_face *f)
{
    if (f->kind == &torus_ops) {
        const struct vec3 axis = transform_normal(t, vec3(0, 1, 0));
        const double turn = vec3_dot(axis, face_odd) < 0 ? -scale : scale;
        f->more[1] = turn * axis.x;
        f->more[2] = turn * axis.y;
        f->more[3] = turn * axis.z;
    } else if (f->kind)
        for (int k = 0; k < 9; k++)
            f->more[k] = scale * t->inverse.m[k / 3][k % 3];
}

// Gives the form unit size and the sign that `face_odd` says. The equation's scale means
// nothing; its size says how large coordinates are with which `more` was measured.
static bool place(const struct leaf *l, struct face *x)
{
    struct curved_face *const f = &x->curve;
    const struct transform *t = l->transform;
    if (!t->identity) {
        f->origin = transform_point(t, f->origin);
        f->gradient = transform_normal(t, f->gradient);
        transform_form(t, f->form);
    }
    double size = 0;
    for (int k = 0; k < 6; k++)
        size += (k < 3 ? 1 : 2) * f->form[k] * f->form[k];
    size = sqrt(size);
    if (!(size > 0) || !isfinite(size))
        return false;
    place_more(t, 1 / sqrt(size), f);
    x->inward = vec3_dot(face_odd, times(f->form, face_odd)) < 0;
    if (x->inward)
        size = -size;
    for (int k = 0; k < 6; k++)
        f->form[k] /= size;
    f->gradient = vec3_scale(1 / size, f->gradient);
    f->value /= size;
    return true;
}

// The equation's gradient at the world's origin, which does not depend on the face's, the
// form and the rest.
static double key_of(const struct curved_face *f)
{
    double key =
        f->own + vec3_dot(face_odd, vec3_mad(f->gradient, -2, times(f->form, f->origin)));
    for (int k = 0; k < 6; k++)
        key += f->form[k] / (k + 1.3);
    for (int k = 0; k < 9; k++)
        key += f->more[k] / (k + 1.7);
    return key;
}

static double reach_of(struct aabb b)
{
    return aabb_is_finite(b) ? fmax(vec3_max_abs(b.min), vec3_max_abs(b.max)) : 0;
}

void curved_faces(const struct leaf *l, struct faces *out)
{
    struct face *x = faces_add(out);
    if (!shape_face(l, &x->curve) || !place(l, x)) {
        out->count--;
        return;
    }
    x->sheet = !l->solid;
    x->inward ^= l->inverted;
    const double size = fmax(reach_of(l->bounds), vec3_max_abs(x->curve.origin));
    x->error = GAMMA(64) * (size + 2 * vec3_max_abs(l->transform->offset));
    x->key = key_of(&x->curve);
}

static bool nearly(const double *a, const double *b, int count)
{
    for (int k = 0; k < count; k++)
        if (!(fabs(a[k] - b[k]) <= GAMMA(1024)))
            return false;
    return true;
}

// The equation of g about f's origin is that of f, or nearly: what is taken for one place
// though it is not costs a little time, since hits tell.
bool curved_faces_coincide(const struct face *x, const struct face *y)
{
    const struct curved_face *const f = &x->curve, *const g = &y->curve;
    if (f->kind != g->kind || !nearly(f->form, g->form, 6) ||
        !nearly(f->more, g->more, 9))
        return false;
    if (x->inward != y->inward && !x->sheet && !y->sheet && !x->clear && !y->clear)
        return false;
    const struct vec3 d = vec3_sub(f->origin, g->origin), bent = times(g->form, d);
    const struct vec3 gradient = vec3_mad(g->gradient, 2, bent);
    const double value = g->value + vec3_dot(g->gradient, d) + vec3_dot(bent, d);
    const double error = 2 * (x->error + y->error), far = vec3_length(d);
    const double size =
        far + vec3_length(gradient) + sqrt(fabs(g->value)) + sqrt(fabs(f->value));
    return vec3_max_abs(vec3_sub(gradient, f->gradient)) <= error + GAMMA(1024) * size &&
           fabs(value - f->value) <= (error + GAMMA(1024) * size) * size;
}
