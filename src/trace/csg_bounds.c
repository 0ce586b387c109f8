// Boxes of CSG nodes (S-bounds).
#include "trace/csg_bounds.h"

#include <stdlib.h>

#include "base/memory.h"
#include "scene/shapes/plane.h"
#include "scene/shapes/quadric.h"
#include "scene/shapes/sphere.h"

static struct aabb drawn_bounds(const struct leaf *l)
{
    if (!l->drawn)
        return aabb_empty();
    if (!l->ops->surface_bounds)
        return l->bounds;
    const struct aabb s = shape_surface_bounds(l->ops, l->shape);
    return l->transform->identity || aabb_is_empty(s)
               ? s
               : aabb_pad(aabb_transform(s, l->transform));
}

// Bottom up: where the node may be inside, and where it may have drawn surfaces
// (Cameron & Yap 1992). Children come after their parents in the array.

struct boxes {
    struct aabb inside, surface;
};

// Boxes may be larger than what they hold by this share of the numbers that they come from,
// which is far above all rounding.
static const double box_slack = 0x1p-30;

// The half space that a plane's leaf keeps in the space of `t`: sum of m[a] y[a] <= d, where
// `size` is that of the numbers that d comes from.
struct half_space {
    double m[3], d, size;
};

static struct half_space half_space(const struct leaf *l, const struct transform *t)
{
    const struct plane *p = l->shape;
    const struct vec3 n = l->inverted ? vec3_neg(p->normal) : p->normal;
    struct half_space h = {.d = vec3_dot(n, vec3_sub(p->point, t->offset)),
                           .size = vec3_max_abs(p->point) + vec3_max_abs(t->offset)};
    for (int a = 0; a < 3; a++)
        h.m[a] =
            vec3_dot(n, vec3(t->linear.m[a][0], t->linear.m[a][1], t->linear.m[a][2]));
    return h;
}

static void cut_box(struct aabb *box, const struct half_space *h)
{
    const double *m = h->m;
    double least[3]; // that each term can be
    double size = h->size;
    for (int a = 0; a < 3; a++) {
        const double lo = vec3_axis(box->min, a), hi = vec3_axis(box->max, a);
        least[a] = fmin(m[a] * lo, m[a] * hi);
        size += fabs(m[a]) * fmax(fabs(lo), fabs(hi));
    }
    const double d = h->d + box_slack * size;
    double *const min[3] = {&box->min.x, &box->min.y, &box->min.z};
    double *const max[3] = {&box->max.x, &box->max.y, &box->max.z};
    for (int a = 0; a < 3; a++) {
        const double end = (d - least[(a + 1) % 3] - least[(a + 2) % 3]) / m[a];
        if (m[a] > 0)
            *max[a] = fmin(*max[a], end);
        else if (m[a] < 0)
            *min[a] = fmax(*min[a], end);
    }
}

// Cuts a box that may have no end at a plane across one of the axes. A tilt of a few
// roundings comes of turning the plane with the shape.
static void cut_across(struct aabb *box, const struct half_space *h)
{
    static const double tilt = 0x1p-46;
    const double most = fmax(fmax(fabs(h->m[0]), fabs(h->m[1])), fabs(h->m[2]));
    double *const min[3] = {&box->min.x, &box->min.y, &box->min.z};
    double *const max[3] = {&box->max.x, &box->max.y, &box->max.z};
    for (int a = 0; a < 3; a++) {
        const double m = h->m[a];
        if (!(fabs(h->m[(a + 1) % 3]) <= tilt * most &&
              fabs(h->m[(a + 2) % 3]) <= tilt * most))
            continue;
        const double end = h->d / m, slack = box_slack * (h->size / fabs(m) + fabs(end));
        if (m > 0)
            *max[a] = fmin(*max[a], end + slack);
        else
            *min[a] = fmax(*min[a], end - slack);
    }
}

// What the planes among its siblings leave of a leaf's box. They are cut off in the leaf's
// own space, since planes that were turned with a shape lie along its axes there only.
static void cut_by_planes(const struct csg_node *sibling, uint32_t count,
                          const struct leaf *leaf, const struct leaf *l,
                          struct boxes *out)
{
    enum { MOST = 16 }; // planes, so that large nodes take linear time
    struct half_space plane[MOST];
    uint32_t planes = 0;
    for (uint32_t i = 0; i < count && planes < MOST; i++)
        if (sibling[i].op == NODE_LEAF && leaf[sibling[i].leaf].ops == &plane_ops)
            plane[planes++] = half_space(&leaf[sibling[i].leaf], l->transform);
    struct aabb box = l->ops->bounds(l->shape);
    if (!planes || aabb_is_empty(box))
        return;
    if (!aabb_is_finite(box) && l->ops == &quadric_ops) {
        for (uint32_t i = 0; i < planes; i++)
            cut_across(&box, &plane[i]);
        box = quadric_bounds_within(l->shape, box, box_slack);
    }
    if (!aabb_is_finite(box))
        return;
    for (uint32_t i = 0; i < planes && !aabb_is_empty(box); i++)
        cut_box(&box, &plane[i]);
    if (!aabb_is_empty(box))
        box = aabb_pad(l->transform->identity ? box : aabb_transform(box, l->transform));
    out->inside = aabb_meet(out->inside, box);
    out->surface = aabb_meet(out->surface, box);
}

// The box of what two spheres have in common. It reaches along an axis as far as the circle in
// which they meet, or as the end of one sphere that lies in the other.
static struct aabb lens_box(const struct sphere *a, const struct sphere *b)
{
    const struct vec3 between = vec3_sub(b->centre, a->centre);
    const double dd = vec3_dot(between, between), aa = a->radius * a->radius,
                 bb = b->radius * b->radius;
    const double slack = box_slack * (aa + bb + dd);
    const double share = (dd + aa - bb) / (2 * dd); // of the way, where the circle is
    const double square = aa - share * share * dd;
    if (!(square > 0)) // one holds the other, or they are apart
        return aabb_infinite();
    const struct vec3 middle = vec3_mad(a->centre, share, between);
    double min[3], max[3];
    for (int k = 0; k < 3; k++) {
        const double way = vec3_axis(between, k);
        const double from_a = vec3_axis(a->centre, k), from_b = vec3_axis(b->centre, k),
                     at = vec3_axis(middle, k);
        const double reach = sqrt(square * fmax(0, 1 - way * way / dd) + slack);
        min[k] = at - reach;
        max[k] = at + reach;
        for (int side = -1; side <= 1; side += 2) {
            const double ra = side * a->radius, rb = side * b->radius;
            const bool a_in_b = dd - 2 * ra * way + aa <= bb + slack,
                       b_in_a = dd + 2 * rb * way + bb <= aa + slack;
            min[k] =
                fmin(min[k], fmin(a_in_b ? from_a + ra : at, b_in_a ? from_b + rb : at));
            max[k] =
                fmax(max[k], fmax(a_in_b ? from_a + ra : at, b_in_a ? from_b + rb : at));
        }
        const double more =
            box_slack * (fabs(from_a) + fabs(from_b) + a->radius + b->radius);
        min[k] -= more;
        max[k] += more;
    }
    return (struct aabb){vec3(min[0], min[1], min[2]), vec3(max[0], max[1], max[2])};
}

static const struct sphere *solid_sphere(const struct csg_node *n,
                                         const struct leaf *leaf)
{
    if (n->op != NODE_LEAF)
        return NULL;
    const struct leaf *l = &leaf[n->leaf];
    return l->ops == &sphere_ops && l->transform->identity && !l->inverted ? l->shape
                                                                           : NULL;
}

// What the spheres among its siblings leave of a sphere's box.
static void cut_by_spheres(const struct csg_node *sibling, uint32_t count,
                           const struct leaf *leaf, const struct sphere *s,
                           struct boxes *out)
{
    enum { MOST = 16 }; // spheres, so that large nodes take linear time
    uint32_t spheres = 0;
    for (uint32_t i = 0; i < count && spheres < MOST; i++) {
        const struct sphere *other = solid_sphere(&sibling[i], leaf);
        if (!other || other == s)
            continue;
        const struct aabb box = lens_box(s, other);
        out->inside = aabb_meet(out->inside, box);
        out->surface = aabb_meet(out->surface, box);
        spheres++;
    }
}

static void cut_children(const struct csg_node *child, uint32_t count,
                         const struct leaf *leaf, struct boxes *box)
{
    for (uint32_t i = 0; i < count; i++) {
        if (child[i].op != NODE_LEAF)
            continue;
        const struct leaf *l = &leaf[child[i].leaf];
        if (l->solid && !l->inverted && l->ops != &plane_ops)
            cut_by_planes(child, count, leaf, l, &box[i]);
        const struct sphere *s = solid_sphere(&child[i], leaf);
        if (s)
            cut_by_spheres(child, count, leaf, s, &box[i]);
    }
}

static void intersect_boxes(const struct csg_node *n, const struct boxes *child,
                            struct boxes *out, struct aabb *suffix)
{
    out->inside = aabb_infinite();
    out->surface = aabb_empty();
    suffix[n->child_count] = aabb_infinite();
    for (uint32_t i = n->child_count; i-- > 0;)
        suffix[i] = aabb_meet(suffix[i + 1], child[i].inside);
    for (uint32_t i = 0; i < n->child_count; i++) {
        const struct boxes *c = &child[i];
        const struct aabb others = aabb_meet(out->inside, suffix[i + 1]);
        out->surface = aabb_join(out->surface, aabb_meet(c->surface, others));
        out->inside = aabb_meet(out->inside, c->inside);
    }
}

// What takes apart a direction into shares of three normals (Cramer).
struct dual {
    struct vec3 cross[3];
    double det;
};

// How far along an axis three half spaces let a point go: if the axis is a sum of shares of
// their normals, none below 0, no further than that of their distances (weak duality of
// linear programs).
static double dual_end(const struct half_space *const h[3], const struct dual *x,
                       int axis, double sign)
{
    static const double rounding = 0x1p-40;
    double end = 0, size = 0;
    for (int i = 0; i < 3; i++) {
        const double share = sign * vec3_axis(x->cross[i], axis) / x->det;
        if (share < -rounding)
            return INFINITY;
        end += fmax(0, share) * h[i]->d;
        size += fabs(share) * h[i]->size;
    }
    return end + box_slack * size;
}

static struct vec3 normal_of(const struct half_space *h)
{
    return vec3(h->m[0], h->m[1], h->m[2]);
}

// The box of a polyhedron of planes; infinite where they enclose none. Some three planes tell
// each end of it exactly; those that are nearly parallel are not asked.
static struct aabb polyhedron_bounds(const struct half_space *plane, uint32_t count)
{
    static const double parallel = 0x1p-12;
    struct aabb box = aabb_infinite();
    double *const min[3] = {&box.min.x, &box.min.y, &box.min.z};
    double *const max[3] = {&box.max.x, &box.max.y, &box.max.z};
    for (uint32_t i = 0; i < count; i++) {
        for (uint32_t j = i + 1; j < count; j++) {
            for (uint32_t k = j + 1; k < count; k++) {
                const struct half_space *const h[3] = {plane + i, plane + j, plane + k};
                const struct vec3 a = normal_of(h[0]), b = normal_of(h[1]),
                                  c = normal_of(h[2]);
                const struct dual x = {
                    {vec3_cross(b, c), vec3_cross(c, a), vec3_cross(a, b)},
                    vec3_dot(a, vec3_cross(b, c))};
                for (int axis = 0; axis < 3 && fabs(x.det) > parallel; axis++) {
                    *max[axis] = fmin(*max[axis], dual_end(h, &x, axis, 1));
                    *min[axis] = fmax(*min[axis], -dual_end(h, &x, axis, -1));
                }
            }
        }
    }
    return box;
}

// Of an intersection that no child gives an end: what its planes enclose.
static void enclose(const struct csg_node *child, uint32_t count, const struct leaf *leaf,
                    struct boxes *out)
{
    enum { MOST = 24 }; // planes; there are 2,024 threes of them
    struct half_space plane[MOST];
    uint32_t planes = 0;
    if (aabb_is_finite(out->surface))
        return;
    for (uint32_t i = 0; i < count && planes < MOST; i++)
        if (child[i].op == NODE_LEAF && leaf[child[i].leaf].ops == &plane_ops)
            plane[planes++] = half_space(&leaf[child[i].leaf], &transform_identity);
    const struct aabb box = polyhedron_bounds(plane, planes);
    if (!aabb_is_finite(box))
        return;
    out->inside = aabb_meet(out->inside, aabb_pad(box));
    out->surface = aabb_meet(out->surface, aabb_pad(box));
}

struct aabb csg_bound(struct csg_node *node, uint32_t root, uint32_t count,
                      const struct leaf *leaf)
{
    if (node[root].op == NODE_LEAF) {
        node[root].base_inside = leaf[node[root].leaf].inverted;
        return node[root].bounds = drawn_bounds(&leaf[node[root].leaf]);
    }
    struct boxes *box = must_malloc(count - root, sizeof *box);
    struct aabb *suffix = must_malloc(count - root + 1, sizeof *suffix);
    for (uint32_t i = count; i-- > root;) {
        struct csg_node *n = &node[i];
        struct boxes *to = &box[i - root];
        struct boxes *child = n->op == NODE_LEAF ? NULL : &box[n->first_child - root];
        if (n->op == NODE_LEAF) {
            const struct leaf *l = &leaf[n->leaf];
            to->inside = l->inverted ? aabb_infinite()
                         : l->solid  ? l->bounds
                                     : aabb_empty();
            to->surface = drawn_bounds(l);
            n->base_inside = l->inverted;
        } else if (n->op == NODE_INTERSECTION) {
            cut_children(&node[n->first_child], n->child_count, leaf, child);
            intersect_boxes(n, child, to, suffix);
            enclose(&node[n->first_child], n->child_count, leaf, to);
        } else {
            *to = (struct boxes){aabb_empty(), aabb_empty()};
            for (uint32_t k = 0; k < n->child_count; k++) {
                to->inside = aabb_join(to->inside, child[k].inside);
                to->surface = aabb_join(to->surface, child[k].surface);
            }
        }
        n->bounds = to->surface;
        if (n->op != NODE_LEAF) { // inside where no leaf's box holds the point
            n->base_inside = 0;
            for (uint32_t k = 0; k < n->child_count; k++) {
                const struct csg_node *c = &node[n->first_child + k];
                n->base_inside += node_is_inside(c, c->base_inside);
            }
        }
    }
    const struct aabb surface = box[0].surface;
    free(box);
    free(suffix);
    return surface;
}
